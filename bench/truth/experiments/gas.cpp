// 16. Elastic discs and boxes in a vessel. Exact: the energy stays, however many they are and however dense.

#include "truth/experiments/experiments.h"
#include "truth/random.h"

#include <vector>

namespace truth {
namespace {

constexpr double radius = 0.1;
constexpr double speed = 2;
constexpr Material elastic{.restitution = 1};

void add_vessel(World& world, double side)
{
    constexpr double thick = 1;
    const Body walls = world.add_body({.motion = Motion::Static});
    for (const double sign : {-1.0, 1.0})
    {
        world.add_shape(walls, box(side + 2 * thick, thick, {0, sign * (side + thick) / 2}), elastic);
        world.add_shape(walls, box(thick, side + 2 * thick, {sign * (side + thick) / 2, 0}), elastic);
    }
}

// Pieces on a grid, with velocities of one size in all directions. A box is as large as a disc.
std::vector<Body> fill(World& world, int count, double side, bool boxes)
{
    const double edge = std::sqrt(pi) * radius;
    const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
    Random random(16);
    std::vector<Body> pieces;
    for (int i = 0; i < count; ++i)
    {
        const double cell = side / columns;
        const Vec at{(i % columns + 0.5) * cell - side / 2, (i / columns + 0.5) * cell - side / 2}; // NOLINT
        pieces.push_back(world.add_body({.position = at, .velocity = speed * direction(random.in(0, 2 * pi))}));
        if (boxes)
        {
            world.add_shape(pieces.back(), box(edge, edge), elastic);
        }
        else
        {
            world.add_shape(pieces.back(), Disc{radius}, elastic);
        }
    }
    return pieces;
}

double energy(const World& world, const std::vector<Body>& pieces, bool boxes)
{
    const double mass = pi * radius * radius;
    const double inertia = boxes ? mass * pi * radius * radius / 6 : mass * radius * radius / 2;
    double sum = 0;
    for (const Body piece : pieces)
    {
        const State s = world.state(piece);
        sum += (mass * dot(s.velocity, s.velocity) + inertia * s.spin * s.spin) / 2;
    }
    return sum;
}

void measure(const Setup& setup, int count, double filled, bool boxes, double seconds, Metrics& metrics)
{
    const std::string name = std::to_string(count) + (boxes ? " boxes" : " discs") + ", " +
                             std::to_string(static_cast<int>(100 * filled)) + " % filled: energy after " +
                             std::to_string(static_cast<int>(seconds)) + " s";
    setup.tell(name);
    const std::unique_ptr<World> world = setup.world();
    const double side = std::sqrt(count * pi * radius * radius / filled);
    add_vessel(*world, side);
    const std::vector<Body> pieces = fill(*world, count, side, boxes);
    const double before = energy(*world, pieces, boxes);
    for (int step = 0; step < setup.steps(seconds); ++step)
    {
        world->step(setup.dt());
        setup.tell(name);
    }
    metrics.push_back({16, name, 1, energy(*world, pieces, boxes) / before, 0.01});
}

} // namespace

Metrics gas(const Setup& setup)
{
    Metrics metrics;
    for (const int count : {2, 16, 17, 40, 200})
    {
        measure(setup, count, 0.3, false, 60, metrics);
    }
    measure(setup, 1000, 0.3, false, 20, metrics);
    measure(setup, 16, 0.3, true, 60, metrics);
    measure(setup, 17, 0.3, true, 60, metrics);
    measure(setup, 200, 0.3, true, 20, metrics);
    measure(setup, 100, 0.7, false, 20, metrics);
    measure(setup, 100, 0.5, true, 20, metrics);
    return metrics;
}

} // namespace truth
