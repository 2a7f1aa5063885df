// Scenes that turn and keep thousands of bodies moving.

#include "scenes/benchmark.h"
#include "scenes/families.h"

#include <limits>

namespace carom::scenes {
namespace {

constexpr float turning_speed = pi / 180 * 25;

/// A square grid of boxes whose lowest left one is at start.
void add_grid(Scene& scene, int count, Vec2 start, float pitch, const Polygon& geometry)
{
    float y = start.y;
    for (int i = 0; i < count; ++i, y += pitch)
    {
        float x = start.x;
        for (int j = 0; j < count; ++j, x += pitch)
            add_dynamic(scene, Vec2{x, y}, geometry);
    }
}

BuiltScene tumbler(const SceneDef& base)
{
    BuiltScene built{Scene(benchmark_def(base))};
    Scene& scene = built.scene;
    const BodyId ground = scene.create_body({});
    const BodyId drum = scene.create_body({.type = BodyType::Dynamic, .position = {0, 10}});
    const ShapeDef heavy{.density = 50};
    for (const float side : {10.0f, -10.0f})
    {
        scene.create_shape(drum, box(0.5f, 10, {side, 0}), heavy);
        scene.create_shape(drum, box(10, 0.5f, {0, side}), heavy);
    }
    scene.create_joint(RevoluteDef{.body_a = ground,
                                   .body_b = drum,
                                   .anchor_a = {0, 10},
                                   .enable_motor = true,
                                   .motor_speed = turning_speed,
                                   .max_motor_torque = 1e8f});
    add_grid(scene, 45, {-9, 1}, 0.4f, box(0.125f, 0.125f));
    return built;
}

/// The piece of a ring between two directions and two radii.
Polygon ring_piece(Vec2 from, Vec2 to, float inner, float outer)
{
    return {.vertices = {inner * from, outer * from, outer * to, inner * to}};
}

void add_washer_drum(Scene& scene)
{
    const BodyId drum = scene.create_body(
        {.type = BodyType::Kinematic, .position = {0, 10}, .velocity = {0.001f, -0.002f}, .angular_velocity = turning_speed});
    constexpr int pieces = 36;
    const Rotation turn = Rotation::from_angle(2 * pi / pieces);
    const Rotation lap = Rotation::from_angle(0.2f * pi / pieces); // the rim's pieces overlap a little
    Vec2 from{1, 0};
    for (int i = 0; i < pieces; ++i)
    {
        const Vec2 to = i == pieces - 1 ? Vec2{1, 0} : rotate(turn, from);
        scene.create_shape(drum, ring_piece(inverse_rotate(lap, from), rotate(lap, to), 16, 18));
        if (i % 9 == 0)
            scene.create_shape(drum, ring_piece(from, to, 14, 16));
        from = to;
    }
}

BuiltScene washer(const SceneDef& base)
{
    BuiltScene built{Scene(benchmark_def(base))};
    (void)built.scene.create_body({});
    add_washer_drum(built.scene);
    constexpr float half = 0.1f;
    add_grid(built.scene, 90, {-99 * half, -99 * half + 10}, 2.1f * half, box(half, half));
    return built;
}

/// A ring of 360 straight pieces, solid to what is inside.
Chain ring(Vec2 center, float radius)
{
    constexpr int corners = 360;
    const auto corner = [&](int i)
    { return center + rotate(Rotation::from_angle(2 * pi * static_cast<float>(i) / corners), {radius, 0}); };
    Chain chain{.start = corner(0), .closed = true, .sides = Sides::Left};
    for (int i = 1; i < corners; ++i)
        chain.pieces.push_back({.end = corner(i)});
    return chain;
}

void add_rotor(Scene& scene, BodyId ground)
{
    const BodyId rotor = scene.create_body({.type = BodyType::Dynamic, .position = {0, 12}, .can_sleep = false});
    scene.create_shape(rotor, box(0.4f, 20, {}, 0, 0.2f), {.friction = 0});
    scene.create_joint(RevoluteDef{.body_a = ground,
                                   .body_b = rotor,
                                   .anchor_a = {0, 12},
                                   .enable_motor = true,
                                   .motor_speed = 5,
                                   .max_motor_torque = std::numeric_limits<float>::max()});
}

BuiltScene spinner(const SceneDef& base)
{
    BuiltScene built{Scene(benchmark_def(base))};
    Scene& scene = built.scene;
    const BodyId ground = add_static(scene, ring({0, 32}, 40), {.friction = 0.1f});
    add_rotor(scene, ground);
    const Geometry kinds[] = {Capsule{{-0.25f, 0}, {0.25f, 0}, 0.25f, 0.25f}, Circle{.radius = 0.35f}, box(0.35f, 0.35f)};
    constexpr int row = 92;
    for (int i = 0; i < 6076; ++i)
    {
        const Vec2 at{-23 + 0.5f * static_cast<float>(i % row), 2 + 0.5f * static_cast<float>(i / row)};
        add_dynamic(scene, at, kinds[i % 3], {.density = 0.25f, .friction = 0.1f, .restitution = 0.1f});
    }
    return built;
}

constexpr SceneEntry entries[] = {
    {.name = "spinner",
     .description = "A rotor stirs six thousand small things in a ring.",
     .create = spinner,
     .frames = 500,
     .view = {{-45, -12}, {45, 76}}},
    {.name = "tumbler",
     .description = "A turning square drum keeps 2,025 boxes falling.",
     .create = tumbler,
     .frames = 750,
     .view = {{-18, -6}, {18, 26}}},
    {.name = "washer",
     .description = "A turning round drum with four paddles and 8,100 boxes.",
     .create = washer,
     .frames = 500,
     .view = {{-22, -10}, {22, 30}}},
};

} // namespace

std::span<const SceneEntry> benchmark_drum_scenes() { return entries; }

} // namespace carom::scenes
