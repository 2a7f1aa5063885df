#include "web/scenes.h"

#include "scenes/benchmark.h"

#include <cmath>
#include <numbers>

namespace web {
namespace {

using namespace carom;
using carom::scenes::add_dynamic;
using carom::scenes::add_static;
using carom::scenes::BuiltScene;
using carom::scenes::SceneEntry;
using carom::scenes::sleepless_def;

BuiltScene pyramid(const SceneDef& base)
{
    constexpr int rows = 20;
    BuiltScene built{Scene(sleepless_def(base))};
    add_static(built.scene, box(40, 1), {}, {0, -1});
    carom::scenes::add_pyramid(built.scene, rows, 0.5f, -0.5f * rows, 0);
    return built;
}

BuiltScene tumbler(const SceneDef& base) { return scenes::find_scene("tumbler")->create(sleepless_def(base)); }

Polygon hexagon(float radius)
{
    Polygon p;
    for (int i = 0; i < 6; ++i)
    {
        const Rotation q = Rotation::from_angle(static_cast<float>(i) * std::numbers::pi_v<float> / 3);
        p.vertices.push_back({radius * q.c, radius * q.s});
    }
    return p;
}

BuiltScene pile(const SceneDef& base)
{
    constexpr int columns = 50;
    constexpr int rows = 40;
    constexpr float pitch = 0.55f;
    constexpr float half_width = 0.5f * pitch * columns;
    BuiltScene built{Scene(sleepless_def(base))};
    Scene& scene = built.scene;
    add_static(scene, box(half_width + 1, 0.5f), {}, {0, -0.5f});
    for (const float side : {-1.0f, 1.0f})
        add_static(scene, box(0.5f, 15), {}, {side * (half_width + 0.5f), 15});
    const Geometry kinds[] = {Circle{.radius = 0.25f}, box(0.25f, 0.25f),
                              Capsule{.a = {-0.12f, 0}, .b = {0.12f, 0}, .radius_a = 0.13f, .radius_b = 0.13f}, hexagon(0.25f)};
    scenes::Random random(7);
    for (int i = 0; i < columns * rows; ++i)
    {
        const float x = (static_cast<float>(i % columns) + 0.5f) * pitch - half_width + random.in(-0.02f, 0.02f);
        const float y = (static_cast<float>(i / columns) + 0.5f) * pitch;
        add_dynamic(scene, {x, y}, kinds[random.below(4)], {}, {}, random.in(-3, 3));
    }
    return built;
}

constexpr SceneEntry list[] = {
    {.name = "pyramid", .description = "A pyramid of 210 boxes.", .create = pyramid, .frames = 2300},
    {.name = "tumbler", .description = "2,025 boxes in a turning drum.", .create = tumbler, .frames = 600},
    {.name = "pile",
     .description = "2,000 discs, boxes, capsules and hexagons fall into a trough.",
     .create = pile,
     .frames = 600},
};

} // namespace

std::span<const SceneEntry> scenes() { return list; }

} // namespace web
