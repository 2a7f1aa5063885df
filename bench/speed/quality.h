#pragma once

/// @file
/// How well a scene was simulated: measured on poses and shapes alone, the same way for every engine.

#include "speed/contestant.h"

#include <limits>

namespace speed {

/// Lengths in m. Not a number where a scene has nothing to measure.
struct Quality
{
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double mean_overlap = none;   ///< of the pairs of shapes that overlap
    double p99_overlap = none;    ///< 99 of 100 such pairs overlap less
    double worst_overlap = none;  ///<
    double worst_joint = none;    ///< distance of a hinge's two anchors
    double drift = none;          ///< of the body farthest from where it was built; scenes that are built at rest
    double residual_speed = none; ///< mean of the dynamic bodies, m/s; scenes that are built at rest
    double near_pairs = none;     ///< mean number of pairs of shapes less than 2 cm apart
    double awake = none;          ///< mean number of dynamic bodies that are awake
};

/// Takes samples of a run and sums them up.
class QualityMeter
{
public:
    /// At the start, where everything is as built.
    QualityMeter(Contestant& contestant, bool at_rest);
    void sample(Contestant& contestant);
    [[nodiscard]] Quality result() const;

private:
    void sample_overlaps(Contestant& contestant, const std::vector<truth::State>& states);
    void sample_joints(Contestant& contestant, const std::vector<truth::State>& states);
    void sample_bodies(Contestant& contestant, const std::vector<truth::State>& states);

    bool m_at_rest;
    std::vector<truth::Vec> m_built{};
    std::vector<double> m_overlaps{};
    double m_worst_joint = Quality::none;
    double m_drift = 0;
    double m_speeds = 0;
    double m_near_pairs = 0;
    double m_awake = 0;
    int m_samples = 0;
};

} // namespace speed
