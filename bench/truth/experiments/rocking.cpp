// 23. A block rocks from edge to edge (Housner 1963). Exact: each impact keeps (1 - 1.5 sin² a)² of the energy, a the angle of the diagonal, and between
// impacts it turns about its edge.

#include "truth/experiments/experiments.h"

#include <algorithm>
#include <cstdio>

namespace truth {
namespace {

double first_swing(const Setup& setup, double width, double height, double release)
{
    const std::unique_ptr<World> world = setup.world(earth);
    const Material rough{.restitution = 0, .friction = 2};
    const Body floor = world->add_body({.motion = Motion::Static});
    world->add_shape(floor, box(20, 1, {0, -0.5}), rough);
    // Turned about its left edge, which stays where it is.
    const Vec edge{-width / 2, 0};
    const Body block = world->add_body({.position = edge + rotate(release, {width / 2, height / 2}), .angle = release});
    world->add_shape(block, box(width, height), rough);
    double least = 0;
    for (int step = 0; step < setup.steps(6); ++step)
    {
        world->step(setup.dt());
        const double angle = world->state(block).angle;
        least = std::min(least, angle);
        if (least < 0 && angle > 0.5 * least && world->state(block).spin > 0)
        {
            break;
        }
    }
    return -degrees(least);
}

void measure(const Setup& setup, double width, double height, double share, Metrics& metrics)
{
    const double diagonal = std::atan(width / height);
    const double release = share * diagonal;
    const double s = std::sin(diagonal);
    const double kept = (1 - 1.5 * s * s) * (1 - 1.5 * s * s);
    const double rise = std::cos(diagonal) + kept * (std::cos(diagonal - release) - std::cos(diagonal));
    const double exact = degrees(diagonal - std::acos(rise));
    char name[80];
    std::snprintf(name, sizeof name, "block of %g x %g m from %.1f degrees: first swing, degrees", width, height,
                  degrees(release));
    metrics.push_back({23, name, exact, first_swing(setup, width, height, release), 0.03 * exact});
}

} // namespace

Metrics rocking(const Setup& setup)
{
    Metrics metrics;
    measure(setup, 0.5, 2, 0.8, metrics);
    measure(setup, 0.5, 2, 0.4, metrics);
    measure(setup, 1, 2, 0.6, metrics);
    measure(setup, 0.1, 0.4, 0.7, metrics);
    return metrics;
}

} // namespace truth
