// 4. A box without weight flies turning onto frictionless ground and hits it with a corner. Exact: the impulse
// (1 + e) v_n / k at the corner, with k = 1/m + r_x² / I.

#include "truth/experiments/experiments.h"
#include "truth/measure.h"
#include "truth/random.h"

#include <algorithm>
#include <array>
#include <optional>

namespace truth {
namespace {

constexpr double width = 1;
constexpr double height = 0.6;
constexpr double mass = 1;
constexpr double inertia = mass * (width * width + height * height) / 12;
constexpr double e = 0.8;

constexpr std::array<Vec, 4> corners{
    {{-width / 2, -height / 2}, {width / 2, -height / 2}, {width / 2, height / 2}, {-width / 2, height / 2}}};

/// The corner that is lowest at an angle, from the center.
Vec lowest_corner(double angle)
{
    Vec lowest = rotate(angle, corners[0]);
    for (const Vec corner : corners)
    {
        const Vec turned = rotate(angle, corner);
        lowest = turned.y < lowest.y ? turned : lowest;
    }
    return lowest;
}

struct Case
{
    State at_impact{};
    double time = 0;
    double normal_speed = 0; ///< of the corner, down
    double compliance = 0;   ///< k
    State after{};           ///< exact
};

State moved(const State& state, double seconds)
{
    return {state.position + seconds * state.velocity, state.angle + seconds * state.spin, state.velocity, state.spin};
}

/// Whether the box stays clear of the ground over an interval that starts or ends with the impact.
bool clear(const State& from, double seconds)
{
    for (int i = 1; i <= 200; ++i)
    {
        const State state = moved(from, seconds * i / 200);
        if (state.position.y + lowest_corner(state.angle).y <= 0)
        {
            return false;
        }
    }
    return true;
}

/// A case in which one corner alone hits, fast enough to matter.
std::optional<Case> draw(Random& random)
{
    Case c;
    c.at_impact.angle = random.in(0, 2 * pi);
    c.at_impact.velocity = {random.in(-3, 3), -random.in(2, 6)};
    c.at_impact.spin = random.in(-5, 5);
    c.time = random.in(0.3, 0.4);
    const Vec r = lowest_corner(c.at_impact.angle);
    c.at_impact.position = {0, -r.y};
    c.normal_speed = -(c.at_impact.velocity + cross(c.at_impact.spin, r)).y;
    c.compliance = 1 / mass + r.x * r.x / inertia;
    const double impulse = (1 + e) * c.normal_speed / c.compliance;
    c.after = c.at_impact;
    c.after.velocity.y += impulse / mass;
    c.after.spin += r.x * impulse / inertia;
    const bool good = c.normal_speed > 1.5 && clear(c.at_impact, -c.time) && clear(c.after, 0.14);
    return good ? std::optional(c) : std::nullopt;
}

State fly(const Setup& setup, const Case& c)
{
    const std::unique_ptr<World> world = setup.world();
    const Material material{.density = mass / (width * height), .restitution = e};
    const Body floor = world->add_body({.motion = Motion::Static});
    world->add_shape(floor, box(200, 2, {0, -1}), material);
    const State start = moved(c.at_impact, -c.time);
    const Body body =
        world->add_body({.position = start.position, .angle = start.angle, .velocity = start.velocity, .spin = start.spin});
    world->add_shape(body, box(width, height), material);
    for (int step = 0; step * setup.dt() < c.time + 0.1; ++step)
    {
        world->step(setup.dt());
    }
    return world->state(body);
}

double energy(const State& s) { return (mass * dot(s.velocity, s.velocity) + inertia * s.spin * s.spin) / 2; }

} // namespace

Metrics box_corner(const Setup& setup)
{
    Random random(4);
    Errors linear;
    Errors angular;
    Errors energies;
    while (linear.count() < setup.cases(200))
    {
        const std::optional<Case> c = draw(random);
        if (!c)
        {
            continue;
        }
        const State got = fly(setup, *c);
        linear.add(length(got.velocity - c->after.velocity) / c->normal_speed * 100);
        angular.add(std::abs(got.spin - c->after.spin) * std::sqrt(inertia / mass) / c->normal_speed * 100);
        const double contact_energy = c->normal_speed * c->normal_speed / c->compliance / 2;
        energies.add(std::abs(energy(got) - energy(c->after)) / contact_energy * 100);
    }
    return {{4, "linear velocity error, mean, %", 0, linear.mean(), 0.3},
            {4, "angular velocity error, mean, %", 0, angular.mean(), 0.3},
            {4, "linear velocity error, worst, %", 0, linear.worst(), 3},
            {4, "angular velocity error, worst, %", 0, angular.worst(), 3},
            {4, "energy error, worst, %", 0, energies.worst(), none}};
}

} // namespace truth
