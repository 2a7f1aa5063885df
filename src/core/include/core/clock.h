#pragma once

// Wall time for the step report. Nothing in the simulation reads it.

#include <chrono>

namespace carom::internal {

/// Runs a stage and adds its wall time in ms.
template <class Stage>
void timed(float& elapsed_ms, const Stage& stage)
{
    const auto start = std::chrono::steady_clock::now();
    stage();
    elapsed_ms += std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace carom::internal
