// 24. A cart on wheels stands on ice with a load of boxes. Exact: nothing pushes it sideways, so the center of mass stays.

#include "truth/experiments/experiments.h"

#include <cmath>
#include <vector>

namespace truth {
namespace {

struct Load
{
    std::vector<Body> bodies{};
    std::vector<double> masses{};

    void add(World& world, Vec at, const Shape& shape, double mass, const Material& material)
    {
        bodies.push_back(world.add_body({.position = at}));
        masses.push_back(mass);
        world.add_shape(bodies.back(), shape, material);
    }

    [[nodiscard]] double center(const World& world) const
    {
        double sum = 0;
        double all = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i)
        {
            sum += masses[i] * world.state(bodies[i]).position.x;
            all += masses[i];
        }
        return sum / all;
    }
};

Load add_cart(World& world, int boxes)
{
    constexpr double wheel = 0.3;
    constexpr double size = 0.4;
    const Material rough{.friction = 0.6};
    const Body ice = world.add_body({.motion = Motion::Static});
    world.add_shape(ice, box(200, 1, {0, -0.5}), {});
    Load load;
    load.add(world, {0, 2 * wheel}, box(4, 0.2), 0.8, rough);
    for (const double x : {-1.5, 1.5})
    {
        load.add(world, {x, wheel}, Disc{wheel}, pi * wheel * wheel, {});
        world.add_hinge(load.bodies.front(), load.bodies.back(), {x, wheel});
    }
    for (int i = 0; i < boxes; ++i)
    {
        const double x = (i % 8 - 3.5) * 1.05 * size; // NOLINT: rows of eight, each a little to one side of the one below
        load.add(world, {x + 0.05 * (i / 8), 2 * wheel + 0.1 + size * (i / 8 + 0.5)}, box(size, size), size * size,
                 rough); // NOLINT
    }
    return load;
}

void measure(const Setup& setup, int boxes, Metrics& metrics)
{
    const std::string name = "cart with " + std::to_string(boxes) + " boxes: drift in a minute, mm";
    setup.tell(name);
    const std::unique_ptr<World> world = setup.world(earth);
    const Load load = add_cart(*world, boxes);
    const double start = load.center(*world);
    for (int step = 0; step < setup.steps(60); ++step)
    {
        world->step(setup.dt());
    }
    metrics.push_back({24, name, 0, 1000 * (load.center(*world) - start), 1});
}

} // namespace

Metrics carts(const Setup& setup)
{
    Metrics metrics;
    for (const int boxes : {5, 12, 20, 60})
    {
        measure(setup, boxes, metrics);
    }
    return metrics;
}

} // namespace truth
