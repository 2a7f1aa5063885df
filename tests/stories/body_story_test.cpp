// The story of a selected body: who pushes it, and how hard.

#include "scenes/scenes.h"
#include "view/body_story.h"

#include <gtest/gtest.h>

#include <string>

namespace carom::view {
namespace {

bool says(const Scene& scene, BodyId body, const std::string& text)
{
    for (const StoryLine& line : body_story(scene, body, 1.0f / 60))
        if (line.text.find(text) != std::string::npos)
            return true;
    return false;
}

std::string all_of(const Scene& scene, BodyId body)
{
    std::string text;
    for (const StoryLine& line : body_story(scene, body, 1.0f / 60))
        text += "\n    " + line.text;
    return text;
}

// Boxes, awake and asleep.
TEST(BodyStory, WhatRestsIsHeldByForcesThatCancelOut)
{
    for (const char* name : {"stack", "small_pyramid"})
    {
        scenes::BuiltScene built = scenes::find_scene(name)->create({});
        for (int i = 0; i < 240; ++i)
        {
            built.step(1.0f / 60);
            if (i < 40 || i % 20 != 0)
                continue;
            for (const BodyId body : built.scene.bodies())
            {
                if (built.scene.body(body).type() == BodyType::Dynamic)
                {
                    EXPECT_TRUE(says(built.scene, body, "All of them cancel out: it stays"))
                        << name << " step " << i << all_of(built.scene, body);
                }
            }
        }
    }
}

TEST(BodyStory, WhatFallsIsPushedByItsWeightAlone)
{
    Scene scene;
    const BodyId ball = scene.create_body({.type = BodyType::Dynamic});
    scene.create_shape(ball, Circle{.radius = 0.5f});
    scene.step(1.0f / 60);
    EXPECT_TRUE(says(scene, ball, "weight: m·g = 0.785·9.81 = 7.70 N down"));
    EXPECT_TRUE(says(scene, ball, "Together 7.70 N down"));
    EXPECT_FALSE(says(scene, ball, "cancel"));
}

TEST(BodyStory, ASleeperTellsWhy)
{
    Scene scene;
    const BodyId ground = scene.create_body({});
    scene.create_shape(ground, HalfSpace{});
    const BodyId crate = scene.create_body({.type = BodyType::Dynamic, .position = {0, 0.5}});
    scene.create_shape(crate, box(0.5f, 0.5f));
    for (int i = 0; i < 120; ++i)
        scene.step(1.0f / 60);
    EXPECT_TRUE(says(scene, crate, "It sleeps"));
    EXPECT_TRUE(says(scene, crate, "floor pushes up with 9.81 N"));
    EXPECT_TRUE(says(scene, ground, "It is static"));
}

TEST(BodyStory, AHangingBodyNamesItsRopeAndItsSpring)
{
    Scene scene({.sleeping = false});
    const BodyId a = scene.create_body({.type = BodyType::Dynamic, .position = {0, -1}});
    scene.create_shape(a, box(0.5f, 0.5f));
    scene.create_joint(DistanceDef{.body_b = a, .anchor_a = {0, 0}, .min_length = 0, .max_length = 1});
    const BodyId b = scene.create_body({.type = BodyType::Dynamic, .position = {3, -1.0981}});
    scene.create_shape(b, box(0.5f, 0.5f));
    scene.create_joint(SpringDef{.body_b = b, .anchor_a = {3, 0}, .stiffness = 100, .damping = 5, .length = 1});
    for (int i = 0; i < 240; ++i)
        scene.step(1.0f / 60);
    EXPECT_TRUE(says(scene, a, "A rope of at most 1.00 m, now 1.00 m: taut")) << all_of(scene, a);
    EXPECT_TRUE(says(scene, a, "cancel out")) << all_of(scene, a);
    EXPECT_TRUE(says(scene, b, "A spring that is stretched")) << all_of(scene, b);
    EXPECT_TRUE(says(scene, b, "100·(1.00 − 1.10) − 5.00·")) << all_of(scene, b);
    EXPECT_TRUE(says(scene, b, "cancel out")) << all_of(scene, b);
}

TEST(BodyStory, ATriggerNamesWhoIsInside)
{
    Scene scene({.gravity = {0, 0}});
    const BodyId gate = scene.create_body({});
    scene.create_shape(gate, box(1, 1), {.trigger = true});
    EXPECT_TRUE(says(scene, gate, "Now: nobody"));
    const BodyId ball = scene.create_body({.type = BodyType::Dynamic});
    scene.create_shape(ball, Circle{});
    scene.step(1.0f / 60);
    EXPECT_TRUE(says(scene, gate, "Now: ball"));
}

} // namespace
} // namespace carom::view
