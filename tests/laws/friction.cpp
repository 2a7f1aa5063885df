// Sliding, rolling, the threshold of friction, rolling resistance, conveyors.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

constexpr double gravity = 9.81;

// A slope that falls towards +x by alpha, its surface through the origin; `lift` is along its normal.
struct Slope
{
    Scene scene{sleepless()};
    Vec2 normal;
    Vec2 down;

    Slope(double alpha, const ShapeDef& ground, bool segment)
        : normal{static_cast<float>(std::sin(alpha)), static_cast<float>(std::cos(alpha))},
          down{static_cast<float>(std::cos(alpha)), static_cast<float>(-std::sin(alpha))}
    {
        if (segment)
            add_static(scene, Segment{-100.0f * down, 100.0f * down}, ground);
        else
            add_static(scene, HalfSpace{.normal = normal}, ground);
    }
    Thing put(const Geometry& geometry, double lift, double alpha, const ShapeDef& def = {})
    {
        const Vec2 at = static_cast<float>(lift) * normal;
        return add(scene, {.type = BodyType::Dynamic, .position = Position{at}, .angle = static_cast<float>(-alpha)}, geometry,
                   def);
    }
    double along(BodyId id) { return static_cast<double>(dot(scene.body(id).velocity(), down)); }
};

} // namespace

TEST(LawRolling, ADiscAcceleratesByTwoThirds)
{
    for (const bool segment : {false, true})
        for (const float h : {1.0f / 60, 1.0f / 1000})
            for (const double alpha : {0.1, 0.5})
            {
                SCOPED_TRACE("alpha " + std::to_string(alpha) + " h " + std::to_string(h) + " segment " +
                             std::to_string(segment));
                Slope slope(alpha, {.friction = 0.8f}, segment);
                const Thing disc = slope.put(Circle{.radius = 0.25f}, 0.25, alpha, {.friction = 0.8f});
                steps(slope.scene, static_cast<int>(1 / h + 0.5f), h);
                const double v = slope.along(disc.body);
                EXPECT_NEAR(v, 2.0 / 3 * gravity * std::sin(alpha), 0.01 * v);
                EXPECT_NEAR(slope.scene.body(disc.body).angular_velocity(), -v / 0.25, 0.01 * v / 0.25) << "no slip";
            }
}

TEST(LawRolling, ABallOfSphereInertiaAcceleratesByFiveSevenths)
{
    const double alpha = 0.3;
    Slope slope(alpha, {.friction = 0.8f}, false);
    const Thing ball = slope.put(Circle{.radius = 0.25f}, 0.25, alpha, {.friction = 0.8f});
    slope.scene.body(ball.body).set_mass({.mass = 2, .inertia = 0.4f * 2 * 0.25f * 0.25f});
    steps(slope.scene, 60);
    EXPECT_NEAR(slope.along(ball.body), 5.0 / 7 * gravity * std::sin(alpha), 0.02);
}

TEST(LawSliding, ABoxAcceleratesByGravityLessFriction)
{
    for (const double mu : {0.0, 0.2, 0.4})
    {
        const double alpha = 0.6;
        Slope slope(alpha, {.friction = static_cast<float>(mu)}, false);
        const Thing body = slope.put(box(0.5f, 0.25f), 0.25, alpha, {.friction = static_cast<float>(mu)});
        steps(slope.scene, 60);
        const double want = gravity * (std::sin(alpha) - mu * std::cos(alpha));
        EXPECT_NEAR(slope.along(body.body), want, 0.01 * want) << mu;
        EXPECT_NEAR(slope.scene.body(body.body).angular_velocity(), 0, 0.02);
    }
}

TEST(LawSliding, AFrictionlessDiscDoesNotTurn)
{
    Slope slope(0.5, {.friction = 0}, false);
    const Thing disc = slope.put(Circle{}, 0.5, 0.5, {.friction = 0});
    steps(slope.scene, 60);
    EXPECT_NEAR(slope.along(disc.body), gravity * std::sin(0.5), 0.02);
    EXPECT_NEAR(slope.scene.body(disc.body).angular_velocity(), 0, 1e-5);
}

TEST(LawSliding, SlidingTurnsIntoRollingAtTwoThirdsOfTheSpeed)
{
    Scene scene(sleepless());
    add_static(scene, HalfSpace{}, {.friction = 0.3f});
    const Thing disc = add_dynamic(scene, {0, 0.25}, Circle{.radius = 0.25f}, {.friction = 0.3f}, {6, 0});
    steps(scene, 30);
    EXPECT_NEAR(scene.body(disc.body).velocity().x, 6 - 0.3 * gravity * 0.5, 0.05) << "still sliding";
    steps(scene, 150);
    EXPECT_NEAR(scene.body(disc.body).velocity().x, 4, 0.02);
    EXPECT_NEAR(scene.body(disc.body).angular_velocity(), -16, 0.1);
}

TEST(LawFriction, ABoxHoldsBelowTheThresholdAndSlidesAbove)
{
    const double mu = 0.5;
    for (const double ratio : {0.9, 0.98, 1.02, 1.1})
    {
        const double alpha = std::atan(mu * ratio);
        Slope slope(alpha, {.friction = static_cast<float>(mu)}, false);
        const Thing body = slope.put(box(0.5f, 0.25f), 0.25, alpha, {.friction = static_cast<float>(mu)});
        steps(slope.scene, 300);
        const double moved = static_cast<double>(dot(slope.scene.body(body.body).position() - Position{}, slope.down));
        const double free = 0.5 * gravity * (std::sin(alpha) - mu * std::cos(alpha)) * 25;
        if (ratio < 1)
            EXPECT_NEAR(moved, 0, 0.01) << ratio;
        else
            EXPECT_NEAR(moved, free, 0.05 * free + 0.02) << ratio;
    }
}

TEST(LawFriction, MixingIsTheGeometricMeanByDefault)
{
    const double alpha = 0.6;
    Slope slope(alpha, {.friction = 0.1f}, false);
    const Thing body = slope.put(box(0.5f, 0.25f), 0.25, alpha, {.friction = 0.4f});
    steps(slope.scene, 60);
    EXPECT_NEAR(slope.along(body.body), gravity * (std::sin(alpha) - 0.2 * std::cos(alpha)), 0.04);
}

TEST(LawFriction, RollingResistanceSlowsARollingBall)
{
    // Torque c r N about the contact, I + m r² = 3/2 m r²: a = c g / 1.5 for a disc.
    Scene scene(sleepless());
    add_static(scene, HalfSpace{}, {});
    const Thing disc = add(scene, {.type = BodyType::Dynamic, .position = {0, 0.5}, .velocity = {5, 0}, .angular_velocity = -10},
                           Circle{}, {.rolling_resistance = 0.05f});
    const Thing free =
        add(scene, {.type = BodyType::Dynamic, .position = {0, 0.5}, .velocity = {-5, 0}, .angular_velocity = 10}, Circle{});
    scene.ignore_pair(disc.body, free.body);
    steps(scene, 60);
    EXPECT_NEAR(scene.body(free.body).velocity().x, -5, 1e-3);
    EXPECT_NEAR(scene.body(disc.body).velocity().x, 5 - 0.05 * gravity / 1.5, 0.03);
    steps(scene, 60 * 20);
    EXPECT_NEAR(scene.body(disc.body).velocity().x, 0, 1e-3) << "it comes to rest and does not turn back";
}

TEST(LawFriction, AConveyorCarriesABoxAtItsSpeed)
{
    // Positive: what lies on it goes to the left of the outward normal, which is -x on a floor.
    for (const Geometry& geometry : {Geometry{box(0.25f, 0.25f)}, Geometry{Capsule{{-0.25f, 0}, {0.25f, 0}}}})
    {
        Scene scene(sleepless());
        add_static(scene, box(50, 0.5f, {0, -0.5f}), {.surface_speed = 2});
        const Thing body = add_dynamic(scene, {0, 0.25}, geometry);
        steps(scene, 20);
        EXPECT_NEAR(scene.body(body.body).velocity().x, -0.6 * gravity / 3, 0.15) << "friction pulls it along";
        steps(scene, 120);
        EXPECT_NEAR(scene.body(body.body).velocity().x, -2, 0.01);
    }
}

TEST(LawFriction, AConveyorSpinsUpABall)
{
    Scene scene(sleepless());
    add_static(scene, box(50, 0.5f, {0, -0.5f}), {.surface_speed = 2});
    const Thing ball = add_dynamic(scene, {0, 0.5}, Circle{});
    steps(scene, 240);
    // Momentum about the contact line: the ball gains until its underside moves at -2: v - (-r w)... v + w r = -2, m v r = I w sign.
    const double v = scene.body(ball.body).velocity().x;
    const double w = scene.body(ball.body).angular_velocity();
    EXPECT_NEAR(v + 0.5 * w, -2, 0.02) << "no slip on the belt";
    EXPECT_NEAR(v, -2.0 / 3, 0.02);
}
