// 10. A pinball at up to 1000 m/s against things a centimeter thick or less, at rest and moving, in every phase of the step.

#include "truth/experiments/experiments.h"
#include "truth/measure.h"

#include <array>
#include <cstdio>

namespace truth {
namespace {

constexpr double radius = 0.0135;
constexpr double mass = 0.080;
constexpr double e = 0.5;
constexpr Material rubber{.density = mass / (pi * radius * radius), .restitution = e};
constexpr int phases = 50;

struct Target
{
    std::string name{};
    Motion motion = Motion::Static;
    Shape shape{};
    Material material{};
    double share = 1; ///< of the closing speed that the disc brings
};

std::vector<Target> targets()
{
    return {{"segment", Motion::Static, Segment{{0, -1}, {0, 1}}, {.restitution = e}, 1},
            {"static box", Motion::Static, box(0.01, 2), {.restitution = e}, 1},
            {"free bar", Motion::Dynamic, box(0.01, 0.5), {.density = 1 / (0.01 * 0.5), .restitution = e}, 1},
            {"head-on pair", Motion::Dynamic, Disc{radius}, rubber, 0.5}};
}

struct Crossed
{
    bool passed = false;
    double restitution = 0;
};

Crossed shoot(const Setup& setup, const Target& target, double speed, double phase)
{
    const std::unique_ptr<World> world = setup.world();
    const double way = 1 + phase * speed * setup.dt();
    const Body aim = world->add_body({.motion = target.motion, .velocity = {-(1 - target.share) * speed, 0}});
    world->add_shape(aim, target.shape, target.material);
    const Body disc = world->add_body({.position = {-way, 0}, .velocity = {target.share * speed, 0}});
    world->add_shape(disc, Disc{radius}, rubber);
    for (int step = 0; step * setup.dt() < way / speed + 2 * setup.dt(); ++step)
    {
        world->step(setup.dt());
    }
    const State one = world->state(disc);
    const State other = world->state(aim);
    return {!(one.position.x < other.position.x), (other.velocity.x - one.velocity.x) / speed};
}

void against(const Setup& setup, const Target& target, Metrics& metrics)
{
    Farthest worst(e);
    for (const double speed : {5.0, 20.0, 100.0, 1000.0})
    {
        int passed = 0;
        const int cases = setup.cases(phases);
        for (int i = 0; i < cases; ++i)
        {
            const Crossed crossed = shoot(setup, target, speed, (i + 0.5) / cases);
            passed += crossed.passed ? 1 : 0;
            worst.add(crossed.restitution);
        }
        char name[64];
        std::snprintf(name, sizeof name, "%s, %g m/s: passed, %%", target.name.c_str(), speed);
        metrics.push_back({10, name, 0, passed * 100.0 / cases, 0});
    }
    metrics.push_back({10, target.name + ": effective restitution, worst", e, worst.value(), 0.005});
}

// A bar 0.3 m x 1 cm turns about its end and meets the disc flat, 0.2 m from the pivot, at a known moment: along x then.
constexpr double turn_rate = 30;
constexpr double arm = 0.2;
constexpr double half_thickness = 0.005;

struct Hit
{
    Vec velocity{};
    Vec exact{};
    Vec before{};
};

Hit swing(const Setup& setup, double speed, double phase)
{
    const std::unique_ptr<World> world = setup.world();
    const Vec before{0, -speed};
    const double time = (2 + phase) * setup.dt(); // of the contact
    const Body bar = world->add_body({.motion = Motion::Kinematic, .angle = -turn_rate * time, .spin = turn_rate});
    world->add_shape(bar, box(0.3, 2 * half_thickness, {0.15, 0}), {.restitution = e});
    world->set_motion(bar, {}, turn_rate);
    const Body disc = world->add_body({.position = Vec{arm, half_thickness + radius} - time * before, .velocity = before});
    world->add_shape(disc, Disc{radius}, rubber);
    for (int step = 0; step < 5; ++step)
    {
        world->step(setup.dt());
    }
    // The bar's upper face moves straight up at the contact, and sideways without effect: nothing rubs.
    const double closing = speed + turn_rate * arm;
    return {world->state(disc).velocity, before + Vec{0, (1 + e) * closing}, before};
}

void bar(const Setup& setup, double speed, Metrics& metrics)
{
    int missed = 0;
    int wrong = 0;
    Farthest ratio(1);
    const int cases = setup.cases(phases);
    for (int i = 0; i < cases; ++i)
    {
        const Hit hit = swing(setup, speed, (i + 0.5) / cases);
        const bool miss = length(hit.velocity - hit.before) < 0.05 * length(hit.exact - hit.before);
        const double along = dot(hit.velocity, hit.exact) / dot(hit.exact, hit.exact);
        missed += miss ? 1 : 0;
        wrong += !miss && !(along >= 0.3) ? 1 : 0;
        if (!miss && along >= 0.3)
        {
            ratio.add(length(hit.velocity) / length(hit.exact));
        }
    }
    char name[64];
    std::snprintf(name, sizeof name, "turning bar, disc at %g m/s: ", speed);
    metrics.push_back({10, name + std::string("missed, %"), 0, missed * 100.0 / cases, 0});
    metrics.push_back({10, name + std::string("wrong side, %"), 0, wrong * 100.0 / cases, 0});
    metrics.push_back({10, name + std::string("speed over exact, worst"), 1, ratio.value(), 0.005});
}

} // namespace

Metrics tunneling(const Setup& setup)
{
    Metrics metrics;
    for (const Target& target : targets())
    {
        setup.tell(target.name);
        against(setup, target, metrics);
    }
    for (const double speed : {0.0, 5.0, 20.0, 100.0})
    {
        setup.tell("turning bar");
        bar(setup, speed, metrics);
    }
    return metrics;
}

} // namespace truth
