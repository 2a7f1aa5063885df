// Symptom: steps of 1/60 s in turn with steps of 1e-5 s shook a resting stack at 0.6 m/s, and in steps of 0.1 s ten boxes sank by 0.8 m.

#include "regressions/numbers.h"
#include "support/effort.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

/// Something that rests.
struct Still
{
    Scene scene{sleepless()};
    std::vector<BodyId> bodies;
    std::vector<double> heights;

    void rest()
    {
        steps(scene, 180);
        for (const BodyId id : bodies)
            heights.push_back(scene.body(id).center_of_mass().y);
    }
};

Still stack(int count, const Geometry& geometry)
{
    Still s;
    add_static(s.scene, HalfSpace{});
    for (int i = 0; i < count; ++i)
        s.bodies.push_back(add_dynamic(s.scene, {0, 0.5 + i}, geometry).body);
    s.rest();
    return s;
}

Still pyramid(int rows)
{
    Still s;
    add_static(s.scene, HalfSpace{});
    for (int row = 0; row < rows; ++row)
    {
        for (int i = 0; i < rows - row; ++i)
            s.bodies.push_back(add_dynamic(s.scene, {1.05 * (i + 0.5 * row), 0.5 + row}, box(0.5f, 0.5f)).body);
    }
    s.rest();
    return s;
}

// Solved all at once, or in lanes.
Still hanging_chain(int count)
{
    Still s;
    BodyId last{};
    for (int i = 0; i < count; ++i)
    {
        const BodyId link = add_dynamic(s.scene, {0, -0.5 - i}, box(0.1f, 0.5f), {.filter = {.mask = 0}}).body;
        s.scene.create_joint(
            RevoluteDef{.body_a = last, .body_b = link, .anchor_a = {0, last.is_null() ? 0 : -0.5f}, .anchor_b = {0, 0.5f}});
        s.bodies.push_back(link);
        last = link;
    }
    s.rest();
    return s;
}

struct Kind
{
    const char* name;
    std::function<Still()> make;
};

std::vector<Kind> kinds()
{
    return {
        {"a box", [] { return stack(1, box(0.5f, 0.5f)); }},
        {"ten boxes", [] { return stack(10, box(0.5f, 0.5f)); }},
        {"thirty boxes", [] { return stack(30, box(0.5f, 0.5f)); }},
        {"ten rounded boxes", [] { return stack(10, box(0.4f, 0.4f, {}, 0, 0.1f)); }},
        {"a pyramid of twelve rows", [] { return pyramid(12); }},
        {"a pyramid of twenty rows", [] { return pyramid(20); }},
        {"a chain of ten", [] { return hanging_chain(10); }},
    };
}

struct Rhythm
{
    const char* name;
    std::function<float(int)> step; ///< s
    double speed;                   ///< most that anything may move at, m/s
    double way;                     ///< m
};

} // namespace

TEST(StepsThatChange, WhatRestsGoesOnResting)
{
    const std::vector<Rhythm> rhythms = {
        {"1/60 and 1e-6", [](int i) { return i % 2 == 0 ? 1.0f / 60 : 1e-6f; }, 0.02, 0.002},
        {"1/60 and 1e-5", [](int i) { return i % 2 == 0 ? 1.0f / 60 : 1e-5f; }, 0.02, 0.002},
        {"1/60 and 1e-3", [](int i) { return i % 2 == 0 ? 1.0f / 60 : 1e-3f; }, 0.02, 0.002},
        {"1/60 and 1/240", [](int i) { return i % 2 == 0 ? 1.0f / 60 : 1.0f / 240; }, 0.02, 0.005},
        {"thirty of 1/60 and thirty of 1e-4", [](int i) { return i / 30 % 2 == 0 ? 1.0f / 60 : 1e-4f; }, 0.02, 0.002},
        {"1/60 to 1/75", [](int i) { return 1 / (60 + static_cast<float>(i * 7 % 15)); }, 0.15, 0.03},
        {"one of 1e-4, then 1/60", [](int i) { return i == 0 ? 1e-4f : 1.0f / 60; }, 0.02, 0.002},
    };
    for (const auto& [kind, make] : kinds())
    {
        for (const Rhythm& rhythm : rhythms)
        {
            SCOPED_TRACE(std::string(kind) + ", " + rhythm.name);
            Still still = make();
            double speed = 0;
            double way = 0;
            for (int i = 0; i < 300 / (slow_build ? 5 : 1); ++i)
            {
                still.scene.step(rhythm.step(i));
                for (std::size_t k = 0; k < still.bodies.size(); ++k)
                {
                    const Body body = still.scene.body(still.bodies[k]);
                    speed = std::max(speed, d(length(body.velocity())));
                    way = std::max(way, std::abs(body.center_of_mass().y - still.heights[k]));
                }
            }
            EXPECT_LT(speed, rhythm.speed);
            EXPECT_LT(way, rhythm.way);
        }
    }
}

// No worse than in steps of 1/30 s.
TEST(StepsThatChange, LongStepsSinkNothing)
{
    for (const auto& [kind, make] : kinds())
    {
        const auto sunk = [&](float step, float time)
        {
            Still still = make();
            for (float t = 0; t < time; t += step)
                still.scene.step(step);
            double way = 0;
            for (std::size_t k = 0; k < still.bodies.size(); ++k)
                way = std::max(way, std::abs(still.scene.body(still.bodies[k]).center_of_mass().y - still.heights[k]));
            return way;
        };
        SCOPED_TRACE(kind);
        const double usual = sunk(1.0f / 30, 4);
        for (const float step : {0.05f, 0.1f, 0.25f, 1.0f})
            EXPECT_LT(sunk(step, 4), 1.1 * usual + 0.001) << step;
    }
}

// A throw goes as far.
TEST(StepsThatChange, WhatFliesFliesOn)
{
    Scene scene(sleepless());
    const BodyId ball = add_dynamic(scene, {0, 100}, Circle{.radius = 0.5f}, {}, {3, 0}).body;
    double time = 0;
    for (int i = 0; i < 200; ++i)
    {
        const float step = i % 3 == 0 ? 0.02f : i % 3 == 1 ? 1e-5f : 0.005f;
        scene.step(step);
        time += d(step);
    }
    EXPECT_NEAR(scene.body(ball).position().x, 3 * time, 1e-3);
    EXPECT_NEAR(scene.body(ball).position().y, 100 - 0.5 * d(-scene.gravity().y) * time * time, 1e-3);
}
