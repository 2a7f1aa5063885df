#include "truth/experiments/bars.h"

namespace truth {

Bar add_bar(World& world, Vec from, Vec to, Vec velocity, double spin)
{
    const Vec along = to - from;
    const double size = length(along);
    const Body body = world.add_body(
        {.position = 0.5 * (from + to), .angle = std::atan2(along.y, along.x), .velocity = velocity, .spin = spin});
    world.add_shape(body, box(size, Bar::width), {.density = Bar::mass / (size * Bar::width), .filter = passes_its_own});
    return {body, size};
}

std::vector<Bar> add_chain(World& world, std::span<const Vec> points)
{
    std::vector<Bar> bars;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
    {
        bars.push_back(add_bar(world, points[i], points[i + 1]));
        if (i > 0)
        {
            world.add_hinge(bars[i - 1].body, bars[i].body, points[i]);
        }
    }
    return bars;
}

double kinetic_energy(const World& world, std::span<const Bar> bars)
{
    double sum = 0;
    for (const Bar& bar : bars)
    {
        const State s = world.state(bar.body);
        sum += (Bar::mass * dot(s.velocity, s.velocity) + bar.inertia() * s.spin * s.spin) / 2;
    }
    return sum;
}

double energy(const World& world, std::span<const Bar> bars, Vec gravity)
{
    double sum = kinetic_energy(world, bars);
    for (const Bar& bar : bars)
    {
        sum -= Bar::mass * dot(gravity, world.state(bar.body).position);
    }
    return sum;
}

double angular_momentum(const World& world, std::span<const Bar> bars)
{
    double sum = 0;
    for (const Bar& bar : bars)
    {
        const State s = world.state(bar.body);
        sum += Bar::mass * cross(s.position, s.velocity) + bar.inertia() * s.spin;
    }
    return sum;
}

} // namespace truth
