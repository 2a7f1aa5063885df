// Symptom: elastic plates at 300 m/s struck each other twice within a step and kept 0.34 of their energy, while the events said that nothing was lost; at
// 100 m/s the impulses in the events missed the momentum by 1.2 N s.

#include "regressions/numbers.h"
#include "regressions/shapes.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

struct Motion
{
    double x = 0;
    double y = 0;
};

// The impulse that a body was given, by the events.
Motion impulses_on(Scene& scene, BodyId body)
{
    Motion sum;
    for (const ImpactEvent& e : scene.impacts())
    {
        const double sign = (e.body_b == body ? 1 : 0) - (e.body_a == body ? 1 : 0);
        const Vec2 t = perp(e.normal);
        sum.x += sign * (d(e.impulse) * d(e.normal.x) + d(e.friction_impulse) * d(t.x));
        sum.y += sign * (d(e.impulse) * d(e.normal.y) + d(e.friction_impulse) * d(t.y));
    }
    return sum;
}

std::vector<NamedShape> long_shapes()
{
    return {{"plate", box(0.01f, 0.3f)},
            {"box", box(0.2f, 0.3f)},
            {"capsule", Capsule{.a = {0, -0.3f}, .b = {0, 0.3f}, .radius_a = 0.05f, .radius_b = 0.05f}},
            {"triangle", Polygon{.vertices = {{0, 0.5f}, {-0.1f, -0.3f}, {0.2f, -0.3f}}}},
            {"ball", Circle{.radius = 0.25f}}};
}

struct Result
{
    double energy = 0;          ///< after over before
    double told = 0;            ///< energy that events say was lost, over before
    double momentum_off = 0;    ///< of what was given to b, over what it had
    std::size_t most_blows = 0; ///< in a step
};

Result collide(const Geometry& first, const Geometry& second, float speed, float offset, float spin, const ShapeDef& def)
{
    Scene scene(weightless());
    const BodyId a = add_dynamic(scene, {-0.5, 0}, first, def, {speed, 0}, spin).body;
    const BodyId b = add_dynamic(scene, {0.5, -d(offset)}, second, def, {-speed, 0}, -0.7f * spin).body;
    const auto kinetic_now = [&] { return kinetic(scene, a) + kinetic(scene, b); };
    const double start = kinetic_now();
    const double mass = d(scene.body(b).mass());
    const Vec2 v = scene.body(b).velocity();
    Result result;
    Motion given;
    for (int i = 0; i < 4; ++i)
    {
        scene.step(dt);
        const Motion now = impulses_on(scene, b);
        given.x += now.x;
        given.y += now.y;
        for (const ImpactEvent& e : scene.impacts())
            result.told += d(e.energy_lost) / start;
        result.most_blows = std::max(result.most_blows, scene.impacts().size());
    }
    const Vec2 u = scene.body(b).velocity();
    result.energy = kinetic_now() / start;
    result.momentum_off = std::hypot(given.x - mass * (d(u.x) - d(v.x)), given.y - mass * (d(u.y) - d(v.y))) / (mass * d(speed));
    return result;
}

} // namespace

TEST(BlowsInAStep, EachHasItsEventAndTheSumsAgree)
{
    std::size_t most_blows = 0;
    for (const auto& [name_a, first] : long_shapes())
    {
        for (const auto& [name_b, second] : long_shapes())
        {
            for (const float speed : {10.0f, 100.0f, 300.0f, 1000.0f})
            {
                for (const float offset : {0.0f, 0.1f, 0.204f, 0.25f, 0.31f, 0.45f})
                {
                    for (const float spin : {0.0f, 300.0f})
                    {
                        for (const ShapeDef& def :
                             {ShapeDef{.friction = 0, .restitution = 1}, ShapeDef{.friction = 0, .restitution = 0.5f},
                              ShapeDef{.friction = 0.4f, .restitution = 1}, ShapeDef{.friction = 0.4f, .restitution = 0.2f}})
                        {
                            SCOPED_TRACE(name_a + " and " + name_b + " at " + std::to_string(speed) + " m/s, " +
                                         std::to_string(offset) + " m beside, turning at " + std::to_string(spin) +
                                         ", friction " + std::to_string(def.friction) + ", e " + std::to_string(def.restitution));
                            const Result r = collide(first, second, speed, offset, spin, def);
                            EXPECT_LT(r.energy, 1 + 1e-4);
                            EXPECT_LT(r.energy + r.told, 1 + 1e-3);
                            if (def.restitution < 1)
                                continue; // they go on pressing: contact forces have no events
                            if (speed > 10 || spin == 0)
                            {
                                EXPECT_NEAR(r.energy + r.told, 1, 1e-3);
                                EXPECT_LT(r.momentum_off, 1e-3);
                            }
                            if (def.friction == 0)
                            {
                                EXPECT_GT(r.energy, 1 - 1e-3);
                            }
                            most_blows = std::max(most_blows, r.most_blows);
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(most_blows, 3u);
}

// Between two walls, and many of them at once.
TEST(BlowsInAStep, OfABodyThatFliesToAndFroKeepItsEnergy)
{
    for (const auto& [name, shape] : long_shapes())
    {
        for (const float speed : {20.0f, 150.0f, 600.0f})
        {
            for (const float turn : {0.0f, 0.3f})
            {
                SCOPED_TRACE(name + " at " + std::to_string(speed) + " m/s, turned by " + std::to_string(turn));
                Scene scene(weightless());
                const ShapeDef elastic{.friction = 0, .restitution = 1};
                for (const double side : {-1.0, 1.0})
                    add_static(scene, box(0.5f, 50), elastic, {side * 2, 0});
                const BodyId body =
                    add(scene, {.type = BodyType::Dynamic, .angle = turn, .velocity = {speed, 0}}, shape, elastic).body;
                const double start = kinetic(scene, body);
                const double mass = d(scene.body(body).mass());
                std::size_t blows = 0;
                for (int i = 0; i < 10; ++i)
                {
                    const Vec2 before = scene.body(body).velocity();
                    scene.step(dt);
                    const Motion given = impulses_on(scene, body);
                    EXPECT_NEAR(given.x, mass * (d(scene.body(body).velocity().x) - d(before.x)), 1e-4 * mass * d(speed));
                    blows += scene.impacts().size();
                    for (const ImpactEvent& e : scene.impacts())
                        EXPECT_LT(std::abs(e.energy_lost), 1e-3 * start);
                }
                EXPECT_NEAR(kinetic(scene, body) / start, 1, 1e-3);
                EXPECT_GT(d(static_cast<float>(blows)), d(speed) * 10 * d(dt) / 3 - 2);
            }
        }
    }
}

namespace {

struct Row
{
    double energy = 0;   ///< the most after a step, over the first
    double momentum = 0; ///< the most that is missing, over that of one who strikes
    bool passed = false; ///< one is on the other side of its neighbour
};

// Bodies at rest in a row with gaps, struck from both ends in one step: who is struck strikes the next.
Row pass_on(const Geometry& shape, int count, double gap, float from_left, float from_right, const ShapeDef& def)
{
    Scene scene(weightless());
    std::vector<BodyId> row;
    for (int i = 0; i < count; ++i)
    {
        const Vec2 v{i == 0 ? from_left : i == count - 1 ? -from_right : 0.0f, 0};
        row.push_back(add_dynamic(scene, {gap * i, 0}, shape, def, v).body);
    }
    const auto energy = [&]
    {
        double sum = 0;
        for (const BodyId b : row)
            sum += kinetic(scene, b);
        return sum;
    };
    const auto momentum = [&]
    {
        double sum = 0;
        for (const BodyId b : row)
            sum += d(scene.body(b).mass()) * d(scene.body(b).velocity().x);
        return sum;
    };
    const double energy_before = energy();
    const double momentum_before = momentum();
    Row result;
    for (int step = 0; step < 3; ++step)
    {
        scene.step(dt);
        result.energy = std::max(result.energy, energy() / energy_before);
        const double missing = std::fabs(momentum() - momentum_before) / (d(scene.body(row[0]).mass()) * d(from_left));
        result.momentum = std::max(result.momentum, missing);
        for (std::size_t i = 1; i < row.size(); ++i)
            result.passed |= scene.body(row[i]).position().x < scene.body(row[i - 1]).position().x && shape.index() == 0;
    }
    return result;
}

} // namespace

// Whoever strikes within the step sees the others where they are, not where the step began.
TEST(BlowsInAStep, WhatIsStruckStrikesTheNextWhereItIs)
{
    for (const auto& [name, shape] : long_shapes())
    {
        for (const int count : {3, 4, 5, 8})
        {
            for (const double gap : {0.7, 1.5, 4.0})
            {
                for (const auto& [left, right] : {std::pair(100.0f, 0.0f), {400.0f, 50.0f}, {500.0f, 400.0f}, {1000.0f, 900.0f}})
                {
                    for (const ShapeDef& def :
                         {ShapeDef{.friction = 0, .restitution = 1}, ShapeDef{.friction = 0.3f, .restitution = 0.6f}})
                    {
                        SCOPED_TRACE(std::to_string(count) + " of " + name + ", " + std::to_string(gap) + " m apart, at " +
                                     std::to_string(left) + " and " + std::to_string(right) + " m/s, e " +
                                     std::to_string(def.restitution));
                        const Row r = pass_on(shape, count, gap, left, right, def);
                        EXPECT_LT(r.energy, 1 + 1e-4);
                        EXPECT_LT(r.momentum, 1e-4);
                        EXPECT_FALSE(r.passed);
                    }
                }
            }
        }
    }
}
