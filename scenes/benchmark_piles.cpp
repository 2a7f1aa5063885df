// Pyramids that stand, heaps that fall into a pit, a wall that is smashed.

#include "scenes/benchmark.h"
#include "scenes/families.h"

#include <algorithm>

namespace carom::scenes {

void add_pyramid(Scene& scene, int rows, float half, float left, float bottom)
{
    for (int row = 0; row < rows; ++row)
        for (int i = row; i < rows; ++i)
        {
            const auto along = static_cast<float>(row + 1) + 2 * static_cast<float>(i - row);
            const auto up = static_cast<float>(2 * row + 1);
            add_dynamic(scene, Vec2{along * half + left, up * half + bottom}, box(half, half));
        }
}

namespace {

BuiltScene large_pyramid(const SceneDef& base)
{
    BuiltScene built{Scene(sleepless_def(base))};
    add_static(built.scene, box(100, 1), {}, {0, -1});
    add_pyramid(built.scene, 100, 0.5f, -50, 0);
    return built;
}

BuiltScene many_pyramids(const SceneDef& base)
{
    constexpr int floors = 20;
    constexpr int columns = 20;
    constexpr float pitch = 11;
    constexpr float half_width = 0.5f * pitch * columns;
    BuiltScene built{Scene(sleepless_def(base))};
    const BodyId ground = built.scene.create_body({});
    for (int i = 0; i < floors; ++i)
    {
        const float y = pitch * static_cast<float>(i);
        built.scene.create_shape(ground, Segment{{-half_width, y}, {half_width, y}});
        for (int j = 0; j < columns; ++j)
            add_pyramid(built.scene, 10, 0.5f, pitch * static_cast<float>(j) + 0.5f - half_width, y);
    }
    return built;
}

BuiltScene smash(const SceneDef& base)
{
    SceneDef def = benchmark_def(base);
    def.gravity = {0, 0};
    BuiltScene built{Scene(def)};
    add_dynamic(built.scene, {-20, 0}, box(4, 4), {.density = 8}, {40, 0});
    constexpr float size = 0.4f;
    constexpr int rows = 80;
    for (int i = 0; i < 120; ++i)
        for (int j = 0; j < rows; ++j)
        {
            const Vec2 at{static_cast<float>(i) * size + 30, static_cast<float>(j - rows / 2) * size};
            const BodyId brick = add_dynamic(built.scene, at, box(size / 2, size / 2));
            built.scene.body(brick).set_awake(false); // after its shape, which wakes it
        }
    return built;
}

/// A pit of blocks of 1 m that reach 5 cm into their neighbours.
BodyId add_pit(Scene& scene, int half_width, int wall_blocks)
{
    const BodyId ground = scene.create_body({});
    for (int i = -half_width; i <= half_width; ++i)
        scene.create_shape(ground, box(0.55f, 0.5f, {static_cast<float>(i), 0}));
    for (const int side : {-half_width, half_width})
        for (int i = 1; i <= wall_blocks; ++i)
            scene.create_shape(ground, box(0.5f, 0.55f, {static_cast<float>(side), static_cast<float>(i)}));
    return ground;
}

BuiltScene compounds(const SceneDef& base)
{
    BuiltScene built{Scene(benchmark_def(base))};
    const BodyId ground = add_pit(built.scene, 40, 100);
    built.scene.create_shape(ground, Segment{{-800, -80}, {800, -80}});
    const Polygon left{{{-1, 0}, {0.5f, 1}, {0, 2}}};
    const Polygon right{{{1, 0}, {-0.5f, 1}, {0, 2}}};
    const ShapeDef material{.friction = 0.5f};
    float side = 0.25f;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 150; ++j)
        {
            const Vec2 at{2 * static_cast<float>(i) - 19 + side, 2.25f * static_cast<float>(j) + 5.575f};
            const BodyId body = add_dynamic(built.scene, at, left, material);
            built.scene.create_shape(body, right, material);
            side = -side;
        }
    return built;
}

/// Five corners a golden angle apart on a circle, in order around it.
Polygon golden_pentagon(float radius)
{
    const float golden = pi * 1.2360680f; // pi (sqrt 5 - 1)
    Polygon polygon;
    for (const int i : {0, 2, 4, 1, 3})
        polygon.vertices.push_back(rotate(Rotation::from_angle(golden * static_cast<float>(i)), {radius, 0}));
    return polygon;
}

BuiltScene junkyard(const SceneDef& base)
{
    constexpr int columns = 200;
    BuiltScene built{Scene(benchmark_def(base))};
    Scene& scene = built.scene;
    add_pit(scene, 80, 50);
    const Polygon pentagon = golden_pentagon(0.25f);
    float side = -0.1f;
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < 40; ++j)
        {
            add_dynamic(scene, Vec2{0.375f * static_cast<float>(2 * i - columns) + side, static_cast<float>(j) + 15}, pentagon);
            side = -side;
        }
    const BodyId pusher = scene.create_body({.type = BodyType::Kinematic});
    scene.create_shape(pusher, box(2, 4, {0, 4}));
    built.before_step = [pusher](Scene& s, float h)
    {
        const float time = static_cast<float>(s.step_count()) / static_cast<float>(steps_in(1, h));
        const float x = 60 * Rotation::from_angle(0.2f * time).s;
        s.body(pusher).set_target_pose({x, 0}, 0);
    };
    return built;
}

constexpr SceneEntry entries[] = {
    {.name = "compounds",
     .description = "Three thousand arrowheads, two triangles each, fall into a pit.",
     .create = compounds,
     .frames = 500,
     .view = {{-45, -2}, {45, 60}}},
    {.name = "junkyard",
     .description = "A pusher ploughs to and fro through eight thousand pentagons.",
     .create = junkyard,
     .frames = 800,
     .view = {{-85, -2}, {85, 60}}},
    {.name = "large_pyramid",
     .description = "A pyramid of a hundred rows, 5,050 boxes.",
     .create = large_pyramid,
     .frames = 500,
     .view = {{-80, -2}, {80, 102}},
     .stands = true},
    {.name = "many_pyramids",
     .description = "Four hundred pyramids of 55 boxes on twenty floors.",
     .create = many_pyramids,
     .frames = 200,
     .view = {{-115, -2}, {115, 222}},
     .stands = true},
    {.name = "smash",
     .description = "A heavy box at 40 m/s meets a wall of 9,600 sleeping bricks.",
     .create = smash,
     .frames = 300,
     .view = {{-30, -40}, {110, 40}}},
};

} // namespace

std::span<const SceneEntry> benchmark_pile_scenes() { return entries; }

} // namespace carom::scenes
