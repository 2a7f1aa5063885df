// 9. A cue ball meets an equal ball at rest, anywhere from full to thin. Exact: the object ball leaves along the line of
// centers, the cue ball at a right angle to it.

#include "truth/experiments/experiments.h"
#include "truth/measure.h"
#include "truth/random.h"

namespace truth {
namespace {

struct Shot
{
    bool missed = false;
    double direction_error = 0;   ///< of the object ball, rad
    double right_angle_error = 0; ///< rad
    double energy_error = 0;
};

Shot shoot(const Setup& setup, double radius, double speed, double offset, double phase)
{
    const std::unique_ptr<World> world = setup.world();
    const Material material{.restitution = 1};
    const double along = std::sqrt(4 * radius * radius - offset * offset); // between the centers when they touch
    const double way = 0.5 + phase * speed * setup.dt();
    const Body object = world->add_body({});
    const Body cue = world->add_body({.position = {-along - way, offset}, .velocity = {speed, 0}});
    world->add_shape(object, Disc{radius}, material);
    world->add_shape(cue, Disc{radius}, material);
    for (int step = 0; step * setup.dt() < way / speed + 0.1; ++step)
    {
        world->step(setup.dt());
    }
    const Vec hit = world->state(object).velocity;
    const Vec left = world->state(cue).velocity;
    return {.missed = length(hit) < 1e-6 * speed,
            .direction_error = angle_between(hit, {along, -offset}),
            .right_angle_error = std::abs(angle_between(hit, left) - pi / 2),
            .energy_error = std::abs((dot(hit, hit) + dot(left, left)) / (speed * speed) - 1)};
}

void series(const Setup& setup, const std::string& name, double radius, double speed, double bound, Metrics& metrics)
{
    setup.tell(name);
    Random random(9);
    Errors direction_error;
    Errors right_angle;
    Errors energy;
    int missed = 0;
    for (int i = 0; i < setup.cases(100); ++i)
    {
        const double offset = random.in(0.02, 0.95) * 2 * radius;
        const Shot shot = shoot(setup, radius, speed, offset, random.in(0, 1));
        if (shot.missed)
        {
            ++missed;
            continue;
        }
        direction_error.add(degrees(shot.direction_error));
        right_angle.add(degrees(shot.right_angle_error));
        energy.add(shot.energy_error * 100);
    }
    metrics.push_back({9, name + ": direction error, mean, deg", 0, direction_error.mean(), bound});
    metrics.push_back({9, name + ": missed of 100", 0, static_cast<double>(missed), 0});
    metrics.push_back({9, name + ": off the right angle, mean, deg", 0, right_angle.mean(), none});
    metrics.push_back({9, name + ": energy error, worst, %", 0, energy.worst(), none});
}

} // namespace

Metrics billiards(const Setup& setup)
{
    Metrics metrics;
    series(setup, "r 250 mm, 5 m/s", 0.25, 5, 0.01, metrics);
    series(setup, "pool ball, 5 m/s", 0.0286, 5, 0.05, metrics);
    series(setup, "pool ball, 1.5 m/s", 0.0286, 1.5, 0.05, metrics);
    return metrics;
}

} // namespace truth
