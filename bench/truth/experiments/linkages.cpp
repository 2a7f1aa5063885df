// 20. Bars in loops swing under gravity: a four-bar linkage and a slider-crank. Exact: the energy stays.

#include "truth/experiments/bars.h"
#include "truth/experiments/experiments.h"

#include <algorithm>
#include <array>

namespace truth {
namespace {

// The point at which two circles meet, on the left of the way from the first center to the second.
Vec meeting(Vec a, double from_a, Vec b, double from_b)
{
    const Vec way = b - a;
    const double d = length(way);
    const double along = (d * d + from_a * from_a - from_b * from_b) / (2 * d);
    const double off = std::sqrt(from_a * from_a - along * along);
    return a + (along / d) * way + (off / d) * perp(way);
}

std::vector<Bar> four_bar(World& world)
{
    constexpr Vec left{0, 0};
    constexpr Vec right{1, 0};
    const Vec crank = 0.4 * direction(radians(60));
    const std::array points{left, crank, meeting(crank, 0.9, right, 0.7), right};
    const std::vector<Bar> bars = add_chain(world, points);
    world.add_hinge(ground, bars.front().body, left);
    world.add_hinge(ground, bars.back().body, right);
    return bars;
}

std::vector<Bar> slider_crank(World& world)
{
    const Vec crank = 0.4 * direction(radians(80));
    const Vec pin{crank.x + std::sqrt(1 - crank.y * crank.y), 0};
    const std::array points{Vec{}, crank, pin};
    std::vector<Bar> bars = add_chain(world, points);
    world.add_hinge(ground, bars.front().body, {});
    bars.push_back(add_bar(world, pin - Vec{0.1, 0}, pin + Vec{0.1, 0}));
    world.add_hinge(bars[1].body, bars[2].body, pin);
    world.add_slider({.a = ground, .b = bars[2].body, .anchor = pin, .axis = {1, 0}});
    return bars;
}

// Over the largest kinetic energy of the first seconds; the mean of the last two.
void measure(const Setup& setup, const std::string& name, std::vector<Bar> (*make)(World&), Metrics& metrics)
{
    setup.tell(name);
    const std::unique_ptr<World> world = setup.world(earth);
    const std::vector<Bar> bars = make(*world);
    const double start = energy(*world, bars, earth);
    double swing = 0;
    double last = 0;
    for (int step = 1; step <= setup.steps(60); ++step)
    {
        world->step(setup.dt());
        swing = step <= setup.steps(5) ? std::max(swing, kinetic_energy(*world, bars)) : swing;
        last += step > setup.steps(58) ? energy(*world, bars, earth) : 0;
    }
    last /= setup.steps(60) - setup.steps(58);
    metrics.push_back({20, name + ": energy kept after 60 s", 1, 1 + (last - start) / swing, 0.01});
}

} // namespace

Metrics linkages(const Setup& setup)
{
    Metrics metrics;
    measure(setup, "four-bar linkage", four_bar, metrics);
    measure(setup, "slider-crank", slider_crank, metrics);
    return metrics;
}

} // namespace truth
