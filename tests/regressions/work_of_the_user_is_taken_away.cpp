// Symptom: with gravity a rope that was wound in never lifted its load, nor did a limit that rose, a crane or a drawbridge; a ball wound in from 4 to 2 m kept
// its speed; what was made inside the floor stayed there. Islands of 17 bodies were right, and so was any island with a motor of 0 N m in it.

#include "regressions/numbers.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

using namespace carom;
using namespace carom::test;

namespace {

BodyId load(Scene& scene, Position at = {}) { return add_dynamic(scene, at, box(0.5f, 0.5f)).body; }

// Bodies that are let go of beside the load without touching it, so that its island has more of them.
void hang_others(Scene& scene, BodyId from, int count)
{
    BodyId last = from;
    for (int i = 0; i < count; ++i)
    {
        const BodyId next = add_dynamic(scene, {0, -1.0 - 0.4 * i}, Circle{.radius = 0.1f}, {.filter = {.mask = 0}}).body;
        scene.create_joint(DistanceDef{.body_a = last, .body_b = next, .min_length = 0, .max_length = i == 0 ? 1 : 0.4f});
        last = next;
    }
}

} // namespace

TEST(WorkOfTheUser, ARopeThatIsWoundInLiftsItsLoad)
{
    for (const int others : {0, 1, 3, 15})
    {
        for (const float speed : {0.01f, 0.2f, 1.0f, 3.0f})
        {
            SCOPED_TRACE(std::to_string(others) + " others, " + std::to_string(speed) + " m/s");
            Scene scene(sleepless());
            const BodyId b = load(scene);
            hang_others(scene, b, others);
            DistanceDef def{.body_b = b, .anchor_a = {0, 5}, .min_length = 0, .max_length = 5};
            const JointId rope = scene.create_joint(def);
            for (int i = 1; i <= 60; ++i)
            {
                def.max_length = 5 - speed * dt * static_cast<float>(i);
                scene.joint(rope).set_def(def);
                scene.step(dt);
            }
            steps(scene, 30);
            EXPECT_NEAR(scene.body(b).position().y, d(speed), 0.002 + 0.002 * others);
        }
    }
}

TEST(WorkOfTheUser, ARodThatShrinksAndOneThatGrowsCarryTheirLoad)
{
    for (const float speed : {-1.0f, -0.05f, 0.05f, 1.0f})
    {
        Scene scene(sleepless());
        const BodyId b = load(scene);
        DistanceDef def{.body_b = b, .anchor_a = {0, 5}, .min_length = 5, .max_length = 5};
        const JointId rod = scene.create_joint(def);
        for (int i = 1; i <= 60; ++i)
        {
            def.min_length = def.max_length = 5 - speed * dt * static_cast<float>(i);
            scene.joint(rod).set_def(def);
            scene.step(dt);
        }
        EXPECT_NEAR(scene.body(b).position().y, d(speed), 1e-3) << speed;
    }
}

TEST(WorkOfTheUser, ALimitThatRisesLifts)
{
    for (const int others : {0, 3, 15})
    {
        Scene scene(sleepless());
        const BodyId b = load(scene);
        hang_others(scene, b, others);
        PrismaticDef def{.body_b = b, .axis_a = {0, 1}, .enable_limit = true, .lower_translation = 0, .upper_translation = 3};
        const JointId slider = scene.create_joint(def);
        for (int i = 1; i <= 60; ++i)
        {
            def.lower_translation = dt * static_cast<float>(i);
            scene.joint(slider).set_def(def);
            scene.step(dt);
        }
        steps(scene, 30);
        EXPECT_NEAR(scene.body(b).position().y, 1, 0.005) << others;
    }
}

// A bridge of 2 m on a hinge at its left end.
TEST(WorkOfTheUser, ALimitOfAHingeThatRisesLiftsABridge)
{
    for (const bool loaded : {false, true})
    {
        for (const bool weighs : {true})
        {
            SceneDef scene_def = sleepless();
            scene_def.gravity = weighs ? scene_def.gravity : Vec2{};
            Scene scene(scene_def);
            const BodyId bridge = add_dynamic(scene, {1, 0}, box(1, 0.1f), {.friction = 1}).body;
            if (loaded)
                add_dynamic(scene, {0.5, 0.25}, box(0.15f, 0.15f), {.friction = 1});
            RevoluteDef def{.body_b = bridge,
                            .anchor_a = {0, 0},
                            .anchor_b = {-1, 0},
                            .enable_limit = true,
                            .lower_angle = 0,
                            .upper_angle = 1};
            const JointId hinge = scene.create_joint(def);
            for (int i = 1; i <= 60; ++i)
            {
                def.lower_angle = 0.4f * dt * static_cast<float>(i);
                scene.joint(hinge).set_def(def);
                scene.step(dt);
            }
            steps(scene, 30);
            EXPECT_NEAR(d(scene.joint(hinge).coordinate()), 0.4, 0.005) << loaded << weighs;
        }
    }
}

TEST(WorkOfTheUser, AHingeMadeOutsideItsLimitsComesBack)
{
    for (const float gravity : {0.0f, -9.81f})
    {
        for (const float lower : {0.01f, 0.5f, 2.0f})
        {
            Scene scene({.gravity = {0, gravity}, .sleeping = false});
            const BodyId b = add_dynamic(scene, {}, box(1, 0.1f)).body;
            scene.create_joint(RevoluteDef{.body_b = b, .enable_limit = true, .lower_angle = lower, .upper_angle = 3});
            steps(scene, 120);
            EXPECT_NEAR(d(scene.body(b).angle()), d(lower), 0.005) << gravity;
        }
    }
}

TEST(WorkOfTheUser, RopesPullAcrossTheirWholeLengthOfError)
{
    for (const float length : {0.5f, 2.0f, 4.9f})
    { // made too short
        Scene scene(sleepless());
        const BodyId b = load(scene);
        scene.create_joint(DistanceDef{.body_b = b, .anchor_a = {0, 5}, .min_length = 0, .max_length = length});
        steps(scene, 300);
        EXPECT_NEAR(scene.body(b).position().y, 5 - d(length), 0.005);
    }
}

TEST(WorkOfTheUser, ACraneLiftsByItsOwnMotion)
{
    for (const bool by_target : {false, true})
    {
        Scene scene(sleepless());
        const BodyId crane = scene.create_body({.type = BodyType::Kinematic, .position = {0, 3}});
        const BodyId b = load(scene);
        scene.create_joint(DistanceDef{.body_a = crane, .body_b = b, .min_length = 0, .max_length = 3});
        for (int i = 1; i <= 120; ++i)
        {
            if (by_target)
                scene.body(crane).set_target_pose({0, 3 + d(dt) * i}, 0);
            else
                scene.body(crane).set_velocity({0, 1});
            scene.step(dt);
        }
        EXPECT_NEAR(scene.body(b).position().y, 2, 0.01) << by_target;
    }
}

// Angular momentum: half the length, twice the speed.
TEST(WorkOfTheUser, ABallThatIsWoundInGainsSpeed)
{
    for (const bool is_rod : {false, true})
    {
        for (const float step : {dt, dt / 4})
        {
            Scene scene(weightless());
            const BodyId b = add_dynamic(scene, {}, Circle{.radius = 0.2f}, {}, {0, 1}).body;
            DistanceDef def{.body_b = b, .anchor_a = {4, 0}, .min_length = is_rod ? 4.0f : 0.0f, .max_length = 4};
            const JointId rope = scene.create_joint(def);
            const int count = static_cast<int>(std::lround(2 / step));
            for (int i = 1; i <= count; ++i)
            {
                def.max_length = 4 - step * static_cast<float>(i);
                def.min_length = is_rod ? def.max_length : 0;
                scene.joint(rope).set_def(def);
                scene.step(step);
            }
            steps(scene, 10);
            EXPECT_NEAR(speed(scene, b), 2, 0.02 * d(step / dt) + 0.01) << is_rod;
        }
    }
}

namespace {

const std::pair<const char*, Geometry> stuck_shapes[] = {
    {"box", box(0.5f, 0.5f)},
    {"circle", Circle{.radius = 0.5f}},
    {"capsule", Capsule{.a = {-0.3f, 0}, .b = {0.3f, 0}, .radius_a = 0.5f, .radius_b = 0.5f}},
    {"hexagon", Polygon{.vertices = {{0.5f, 0}, {0.25f, 0.5f}, {-0.25f, 0.5f}, {-0.5f, 0}, {-0.25f, -0.5f}, {0.25f, -0.5f}}}},
};

} // namespace

TEST(WorkOfTheUser, WhatIsMadeInsideTheFloorComesOut)
{
    for (const auto& [name, shape] : stuck_shapes)
    {
        for (const int floor : {0, 1})
        {
            for (const float depth : {0.02f, 0.05f, 0.2f, 0.4f})
            {
                for (const bool sleeping : {false, true})
                {
                    SCOPED_TRACE(std::string(name) + " " + std::to_string(depth) + " floor " + std::to_string(floor));
                    Scene scene({.sleeping = sleeping});
                    if (floor == 0)
                        add_static(scene, box(20, 2), {}, {0, -2});
                    else
                        add_static(scene, HalfSpace{});
                    const BodyId b = add_dynamic(scene, {0, 0.5 - d(depth)}, shape).body;
                    steps(scene, 300);
                    EXPECT_NEAR(scene.body(b).position().y, 0.5, 0.006);
                }
            }
        }
    }
}

TEST(WorkOfTheUser, AStackThatWasPressedTogetherRisesAgain)
{
    for (const int count : {3, 10, 20})
    {
        Scene scene;
        add_static(scene, box(20, 2), {}, {0, -2});
        BodyId top{};
        for (int i = 0; i < count; ++i)
            top = load(scene, {0, 0.5 + i});
        steps(scene, 60);
        const double before = scene.body(top).position().y;
        scene.step(0.25f);
        steps(scene, 300);
        EXPECT_NEAR(scene.body(top).position().y, before, 0.002 * count) << count;
    }
}
