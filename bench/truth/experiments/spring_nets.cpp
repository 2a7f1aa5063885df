// 22. Masses joined by stiff springs, and a slider between elastic limits. Exact: the energy stays.

#include "truth/experiments/experiments.h"

#include <cstdio>
#include <vector>

namespace truth {
namespace {

constexpr double radius = 0.05;

struct Net
{
    struct Thread
    {
        Body a;
        Body b;
        double length;
    };
    std::vector<Body> masses{};
    std::vector<Thread> threads{};
    double stiffness = 0;
};

Body add_mass(World& world, Vec at, bool moves)
{
    const Body body = world.add_body({.motion = moves ? Motion::Dynamic : Motion::Static, .position = at});
    world.add_shape(body, Disc{radius}, {.density = 1 / (pi * radius * radius), .filter = passes_its_own});
    return body;
}

void join(World& world, Net& net, Body a, Body b)
{
    const double distance = length(world.state(a).position - world.state(b).position);
    // At first a tenth too short.
    net.threads.push_back({a, b, 1.1 * distance});
    world.add_spring(a, b, 1.1 * distance, net.stiffness, 0);
}

// Five masses in a row between two walls, along the row or, where they may leave it, a little off it.
Net row(World& world, double stiffness)
{
    Net net{.stiffness = stiffness};
    Body last = add_mass(world, {0, 0}, false);
    for (int i = 1; i <= 5; ++i)
    {
        net.masses.push_back(add_mass(world, {static_cast<double>(i), i % 2 == 0 ? 0.2 : -0.1}, true));
        join(world, net, last, net.masses.back());
        last = net.masses.back();
    }
    join(world, net, last, add_mass(world, {6, 0}, false));
    return net;
}

// A free truss of triangles.
Net truss(World& world, double stiffness)
{
    Net net{.stiffness = stiffness};
    for (int i = 0; i < 5; ++i)
    {
        net.masses.push_back(add_mass(world, {0.5 * i, i % 2 == 0 ? 0 : 0.9}, true));
        for (int k = 1; k <= 2 && k <= i; ++k)
        {
            join(world, net, net.masses[static_cast<std::size_t>(i - k)], net.masses.back());
        }
    }
    return net;
}

double energy(const World& world, const Net& net)
{
    double sum = 0;
    for (const Body mass : net.masses)
    {
        const Vec velocity = world.state(mass).velocity;
        sum += dot(velocity, velocity) / 2;
    }
    for (const Net::Thread& thread : net.threads)
    {
        const double stretched = length(world.state(thread.a).position - world.state(thread.b).position) - thread.length;
        sum += net.stiffness * stretched * stretched / 2;
    }
    return sum;
}

void measure(const Setup& setup, const char* what, Net (*make)(World&, double), double stiffness, Metrics& metrics)
{
    char name[80];
    std::snprintf(name, sizeof name, "%s of %g N/m: energy kept after 60 s", what, stiffness);
    setup.tell(name);
    const std::unique_ptr<World> world = setup.world();
    const Net net = make(*world, stiffness);
    const double start = energy(*world, net);
    for (int step = 0; step < setup.steps(60); ++step)
    {
        world->step(setup.dt());
    }
    metrics.push_back({22, name, 1, energy(*world, net) / start, 0.01});
}

void slider(const Setup& setup, Metrics& metrics)
{
    constexpr double speed = 2;
    const std::unique_ptr<World> world = setup.world();
    const Body mass = world->add_body({.velocity = {speed, 0}});
    world->add_shape(mass, Disc{radius}, {});
    world->add_slider({.a = ground, .b = mass, .limited = true, .lower = -0.5, .upper = 0.7, .restitution = 1});
    for (int step = 0; step < setup.steps(20); ++step)
    {
        world->step(setup.dt());
    }
    const Vec velocity = world->state(mass).velocity;
    metrics.push_back(
        {22, "slider between elastic limits: energy kept after 20 s", 1, dot(velocity, velocity) / (speed * speed), 0.02});
}

} // namespace

Metrics spring_nets(const Setup& setup)
{
    Metrics metrics;
    for (const double stiffness : {1e3, 1e4, 1e5})
    {
        measure(setup, "row between walls", row, stiffness, metrics);
        measure(setup, "free truss", truss, stiffness, metrics);
    }
    slider(setup, metrics);
    return metrics;
}

} // namespace truth
