// 11. A pinball flies through a sensor 50 mm wide, at rest and moving: one begin, one end, each at its time within the step.

#include "truth/experiments/experiments.h"
#include "truth/measure.h"

#include <cstdio>

namespace truth {
namespace {

constexpr double radius = 0.0135;
constexpr double width = 0.05;

struct Passage
{
    int enters = 0;
    int exits = 0;
    double time_error = none; ///< the larger one, s
};

Passage fly(const Setup& setup, double speed, bool moving, double phase)
{
    const std::unique_ptr<World> world = setup.world();
    const double way = 1 + phase * speed * setup.dt(); // until they touch
    const double share = moving ? 0.5 : 1;
    const Body gate = world->add_body({.motion = moving ? Motion::Kinematic : Motion::Static});
    world->add_shape(gate, box(width, 2), {.sensor = true});
    if (moving)
    {
        world->set_motion(gate, {-(1 - share) * speed, 0}, 0);
    }
    const Body disc = world->add_body({.position = {-width / 2 - radius - way, 0}, .velocity = {share * speed, 0}});
    world->add_shape(disc, Disc{radius}, {.density = 0.080 / (pi * radius * radius)});
    const double enter = way / speed;
    const double exit = enter + (width + 2 * radius) / speed;
    Passage passage;
    double error = 0;
    for (int step = 0; step * setup.dt() < exit + 2 * setup.dt(); ++step)
    {
        world->step(setup.dt());
        for (const Crossing& crossing : world->crossings())
        {
            ++(crossing.enter ? passage.enters : passage.exits);
            error = std::max(error, std::abs(step * setup.dt() + crossing.time - (crossing.enter ? enter : exit)));
        }
    }
    passage.time_error = world->crossing_times() ? error : none;
    return passage;
}

void series(const Setup& setup, double speed, bool moving, Metrics& metrics)
{
    const int cases = setup.cases(50);
    int enters = 0;
    int exits = 0;
    Errors time;
    for (int i = 0; i < cases; ++i)
    {
        const Passage passage = fly(setup, speed, moving, (i + 0.5) / cases);
        enters += passage.enters == 1 ? 1 : 0;
        exits += passage.exits == 1 ? 1 : 0;
        time.add(passage.time_error * 1e6);
    }
    char name[64];
    std::snprintf(name, sizeof name, "%s sensor, %g m/s: ", moving ? "moving" : "fixed", speed);
    metrics.push_back({11, name + std::string("enter seen, %"), 100, enters * 100.0 / cases, 0});
    metrics.push_back({11, name + std::string("exit seen, %"), 100, exits * 100.0 / cases, 0});
    // 10 µs: a millimeter of the way at 100 m/s, and a thousandth of the step.
    metrics.push_back({11, name + std::string("time error, worst, us"), 0, time.worst(), 10});
}

} // namespace

Metrics sensors(const Setup& setup)
{
    Metrics metrics;
    for (const double speed : {10.0, 100.0})
    {
        series(setup, speed, false, metrics);
        series(setup, speed, true, metrics);
    }
    return metrics;
}

} // namespace truth
