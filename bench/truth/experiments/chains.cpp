// 13. A chain of 50 links with a heavy disc at its end, hanging and released level: how far its hinges come apart.

#include "truth/experiments/experiments.h"

#include <algorithm>

namespace truth {
namespace {

constexpr int links = 50;
constexpr double link_length = 0.2;
constexpr double link_width = 0.04;
constexpr double weight_radius = 0.5;

struct Chain
{
    std::unique_ptr<World> world{};
    std::vector<Body> bodies{}; ///< the links, then the weight
    Vec along{};                ///< at the start
};

/// From the origin in a direction; links lie along their own x. A link is 1 kg.
Chain build(const Setup& setup, double angle, double weight)
{
    Chain chain{.world = setup.world(earth), .along = direction(angle)};
    const Material iron{.density = 1 / (link_length * link_width), .friction = 0.6, .collides = false};
    Body before = ground;
    for (int i = 0; i < links; ++i)
    {
        const Body link = chain.world->add_body({.position = (i + 0.5) * link_length * chain.along, .angle = angle});
        chain.world->add_shape(link, box(link_length, link_width), iron);
        chain.world->add_hinge(before, link, i * link_length * chain.along);
        chain.bodies.push_back(link);
        before = link;
    }
    const Vec end = links * link_length * chain.along;
    chain.bodies.push_back(chain.world->add_body({.position = end}));
    chain.world->add_shape(chain.bodies.back(), Disc{weight_radius},
                           {.density = weight / (pi * weight_radius * weight_radius), .friction = 0.6, .collides = false});
    chain.world->add_hinge(before, chain.bodies.back(), end);
    return chain;
}

double largest_gap(const Chain& chain)
{
    Vec end{0, 0};
    double largest = 0;
    for (int i = 0; i < links; ++i)
    {
        const State s = chain.world->state(chain.bodies[static_cast<std::size_t>(i)]);
        const Vec half = (link_length / 2) * direction(s.angle);
        largest = std::max(largest, length(s.position - half - end));
        end = s.position + half;
    }
    return std::max(largest, length(chain.world->state(chain.bodies.back()).position - end));
}

void hold(const Setup& setup, const std::string& name, double angle, double weight, double seconds, double bound,
          Metrics& metrics)
{
    setup.tell(name);
    const Chain chain = build(setup, angle, weight);
    double largest = 0;
    for (int step = 0; step < setup.steps(seconds); ++step)
    {
        chain.world->step(setup.dt());
        largest = std::max(largest, largest_gap(chain));
    }
    metrics.push_back({13, name + ": largest gap in a hinge, mm", 0, largest * 1000, bound});
}

} // namespace

Metrics chains(const Setup& setup)
{
    Metrics metrics;
    for (const int weight : {10, 100, 1000})
    {
        hold(setup, "hanging, weight " + std::to_string(weight), -pi / 2, weight, 10, 0.01, metrics);
    }
    hold(setup, "released level, weight 1", 0, 1, 20, none, metrics);
    hold(setup, "released level, weight 1000", 0, 1000, 20, none, metrics);
    return metrics;
}

} // namespace truth
