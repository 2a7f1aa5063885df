// 21. Chains of bars: swinging, held at both ends and let go, at rest, and free. Exact: energy, momentum, the force at the end.

#include "truth/experiments/bars.h"
#include "truth/experiments/experiments.h"

#include <algorithm>

namespace truth {
namespace {

constexpr double g = -earth.y;
constexpr double size = 0.5; ///< of a bar

void run(const Setup& setup, World& world, double seconds, const std::string& name)
{
    for (int step = 0; step < setup.steps(seconds); ++step)
    {
        world.step(setup.dt());
        setup.tell(name);
    }
}

void swinging(const Setup& setup, int bars, double angle, double seconds, Metrics& metrics)
{
    const std::string name = std::to_string(bars) + " bars swing from " + std::to_string(static_cast<int>(angle)) + " degrees";
    const std::unique_ptr<World> world = setup.world(earth);
    std::vector<Vec> points;
    for (int i = 0; i <= bars; ++i)
    {
        points.push_back(i * size * Vec{std::sin(radians(angle)), -std::cos(radians(angle))});
    }
    const std::vector<Bar> chain = add_chain(*world, points);
    world->add_hinge(ground, chain.front().body, {});
    const double start = energy(*world, chain, earth);
    const double swing = bars * Bar::mass * g * bars * size / 2 * (1 - std::cos(radians(angle)));
    run(setup, *world, seconds, name);
    metrics.push_back({21, name + ": energy kept after " + std::to_string(static_cast<int>(seconds)) + " s", 1,
                       1 + (energy(*world, chain, earth) - start) / swing, 0.01});
}

// A zig-zag between two walls, 0.8 of its length apart.
void let_go(const Setup& setup, int bars, Metrics& metrics)
{
    const std::string name = std::to_string(bars) + " bars held at both ends and let go";
    const std::unique_ptr<World> world = setup.world(earth);
    std::vector<Vec> points;
    for (int i = 0; i <= bars; ++i)
    {
        points.push_back({0.8 * size * i, i % 2 == 0 ? 0 : -0.6 * size});
    }
    const std::vector<Bar> chain = add_chain(*world, points);
    world->add_hinge(ground, chain.front().body, points.front());
    world->add_hinge(ground, chain.back().body, points.back());
    const double start = energy(*world, chain, earth);
    double swing = 0;
    for (int step = 0; step < setup.steps(2); ++step)
    {
        world->step(setup.dt());
        swing = std::max(swing, kinetic_energy(*world, chain));
        setup.tell(name);
    }
    metrics.push_back({21, name + ": energy kept after 2 s", 1, 1 + (energy(*world, chain, earth) - start) / swing, 0.01});
}

// The horizontal force of a chain that hangs between walls 0.8 of its length apart: bar i lies at the slope (i + 1/2 - n/2) m g / force.
double catenary_force(int bars)
{
    double low = 0;
    double high = 100 * bars * Bar::mass * g;
    for (int i = 0; i < 100; ++i)
    {
        const double force = (low + high) / 2;
        double span = 0;
        for (int k = 0; k < bars; ++k)
        {
            span += size * std::cos(std::atan((k + 0.5 - bars / 2.0) * Bar::mass * g / force));
        }
        (span < 0.8 * size * bars ? low : high) = force;
    }
    return low;
}

double mean_force(const Setup& setup, World& world, int hinge, const std::string& name)
{
    run(setup, world, 2, name);
    Vec sum{};
    const int steps = setup.steps(2);
    for (int step = 0; step < steps; ++step)
    {
        world.step(setup.dt());
        try
        {
            sum = sum + world.hinge_force(hinge);
        }
        catch (const Missing&)
        {
            return none;
        }
    }
    return length(sum) / steps;
}

void at_rest(const Setup& setup, int bars, Metrics& metrics)
{
    const std::string name = std::to_string(bars) + " bars hang between two walls";
    const double force = catenary_force(bars);
    const std::unique_ptr<World> world = setup.world(earth);
    std::vector<Vec> points{{}};
    for (int i = 0; i < bars; ++i)
    {
        points.push_back(points.back() + size * direction(std::atan((i + 0.5 - bars / 2.0) * Bar::mass * g / force)));
    }
    const std::vector<Bar> chain = add_chain(*world, points);
    world->add_hinge(ground, chain.front().body, points.front());
    world->add_hinge(ground, chain.back().body, points.back());
    const double exact = std::hypot(force, bars * Bar::mass * g / 2);
    metrics.push_back({21, name + ": force at the end, N", exact, mean_force(setup, *world, bars - 1, name), 0.01 * exact});
}

void hanging(const Setup& setup, int bars, Metrics& metrics)
{
    const std::string name = std::to_string(bars) + " bars hang";
    const std::unique_ptr<World> world = setup.world(earth);
    std::vector<Vec> points;
    for (int i = 0; i <= bars; ++i)
    {
        points.push_back({0, -size * i});
    }
    const std::vector<Bar> chain = add_chain(*world, points);
    world->add_hinge(ground, chain.front().body, {});
    const double exact = bars * Bar::mass * g;
    metrics.push_back({21, name + ": force at the end, N", exact, mean_force(setup, *world, bars - 1, name), 0.01 * exact});
}

// Nothing holds it; its last bar moves across at first.
void free_chain(const Setup& setup, int bars, Metrics& metrics)
{
    constexpr double speed = 5;
    const std::string name = std::to_string(bars) + " free bars";
    const std::unique_ptr<World> world = setup.world();
    std::vector<Bar> chain;
    for (int i = 0; i < bars; ++i)
    {
        const bool last = i + 1 == bars;
        chain.push_back(add_bar(*world, {size * i, 0}, {size * (i + 1), 0}, {0, last ? speed / 2 : 0}, last ? speed / size : 0));
        if (i > 0)
        {
            world->add_hinge(chain[chain.size() - 2].body, chain.back().body, {size * i, 0});
        }
    }
    const double start = energy(*world, chain, {});
    const double momentum = angular_momentum(*world, chain);
    run(setup, *world, 20, name);
    metrics.push_back({21, name + ": energy kept after 20 s", 1, energy(*world, chain, {}) / start, 0.01});
    metrics.push_back({21, name + ": angular momentum kept", 1, angular_momentum(*world, chain) / momentum, 0.01});
}

} // namespace

Metrics long_chains(const Setup& setup)
{
    Metrics metrics;
    for (const int bars : {5, 16, 64, 65, 129})
    {
        swinging(setup, bars, 20, 20, metrics);
    }
    for (const int bars : {2, 5, 16, 33, 65, 129})
    {
        swinging(setup, bars, 90, 20, metrics);
    }
    for (const int bars : {6, 16, 40})
    {
        let_go(setup, bars, metrics);
    }
    for (const int bars : {5, 40, 65})
    {
        at_rest(setup, bars, metrics);
        hanging(setup, bars, metrics);
    }
    for (const int bars : {2, 16, 33, 64, 65})
    {
        free_chain(setup, bars, metrics);
    }
    return metrics;
}

} // namespace truth
