// Row 10: kinematic bodies push and are never pushed; the surface speed of a body that turns about a pivot enters the impact.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(Row10_Kinematic, APlatePushesABox)
{
    for (const Geometry& geometry : {Geometry{box(0.5f, 0.5f)}, Geometry{Circle{}}})
    {
        Scene scene(sleepless());
        add_static(scene, HalfSpace{}, {.friction = 0});
        const Thing plate = add(scene, {.type = BodyType::Kinematic, .position = {-1, 0.5}, .velocity = {1, 0}}, box(0.1f, 0.5f),
                                {.friction = 0});
        const Thing body = add_dynamic(scene, {0, 0.5}, geometry, {.friction = 0});
        steps(scene, 180);
        EXPECT_NEAR(scene.body(plate.body).position().x, 2, 1e-5);
        EXPECT_EQ(scene.body(plate.body).velocity(), (Vec2{1, 0}));
        EXPECT_NEAR(scene.body(body.body).velocity().x, 1, 1e-3);
        EXPECT_NEAR(scene.body(body.body).position().x, 2.6, 0.01);
    }
}

TEST(Row10_Kinematic, TargetPoseIsReachedExactlyAndThenItStops)
{
    Scene scene(sleepless());
    const Thing bar = add(scene, {.type = BodyType::Kinematic, .position = {1, 2}, .angle = 0.3f}, box(1, 0.1f, {0.5f, 0}));
    scene.body(bar.body).set_target_pose({1.5, 1.75}, -0.9f);
    const float h = 1.0f / 60;
    scene.step(h);
    EXPECT_NEAR(scene.body(bar.body).position().x, 1.5, 1e-6);
    EXPECT_NEAR(scene.body(bar.body).position().y, 1.75, 1e-6);
    EXPECT_NEAR(scene.body(bar.body).angle(), -0.9, 1e-6);
    scene.step(h);
    EXPECT_NEAR(scene.body(bar.body).position().x, 1.5, 1e-6);
    EXPECT_NEAR(scene.body(bar.body).angle(), -0.9, 1e-6);
    EXPECT_EQ(scene.body(bar.body).velocity(), (Vec2{}));
    EXPECT_EQ(scene.body(bar.body).angular_velocity(), 0);
}

TEST(Row10_Kinematic, ABallOnATargetedPlateGetsItsSpeed)
{
    Scene scene(weightless());
    const Thing plate = add(scene, {.type = BodyType::Kinematic}, box(1, 0.5f), {.friction = 0, .restitution = 0});
    const Thing ball = add_dynamic(scene, {0, 1}, Circle{}, {.friction = 0, .restitution = 0});
    const float h = 1.0f / 60;
    scene.body(plate.body).set_target_pose({0, 0.05}, 0);
    scene.step(h);
    EXPECT_NEAR(scene.body(ball.body).velocity().y, 0.05 * 60, 0.01);
    steps(scene, 10);
    EXPECT_NEAR(scene.body(ball.body).velocity().y, 0.05 * 60, 0.01) << "it flies on; the plate has stopped";
    EXPECT_NEAR(scene.body(plate.body).position().y, 0.05, 1e-6);
}

TEST(Row10_Kinematic, ATurningBarHitsWithItsSurfaceSpeed)
{
    // A bar about a pivot at its end; the ball waits at distance 1.5 above it. e = 1: the ball leaves with twice the surface speed.
    for (const float h : {1.0f / 60, 1.0f / 1000})
    {
        Scene scene(weightless());
        const Thing bar = add(scene, {.type = BodyType::Kinematic, .angular_velocity = 4}, box(1, 0.1f, {1, 0}),
                              {.friction = 0, .restitution = 1});
        const Thing ball = add_dynamic(scene, {1.5, 0.3}, Circle{.radius = 0.15f}, {.friction = 0, .restitution = 1});
        Vec2 hit_at{};
        float approach = 0;
        for (int i = 0; i < 300 && approach == 0; ++i)
        {
            scene.step(h);
            if (!scene.impacts().empty())
            {
                approach = scene.impacts()[0].approach_speed;
                hit_at = to_vec2(scene.impacts()[0].point);
            }
        }
        // Speed along the bar's normal at the point is w times the distance along the bar.
        const double along = std::sqrt(static_cast<double>(dot(hit_at, hit_at)) - 0.01);
        EXPECT_NEAR(approach, 4 * along, 0.01);
        EXPECT_NEAR(speed(scene, ball.body), 8 * along, 0.03);
        EXPECT_EQ(scene.body(bar.body).angular_velocity(), 4);
    }
}

// The pinball flipper: dynamic, translation locked, center of mass at the pivot, inertia about the pivot, driven by torque.
TEST(Row10_Kinematic, AFlipperIsABodyThatTurnsAboutItsPivot)
{
    Scene scene(weightless());
    const BodyId flipper = scene.create_body({.type = BodyType::Dynamic, .locks = {.linear_x = true, .linear_y = true}});
    scene.create_shape(flipper, Capsule{{0, 0}, {0.08f, 0}, 0.012f, 0.007f}, {.friction = 0, .restitution = 0});
    scene.body(flipper).set_mass({.mass = 0.05f, .center = {}, .inertia = 1e-4f});
    EXPECT_EQ(scene.body(flipper).center_of_mass(), (Position{0, 0}));
    for (int i = 0; i < 20; ++i)
    {
        scene.body(flipper).apply_torque(0.02f);
        scene.step(1e-3f);
    }
    EXPECT_NEAR(scene.body(flipper).angular_velocity(), 0.02 / 1e-4 * 0.02, 1e-3);
    EXPECT_NEAR(scene.body(flipper).angle(), 0.5 * 200 * 0.02 * 0.02, 6e-4); // torque acts sub-step by sub-step, 0.25 ms each
    EXPECT_EQ(scene.body(flipper).position(), (Position{0, 0}));
}

TEST(Row10_Kinematic, AFlipperStruckByABallTakesTheImpulseAboutItsPivot)
{
    Scene scene(weightless());
    const BodyId flipper = scene.create_body({.type = BodyType::Dynamic, .locks = {.linear_x = true, .linear_y = true}});
    const float inertia = 0.3f;
    scene.create_shape(flipper, Capsule{{0, 0}, {1, 0}, 0.1f, 0.1f}, {.friction = 0, .restitution = 0.5f});
    scene.body(flipper).set_mass({.mass = 2, .center = {}, .inertia = inertia});
    const Thing ball =
        add_dynamic(scene, {0.8, 0.25}, Circle{.radius = 0.1f}, {.density = 20, .friction = 0, .restitution = 0.5f}, {0, -5});
    const double m = scene.body(ball.body).mass();
    steps(scene, 2);
    // m1 = m, m2 = I / r²: mass at the pivot is out of play, it cannot move.
    const double m2 = static_cast<double>(inertia) / 0.64;
    const double j = 1.5 * m * m2 / (m + m2) * 5;
    EXPECT_NEAR(scene.body(ball.body).velocity().y, -5 + j / m, 2e-3);
    EXPECT_NEAR(scene.body(flipper).angular_velocity(), -j * 0.8 / static_cast<double>(inertia), 2e-2);
    EXPECT_EQ(scene.body(flipper).position(), (Position{0, 0}));
}

// Where its rows do not hold what has landed in mid-step, it falls on into the plate until the step is over.
TEST(Row10_Kinematic, EveryBodyThatLandsOnAPlateIsCarriedAtOnce)
{
    SceneDef def = sleepless();
    def.gravity = {0, -200};
    Scene scene(def);
    const float speed = 6;
    add(scene, {.type = BodyType::Kinematic, .velocity = {0, speed}}, box(50, 0.5f), {.friction = 0, .restitution = 0});
    std::vector<Thing> things;
    for (int i = 0; i < 8; ++i) // far apart: each is solved by itself
        things.push_back(add_dynamic(scene, {10.0 * i - 35, 1.02 + 0.002 * i}, Circle{}, {.friction = 0, .restitution = 0}));
    for (int step = 1; step <= 3; ++step)
    {
        scene.step(1.0f / 60);
        const double top = 0.5 + step * static_cast<double>(speed) / 60;
        for (const Thing& t : things)
            EXPECT_GT(scene.body(t.body).position().y - 0.5, top - 0.002) << "step " << step;
    }
}
