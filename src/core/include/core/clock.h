#pragma once

// Wall time for the step report. Nothing in the simulation reads it.

#include <chrono>

namespace carom::internal {

/// Reads the clock once per stage: in a step of microseconds, readings count.
class Stopwatch
{
public:
    /// Runs a stage and adds the wall time since the end of the previous stage, in ms.
    template <class Stage>
    void time(float& elapsed_ms, const Stage& stage)
    {
        stage();
        const Clock::time_point before = m_now;
        m_now = Clock::now();
        elapsed_ms += ms_between(before, m_now);
    }

    /// Time since the construction, ms.
    [[nodiscard]] float total() const { return ms_between(m_start, Clock::now()); }

private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] static float ms_between(Clock::time_point from, Clock::time_point to)
    {
        return std::chrono::duration<float, std::milli>(to - from).count();
    }

    Clock::time_point m_start = Clock::now();
    Clock::time_point m_now = m_start;
};

} // namespace carom::internal
