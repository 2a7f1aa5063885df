#pragma once

/// @file
/// A disc dropped on level ground: experiments 1 and 2.

#include "truth/experiment.h"
#include "truth/measure.h"

namespace truth {

struct Drop
{
    std::unique_ptr<World> world{};
    Body disc = 0;
    double radius = 0.25;

    [[nodiscard]] double height() const { return world->state(disc).position.y - radius; }
};

/// A frictionless disc with its bottom at a height above ground.
[[nodiscard]] Drop drop_disc(const Setup& setup, double height, double restitution);

/// Apex heights after each of the first bounces, from three samples around each maximum; fewer where time runs out first.
[[nodiscard]] std::vector<double> apexes(const Setup& setup, Drop& drop, int count, double seconds);

/// Times of the first impacts, s, as the engine reports them.
[[nodiscard]] std::vector<double> impact_times(const Setup& setup, Drop& drop, int count, double seconds);

} // namespace truth
