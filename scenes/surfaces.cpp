#include "scenes/build.h"
#include "scenes/families.h"

namespace carom::scenes {
namespace {

// Boxes of rising friction on a slope of 20 degrees (tan 20° = 0.364): the first two slide, the others stay.
// On the second slope: a wheel, a wheel that resists rolling, and ice, which is fastest because nothing makes it turn.
BuiltScene slopes(const SceneDef& base)
{
    BuiltScene built{Scene(base)};
    Scene& scene = built.scene;
    add_floor(scene, 0, {.friction = 1});
    const float angle = -20 * pi / 180;
    const Rotation lean = Rotation::from_angle(angle);
    const auto slope = [&](Position middle, float half_length)
    { add_static(scene, box(half_length, 0.15f), {.friction = 1}, middle, angle); };
    const auto on_slope = [&](Position middle, float along, float above)
    { return middle + rotate(lean, {along, 0.15f + above}); };
    const Position upper{-5, 8};
    slope(upper, 5);
    const float friction[] = {0.05f, 0.2f, 0.45f, 0.7f, 1};
    for (int i = 0; i < 5; ++i)
    {
        // The mixed friction is the geometric mean with the slope's 1: its square root is what counts.
        const ShapeDef material{.friction = friction[i] * friction[i]};
        add_dynamic(scene, on_slope(upper, 4.0f - 1.8f * static_cast<float>(i), 0.35f), box(0.35f, 0.35f), material, {}, angle);
    }
    const Position lower{5, 3};
    slope(lower, 5);
    add_dynamic(scene, on_slope(lower, -4.4f, 0.3f), Circle{.radius = 0.3f}, {.friction = 0.9f});
    add_dynamic(scene, on_slope(lower, -3.2f, 0.3f), Circle{.radius = 0.3f}, {.friction = 0.9f, .rolling_resistance = 0.2f});
    add_dynamic(scene, on_slope(lower, -2, 0.3f), box(0.3f, 0.3f), {.friction = 0}, {}, angle);
    return built;
}

/// Floors that are passed from below, balls thrown up through them, and a belt that carries boxes into a bin.
BuiltScene one_way_and_conveyor(const SceneDef& base)
{
    BuiltScene built{Scene(base)};
    Scene& scene = built.scene;
    add_floor(scene);
    for (int i = 0; i < 3; ++i)
        add_static(scene, Segment{{-9, 0}, {-4, 0}, 0.05f}, {.one_way = {0, 1}}, {0, 2.0 + 2 * i});
    const float speed[] = {7.5f, 10, 12.5f};
    for (int i = 0; i < 3; ++i)
        add_dynamic(scene, {-8.0 + 1.5 * i, 0.4}, Circle{.radius = 0.4f}, {.restitution = 0.2f}, {0, speed[i]});
    // Positive surface speed moves things to the left of the outward normal, which is -x on top: -2 carries to the right.
    add_static(scene, box(4, 0.2f), {.friction = 0.8f, .surface_speed = -2}, {2, 3});
    for (int i = 0; i < 4; ++i)
        add_dynamic(scene, {-1.5 + 1.1 * i, 3.6}, box(0.35f, 0.35f), {.friction = 0.8f});
    add_static(scene, box(0.1f, 1), {}, {7, 1});
    add_static(scene, box(0.1f, 1.5f), {}, {10, 1.5});
    return built;
}

/// A ball that rolls to the right on what lies below it, without sliding.
void add_rolling(Scene& scene, Position at, float speed)
{
    const BodyId ball = add_dynamic(scene, at, Circle{.radius = 0.3f}, {.friction = 0.9f}, {speed, 0});
    scene.body(ball).set_angular_velocity(-speed / 0.3f);
}

/// A loop for a ball, a half-pipe of lines and arcs, and a ring of four arcs.
BuiltScene arc_loop(const SceneDef& base)
{
    SceneDef def = base;
    def.sleeping = false;
    BuiltScene built{Scene(def)};
    Scene& scene = built.scene;
    const ShapeDef track{.friction = 0.9f};
    // A rolling disc needs v² >= 3.67 g R at the bottom to get round (R to its centre): 11 m/s is enough for 2.7 m.
    add_static(scene, Arc{.center = {-7, 3}, .radius = 3, .start_angle = -pi / 2, .sweep = 2 * pi}, track);
    add_rolling(scene, {-7, 0.3}, 11);

    const Chain half_pipe{.start = {-2, 6},
                          .pieces = {{{-2, 2}, 0}, {{0, 0}, pi / 2}, {{3, 0}, 0}, {{5, 2}, pi / 2}, {{5, 6}, 0}}};
    add_static(scene, half_pipe, track);
    add_dynamic(scene, {-1.7, 4.5}, Circle{.radius = 0.3f}, track);

    // A full circle of four arcs: a ball that keeps to it passes a seam in each quarter.
    const float quarter = pi / 2;
    const Chain ring{.start = {10, 0.5f},
                     .pieces = {{{12.5f, 3}, quarter}, {{10, 5.5f}, quarter}, {{7.5f, 3}, quarter}, {{10, 0.5f}, quarter}},
                     .closed = true,
                     .sides = Sides::Left};
    add_static(scene, ring, track);
    add_rolling(scene, {10, 0.8}, 10);
    return built;
}

constexpr SceneEntry entries[] = {
    {.name = "slopes",
     .description = "Friction decides who slides on 20 degrees; below, a wheel, a stiff wheel and ice.",
     .create = slopes,
     .view = {{-12, -1}, {13, 11}}},
    {.name = "one_way_and_conveyor",
     .description = "Floors that are passed from below, and a belt that fills a bin.",
     .create = one_way_and_conveyor,
     .view = {{-11, -1}, {11, 9}}},
    {.name = "arc_loop",
     .description = "Balls in a loop, a half-pipe and a ring of four arcs: no seam is felt.",
     .create = arc_loop,
     .h = 1.0f / 240,
     .frames = 2400,
     .view = {{-11, -1}, {14, 7}}},
};

} // namespace

std::span<const SceneEntry> surface_scenes() { return entries; }

} // namespace carom::scenes
