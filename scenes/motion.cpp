#include "scenes/build.h"
#include "scenes/families.h"

namespace carom::scenes {
namespace {

// A turning bar and a piston, both told how to move, push what is in their way.
BuiltScene kinematic_bar(const SceneDef& base)
{
    BuiltScene built{Scene(base)};
    Scene& scene = built.scene;
    add_trough(scene, 10, 150);
    const BodyId bar = scene.create_body({.type = BodyType::Kinematic, .position = {-4, 4}, .angular_velocity = 3});
    scene.create_shape(bar, Capsule{{-3, 0}, {3, 0}, 0.2f, 0.2f});
    const BodyId piston = scene.create_body({.type = BodyType::Kinematic, .position = {12.5, 0.8}});
    // So long that its tail never leaves the wall: nothing gets behind it and is squeezed on its way back.
    scene.create_shape(piston, box(3, 0.7f));
    Random random(3);
    for (int i = 0; i < 60; ++i)
        add_dynamic(scene, {-9 + 0.9 * (i % 20), 8.5 + 0.8 * (i / 20)}, Circle{.radius = random.in(0.2f, 0.35f)},
                    {.restitution = 0.3f});
    built.before_step = [piston](Scene& s, float h)
    {
        // Out and back once in four seconds, on a curve without jumps.
        const std::uint64_t period = steps_in(4, h);
        const float phase = static_cast<float>(s.step_count() % period) / static_cast<float>(period);
        const float out = phase < 0.5f ? phase * 2 : 2 - phase * 2;
        const float eased = out * out * (3 - 2 * out);
        s.body(piston).set_target_pose({12.5 - 5.0 * static_cast<double>(eased), 0.8}, 0);
    };
    return built;
}

// Thin walls and balls that go up to 1,000 m/s: seventeen metres a step.
BuiltScene bullet(const SceneDef& base)
{
    SceneDef def = base;
    def.gravity = {0, 0};
    BuiltScene built{Scene(def)};
    Scene& scene = built.scene;
    const ShapeDef wall{.friction = 0, .restitution = 1};
    const Chain room{.start = {-10, 0}, .pieces = {{{10, 0}}, {{10, 10}}, {{-10, 10}}}, .closed = true};
    add_static(scene, room, wall);
    for (int i = 0; i < 4; ++i)
        add_static(scene, Segment{{-6 + 4 * static_cast<float>(i), 2}, {-6 + 4 * static_cast<float>(i), 8}}, wall);
    const float speed[] = {10, 50, 200, 500, 1000};
    Random random(9);
    for (int i = 0; i < 20; ++i)
    {
        const Rotation way = Rotation::from_angle(random.in(-pi, pi));
        add_dynamic(scene, {-8 + 4.0 * (i % 5), 1.0 + 2.6 * (i / 5)}, Circle{.radius = 0.1f}, {.friction = 0, .restitution = 1},
                    rotate(way, {speed[i % 5], 0}));
    }
    return built;
}

/// Elastic discs and boxes in a vessel.
BuiltScene gas(const SceneDef& base)
{
    SceneDef def = base;
    def.gravity = {0, 0};
    BuiltScene built{Scene(def)};
    const ShapeDef elastic{.friction = 0, .restitution = 1};
    const Chain vessel{.start = {-6, 0}, .pieces = {{{6, 0}}, {{6, 8}}, {{-6, 8}}}, .closed = true};
    add_static(built.scene, vessel, elastic);
    Random random(16);
    for (int i = 0; i < 240; ++i)
    {
        const Position at{-5.7 + 0.6 * (i % 20), 0.35 + 0.66 * (i / 20)}; // NOLINT(bugprone-integer-division)
        const Vec2 velocity = rotate(Rotation::from_angle(random.in(-pi, pi)), {3, 0});
        if (i % 3 == 0)
            add_dynamic(built.scene, at, box(0.15f, 0.15f), elastic, velocity);
        else
            add_dynamic(built.scene, at, Circle{.radius = 0.18f}, elastic, velocity);
    }
    return built;
}

/// Balls that bounce well come down like hail, all at once.
BuiltScene hail(const SceneDef& base)
{
    BuiltScene built{Scene(base)};
    const ShapeDef rubber{.friction = 0.2f, .restitution = 0.75f};
    add_static(built.scene, Chain{.start = {-5, 40}, .pieces = {{{-5, 0}}, {{5, 0}}, {{5, 40}}}}, rubber);
    Random random(17);
    for (int i = 0; i < 200; ++i)
        add_dynamic(built.scene, {-4.5 + 0.45 * (i % 20) + 0.02 * random.in(0, 1), 1 + 0.5 * (i / 20)},
                    Circle{.radius = 0.15f}, // NOLINT(bugprone-integer-division)
                    rubber);
    return built;
}

/// A ball flies through a booster, meets a bumper, falls through triggers.
BuiltScene triggers(const SceneDef& base)
{
    BuiltScene built{Scene(base)};
    Scene& scene = built.scene;
    add_trough(scene, 8, 10);
    add_static(scene, box(1, 3), {.trigger = true, .field = {.acceleration = {0, 25}}}, {-5, 3});
    add_static(scene, box(2, 1), {.trigger = true, .field = {.drag = 4}}, {0, 5});
    for (const double x : {3.0, 6.0})
        add_static(scene, Circle{.radius = 0.8f}, {.restitution = 0.5f, .kick = {.speed = 4, .threshold = 1, .cooldown = 0.05f}},
                   {x, 3});
    Random random(21);
    for (int i = 0; i < 14; ++i)
        add_dynamic(scene, {-6.5 + static_cast<double>(i), 8.0 + 0.4 * (i % 3)}, Circle{.radius = 0.25f}, {.restitution = 0.4f},
                    {random.in(-1, 1), 0});
    return built;
}

constexpr SceneEntry entries[] = {
    {.name = "kinematic_bar",
     .description = "A turning bar and a piston push sixty balls and are never pushed.",
     .create = kinematic_bar,
     .view = {{-12, -1}, {12, 12}}},
    {.name = "bullet",
     .description = "Balls of up to 1,000 m/s between walls without thickness: none gets out.",
     .create = bullet,
     .view = {{-11, -1}, {11, 11}}},
    {.name = "triggers",
     .description = "A lift, a brake and two bumpers: fields and kicks.",
     .create = triggers,
     .view = {{-10, -1}, {10, 10}}},
    {.name = "gas",
     .description = "240 elastic discs and boxes in a vessel keep their energy for ever.",
     .create = gas,
     .view = {{-7, -1}, {7, 9}}},
    {.name = "hail",
     .description = "200 balls that bounce well come down all at once.",
     .create = hail,
     .view = {{-6, -1}, {6, 9}}},
};

} // namespace

std::span<const SceneEntry> motion_scenes() { return entries; }

} // namespace carom::scenes
