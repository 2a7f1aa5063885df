#pragma once

/// @file
/// Figures of Box2D 3.2 (development version of August 2026, Release, SSE2, 4 sub-steps, sleeping off, 1/60 s) in experiments
/// 12 and 14, measured with the same definitions: what is at rest has to be no worse than this.

namespace truth::box2d_3_2 {

inline constexpr double mass_ratio_10_penetration_mm = 3.8;
inline constexpr double mass_ratio_100_penetration_mm = 34.9;

// Three seeds of the pile.
inline constexpr double pile_mean_penetration_mm = 8.19;
inline constexpr double pile_worst_penetration_mm = 61.1;
inline constexpr double pile_rms_speed_mm = 0.0248;   ///< mm/s, over the last second
inline constexpr double pile_fastest_speed_mm = 1.97; ///< mm/s, at the end

} // namespace truth::box2d_3_2
