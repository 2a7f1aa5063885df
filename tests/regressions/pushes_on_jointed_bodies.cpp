// Symptom: a bar on a hinge that was pushed at its center did not move, pushed at its end turned twice as fast; a rod that caught a ball gave it back all its
// speed; free chains gained angular momentum from an impulse. A joint takes a speed that it forbids plastically: of the velocities that it allows, the
// bodies keep the nearest ones, as kinetic energy measures.

#include "regressions/numbers.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float instant = 1e-5f; // s

// --- a bar on one hinge -------------------------------------------------------------------------------------------------------------

enum class Push
{
    Center,
    Velocity,
    FarEnd,
    Pivot,
    Twist,
    Spin
};

// The pivot is at (0, 0.5) in the bar's frame; angular momentum about it over the moment of inertia about it.
double push(Body bar, Push how)
{
    const double m = d(bar.mass());
    const double about_pivot = d(bar.inertia()) + 0.25 * m;
    switch (how)
    {
    case Push::Center: bar.apply_impulse({0.3f, 0}); return 0.5 * 0.3 / about_pivot;
    case Push::Velocity: bar.set_velocity({0.7f, 0.2f}); return 0.5 * 0.7 * m / about_pivot;
    case Push::FarEnd: bar.apply_impulse({0.3f, 0.1f}, bar.world_point({0, -0.5f})); return 0.3 / about_pivot;
    case Push::Pivot: bar.apply_impulse({3, 4}, bar.world_point({0, 0.5f})); return 0;
    case Push::Twist: bar.apply_angular_impulse(0.2f); return 0.2 / about_pivot;
    case Push::Spin: break;
    }
    bar.set_angular_velocity(3);
    return 3 * d(bar.inertia()) / about_pivot;
}

// Surroundings that make the hinge one that flight cannot have, and company that the bar does not touch.
struct Surroundings
{
    const char* name;
    BodyType anchor;
    bool has_motor;
    bool has_limits;
    bool bar_is_a;
    int spectators;
    bool asleep;
};

constexpr Surroundings all_surroundings[] = {
    {"on the world", BodyType::Dynamic, false, false, false, 0, false},
    {"on a static body", BodyType::Static, false, false, false, 0, false},
    {"on a kinematic body", BodyType::Kinematic, false, false, false, 0, false},
    {"as the first body", BodyType::Static, false, false, true, 0, false},
    {"with a motor of nearly nothing", BodyType::Dynamic, true, false, false, 0, false},
    {"within limits", BodyType::Dynamic, false, true, false, 0, false},
    {"beside twenty others", BodyType::Dynamic, false, false, false, 20, false},
    {"asleep", BodyType::Static, false, false, false, 0, true},
};

class Hung
{
public:
    explicit Hung(const Surroundings& s) : m_scene({.gravity = {}})
    {
        bar = add_dynamic(m_scene, {}, box(0.1f, 0.5f)).body;
        const BodyId anchor = s.anchor == BodyType::Dynamic ? BodyId{} : m_scene.create_body({.type = s.anchor});
        RevoluteDef def{.body_a = anchor, .body_b = bar, .anchor_a = {0, 0.5f}, .anchor_b = {0, 0.5f}};
        if (s.bar_is_a)
            std::swap(def.body_a, def.body_b);
        def.enable_motor = s.has_motor;
        def.max_motor_torque = 1e-9f;
        def.enable_limit = s.has_limits;
        def.lower_angle = -1;
        def.upper_angle = 1;
        m_scene.create_joint(def);
        for (int i = 0; i < s.spectators; ++i)
            add_dynamic(m_scene, {3.0 + i, 0}, Circle{.radius = 0.3f});
        steps(m_scene, 1);
        if (s.asleep)
            m_scene.body(bar).set_awake(false);
    }

    Scene& scene() { return m_scene; }
    BodyId bar{};

private:
    Scene m_scene;
};

} // namespace

TEST(PushesOnJointedBodies, ABarOnAHingeTurnsByItsAngularMomentumAboutThePivot)
{
    for (const Surroundings& s : all_surroundings)
    {
        for (const Push how : {Push::Center, Push::Velocity, Push::FarEnd, Push::Pivot, Push::Twist, Push::Spin})
        {
            SCOPED_TRACE(std::string(s.name) + ", push " + std::to_string(static_cast<int>(how)));
            Hung hung(s);
            const double right = push(hung.scene().body(hung.bar), how);
            hung.scene().step(1.0f / 60);
            EXPECT_NEAR(d(hung.scene().body(hung.bar).angular_velocity()), right, 1e-4 * (1 + right));
        }
    }
}

TEST(PushesOnJointedBodies, TheBlowIsInTheForceOfTheJoint)
{
    for (const bool has_motor : {false, true})
    {
        Scene scene(weightless());
        const BodyId bar = add_dynamic(scene, {}, box(0.1f, 0.5f)).body;
        const JointId hinge = scene.create_joint(RevoluteDef{
            .body_b = bar, .anchor_a = {0, 0.5f}, .anchor_b = {0, 0.5f}, .enable_motor = has_motor, .max_motor_torque = 1e-9f});
        scene.step(1.0f / 60);
        scene.body(bar).apply_impulse({0, -0.3f});
        scene.step(1.0f / 60);
        EXPECT_NEAR(d(scene.joint(hinge).force().y), 0.3 * 60, 0.01) << has_motor;
        scene.step(1.0f / 60);
        EXPECT_NEAR(d(scene.joint(hinge).force().y), 0, 0.01) << has_motor;
    }
}

// --- rows of bodies -----------------------------------------------------------------------------------------------------------------

namespace {

enum class Link
{
    Hinge,
    Slider,
    Rod
};

JointId join(Scene& scene, Link link, BodyId a, Vec2 at_a, BodyId b, Vec2 at_b)
{
    switch (link)
    {
    case Link::Hinge: return scene.create_joint(RevoluteDef{.body_a = a, .body_b = b, .anchor_a = at_a, .anchor_b = at_b});
    case Link::Slider:
        return scene.create_joint(
            PrismaticDef{.body_a = a, .body_b = b, .anchor_a = at_a, .anchor_b = at_b, .axis_a = {0.6f, 0.8f}});
    case Link::Rod: break;
    }
    return scene.create_joint(DistanceDef{.body_a = a, .body_b = b, .anchor_a = 0.4f * at_a, .anchor_b = 0.4f * at_b});
}

struct Row
{
    Scene scene{weightless()};
    std::vector<BodyId> bodies{};

    Row(Link link, int count, bool hangs)
    {
        for (int i = 0; i < count; ++i)
            bodies.push_back(add_dynamic(scene, {1.0 * i, 0.05 * (i % 2)}, box(0.5f, 0.1f + 0.02f * static_cast<float>(i % 3)),
                                         {.filter = {.mask = 0}})
                                 .body);
        for (std::size_t i = 0; i + 1 < bodies.size(); ++i)
            join(scene, link, bodies[i], {0.5f, 0}, bodies[i + 1], scene.body(bodies[i + 1]).local_point(world(i)));
        if (hangs)
            join(scene, link, {}, {-0.5f, 0}, bodies[0], {-0.5f, link == Link::Rod ? 0.5f : 0});
        scene.step(instant);
    }

    Position world(std::size_t i) { return scene.body(bodies[i]).world_point({0.5f, 0}); }
};

using Speeds = std::vector<std::array<double, 3>>;

Speeds speeds_of(Row& row)
{
    Speeds all;
    for (const BodyId id : row.bodies)
    {
        const Body b = row.scene.body(id);
        all.push_back({d(b.velocity().x), d(b.velocity().y), d(b.angular_velocity())});
    }
    return all;
}

// v M u
double product(Row& row, const Speeds& v, const Speeds& u)
{
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
    {
        const Body b = row.scene.body(row.bodies[i]);
        sum += d(b.mass()) * (v[i][0] * u[i][0] + v[i][1] * u[i][1]) + d(b.inertia()) * v[i][2] * u[i][2];
    }
    return sum;
}

struct Momentum
{
    double x = 0;
    double y = 0;
    double turn = 0;
};

Momentum momentum_of(Row& row)
{
    Momentum sum;
    for (const BodyId id : row.bodies)
    {
        const Body b = row.scene.body(id);
        const Position p = b.center_of_mass();
        const double m = d(b.mass());
        sum.x += m * d(b.velocity().x);
        sum.y += m * d(b.velocity().y);
        sum.turn += d(b.inertia()) * d(b.angular_velocity()) + m * (p.x * d(b.velocity().y) - p.y * d(b.velocity().x));
    }
    return sum;
}

constexpr Link all_links[] = {Link::Hinge, Link::Slider, Link::Rod};

} // namespace

TEST(PushesOnJointedBodies, ARowKeepsTheNearestVelocitiesThatItsJointsAllow)
{
    for (const Link link : all_links)
    {
        for (const int count : {2, 3, 5, 16, 17, 40})
        {
            for (const bool hangs : {false, true})
            {
                SCOPED_TRACE(std::to_string(static_cast<int>(link)) + ", " + std::to_string(count) + (hangs ? " hang" : " free"));
                Row row(link, count, hangs);
                Body middle = row.scene.body(row.bodies[static_cast<std::size_t>(count / 2)]);
                middle.apply_impulse({1, 3}, middle.world_point({0.3f, 0.1f}));
                const Speeds before = speeds_of(row);
                const Momentum given = momentum_of(row);
                row.scene.step(instant);
                const Speeds after = speeds_of(row);
                Speeds taken = before;
                for (std::size_t i = 0; i < taken.size(); ++i)
                {
                    for (std::size_t k = 0; k < 3; ++k)
                        taken[i][k] -= after[i][k];
                }
                const double start = product(row, before, before);
                EXPECT_GT(product(row, after, after), 1e-3 * start);
                EXPECT_NEAR(product(row, after, taken) / start, 0, 2e-3); // in a right angle
                if (hangs)
                    continue;
                const Momentum now = momentum_of(row);
                EXPECT_NEAR(now.x, given.x, 1e-4);
                EXPECT_NEAR(now.y, given.y, 1e-4);
                EXPECT_NEAR(now.turn, given.turn, 1e-3 * (1 + std::fabs(given.turn)));
            }
        }
    }
}

TEST(PushesOnJointedBodies, FreeRowsKeepAngularMomentumAfterAnImpulse)
{
    for (const Link link : all_links)
    {
        for (const int count : {2, 3, 5, 12})
        {
            SCOPED_TRACE(std::to_string(static_cast<int>(link)) + ", " + std::to_string(count));
            Row row(link, count, false);
            row.scene.body(row.bodies.back()).apply_impulse({0.2f, 1});
            row.scene.body(row.bodies.front()).set_angular_velocity(1);
            const Momentum given = momentum_of(row);
            steps(row.scene, 120);
            EXPECT_NEAR(momentum_of(row).turn / given.turn, 1, 2e-3);
        }
    }
}

// --- caught in flight ---------------------------------------------------------------------------------------------------------------

namespace {

enum class Catch
{
    Rod,
    Rope,
    Hinge
};

// How fast two bodies, or a body and the world, are a second after a joint was made that holds them `gap` apart from where they are.
float speed_after_closing(bool hinge, bool to_world, float gap, float lever, float hz)
{
    Scene scene(weightless());
    const Filter alone{.mask = 0};
    const BodyId body = scene.create_body({.type = BodyType::Dynamic});
    scene.create_shape(body, box(0.25f, 0.25f), {.filter = alone});
    BodyId other{};
    if (!to_world)
    {
        other = scene.create_body({.type = BodyType::Dynamic, .position = {0, d(gap) + 0.7}});
        scene.create_shape(other, box(0.3f, 0.2f), {.filter = alone});
    }
    const Vec2 anchor = to_world ? Vec2{0.1f, gap} : Vec2{0.1f, -0.7f};
    if (hinge)
        scene.create_joint(RevoluteDef{.body_a = body, .body_b = other, .anchor_a = {lever, 0}, .anchor_b = anchor});
    else
        scene.create_joint(DistanceDef{
            .body_a = body, .body_b = other, .anchor_a = {lever, 0}, .anchor_b = anchor, .min_length = 0.1f, .max_length = 0.1f});
    for (float t = 0; t < 1; t += 1 / hz)
        scene.step(1 / hz);
    return length(scene.body(body).velocity());
}

// A ball at (2, 0) with 5 m/s, 60 degrees off the tangent: what catches it at the origin leaves 2.5 m/s.
double speed_after_catch(Catch what, int spectators, float length_scale)
{
    SceneDef def = weightless();
    def.length_scale = length_scale;
    Scene scene(def);
    const BodyId ball = add_dynamic(scene, {2, 0}, Circle{.radius = 0.2f}).body;
    for (int i = 0; i < spectators; ++i)
        add_dynamic(scene, {4.0 + i, 5}, Circle{.radius = 0.3f});
    steps(scene, 1);
    scene.body(ball).set_velocity({5 * std::sqrt(0.75f), 2.5f});
    if (what == Catch::Hinge)
        scene.create_joint(RevoluteDef{.body_b = ball, .anchor_b = {-2, 0}});
    else
        scene.create_joint(DistanceDef{.body_b = ball, .min_length = what == Catch::Rope ? 0.0f : -1.0f});
    steps(scene, 30);
    return speed(scene, ball);
}

} // namespace

TEST(PushesOnJointedBodies, WhatCatchesABallTakesTheSpeedAlongIt)
{
    for (const int spectators : {0, 20})
    {
        for (const float scale : {0.1f, 1.0f, 10.0f})
        {
            EXPECT_NEAR(speed_after_catch(Catch::Rod, spectators, scale), 2.5, 0.01) << spectators << " " << scale;
            EXPECT_NEAR(speed_after_catch(Catch::Rope, spectators, scale), 2.5, 0.01) << spectators << " " << scale;
        }
        // The hinge turns the ball with it: m r v / (m r + I / r).
        const double inertia = 0.5 * 0.04;
        EXPECT_NEAR(speed_after_catch(Catch::Hinge, spectators, 1), 2.5 * 4 / (4 + inertia), 0.01) << spectators;
    }
}

// A joint that is made open closes, and gives no speed for it: that grew with the gap and with finer steps, to 233 m/s.
TEST(PushesOnJointedBodies, AJointThatIsMadeOpenClosesWithoutSpeed)
{
    for (const bool hinge : {true, false})
    {
        for (const bool to_world : {true, false})
        {
            for (const float gap : {0.01f, 0.05f, 0.1f, 0.2f, 0.5f, 1.0f, 2.0f})
            {
                for (const float lever : {0.0f, 0.1f, 0.3f, 1.0f})
                {
                    for (const float hz : {30.0f, 60.0f, 120.0f})
                    {
                        EXPECT_LT(speed_after_closing(hinge, to_world, gap, lever, hz), 0.3f)
                            << (hinge ? "hinge" : "rod") << ", gap " << gap << ", lever " << lever << ", " << hz << " Hz";
                    }
                }
            }
        }
    }
}
