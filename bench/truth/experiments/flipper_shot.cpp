// 15. A flipper, as a kinematic bar that turns from rest position to its end at constant speed, meets a resting pinball at any
// moment of a step. The shot must not depend on that moment.

#include "truth/experiments/experiments.h"
#include "truth/experiments/flipper.h"
#include "truth/measure.h"

#include <algorithm>
#include <cstdio>

namespace truth {
namespace {

const double gravity = 9.81 * std::sin(radians(6.5));
constexpr double bar_length = 0.076;
constexpr double half_thickness = 0.005;
constexpr double turn_rate = 30;
const double meets = radians(-25);
const double stops = radians(25);
constexpr double radius = 0.0135;
constexpr double mass = 0.080;
constexpr double arm = 0.060;
constexpr double duration = 0.12;

Vec ball_start() { return rotate(meets, {arm, half_thickness + radius}); }

/// Speed for the next step: the last one is slowed so that the bar stops exactly at its end.
double next_spin(double angle, double dt) { return std::min(turn_rate, (stops - angle) / dt); }

Shot without_gravity(Vec velocity, double seconds) { return {velocity + Vec{0, gravity * seconds}}; }

/// The ball of the reference: pushed by the bar's surface at the exact closest point, nothing rubs.
class Reference
{
public:
    Reference(double start_angle, double restitution) : m_angle(start_angle), m_restitution(restitution) {}

    void advance(double spin, double h)
    {
        m_velocity.y -= gravity * h;
        m_position = m_position + h * m_velocity;
        m_angle += spin * h;
        push(spin);
    }
    [[nodiscard]] Vec velocity() const { return m_velocity; }

private:
    void push(double spin)
    {
        const Vec local = rotate(-m_angle, m_position);
        const Vec closest{std::clamp(local.x, 0.0, bar_length), std::clamp(local.y, -half_thickness, half_thickness)};
        const double distance = length(local - closest);
        if (distance >= radius)
        {
            return;
        }
        const Vec normal = (1 / distance) * rotate(m_angle, local - closest);
        const double closing = dot(cross(spin, rotate(m_angle, closest)) - m_velocity, normal);
        m_velocity = m_velocity + std::max(0.0, (1 + m_restitution) * closing) * normal;
        m_position = m_position + (radius - distance) * normal;
    }

    double m_angle;
    double m_restitution;
    Vec m_position = ball_start();
    Vec m_velocity{};
};

} // namespace

Shot exact_flipper_shot(double dt, double restitution, double phase)
{
    const double start = meets - turn_rate * phase * dt;
    Reference reference(start, restitution);
    double angle = start;
    const int slices = static_cast<int>(std::lround(dt * 1e6));
    for (int step = 0; step * dt < duration - dt / 2; ++step)
    {
        const double spin = next_spin(angle, dt);
        for (int i = 0; i < slices; ++i)
        {
            reference.advance(spin, dt / slices);
        }
        angle += spin * dt;
    }
    return without_gravity(reference.velocity(), std::ceil(duration / dt - 0.5) * dt);
}

Shot flipper_shot_of(const Setup& setup, double restitution, double phase)
{
    const std::unique_ptr<World> world = setup.world({0, -gravity});
    const double dt = setup.dt();
    double angle = meets - turn_rate * phase * dt;
    const Material rubber{.density = mass / (pi * radius * radius), .restitution = restitution};
    const Body bar = world->add_body({.motion = Motion::Kinematic, .angle = angle});
    world->add_shape(bar, box(bar_length, 2 * half_thickness, {bar_length / 2, 0}), rubber);
    const Body ball = world->add_body({.position = ball_start()});
    world->add_shape(ball, Disc{radius}, rubber);
    int step = 0;
    for (; step * dt < duration - dt / 2; ++step)
    {
        const double spin = next_spin(angle, dt);
        world->set_motion(bar, {}, spin);
        world->step(dt);
        angle += spin * dt;
    }
    return without_gravity(world->state(ball).velocity, step * dt);
}

namespace {

void series(const Setup& setup, double restitution, Metrics& metrics)
{
    Errors speed;
    Errors angle;
    int missed = 0;
    const int phases = setup.cases(20);
    for (int i = 0; i < phases; ++i)
    {
        const double phase = static_cast<double>(i) / phases;
        const Shot exact = exact_flipper_shot(setup.dt(), restitution, phase);
        const Shot got = flipper_shot_of(setup, restitution, phase);
        if (!(dot(got.velocity, exact.velocity) >= 0.3 * exact.speed() * exact.speed()))
        {
            ++missed;
            continue;
        }
        speed.add(std::abs(got.speed() / exact.speed() - 1) * 100);
        angle.add(degrees(angle_between(got.velocity, exact.velocity)));
    }
    char name[32];
    std::snprintf(name, sizeof name, "e %g: ", restitution);
    metrics.push_back({15, name + std::string("missed of 20"), 0, static_cast<double>(missed), 0});
    metrics.push_back({15, name + std::string("speed error, mean, %"), 0, speed.mean(), 0.5});
    metrics.push_back({15, name + std::string("angle error, mean, deg"), 0, angle.mean(), 0.3});
    metrics.push_back({15, name + std::string("angle error, worst, deg"), 0, angle.worst(), 1});
}

} // namespace

Metrics flipper_shot(const Setup& setup)
{
    Metrics metrics;
    series(setup, 0, metrics);
    series(setup, 0.5, metrics);
    return metrics;
}

} // namespace truth
