// 17. Newton's cradle of any length: touching discs in a row; the first comes, the last leaves.

#include "truth/experiments/experiments.h"

#include <algorithm>
#include <vector>

namespace truth {
namespace {

constexpr double radius = 0.1;
constexpr double speed = 2;

void measure(const Setup& setup, int count, int strikers, Metrics& metrics)
{
    const std::string name = std::to_string(count) + " discs, " + std::to_string(strikers) + " strike: ";
    setup.tell(name);
    const std::unique_ptr<World> world = setup.world();
    std::vector<Body> discs;
    for (int i = 0; i < count; ++i)
    {
        const bool strikes = i < strikers;
        discs.push_back(
            world->add_body({.position = {2 * radius * i - (strikes ? 0.3 : 0), 0}, .velocity = {strikes ? speed : 0, 0}}));
        world->add_shape(discs.back(), Disc{radius}, {.restitution = 1});
    }
    for (int step = 0; step < setup.steps(0.5); ++step)
    {
        world->step(setup.dt());
    }
    double slowest = speed;
    double other = 0;
    for (int i = 0; i < count; ++i)
    {
        const Vec velocity = world->state(discs[static_cast<std::size_t>(i)]).velocity;
        if (i >= count - strikers)
        {
            slowest = std::min(slowest, velocity.x);
        }
        else
        {
            other = std::max(other, length(velocity));
        }
    }
    metrics.push_back({17, name + "speed of the slowest that leaves", 1, slowest / speed, 0.01});
    metrics.push_back({17, name + "largest other speed", 0, other / speed, 0.01});
}

} // namespace

Metrics long_rows(const Setup& setup)
{
    Metrics metrics;
    for (const int count : {2, 16, 17, 40, 100})
    {
        measure(setup, count, 1, metrics);
    }
    measure(setup, 17, 3, metrics);
    measure(setup, 40, 3, metrics);
    return metrics;
}

} // namespace truth
