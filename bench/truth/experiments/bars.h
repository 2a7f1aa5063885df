#pragma once

/// @file
/// Bars joined by hinges, and what a motion of them must keep.

#include "truth/world.h"

#include <span>
#include <vector>

namespace truth {

/// A bar has 1 kg and a width of 50 mm. Bars pass each other.
struct Bar
{
    Body body = ground;
    double length = 0;

    static constexpr double mass = 1;
    static constexpr double width = 0.05;
    [[nodiscard]] double inertia() const { return mass * (length * length + width * width) / 12; }
};

/// From one point to another, with the velocity of its center and its spin.
Bar add_bar(World& world, Vec from, Vec to, Vec velocity = {}, double spin = 0);

/// Bars from point to point, each hinged to the next.
std::vector<Bar> add_chain(World& world, std::span<const Vec> points);

/// Kinetic and potential energy under `gravity`.
[[nodiscard]] double energy(const World& world, std::span<const Bar> bars, Vec gravity);
[[nodiscard]] double kinetic_energy(const World& world, std::span<const Bar> bars);
/// About the origin.
[[nodiscard]] double angular_momentum(const World& world, std::span<const Bar> bars);

} // namespace truth
