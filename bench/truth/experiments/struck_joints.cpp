// 19. Blows to what is joined: two discs on a rod fall on a floor, a bar on a free platform strikes a ball, a ball strikes a hanging chain. Exact: the
// impulse acts through the joints.

#include "truth/experiments/bars.h"
#include "truth/experiments/experiments.h"
#include "truth/measure.h"

#include <algorithm>

namespace truth {
namespace {

constexpr double disc_radius = 0.1;
constexpr double disc_mass = 1;
constexpr double density = disc_mass / (pi * disc_radius * disc_radius);
constexpr double rod = 1;

// Both discs fall with `speed`; the lower one strikes the floor `phase` of a step after the start of one.
double dumbbell_error(const Setup& setup, double angle, double e, double phase)
{
    constexpr double speed = 3;
    const std::unique_ptr<World> world = setup.world();
    const Material material{.density = density, .restitution = e};
    const Body floor = world->add_body({.motion = Motion::Static});
    world->add_shape(floor, box(20, 1, {0, -0.5}), material);
    const Vec u = direction(angle);
    const Vec low{0, disc_radius + (3 + phase) * speed * setup.dt()};
    const Body a = world->add_body({.position = low, .velocity = {0, -speed}});
    world->add_shape(a, Disc{disc_radius}, material);
    const Body b = world->add_body({.position = low + rod * u, .velocity = {0, -speed}});
    world->add_shape(b, Disc{disc_radius}, material);
    world->add_rod(a, b, rod);
    for (int step = 0; step < 5; ++step)
    {
        world->step(setup.dt());
    }
    // The discs turn freely on the rod. Flat, both strike.
    const bool flat = u.y == 0;
    const double impulse = (1 + e) * speed / ((1 - u.y * u.y / 2) / disc_mass);
    const Vec exact_center{0, flat ? e * speed : impulse / (2 * disc_mass) - speed};
    const double exact_spin = flat ? 0 : -impulse * u.x / (disc_mass * rod);
    const State sa = world->state(a);
    const State sb = world->state(b);
    const Vec at = sb.position - sa.position;
    const Vec center = 0.5 * (sa.velocity + sb.velocity);
    const double spin = cross(at, sb.velocity - sa.velocity) / dot(at, at);
    return 100 * std::max(length(center - exact_center), rod / 2 * std::abs(spin - exact_spin)) / speed;
}

void dumbbells(const Setup& setup, double e, Metrics& metrics)
{
    Errors errors;
    for (const double degree : {0.0, 10.0, 30.0, 45.0, 60.0, 80.0})
    {
        for (const double phase : {0.1, 0.4, 0.7, 0.95})
        {
            errors.add(dumbbell_error(setup, radians(degree), e, phase));
        }
    }
    const std::string name = "discs on a rod, restitution " + std::to_string(e).substr(0, 3);
    metrics.push_back({19, name + ": error of the speeds, mean, %", 0, errors.mean(), 1});
    metrics.push_back({19, name + ": worst, %", 0, errors.worst(), 3});
}

/// Change of the velocity of a body by impulses.
struct Kick
{
    double x = 0;
    double y = 0;
    double spin = 0;
};

Kick response(double mass, double inertia, Vec arm, Vec impulse)
{
    return {impulse.x / mass, impulse.y / mass, cross(arm, impulse) / inertia};
}

Vec at(const Kick& kick, Vec arm) { return Vec{kick.x, kick.y} + cross(kick.spin, arm); }

// A bar turns on a hinge of a platform that is free or does not move, and strikes a ball at rest that all but touches it.
struct Platform
{
    double mass = 0;     ///< 0: it does not move
    double strike = 0.8; ///< where on the bar, from the hinge on
};

constexpr double bar_length = 1;
constexpr double bar_spin = 5;
constexpr double ball_radius = 0.1;
constexpr double platform_side = 0.6;
constexpr Vec hinge_arm{0.2, 0.3}; ///< from the platform's center

double exact_ball_speed(const Platform& platform)
{
    const double inertia = Bar{.length = bar_length}.inertia();
    const Vec to_hinge{-bar_length / 2, 0};
    const Vec to_ball{platform.strike - bar_length / 2, Bar::width / 2};
    const Vec n{0, 1};
    // The hinge answers a unit impulse along -n on the bar by the impulse that keeps both of its sides together.
    const Kick bar = response(Bar::mass, inertia, to_ball, -n);
    const double platform_inertia = platform.mass * platform_side * platform_side / 6;
    const auto side = [&](Vec impulse) // velocity of the hinge on the bar less that on the platform
    {
        const Kick on_bar = response(Bar::mass, inertia, to_hinge, impulse);
        const Vec moved =
            platform.mass > 0 ? at(response(platform.mass, platform_inertia, hinge_arm, -impulse), hinge_arm) : Vec{};
        return at(on_bar, to_hinge) - moved;
    };
    const Vec kx = side({1, 0});
    const Vec ky = side({0, 1});
    const Vec want = -at(bar, to_hinge);
    const double det = kx.x * ky.y - ky.x * kx.y;
    const Vec held{(want.x * ky.y - ky.x * want.y) / det, (kx.x * want.y - kx.y * want.x) / det};
    const Kick by_hinge = response(Bar::mass, inertia, to_hinge, held);
    const double ball_mass = density * pi * ball_radius * ball_radius;
    const double mobility = 1 / ball_mass - dot(at(bar, to_ball) + at(by_hinge, to_ball), n);
    return 2 * bar_spin * platform.strike / mobility / ball_mass;
}

void platform(const Setup& setup, const Platform& of, const std::string& name, Metrics& metrics)
{
    const std::unique_ptr<World> world = setup.world();
    const Material elastic{.density = density, .restitution = 1};
    Body base = ground;
    if (of.mass > 0)
    {
        base = world->add_body({.position = -hinge_arm});
        world->add_shape(base, box(platform_side, platform_side),
                         {.density = of.mass / (platform_side * platform_side), .filter = passes_its_own});
    }
    const Body bar =
        world->add_body({.position = {bar_length / 2, 0}, .velocity = {0, bar_spin * bar_length / 2}, .spin = bar_spin});
    world->add_shape(bar, box(bar_length, Bar::width),
                     {.density = Bar::mass / (bar_length * Bar::width), .restitution = 1, .filter = passes_its_own});
    world->add_hinge(base, bar, {});
    const Body ball = world->add_body({.position = {of.strike, Bar::width / 2 + ball_radius + 1e-4}});
    world->add_shape(ball, Disc{ball_radius}, elastic);
    for (int step = 0; step < 3; ++step)
    {
        world->step(setup.dt());
    }
    const double exact = exact_ball_speed(of);
    metrics.push_back({19, name + ": speed of the ball, m/s", exact, length(world->state(ball).velocity), 0.01 * exact});
}

// Hanging bars, struck on the third. Exact by elimination: bars in a row have a tridiagonal system in the hinges' impulses.
double exact_chain_speed(int bars, double length, double mass, double speed, double e)
{
    const double inertia = Bar{.length = length}.inertia();
    // Across the chain, a hinge impulse p[i] between bars i - 1 and i: k p[i-1] + d p[i] + k p[i+1] = b[i].
    const double near = 1 / Bar::mass + length * length / 4 / inertia;
    const double far = 1 / Bar::mass - length * length / 4 / inertia;
    const auto n = static_cast<std::size_t>(bars);
    std::vector<double> diagonal(n, 2 * near);
    std::vector<double> right(n, 0);
    diagonal[0] = near; // to the world
    // A unit impulse on the middle of bar 2: both of its hinges would move by 1 / mass.
    right[2] = -1 / Bar::mass;
    if (bars > 3)
    {
        right[3] = 1 / Bar::mass;
    }
    // Hinge i acts with +p on bar i and -p on bar i - 1: row i is v(bar i, top) - v(bar i - 1, bottom).
    for (std::size_t i = 1; i < n; ++i)
    {
        const double f = -far / diagonal[i - 1];
        diagonal[i] += f * far;
        right[i] -= f * right[i - 1];
    }
    std::vector<double> p(n, 0);
    for (std::size_t i = n; i-- > 0;)
    {
        p[i] = (right[i] + (i + 1 < n ? far * p[i + 1] : 0)) / diagonal[i];
    }
    const double mobility = 1 / Bar::mass + (p[2] - (bars > 3 ? p[3] : 0)) / Bar::mass;
    return speed - (1 + e) * speed / (1 / mass + mobility) / mass;
}

void hanging_chain(const Setup& setup, int bars, double e, Metrics& metrics)
{
    constexpr double size = 0.5;
    constexpr double speed = 5;
    constexpr double mass = density * pi * ball_radius * ball_radius;
    const std::unique_ptr<World> world = setup.world();
    Body last = ground;
    for (int i = 0; i < bars; ++i)
    {
        const Body bar = world->add_body({.position = {0, -(i + 0.5) * size}});
        world->add_shape(bar, box(Bar::width, size),
                         {.density = Bar::mass / (size * Bar::width), .restitution = e, .filter = passes_its_own});
        world->add_hinge(last, bar, {0, -i * size});
        last = bar;
    }
    const Body ball = world->add_body({.position = {-ball_radius - Bar::width / 2 - 1e-4, -2.5 * size}, .velocity = {speed, 0}});
    world->add_shape(ball, Disc{ball_radius}, {.density = density, .restitution = e});
    world->step(setup.dt());
    world->step(setup.dt());
    const std::string name = "a ball strikes the third of " + std::to_string(bars) + " hanging bars, restitution " +
                             std::to_string(e).substr(0, 3) + ": its speed, m/s";
    metrics.push_back({19, name, exact_chain_speed(bars, size, mass, speed, e), world->state(ball).velocity.x, 0.01 * speed});
}

} // namespace

Metrics struck_joints(const Setup& setup)
{
    Metrics metrics;
    for (const double e : {0.0, 0.5, 1.0})
    {
        dumbbells(setup, e, metrics);
    }
    platform(setup, {}, "bar on a wall", metrics);
    platform(setup, {.mass = 5}, "bar on a free platform", metrics);
    platform(setup, {.mass = 0.5, .strike = 0.5}, "bar on a light platform", metrics);
    for (const int bars : {3, 5, 16, 40, 65})
    {
        hanging_chain(setup, bars, 1, metrics);
    }
    hanging_chain(setup, 5, 0.5, metrics);
    return metrics;
}

} // namespace truth
