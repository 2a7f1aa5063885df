#pragma once

/// @file
/// How well a scene was simulated: measured on poses and shapes alone, the same way for every engine.

#include "speed/contestant.h"

#include <limits>

namespace speed {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Statistics of all samples; not a number where a scene has nothing to measure.
struct Spread
{
    double mean = none;
    double p99 = none; ///< 99 of 100 are less
    double worst = none;
};

/// Lengths in m.
struct Quality
{
    Spread overlap{};         ///< of the pairs of shapes that overlap
    Spread joint{};           ///< distance of a hinge's two anchors
    Spread drift{};           ///< of bodies from where they were built; scenes that are built at rest
    Spread speed{};           ///< of the dynamic bodies, m/s; scenes that are built at rest
    double near_pairs = none; ///< mean number of pairs of shapes less than 2 cm apart
    double awake = none;      ///< mean number of dynamic bodies that are awake, over the whole run
    double moving = none;     ///< of those whose centres are faster than they may fall asleep at, over the whole run
    double energy = none;     ///< mean kinetic energy of all of them, J
};

/// Takes samples of one run or several and sums them up.
class QualityMeter
{
public:
    explicit QualityMeter(bool at_rest) : m_at_rest(at_rest) {}
    /// At the start of a run, where everything is as built.
    void start(Contestant& contestant);
    void sample(Contestant& contestant);
    /// How many are awake and move now.
    void count(Contestant& contestant);
    [[nodiscard]] Quality result() const;
    /// Memory that it holds itself.
    [[nodiscard]] std::size_t bytes() const;

private:
    void sample_overlaps(Contestant& contestant, const std::vector<truth::State>& states);
    void sample_joints(Contestant& contestant, const std::vector<truth::State>& states);
    void sample_bodies(Contestant& contestant, const std::vector<truth::State>& states);

    bool m_at_rest;
    std::vector<truth::Vec> m_built{};
    std::vector<double> m_overlaps{};
    std::vector<double> m_joints{};
    std::vector<double> m_drifts{};
    std::vector<double> m_speeds{};
    double m_near_pairs = 0;
    double m_awake = 0;
    double m_moving = 0;
    double m_energy = 0;
    int m_samples = 0;
    int m_counts = 0;
};

} // namespace speed
