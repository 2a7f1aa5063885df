// Symptom: motion locks held against forces and contacts, but not against a speed that the user gave.

#include "regressions/numbers.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

using Give = std::function<void(Body)>;

const std::vector<Give> ways = {
    [](Body b)
    {
        b.set_velocity({5, 4});
        b.set_angular_velocity(3);
    },
    [](Body b) { b.apply_impulse({5, 4}, b.world_point({0.3f, 0.2f})); },
    [](Body b) { b.apply_force({500, 400}, b.world_point({0.3f, 0.2f})); },
    [](Body b)
    { // a speed from before it was dynamic, and one from before it was locked
        const MotionLocks locks = b.locks();
        b.set_type(BodyType::Kinematic);
        b.set_velocity({5, 4});
        b.set_angular_velocity(3);
        b.set_type(BodyType::Dynamic);
        b.set_locks({});
        b.set_velocity({5, 4});
        b.set_angular_velocity(3);
        b.set_locks(locks);
    },
    [](Body b)
    { // the center of mass moves, and with it, in a body that turns, its velocity
        b.set_angular_velocity(3);
        b.set_mass({2, {0.2f, 0.3f}, 1});
    },
};

} // namespace

TEST(MotionLocks, HoldWhoeverGivesTheSpeed)
{
    for (int bits = 1; bits < 8; ++bits)
    {
        const MotionLocks locks{.linear_x = (bits & 1) != 0, .linear_y = (bits & 2) != 0, .angular = (bits & 4) != 0};
        for (int way = -1; way < static_cast<int>(ways.size()); ++way)
        {
            for (const bool sleeping : {false, true})
            {
                SCOPED_TRACE(bits * 10 + way);
                Scene scene({.gravity = {}, .sleeping = sleeping});
                BodyDef def{.type = BodyType::Dynamic, .locks = locks};
                if (way < 0)
                {
                    def.velocity = {5, 4};
                    def.angular_velocity = 3;
                }
                const BodyId id = add(scene, def, box(0.5f, 0.5f)).body;
                const Body body = scene.body(id);
                if (way >= 0)
                    ways[static_cast<std::size_t>(way)](body);
                const Position start = body.center_of_mass();
                steps(scene, 20);
                const Position end = body.center_of_mass();
                EXPECT_EQ(end.x == start.x, locks.linear_x || (way == 4 && locks.angular));
                EXPECT_EQ(end.y == start.y, locks.linear_y || (way == 4 && locks.angular));
                EXPECT_EQ(body.angle() == 0, locks.angular);
            }
        }
    }
}

// Between a body that is locked on all axes and a plate that moves as told nothing gives way: in a crowd its contacts read NaN after some steps.
TEST(MotionLocks, WhatALockedBodyBearsIsANumber)
{
    Scene scene;
    for (int i = 0; i < 240; ++i)
    {
        const bool is_locked = i < 20;
        const BodyId body = scene.create_body({.type = BodyType::Dynamic,
                                               .position = {1.0 * (i % 20), 0.5 + i / 20},
                                               .locks = {.linear_x = is_locked, .linear_y = is_locked, .angular = is_locked}});
        scene.create_shape(body, box(0.5f, 0.5f), {});
    }
    const BodyId plate = scene.create_body({.type = BodyType::Kinematic, .position = {10, -3}, .velocity = {0, 30}});
    scene.create_shape(plate, box(12, 1), {});
    for (int i = 0; i < 30; ++i)
    {
        scene.step(1.0f / 60);
        for (const ContactInfo& c : scene.contacts())
        {
            for (int k = 0; k < c.point_count; ++k)
                ASSERT_TRUE(std::isfinite(c.points[k].normal_impulse) && std::isfinite(c.points[k].friction_impulse))
                    << "step " << i;
        }
    }
}
