// Symptom: limits of exactly -pi and pi did not exist, those beyond were refused, and coordinate() jumped from pi to -pi: a hinge did not count its turns.

#include "regressions/numbers.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace carom;
using namespace carom::test;

namespace {

struct Arms
{
    Scene scene;
    BodyId a{}; ///< null: the world
    BodyId b{};
    JointId joint{};
};

// A bar on the world or on another; beside `others` that hang together with it, so that it is solved alone, all at once, or in lanes.
Arms make_arms(bool on_body, int others, RevoluteDef def, double at = 0)
{
    Arms arms{Scene(weightless())};
    Scene& s = arms.scene;
    if (on_body)
        arms.a = add_dynamic(s, {0, 0}, box(0.5f, 0.5f), {.density = 100}).body;
    arms.b = add(s, {.type = BodyType::Dynamic, .position = {0, 0}, .angle = static_cast<float>(at)}, box(0.6f, 0.05f)).body;
    def.body_a = arms.a;
    def.body_b = arms.b;
    def.anchor_b = {-0.5f, 0};
    const Position pivot = s.body(arms.b).world_point(def.anchor_b);
    def.anchor_a = on_body ? s.body(arms.a).local_point(pivot) : Vec2{static_cast<float>(pivot.x), static_cast<float>(pivot.y)};
    arms.joint = s.create_joint(def);
    BodyId last = arms.b;
    for (int i = 0; i < others; ++i)
    {
        const BodyId next = add_dynamic(s, {5.0 + i, 5}, Circle{.radius = 0.1f}, {.density = 0.01f}).body;
        s.create_joint(SpringDef{.body_a = last, .body_b = next, .stiffness = 1e-6f});
        last = next;
    }
    return arms;
}

} // namespace

TEST(HingesForgetTurns, TheAngleGrows)
{
    for (const bool on_body : {false, true})
    {
        for (const int others : {0, 20})
        {
            for (const float speed : {3.0f, -40.0f, 150.0f, 300.0f, -1000.0f})
            {
                SCOPED_TRACE((on_body ? "on a body, " : "on the world, ") + std::to_string(others) + " others, " +
                             std::to_string(speed) + " rad/s");
                Arms arms = make_arms(on_body, others, {.enable_motor = true, .motor_speed = speed, .max_motor_torque = 1e9f});
                double turned = 0;
                for (int i = 0; i < 240; ++i)
                {
                    arms.scene.step(dt);
                    if (i > 0)
                        turned += d(speed) * d(dt);
                    else
                        turned = d(arms.scene.joint(arms.joint).coordinate());
                }
                EXPECT_NEAR(d(arms.scene.joint(arms.joint).coordinate()) / turned, 1, 0.02);
            }
        }
    }
}

TEST(HingesForgetTurns, LimitsMayBeAnyNumberOfTurnsAway)
{
    for (const bool on_body : {false, true})
    {
        for (const int others : {0, 20})
        {
            for (const float limit : {0.5f, 3.0f, pi, 3.3f, 2 * pi, 12.0f, 40.0f})
            {
                for (const float way : {1.0f, -1.0f})
                {
                    for (const double at : {0.0, 3.0})
                    {
                        SCOPED_TRACE((on_body ? "on a body, " : "on the world, ") + std::to_string(others) + " others, limit " +
                                     std::to_string(way * limit) + ", from " + std::to_string(at));
                        Arms arms = make_arms(on_body, others,
                                              {.reference_angle = static_cast<float>(at),
                                               .enable_limit = true,
                                               .lower_angle = -limit,
                                               .upper_angle = limit,
                                               .enable_motor = true,
                                               .motor_speed = way * 15,
                                               .max_motor_torque = 500},
                                              at);
                        steps(arms.scene, 300);
                        EXPECT_NEAR(arms.scene.joint(arms.joint).coordinate(), way * limit, 0.02f);
                    }
                }
            }
        }
    }
}

// By hand, too: bodies that turn without the joint, teleports and targets.
TEST(HingesForgetTurns, WhateverTurnsTheBodies)
{
    Scene scene(weightless());
    const BodyId crank = scene.create_body({.type = BodyType::Kinematic});
    const BodyId wheel = add_dynamic(scene, {0, 0}, Circle{.radius = 0.5f}).body;
    const JointId joint = scene.create_joint(RevoluteDef{.body_a = crank, .body_b = wheel});
    const auto angle = [&] { return scene.joint(joint).coordinate(); };
    for (int i = 1; i <= 20; ++i)
    {
        scene.body(wheel).teleport({}, static_cast<float>(i));
        EXPECT_NEAR(angle(), static_cast<float>(i), 1e-4f);
    }
    for (int i = 1; i <= 20; ++i)
    {
        scene.body(crank).set_target_pose({}, static_cast<float>(i));
        scene.step(dt);
        EXPECT_NEAR(angle(), static_cast<float>(20 - i), 0.5f * static_cast<float>(i)) << "friction of nothing turns the wheel";
    }
    scene.body(crank).set_angular_velocity(-30);
    const float before = angle();
    steps(scene, 60);
    EXPECT_NEAR(angle() - before, 30, 0.5f);
    scene.body(crank).set_angular_velocity(-1000); // its path is known
    const float slow = angle();
    steps(scene, 60);
    EXPECT_NEAR((angle() - slow) / 1000, 1, 0.01f);
    // One that is made now begins within a turn.
    const JointId late = scene.create_joint(RevoluteDef{.body_a = crank, .body_b = wheel});
    EXPECT_LE(std::abs(scene.joint(late).coordinate()), pi + 1e-4f);
    // The count decides the future: it is in the hash.
    Scene one(weightless());
    Scene two(weightless());
    for (Scene* s : {&one, &two})
    {
        const BodyId body = add_dynamic(*s, {}, Circle{}).body;
        s->create_joint(RevoluteDef{.body_b = body});
        for (int i = 1; s == &two && i <= 4; ++i)
            s->body(body).teleport({}, static_cast<float>(i) * pi / 2);
        s->body(body).teleport({}, 0);
    }
    EXPECT_NE(one.state_hash(), two.state_hash());
}

// A slider holds its angle: turned away by hand it goes back the short way.
TEST(HingesForgetTurns, SlidersDoNot)
{
    Scene scene(weightless());
    const BodyId rail = add_dynamic(scene, {0, 0}, box(0.5f, 0.1f)).body;
    const BodyId cart = add_dynamic(scene, {2, 0}, box(0.1f, 0.1f)).body;
    scene.create_joint(PrismaticDef{.body_a = rail, .body_b = cart, .anchor_a = {2, 0}, .axis_a = {1, 0}});
    scene.body(rail).set_angular_velocity(20);
    steps(scene, 120);
    const float before = scene.body(rail).angular_velocity();
    EXPECT_NEAR(scene.body(cart).angular_velocity(), before, 0.01f);
    for (int i = 0; i < 4; ++i)
    {
        scene.body(cart).teleport(scene.body(cart).position(), scene.body(cart).angle() + 2);
        steps(scene, 120);
        EXPECT_NEAR(std::remainder(scene.body(cart).angle() - scene.body(rail).angle(), 2 * pi), 0, 0.01f);
    }
}
