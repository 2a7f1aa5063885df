// 3. Two frictionless discs meet in empty space. Exact: an impulse (1 + e) times the reduced mass times the closing speed,
// along the line of centers at the true moment of contact.

#include "truth/experiments/experiments.h"
#include "truth/measure.h"
#include "truth/random.h"

namespace truth {
namespace {

struct Case
{
    double mass[2];
    double radius[2];
    double restitution;
    Vec normal; ///< from disc 0 to disc 1 when they touch
    Vec velocity[2];
    double closing_speed;
    double time; ///< of the impact
};

struct Range
{
    double closing_low;
    double closing_high;
    double tangential;
};

Case draw(Random& random, const Range& range)
{
    Case c{};
    for (int i = 0; i < 2; ++i)
    {
        c.mass[i] = random.log_in(0.1, 10);
        c.radius[i] = random.in(0.1, 1);
    }
    c.restitution = random.in(0, 1);
    c.normal = direction(random.in(0, 2 * pi));
    const Vec common{random.in(-5, 5), random.in(-5, 5)};
    c.closing_speed = random.in(range.closing_low, range.closing_high);
    const double tangential = random.in(-range.tangential, range.tangential);
    const Vec relative = -c.closing_speed * c.normal + tangential * perp(c.normal);
    c.velocity[0] = common - 0.5 * relative;
    c.velocity[1] = common + 0.5 * relative;
    c.time = random.in(0.1, 0.2);
    return c;
}

struct Outcome
{
    double velocity_error;
    double momentum_error;
    double energy_error;
    bool missed;
};

Outcome judge(const Case& c, const Vec (&after)[2])
{
    const double reduced = c.mass[0] * c.mass[1] / (c.mass[0] + c.mass[1]);
    const double impulse = (1 + c.restitution) * reduced * c.closing_speed;
    const double relative_speed = length(c.velocity[1] - c.velocity[0]);
    Outcome outcome{};
    Vec momentum{};
    double energy = 0;
    double exact_energy = 0;
    for (int i = 0; i < 2; ++i)
    {
        const Vec exact = c.velocity[i] + ((i == 0 ? -1 : 1) * impulse / c.mass[i]) * c.normal;
        outcome.velocity_error = std::max(outcome.velocity_error, length(after[i] - exact) / relative_speed);
        momentum = momentum + c.mass[i] * (after[i] - c.velocity[i]);
        energy += c.mass[i] * dot(after[i], after[i]) / 2;
        exact_energy += c.mass[i] * dot(exact, exact) / 2;
    }
    outcome.momentum_error = length(momentum) / (reduced * relative_speed);
    outcome.energy_error = std::abs(energy - exact_energy) / (reduced * relative_speed * relative_speed / 2);
    outcome.missed = length(after[0] - c.velocity[0]) * c.mass[0] < 0.05 * impulse;
    return outcome;
}

Outcome collide(const Setup& setup, const Case& c)
{
    const std::unique_ptr<World> world = setup.world();
    Body discs[2];
    for (int i = 0; i < 2; ++i)
    {
        const double offset = i == 0 ? 0 : c.radius[0] + c.radius[1];
        discs[i] = world->add_body({.position = offset * c.normal - c.time * c.velocity[i], .velocity = c.velocity[i]});
        const double density = c.mass[i] / (pi * c.radius[i] * c.radius[i]);
        world->add_shape(discs[i], Disc{c.radius[i]}, {.density = density, .restitution = c.restitution});
    }
    // An engine of floats rounds what it is given; the exact answer is the one to the velocities it has.
    Case taken = c;
    for (int i = 0; i < 2; ++i)
    {
        taken.velocity[i] = world->state(discs[i]).velocity;
    }
    taken.closing_speed = dot(taken.velocity[0] - taken.velocity[1], c.normal);
    for (int step = 0; step * setup.dt() < c.time + 0.1; ++step)
    {
        world->step(setup.dt());
    }
    const Vec after[2] = {world->state(discs[0]).velocity, world->state(discs[1]).velocity};
    return judge(taken, after);
}

struct Summary
{
    Errors velocity{};
    Errors momentum{};
    Errors energy{};
    int missed = 0;
};

Summary collide_all(const Setup& setup, std::uint64_t seed, const Range& range)
{
    Random random(seed);
    Summary summary;
    for (int i = 0; i < setup.cases(200); ++i)
    {
        const Outcome outcome = collide(setup, draw(random, range));
        summary.velocity.add(outcome.velocity_error * 100);
        summary.momentum.add(outcome.momentum_error * 100);
        summary.energy.add(outcome.energy_error * 100);
        summary.missed += outcome.missed ? 1 : 0;
    }
    return summary;
}

} // namespace

Metrics two_discs(const Setup& setup)
{
    const Summary oblique = collide_all(setup, 3, {1, 10, 10});
    const Summary central = collide_all(setup, 31, {1, 10, 0});
    const Summary slow = collide_all(setup, 32, {0.1, 1, 0});
    return {{3, "oblique: velocity error, mean, %", 0, oblique.velocity.mean(), 0.05},
            {3, "oblique: velocity error, worst, %", 0, oblique.velocity.worst(), 0.5},
            {3, "oblique: missed of 200", 0, static_cast<double>(oblique.missed), 0},
            {3, "oblique: momentum error, worst, %", 0, oblique.momentum.worst(), none},
            {3, "oblique: energy error, worst, %", 0, oblique.energy.worst(), none},
            {3, "central, 1 to 10 m/s: velocity error, worst, %", 0, central.velocity.worst(), 0.001},
            {3, "central, 0.1 to 1 m/s: velocity error, worst, %", 0, slow.velocity.worst(), 0.001}};
}

} // namespace truth
