// x = x0 + v0 t + g t²/2, for round and cornered bodies, at any step.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

void expect_parabola(const Geometry& geometry, float h, int count)
{
    Scene scene(sleepless());
    const Vec2 v0{3, 4};
    const Thing body = add_dynamic(scene, {0, 100}, geometry, {}, v0, 2);
    steps(scene, count, h);
    const double t = static_cast<double>(h) * count;
    const Position p = scene.body(body.body).position();
    // A velocity is a float of up to 16 m/s, rounded in each of four sub-steps: half of 2^-20 each time at the worst.
    const double rounding = 4 * count * 0x1p-21 + 1e-6;
    EXPECT_NEAR(p.x, 3 * t, rounding);
    EXPECT_NEAR(p.y, 100 + 4 * t - 0.5 * static_cast<double>(9.81f) * t * t, rounding);
    EXPECT_NEAR(scene.body(body.body).velocity().y, 4 - static_cast<double>(9.81f) * t, rounding);
    EXPECT_NEAR(scene.body(body.body).angular_velocity(), 2, 1e-6);
}

} // namespace

TEST(LawFreeFall, BallFollowsTheParabola)
{
    expect_parabola(Circle{}, 1.0f / 60, 120);
    expect_parabola(Circle{}, 1.0f / 1000, 2000);
    expect_parabola(Circle{}, 0.1f, 20);
}

TEST(LawFreeFall, BoxFollowsTheParabola)
{
    expect_parabola(box(0.5f, 0.3f), 1.0f / 60, 120);
    expect_parabola(box(0.5f, 0.3f), 1.0f / 1000, 2000);
    expect_parabola(box(0.5f, 0.3f), 0.1f, 20);
}

TEST(LawFreeFall, CapsuleTurnsAtItsSpin)
{
    Scene scene(sleepless());
    const Thing body = add_dynamic(scene, {0, 0}, Capsule{.radius_a = 0.3f, .radius_b = 0.1f}, {}, {}, 1.5f);
    steps(scene, 120);
    EXPECT_NEAR(scene.body(body.body).angle(), 3.0, 1e-5);
}

TEST(LawFreeFall, GravityScaleMultiplies)
{
    for (const float scale : {0.0f, 0.5f, -1.0f, 3.0f})
    {
        Scene scene(sleepless());
        const BodyId body = scene.create_body({.type = BodyType::Dynamic, .gravity_scale = scale});
        scene.create_shape(body, Circle{});
        steps(scene, 60);
        EXPECT_NEAR(scene.body(body).position().y, -0.5 * 9.81 * static_cast<double>(scale), 2e-5 * 9.81 * 3);
    }
}

TEST(LawDamping, VelocityDecaysExponentially)
{
    for (const float h : {1.0f / 30, 1.0f / 240})
    {
        Scene scene(weightless());
        for (const Geometry& geometry : {Geometry{Circle{}}, Geometry{box(0.5f, 0.5f)}})
        {
            const Thing body = add(scene,
                                   {.type = BodyType::Dynamic,
                                    .velocity = {10, 0},
                                    .angular_velocity = 4,
                                    .linear_damping = 0.7f,
                                    .angular_damping = 1.3f},
                                   geometry);
            scene.body(body.body).set_user_data(1);
            const int n = static_cast<int>(2 / h + 0.5f);
            steps(scene, n, h);
            EXPECT_NEAR(scene.body(body.body).velocity().x, 10 * std::exp(-0.7 * 2), 2e-4);
            EXPECT_NEAR(scene.body(body.body).angular_velocity(), 4 * std::exp(-1.3 * 2), 1e-4);
            scene.destroy(body.body);
        }
    }
}

TEST(LawDamping, HeavyDampingStaysFinite)
{
    Scene scene(weightless());
    const Thing body =
        add(scene, {.type = BodyType::Dynamic, .velocity = {10, 0}, .linear_damping = 1e6f, .angular_damping = 1e6f}, box(1, 1));
    steps(scene, 10);
    EXPECT_NEAR(speed(scene, body.body), 0, 1e-6);
}

TEST(LawMotionLocks, LockedDirectionsDoNotMove)
{
    for (const Geometry& geometry : {Geometry{Circle{}}, Geometry{box(0.5f, 0.5f)}})
    {
        Scene scene(sleepless());
        const Thing body =
            add(scene, {.type = BodyType::Dynamic, .velocity = {2, 0}, .locks = {.linear_y = true, .angular = true}}, geometry);
        scene.body(body.body).apply_impulse({0, 5}, {0.3, 0.1});
        steps(scene, 60);
        EXPECT_EQ(scene.body(body.body).position().y, 0);
        EXPECT_EQ(scene.body(body.body).angle(), 0);
        EXPECT_NEAR(scene.body(body.body).position().x, 2, 1e-5);
    }
}

TEST(LawMotionLocks, ALockedBodyIsAWallAlongTheLock)
{
    Scene scene(weightless());
    const Thing wall = add(scene, {.type = BodyType::Dynamic, .position = {1, 0}, .locks = {true, true, true}}, box(0.5f, 0.5f),
                           {.restitution = 1});
    const Thing ball = add_dynamic(scene, {-1, 0.2}, Circle{.radius = 0.25f}, {.friction = 0, .restitution = 1}, {5, 0});
    steps(scene, 60);
    EXPECT_NEAR(scene.body(ball.body).velocity().x, -5, 1e-5);
    EXPECT_EQ(scene.body(wall.body).position().x, 1);
}

TEST(LawForces, ForceTorqueAndImpulse)
{
    for (const Geometry& geometry : {Geometry{Circle{}}, Geometry{box(0.5f, 0.5f)}})
    {
        Scene scene(weightless());
        const Thing thing = add_dynamic(scene, {0, 0}, geometry, {.density = 2});
        const double m = scene.body(thing.body).mass();
        const double inertia = scene.body(thing.body).inertia();
        for (int i = 0; i < 60; ++i)
        {
            scene.body(thing.body).apply_force({3, 0});
            scene.body(thing.body).apply_torque(0.5f);
            scene.step(1.0f / 60);
        }
        EXPECT_NEAR(scene.body(thing.body).velocity().x, 3 / m, 1e-5);
        EXPECT_NEAR(scene.body(thing.body).position().x, 0.5 * 3 / m, 2e-5);
        EXPECT_NEAR(scene.body(thing.body).angular_velocity(), 0.5 / inertia, 1e-5);
        scene.step(1.0f / 60);
        EXPECT_NEAR(scene.body(thing.body).velocity().x, 3 / m, 1e-5) << "forces act through one step";

        const Vec2 before = scene.body(thing.body).velocity();
        const float w = scene.body(thing.body).angular_velocity();
        const Position c = scene.body(thing.body).center_of_mass();
        scene.body(thing.body).apply_impulse({0, 2}, c + Vec2{0.25f, 0});
        EXPECT_NEAR(scene.body(thing.body).velocity().y - before.y, 2 / m, 1e-6);
        EXPECT_NEAR(scene.body(thing.body).angular_velocity() - w, 0.5 / inertia, 1e-5);
    }
}

namespace {

// Impulses act at two anchors that slide apart during a step, which leaks a little angular momentum: it must vanish with the step.
void expect_kept(float friction, float h, double spin_tolerance)
{
    Scene scene(weightless());
    Random random(5);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 60; ++i)
    {
        const Position p{1.1 * (i % 8) - 3.9, 1.1 * (i / 8) - 3.6}; // apart at the start
        const Geometry geometry = i % 3 == 0   ? Geometry{Circle{.radius = 0.3f}}
                                  : i % 3 == 1 ? Geometry{box(0.3f, 0.2f)}
                                               : Geometry{Capsule{{-0.2f, 0}, {0.2f, 0}, 0.1f, 0.2f}};
        bodies.push_back(
            add_dynamic(scene, p, geometry, {.friction = friction, .restitution = 0.5f}, -1.5f * to_vec2(p), random.rangef(-3, 3))
                .body);
    }
    const auto sums = [&]
    {
        struct Moments
        {
            double px = 0, py = 0, l = 0;
        } s;
        for (const BodyId id : bodies)
        {
            const Body b = scene.body(id);
            const double m = b.mass();
            const Position c = b.center_of_mass();
            s.px += m * b.velocity().x;
            s.py += m * b.velocity().y;
            s.l += m * (c.x * b.velocity().y - c.y * b.velocity().x) + static_cast<double>(b.inertia()) * b.angular_velocity();
        }
        return s;
    };
    const auto before = sums();
    int impacts = 0;
    for (float t = 0; t < 4; t += h)
    {
        scene.step(h);
        impacts += static_cast<int>(scene.impacts().size());
    }
    const auto after = sums();
    EXPECT_GT(impacts, 50);
    EXPECT_NEAR(after.px, before.px, 1e-3);
    EXPECT_NEAR(after.py, before.py, 1e-3);
    EXPECT_NEAR(after.l, before.l, spin_tolerance);
}

} // namespace

// The spins add up to about 20, the impulses to about 70 N s.
TEST(LawMomentum, ACloudKeepsMomentumAndSpin)
{
    expect_kept(0, 1.0f / 60, 0.5);
    expect_kept(0.6f, 1.0f / 60, 0.5);
    expect_kept(0, 1.0f / 2000, 0.02);
    expect_kept(0.6f, 1.0f / 2000, 0.02);
}
