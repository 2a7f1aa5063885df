// 18. A pool shot beside balls that nobody touches. Exact: the object ball leaves along the line of centers, as without them.

#include "truth/experiments/experiments.h"
#include "truth/measure.h"
#include "truth/random.h"

namespace truth {
namespace {

constexpr double radius = 0.0286;
constexpr Material ivory{.restitution = 1};

void add_ball(World& world, Vec at) { world.add_shape(world.add_body({.position = at}), Disc{radius}, ivory); }

// Two rows along the cue ball's way, a millimeter from it and from each other, so that the whole crowd may come to touch.
void add_lane(World& world, int count, Vec end)
{
    for (int i = 0; i < count; ++i)
    {
        add_ball(world, end + Vec{-(i / 2) * (2 * radius + 0.001), (i % 2 == 0 ? 1 : -1) * (2 * radius + 0.001)}); // NOLINT
    }
}

// A rack of balls that touch each other, far away.
void add_rack(World& world, int count)
{
    for (int i = 0; i < count; ++i)
    {
        add_ball(world, {5 + 2 * radius * (i % 20), 2 * radius * (i / 20)}); // NOLINT
    }
}

double shot_error(const Setup& setup, double speed, double cut, double phase, int count, bool beside)
{
    const std::unique_ptr<World> world = setup.world();
    const double along = 2 * radius * std::cos(cut);
    const double off = 2 * radius * std::sin(cut);
    const double way = 0.2 + phase * speed * setup.dt();
    const Body object = world->add_body({});
    world->add_shape(object, Disc{radius}, ivory);
    const Body cue = world->add_body({.position = {-along - way, off}, .velocity = {speed, 0}});
    world->add_shape(cue, Disc{radius}, ivory);
    beside ? add_lane(*world, count, {-along - 5 * radius, off}) : add_rack(*world, count);
    for (int step = 0; step < setup.steps(way / speed) + 2; ++step)
    {
        world->step(setup.dt());
    }
    const Vec hit = world->state(object).velocity;
    return length(hit) < 1e-6 * speed ? 180 : degrees(angle_between(hit, {along, -off}));
}

void series(const Setup& setup, int count, bool beside, Metrics& metrics)
{
    const std::string name = std::to_string(count) + (beside ? " beside the way" : " far away") + ": direction error, worst, deg";
    setup.tell(name);
    Random random(18);
    Errors errors;
    for (int i = 0; i < setup.cases(count > 100 ? 10 : 40); ++i)
    {
        errors.add(shot_error(setup, random.in(1, 2), radians(random.in(5, 40)), random.in(0, 1), count, beside));
    }
    metrics.push_back({18, name, 0, errors.worst(), 0.1});
}

} // namespace

Metrics spectators(const Setup& setup)
{
    Metrics metrics;
    for (const int count : {0, 14, 15, 50, 500})
    {
        series(setup, count, true, metrics);
    }
    series(setup, 15, false, metrics);
    series(setup, 500, false, metrics);
    return metrics;
}

} // namespace truth
