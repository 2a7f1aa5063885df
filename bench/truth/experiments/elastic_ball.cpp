// 1. A disc with restitution 1 falls 5 m and must come back to 5 m for ever.

#include "truth/experiments/drop.h"
#include "truth/experiments/experiments.h"
#include "truth/random.h"

namespace truth {
namespace {

/// Energy after a number of bounces over that at the start, less 1, in %.
double drift_percent(const Setup& setup, double height, int bounces)
{
    Drop drop = drop_disc(setup, height, 1);
    const double round_trip = 2 * std::sqrt(2 * height / -earth.y);
    const std::vector<double> heights = apexes(setup, drop, bounces, 1.5 * round_trip * (bounces + 1));
    return static_cast<int>(heights.size()) < bounces ? -100 : (heights.back() / height - 1) * 100;
}

} // namespace

Metrics elastic_ball(const Setup& setup)
{
    Metrics metrics;
    metrics.push_back({1, "energy drift after 60 bounces, %", 0, drift_percent(setup, 5, 60), 0.01});
    Random random(1);
    Farthest worst(0);
    for (int i = 0; i < setup.cases(20); ++i)
    {
        setup.tell("height " + std::to_string(i + 1));
        worst.add(drift_percent(setup, random.in(2, 8), 10));
    }
    metrics.push_back({1, "energy drift after 10 bounces, worst of 20 heights, %", 0, worst.value(), 0.01});
    return metrics;
}

} // namespace truth
