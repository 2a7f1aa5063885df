// 7. A mass on a spring. Every linear integrator's samples obey x[k+1] = A x[k] - B x[k-1]; A and B give frequency and damping.

#include "truth/experiments/experiments.h"

#include <cstdio>

namespace truth {
namespace {

struct Vibration
{
    double damping_ratio = none;
    double frequency = none; ///< of the damped vibration, Hz
};

std::vector<double> displacements(const Setup& setup, double frequency, double damping_ratio)
{
    const std::unique_ptr<World> world = setup.world();
    const double omega = 2 * pi * frequency;
    const double radius = 0.1;
    const Body anchor = world->add_body({.motion = Motion::Static});
    const Body mass = world->add_body({.position = {1.1, 0}});
    world->add_shape(mass, Disc{radius}, {.density = 1 / (pi * radius * radius)});
    world->add_spring(anchor, mass, 1, omega * omega, 2 * damping_ratio * omega);
    std::vector<double> x{0.1};
    for (int step = 0; step < setup.steps(damping_ratio > 0 ? 2 / frequency : 10); ++step)
    {
        world->step(setup.dt());
        x.push_back(world->state(mass).position.x - 1);
    }
    return x;
}

/// Least squares over all samples.
Vibration fit(const Setup& setup, const std::vector<double>& x)
{
    double pp = 0;
    double pq = 0;
    double qq = 0;
    double np = 0;
    double nq = 0;
    for (std::size_t k = 1; k + 1 < x.size(); ++k)
    {
        pp += x[k] * x[k];
        pq += x[k] * x[k - 1];
        qq += x[k - 1] * x[k - 1];
        np += x[k + 1] * x[k];
        nq += x[k + 1] * x[k - 1];
    }
    const double determinant = pp * qq - pq * pq;
    const double a = (np * qq - nq * pq) / determinant;
    const double b = -(nq * pp - np * pq) / determinant;
    const double decay = -std::log(b) / (2 * setup.dt());
    const double damped = std::acos(a / (2 * std::sqrt(b))) / setup.dt();
    return {decay / std::hypot(decay, damped), damped / (2 * pi)};
}

void measure(const Setup& setup, double frequency, double damping_ratio, double damping_bound, double frequency_bound,
             Metrics& metrics)
{
    const Vibration got = fit(setup, displacements(setup, frequency, damping_ratio));
    const double exact = frequency * std::sqrt(1 - damping_ratio * damping_ratio);
    char name[64];
    std::snprintf(name, sizeof name, "%g Hz, damping ratio %g: ", frequency, damping_ratio);
    metrics.push_back({7, name + std::string("damping ratio"), damping_ratio, got.damping_ratio, damping_bound});
    metrics.push_back({7, name + std::string("frequency error, %"), 0, (got.frequency / exact - 1) * 100, frequency_bound});
}

} // namespace

Metrics springs(const Setup& setup)
{
    Metrics metrics;
    measure(setup, 1, 0, 1e-5, none, metrics);
    measure(setup, 5, 0, 1e-5, none, metrics);
    measure(setup, 1, 0.1, none, none, metrics);
    measure(setup, 5, 0.2, 0.001, 0.1, metrics);
    return metrics;
}

} // namespace truth
