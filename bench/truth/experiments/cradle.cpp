// 8. Newton's cradle: five equal discs in a row; the first comes, the last leaves. Then hanging, for 20 s.

#include "truth/experiments/experiments.h"

#include <algorithm>
#include <array>

namespace truth {
namespace {

constexpr std::size_t count = 5;
constexpr double radius = 0.1;
constexpr double mass = pi * radius * radius;
constexpr double inertia = mass * radius * radius / 2;
constexpr double g = -earth.y;
constexpr Material steel{.restitution = 1};

using Discs = std::array<Body, count>;

struct Row
{
    double last = 0;  ///< speed of the last disc over that of the first before
    double other = 0; ///< largest of the others'
    double energy = 0;
};

Row row(const Setup& setup, double gap)
{
    const std::unique_ptr<World> world = setup.world();
    Discs discs{};
    for (std::size_t i = 0; i < count; ++i)
    {
        const double x = static_cast<double>(i) * (2 * radius + gap);
        const bool first = i == 0;
        // The first disc's way is 0.3 m: it starts that much farther back than where it touches.
        discs[i] = world->add_body({.position = {first ? gap - 0.3 : x, 0}, .velocity = {first ? 2.0 : 0.0, 0}});
        world->add_shape(discs[i], Disc{radius}, steel);
    }
    for (int step = 0; step < setup.steps(0.5); ++step)
    {
        world->step(setup.dt());
    }
    Row result;
    for (std::size_t i = 0; i < count; ++i)
    {
        const Vec velocity = world->state(discs[i]).velocity;
        result.energy += dot(velocity, velocity) / 4;
        (i + 1 == count ? result.last : result.other) =
            i + 1 == count ? velocity.x / 2 : std::max(result.other, length(velocity) / 2);
    }
    return result;
}

struct Hanging
{
    double swing = 0;  ///< of the last disc over the release angle
    double energy = 0; ///< mean from 18 to 20 s over that at the start
};

double energy(const World& world, const Discs& discs)
{
    double sum = 0;
    for (const Body disc : discs)
    {
        const State s = world.state(disc);
        sum += (mass * dot(s.velocity, s.velocity) + inertia * s.spin * s.spin) / 2 + mass * g * (s.position.y + 1);
    }
    return sum;
}

Discs hang(World& world, double release)
{
    Discs discs{};
    for (std::size_t i = 0; i < count; ++i)
    {
        const Vec pivot{static_cast<double>(i) * 2 * radius, 0};
        const double angle = i == 0 ? -release : 0;
        discs[i] = world.add_body({.position = pivot + Vec{std::sin(angle), -std::cos(angle)}});
        world.add_shape(discs[i], Disc{radius}, steel);
        world.add_hinge(ground, discs[i], pivot);
    }
    return discs;
}

Hanging hanging(const Setup& setup)
{
    const std::unique_ptr<World> world = setup.world(earth);
    const double release = radians(20);
    const Discs discs = hang(*world, release);
    const double start = energy(*world, discs);
    const double last_pivot = static_cast<double>(count - 1) * 2 * radius;
    Hanging result;
    double sum = 0;
    for (int step = 1; step <= setup.steps(20); ++step)
    {
        world->step(setup.dt());
        const Vec at = world->state(discs.back()).position;
        if (step >= setup.steps(0.6) && step <= setup.steps(1.35))
        {
            result.swing = std::max(result.swing, std::atan2(at.x - last_pivot, -at.y) / release);
        }
        sum += step > setup.steps(18) ? energy(*world, discs) : 0;
    }
    result.energy = sum / (setup.steps(20) - setup.steps(18)) / start;
    return result;
}

} // namespace

Metrics cradle(const Setup& setup)
{
    const Row touching = row(setup, 0);
    const Row gaps = row(setup, 0.001);
    const Hanging hung = hanging(setup);
    return {{8, "touching: last disc's speed", 1, touching.last, 0.001},
            {8, "touching: largest other speed", 0, touching.other, none},
            {8, "touching: energy kept", 1, touching.energy, none},
            {8, "1 mm gaps: last disc's speed", 1, gaps.last, 0.001},
            {8, "hanging: first swing of the last disc", 1, hung.swing, none},
            {8, "hanging: energy kept after 20 s", 1, hung.energy, 0.01}};
}

} // namespace truth
