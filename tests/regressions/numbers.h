#pragma once

namespace carom::test {

/// In double, as tests calculate.
constexpr double d(float x) { return static_cast<double>(x); }

/// The step of games, s.
constexpr float dt = 1.0f / 60;

} // namespace carom::test
