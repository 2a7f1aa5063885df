#include "truth/experiments/drop.h"

namespace truth {

Drop drop_disc(const Setup& setup, double height, double restitution)
{
    Drop drop{.world = setup.world(earth)};
    const Material material{.restitution = restitution};
    const Body floor = drop.world->add_body({.motion = Motion::Static});
    drop.world->add_shape(floor, box(200, 2, {0, -1}), material);
    drop.disc = drop.world->add_body({.position = {0, height + drop.radius}});
    drop.world->add_shape(drop.disc, Disc{drop.radius}, material);
    return drop;
}

std::vector<double> apexes(const Setup& setup, Drop& drop, int count, double seconds)
{
    std::vector<double> found;
    double before = drop.height();
    double at = before;
    for (int step = 0; step < setup.steps(seconds) && static_cast<int>(found.size()) < count; ++step)
    {
        drop.world->step(setup.dt());
        const double after = drop.height();
        if (before < at && at >= after)
        {
            found.push_back(vertex(before, at, after));
        }
        before = at;
        at = after;
    }
    return found;
}

std::vector<double> impact_times(const Setup& setup, Drop& drop, int count, double seconds)
{
    std::vector<double> times;
    for (int step = 0; step < setup.steps(seconds) && static_cast<int>(times.size()) < count; ++step)
    {
        drop.world->step(setup.dt());
        for (const Impact& impact : drop.world->impacts())
        {
            times.push_back(step * setup.dt() + impact.time);
        }
    }
    return times;
}

} // namespace truth
