#include "scenes/build.h"
#include "scenes/families.h"

#include <array>

namespace carom::scenes {
namespace {

Polygon regular_polygon(int corners, float radius)
{
    Polygon polygon;
    for (int i = 0; i < corners; ++i)
    {
        const Rotation turn = Rotation::from_angle(2 * pi * static_cast<float>(i) / static_cast<float>(corners));
        polygon.vertices.push_back(rotate(turn, {radius, 0}));
    }
    return polygon;
}

// An L from one concave outline: several shapes on one body.
void add_bracket(Scene& scene, BodyId body, float size)
{
    const std::array<Vec2, 6> outline{Vec2{-size, -size},       Vec2{size, -size},
                                      Vec2{size, -0.3f * size}, Vec2{-0.3f * size, -0.3f * size},
                                      Vec2{-0.3f * size, size}, Vec2{-size, size}};
    for (const Polygon& part : split_concave(outline))
        scene.create_shape(body, part);
}

void add_something(Scene& scene, Position at, Random& random)
{
    const BodyId body = scene.create_body({.type = BodyType::Dynamic, .position = at, .angle = random.in(-pi, pi)});
    const float size = random.in(0.2f, 0.45f);
    switch (random.below(6))
    {
    case 0: scene.create_shape(body, Circle{.radius = size}); break;
    case 1: scene.create_shape(body, box(size, size * random.in(0.4f, 1.0f))); break;
    case 2: scene.create_shape(body, Capsule{{-size, 0}, {size, 0}, 0.5f * size, 0.5f * size}); break;
    case 3: scene.create_shape(body, Capsule{{-size, 0}, {size, 0}, 0.6f * size, 0.25f * size}); break;
    case 4: scene.create_shape(body, regular_polygon(3 + random.below(5), size)); break;
    default: add_bracket(scene, body, size); break;
    }
}

BuiltScene mixed_pile(const SceneDef& base)
{
    BuiltScene built{Scene(base)};
    add_trough(built.scene, 6, 10);
    Random random(11);
    for (int row = 0; row < 20; ++row)
        for (int column = 0; column < 10; ++column)
            add_something(built.scene, {-4.95 + 1.1 * column + random.in(-0.05f, 0.05f), 0.7 + 1.05 * row}, random);
    return built;
}

BuiltScene drum(const SceneDef& base)
{
    BuiltScene built{Scene(base)};
    const BodyId walls = built.scene.create_body({.type = BodyType::Kinematic, .position = {0, 0}, .angular_velocity = 0.5f});
    for (const auto& [half, center] : {std::pair<Vec2, Vec2>{{5.25f, 0.25f}, {0, 5}},
                                       {{5.25f, 0.25f}, {0, -5}},
                                       {{0.25f, 5.25f}, {5, 0}},
                                       {{0.25f, 5.25f}, {-5, 0}}})
        built.scene.create_shape(walls, box(half.x, half.y, center));
    for (int i = 0; i < 225; ++i)
    {
        const Position at{-3.5 + 0.5 * (i % 15), -3.5 + 0.5 * (i / 15)};
        if (i % 3 == 0)
            add_dynamic(built.scene, at, Circle{.radius = 0.2f});
        else
            add_dynamic(built.scene, at, box(0.2f, 0.2f));
    }
    return built;
}

// From 5 mm to 5 m: a factor of a thousand.
BuiltScene many_sizes(const SceneDef& base)
{
    SceneDef def = base;
    def.length_scale = 0.05f;
    BuiltScene built{Scene(def)};
    Scene& scene = built.scene;
    add_trough(scene, 9, 14);
    add_dynamic(scene, {0, 5}, Circle{.radius = 5});
    for (const double x : {-7.4, 7.4})
        add_dynamic(scene, {x, 1.5}, Circle{.radius = 1.5f});
    Random random(5);
    for (int i = 0; i < 12; ++i)
        add_dynamic(scene, {-8.2 + 1.49 * i, 11.5 + 0.5 * (i % 2)}, box(0.4f, 0.25f));
    for (int i = 0; i < 60; ++i)
        add_dynamic(scene, {-8.6 + 0.29 * i, 13.2}, Circle{.radius = random.in(0.03f, 0.1f)});
    // The smallest have a roof of their own: what weighs thousands of times as much would press them into the floor.
    const BodyId bay = scene.create_body({.position = {10.5, 0}});
    for (const Vec2 at : {Vec2{0, -0.1f}, Vec2{0, 0.5f}})
        scene.create_shape(bay, box(0.6f, 0.1f, at));
    for (const float x : {-0.55f, 0.55f})
        scene.create_shape(bay, box(0.05f, 0.2f, {x, 0.2f}));
    for (int i = 0; i < 300; ++i)
        add_dynamic(scene, {10.2 + 0.012 * (i % 20) + random.in(0, 0.001f), 0.05 + 0.012 * (i / 20)}, Circle{.radius = 0.005f});
    return built;
}

constexpr SceneEntry entries[] = {
    {.name = "mixed_pile",
     .description = "Two hundred things of every shape fall into a trough and come to rest.",
     .create = mixed_pile,
     .view = {{-10, -1}, {10, 14}}},
    {.name = "drum", .description = "A turning drum keeps 225 bodies awake.", .create = drum, .view = {{-8, -8}, {8, 8}}},
    {.name = "many_sizes",
     .description = "Balls from 5 mm to 5 m in one trough: a factor of a thousand.",
     .create = many_sizes,
     .view = {{-10.5, -1}, {12, 15}}},
};

} // namespace

std::span<const SceneEntry> pile_scenes() { return entries; }

} // namespace carom::scenes
