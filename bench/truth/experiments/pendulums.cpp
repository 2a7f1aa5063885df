// 6. A disc on a rigid arm swings from 10 and from 120 degrees; two in series swing from 120.

#include "truth/experiments/experiments.h"
#include "truth/experiments/pendulum.h"
#include "truth/measure.h"

#include <array>

namespace truth {
namespace {

constexpr double g = -earth.y;
constexpr double arm = 1;
constexpr double radius = 0.1;
constexpr double mass = 1;
constexpr double disc_inertia = mass * radius * radius / 2;

Body add_disc(World& world, Vec at)
{
    const Body disc = world.add_body({.position = at});
    world.add_shape(disc, Disc{radius}, {.density = mass / (pi * radius * radius), .filter = passes_its_own});
    return disc;
}

/// From straight down.
Vec hang(double angle) { return {arm * std::sin(angle), -arm * std::cos(angle)}; }

/// Complete elliptic integral of the first kind by the arithmetic-geometric mean.
double elliptic_k(double k)
{
    double a = 1;
    double b = std::sqrt(1 - k * k);
    while (std::abs(a - b) > 1e-15)
    {
        const double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return pi / (2 * a);
}

double exact_period(double amplitude)
{
    const double inertia = mass * arm * arm + disc_inertia;
    return 2 * pi * std::sqrt(inertia / (mass * g * arm)) * 2 / pi * elliptic_k(std::sin(amplitude / 2));
}

/// Over 20 swings, between the first and the last time it passes the lowest point to the right.
double measured_period(const Setup& setup, const std::vector<double>& angles)
{
    std::vector<double> crossings;
    for (std::size_t i = 1; i + 2 < angles.size() && crossings.size() < 21; ++i)
    {
        if (angles[i] < 0 && angles[i + 1] >= 0)
        {
            crossings.push_back(static_cast<double>(i) + crossing({angles[i - 1], angles[i], angles[i + 1], angles[i + 2]}));
        }
    }
    return crossings.size() < 21 ? none : (crossings.back() - crossings.front()) / 20 * setup.dt();
}

/// The angle at the last turning point.
double last_amplitude(const std::vector<double>& angles)
{
    for (std::size_t i = angles.size() - 2; i > 0; --i)
    {
        const double at = std::abs(angles[i]);
        if (at >= std::abs(angles[i - 1]) && at >= std::abs(angles[i + 1]))
        {
            return vertex(std::abs(angles[i - 1]), at, std::abs(angles[i + 1]));
        }
    }
    return none;
}

void single(const Setup& setup, double release_deg, double period_bound, double energy_bound, Metrics& metrics)
{
    const double release = radians(release_deg);
    const std::vector<double> angles = pendulum_angles(setup, release, 60);
    const double period = measured_period(setup, angles);
    const double kept = (1 - std::cos(last_amplitude(angles))) / (1 - std::cos(release));
    const std::string name = std::to_string(static_cast<int>(release_deg)) + " deg: ";
    metrics.push_back({6, name + "period error, %", 0, (period / exact_period(release) - 1) * 100, period_bound});
    metrics.push_back({6, name + "energy drift after 60 s, %", 0, (kept - 1) * 100, energy_bound});
}

/// Above the lowest point.
double energy(const World& world, const std::array<Body, 2>& discs)
{
    double sum = 0;
    for (std::size_t i = 0; i < 2; ++i)
    {
        const State s = world.state(discs[i]);
        sum += (mass * dot(s.velocity, s.velocity) + disc_inertia * s.spin * s.spin) / 2;
        sum += mass * g * (s.position.y + arm * static_cast<double>(i + 1));
    }
    return sum;
}

/// Mean energy of the last four of 60 s over that at the start, less 1.
double double_drift(const Setup& setup, double release)
{
    const std::unique_ptr<World> world = setup.world(earth);
    const Vec first = hang(release);
    const std::array<Body, 2> discs{add_disc(*world, first), add_disc(*world, first + hang(release))};
    world->add_hinge(ground, discs[0], {0, 0});
    world->add_hinge(discs[0], discs[1], first);
    const double start = energy(*world, discs);
    double sum = 0;
    for (int step = 0; step < setup.steps(60); ++step)
    {
        world->step(setup.dt());
        sum += step >= setup.steps(56) ? energy(*world, discs) : 0;
    }
    return sum / (setup.steps(60) - setup.steps(56)) / start - 1;
}

// The motion is chaotic: one start says little, so that twelve neighbors a tenth of a degree apart are taken.
void double_pendulum(const Setup& setup, Metrics& metrics)
{
    Errors drift;
    for (int i = 0; i < setup.cases(12); ++i)
    {
        setup.tell("double pendulum, start " + std::to_string(i + 1) + " of 12");
        drift.add(std::abs(double_drift(setup, radians(120 + 0.1 * (i - 5.5)))) * 100);
    }
    metrics.push_back({6, "double: energy drift after 60 s, mean of 12 starts, %", 0, drift.mean(), 1});
    metrics.push_back({6, "double: energy drift after 60 s, worst of 12 starts, %", 0, drift.worst(), none});
}

} // namespace

std::vector<double> pendulum_angles(const Setup& setup, double release, double seconds)
{
    const std::unique_ptr<World> world = setup.world(earth);
    const Body disc = add_disc(*world, hang(release));
    world->add_hinge(ground, disc, {0, 0});
    std::vector<double> angles{release};
    for (int step = 0; step < setup.steps(seconds); ++step)
    {
        world->step(setup.dt());
        const Vec at = world->state(disc).position;
        angles.push_back(std::atan2(at.x, -at.y));
    }
    return angles;
}

Metrics pendulums(const Setup& setup)
{
    Metrics metrics;
    single(setup, 10, none, none, metrics);
    single(setup, 120, 0.02, 0.1, metrics);
    double_pendulum(setup, metrics);
    return metrics;
}

} // namespace truth
