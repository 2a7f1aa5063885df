// Symptom: a frictionless box on a row of flush static boxes stopped dead at the first seam, or was thrown eight metres high at 25 m/s; on a wall of tiles a
// pressed body hung. What lies side by side has no edges inside.

#include "regressions/numbers.h"
#include "regressions/shapes.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

using namespace carom;
using namespace carom::test;

namespace {

constexpr ShapeDef slippery{.friction = 0};

void add_tile(Scene& scene, BodyId body, float from, float to)
{
    scene.create_shape(body, box(0.5f * (to - from), 0.5f, {0.5f * (from + to), -0.5f}), slippery);
}

// Along y = 0, from x = 0 to 30.
using Floor = std::pair<std::string, std::function<void(Scene&)>>;

template <class Visit>
void for_each_tile(float width, const Visit& visit)
{
    for (float x = 0; x < 30; x += width)
        visit(x, x + width);
}

std::vector<Floor> floors()
{
    const auto bodies = [](BodyType type, float width, float gap)
    {
        return [=](Scene& scene)
        {
            for_each_tile(width,
                          [&](float from, float to) { add_tile(scene, scene.create_body({.type = type}), from, to - gap); });
        };
    };
    const auto one_body = [](BodyType type)
    {
        return [=](Scene& scene)
        {
            const BodyId body = scene.create_body({.type = type});
            for_each_tile(1, [&](float from, float to) { add_tile(scene, body, from, to); });
        };
    };
    return {
        {"static boxes", bodies(BodyType::Static, 1, 0)},
        {"small boxes", bodies(BodyType::Static, 0.25f, 0)},
        {"kinematic boxes", bodies(BodyType::Kinematic, 1, 0)},
        {"gaps of 1 mm", bodies(BodyType::Static, 1, 0.001f)},
        {"gaps of 4 mm", bodies(BodyType::Static, 1, 0.004f)},
        {"overlapping", bodies(BodyType::Static, 1, -0.1f)},
        {"one body", one_body(BodyType::Static)},
        {"one kinematic body", one_body(BodyType::Kinematic)},
        {"static beside kinematic",
         [](Scene& scene)
         {
             for_each_tile(1,
                           [&](float from, float to)
                           {
                               const bool odd = static_cast<int>(from) % 2 != 0;
                               add_tile(scene, scene.create_body({.type = odd ? BodyType::Static : BodyType::Kinematic}), from,
                                        to);
                           });
         }},
        {"segments",
         [](Scene& scene)
         {
             for_each_tile(1, [&](float from, float to) { add_static(scene, Segment{.a = {from, 0}, .b = {to, 0}}, slippery); });
         }},
        {"one-sided segments",
         [](Scene& scene)
         {
             for_each_tile(1, [&](float from, float to)
                           { add_static(scene, Segment{.a = {from, 0}, .b = {to, 0}, .sides = Sides::Left}, slippery); });
         }},
        {"chains end to end",
         [](Scene& scene)
         {
             for_each_tile(
                 2, [&](float from, float to)
                 { add_static(scene, Chain{.start = {from, 0}, .pieces = {{{0.5f * (from + to), 0}}, {{to, 0}}}}, slippery); });
         }},
        {"boxes and segments",
         [](Scene& scene)
         {
             for_each_tile(2,
                           [&](float from, float to)
                           {
                               add_tile(scene, scene.create_body({}), from, from + 1);
                               add_static(scene, Segment{.a = {from + 1, 0}, .b = {to, 0}}, slippery);
                           });
         }},
        {"tiles in a half-space",
         [](Scene& scene)
         {
             add_static(scene, HalfSpace{}, slippery);
             for_each_tile(2, [&](float from, float) { add_tile(scene, scene.create_body({}), from, from + 1); });
         }},
        {"two rows",
         [](Scene& scene)
         {
             for_each_tile(1,
                           [&](float from, float to)
                           {
                               add_static(scene, box(0.5f * (to - from), 0.25f, {0.5f * (from + to), -0.25f}), slippery);
                               add_static(scene, box(0.5f * (to - from), 0.25f, {0.5f * (from + to) + 0.5f, -0.75f}), slippery);
                           });
         }},
    };
}

struct Slide
{
    double least_speed = 1e9;
    double most_speed = 0;
    double lowest = 0;
    double highest = 0;
};

Slide slide(const Floor& floor, const Geometry& shape, float speed, bool locked, double start, float scale = 1)
{
    Scene scene({.length_scale = scale});
    floor.second(scene);
    const BodyId body =
        add(scene, {.type = BodyType::Dynamic, .position = {start, 0.6}, .velocity = {speed, 0}, .locks = {.angular = locked}},
            shape, slippery)
            .body;
    Slide s;
    const int count = std::min(300, static_cast<int>(20 / speed * 60));
    double height = 0;
    for (int i = 0; i < count && scene.body(body).position().x < 24; ++i)
    {
        scene.step(dt);
        if (i == 20)
            height = scene.body(body).position().y; // settled
        if (i < 20)
            continue;
        const double y = scene.body(body).position().y - height;
        s.lowest = std::min(s.lowest, y);
        s.highest = std::max(s.highest, y);
        s.least_speed = std::min(s.least_speed, d(scene.body(body).velocity().x));
        s.most_speed = std::max(s.most_speed, d(scene.body(body).velocity().x));
    }
    return s;
}

} // namespace

TEST(FlushNeighbours, NothingFeelsTheSeams)
{
    for (const Floor& floor : floors())
    {
        for (const auto& [name, shape] : moving_shapes())
        {
            const bool tips = name == "upright capsule" || name == "tapered capsule"; // by itself, on a point
            for (const float speed : {0.1f, 0.3f, 1.0f, 3.0f, 10.0f, 30.0f})
            {
                for (const bool locked : {false, true})
                {
                    if (tips && !locked)
                        continue;
                    SCOPED_TRACE(floor.first + ", " + name + " " + std::to_string(speed) + (locked ? " locked" : ""));
                    const Slide s = slide(floor, shape, speed, locked, 1.7137);
                    EXPECT_GT(s.least_speed, 0.99 * d(speed));
                    EXPECT_LT(s.most_speed, 1.01 * d(speed));
                    EXPECT_GT(s.lowest, -0.001);
                    EXPECT_LT(s.highest, 0.001);
                }
            }
        }
    }
}

TEST(FlushNeighbours, WorkAtOtherScales)
{
    for (const float scale : {0.1f, 10.0f})
    {
        for (const auto& [name, shape] : {moving_shapes()[0], moving_shapes()[4], moving_shapes()[7]})
        {
            for (const float speed : {1.0f, 10.0f})
            {
                const Slide s = slide(floors()[0], shape, speed, false, 1.7137, scale);
                EXPECT_GT(s.least_speed, 0.99 * d(speed)) << name << scale;
                EXPECT_LT(s.highest, 0.001) << name << scale;
            }
        }
    }
}

TEST(FlushNeighbours, ATileEditorMayWorkWhileThingsSlide)
{
    Scene scene;
    std::vector<BodyId> tiles;
    const auto add_at = [&](int i)
    {
        const BodyId tile = scene.create_body({});
        add_tile(scene, tile, static_cast<float>(i), static_cast<float>(i + 1));
        tiles.push_back(tile);
    };
    for (int i = 0; i < 4; ++i)
        add_at(i);
    const BodyId body = add_dynamic(scene, {0.9, 0.4}, box(0.4f, 0.4f), slippery, {3, 0}).body;
    for (int i = 0; i < 300; ++i)
    { // made before it, taken away behind it
        scene.step(dt);
        const double x = scene.body(body).position().x;
        if (static_cast<double>(tiles.size()) < x + 2.5)
            add_at(static_cast<int>(tiles.size()));
        const auto behind = static_cast<std::size_t>(std::max(x - 1.5, 0.0));
        if (behind > 0 && scene.is_valid(tiles[behind - 1]))
            scene.destroy(tiles[behind - 1]);
    }
    EXPECT_NEAR(d(scene.body(body).velocity().x), 3, 0.03);
    EXPECT_NEAR(scene.body(body).position().y, 0.4, 0.001);
}

TEST(FlushNeighbours, APressedBodyFallsAlongAWall)
{
    for (const bool one_body : {false, true})
    {
        for (const auto& [name, shape] : moving_shapes())
        {
            for (const float press : {0.0f, 1.0f, 10.0f, 200.0f}) // m/s²
            {
                SCOPED_TRACE(name + " " + std::to_string(press));
                Scene scene;
                const BodyId wall = scene.create_body({});
                for (int i = 0; i < 60; ++i)
                {
                    const BodyId tile = one_body ? wall : scene.create_body({});
                    scene.create_shape(tile, box(0.5f, 0.5f, {0.5f, -0.5f - static_cast<float>(i)}), slippery);
                }
                const BodyId body =
                    add(scene, {.type = BodyType::Dynamic, .position = {-1, -1.3}, .locks = {.angular = true}}, shape, slippery)
                        .body;
                for (int i = 0; i < 120; ++i)
                {
                    scene.body(body).apply_force({press * scene.body(body).mass(), 0});
                    scene.step(dt);
                }
                EXPECT_NEAR(d(scene.body(body).velocity().y), -2 * 9.81, 0.01 * 2 * 9.81);
                EXPECT_LT(scene.body(body).position().x, -0.29);
            }
        }
    }
}

TEST(FlushNeighbours, ARealStepStopsWhatHitsIt)
{
    for (const bool sunk : {false, true})
    { // set on the tiles, or a taller tile among them
        for (const float height : {0.015f, 0.05f, 0.3f, 2.0f})
        {
            for (const float speed : {0.3f, 1.0f, 5.0f, 25.0f})
            {
                for (const auto& [name, shape] : {moving_shapes()[0], NamedShape{"narrow box", box(0.2f, 0.6f)}})
                {
                    SCOPED_TRACE(name + " " + std::to_string(speed) + " at " + std::to_string(height));
                    Scene scene;
                    for_each_tile(1, [&](float from, float to) { add_tile(scene, scene.create_body({}), from, to); });
                    const float bottom = sunk ? -1.0f : 0.0f;
                    add_static(scene, box(0.5f, 0.5f * (height - bottom), {8.5f, 0.5f * (height + bottom)}), slippery);
                    const BodyId body = add(scene,
                                            {.type = BodyType::Dynamic,
                                             .position = {5.03, 0.6},
                                             .velocity = {speed, 0},
                                             .locks = {.angular = true}},
                                            shape, slippery)
                                            .body;
                    double farthest = 0;
                    for (int i = 0; i < 900 && scene.body(body).velocity().x > 0; ++i)
                    {
                        scene.step(dt);
                        farthest = std::max(farthest, scene.body(body).position().x);
                    }
                    EXPECT_NEAR(farthest, 8 - (name == "box" ? 0.5 : 0.2), 0.006);
                    EXPECT_NEAR(scene.body(body).position().y, 0.6, 0.002);
                }
            }
        }
    }
}
