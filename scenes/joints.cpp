#include "scenes/build.h"
#include "scenes/families.h"

namespace carom::scenes {
namespace {

// A chain of hinged links carries fifty times a link's mass.
BuiltScene chain(const SceneDef& base)
{
    constexpr int links = 20;
    constexpr float length = 0.5f;
    BuiltScene built{Scene(base)};
    Scene& scene = built.scene;
    add_floor(scene, -14);
    BodyId previous{};
    Vec2 previous_anchor{0, 0};
    for (int i = 0; i < links; ++i)
    {
        const BodyId link = add_dynamic(scene, {length * (i + 0.5), 0}, Capsule{{-0.2f, 0}, {0.2f, 0}, 0.05f, 0.05f});
        scene.create_joint(
            RevoluteDef{.body_a = previous, .body_b = link, .anchor_a = previous_anchor, .anchor_b = {-length / 2, 0}});
        previous = link;
        previous_anchor = {length / 2, 0};
    }
    const float link_mass = scene.body(previous).mass();
    const BodyId weight =
        add_dynamic(scene, {length * links + 0.5, 0}, Circle{.radius = 0.5f}, {.density = 50 * link_mass / (pi * 0.25f)});
    scene.create_joint(RevoluteDef{.body_a = previous, .body_b = weight, .anchor_a = previous_anchor, .anchor_b = {-0.5f, 0}});
    return built;
}

/// Five steel balls on rods. The first is drawn back by 40 degrees.
void add_cradle(Scene& scene, Position pivot, float gap)
{
    constexpr float radius = 0.5f;
    constexpr float rod = 4;
    const ShapeDef steel{.density = 8, .friction = 0, .restitution = 1};
    for (int i = 0; i < 5; ++i)
    {
        const Position top = pivot + Vec2{(2 * radius + gap) * static_cast<float>(i - 2), 0};
        const Rotation swing = Rotation::from_angle(i == 0 ? -40 * pi / 180 : 0);
        const BodyId ball = add_dynamic(scene, top + rotate(swing, {0, -rod}), Circle{.radius = radius}, steel);
        scene.create_joint(DistanceDef{.body_a = {}, .body_b = ball, .anchor_a = to_vec2(top), .anchor_b = {0, 0}});
    }
}

BuiltScene cradle(const SceneDef& base)
{
    SceneDef def = base;
    def.sleeping = false;
    BuiltScene built{Scene(def)};
    add_cradle(built.scene, {-4.5, 6}, 0);
    add_cradle(built.scene, {4.5, 6}, 0.001f);
    return built;
}

struct Oscillator
{
    float stiffness; ///< N/m
    float damping;   ///< N s/m
};

BuiltScene springs(const SceneDef& base)
{
    SceneDef def = base;
    def.sleeping = false;
    BuiltScene built{Scene(def)};
    Scene& scene = built.scene;
    // Masses of 1 kg, drawn down by half a metre: 0.5, 1 and 2 Hz, damped, over-damped, and far stiffer than a step can show.
    const Oscillator rows[] = {{9.8696f, 0}, {39.478f, 0}, {157.91f, 0}, {39.478f, 1}, {39.478f, 20}, {1e6f, 0}};
    float x = -7.5f;
    for (const Oscillator& o : rows)
    {
        const float sag = 9.81f / o.stiffness;
        const float pull = o.stiffness > 1e5f ? 0 : 0.5f;
        const BodyId mass = add_dynamic(scene, {x, -3.0 - static_cast<double>(sag + pull)}, box(0.5f, 0.5f));
        scene.create_joint(
            SpringDef{.body_b = mass, .anchor_a = {x, 0}, .stiffness = o.stiffness, .damping = o.damping, .length = 3});
        x += 3;
    }
    return built;
}

/// A bridge of planks, a rope that goes slack, a slider with a motor, a soft hinge.
BuiltScene joints(const SceneDef& base)
{
    BuiltScene built{Scene(base)};
    Scene& scene = built.scene;
    add_floor(scene);
    BodyId previous{};
    Vec2 anchor{-9, 6};
    for (int i = 0; i < 12; ++i)
    {
        const BodyId plank = add_dynamic(scene, {-8.6 + 0.8 * i, 6}, box(0.4f, 0.08f), {.density = 2});
        scene.create_joint(RevoluteDef{.body_a = previous, .body_b = plank, .anchor_a = anchor, .anchor_b = {-0.4f, 0}});
        previous = plank;
        anchor = {0.4f, 0};
    }
    scene.create_joint(RevoluteDef{.body_a = previous, .body_b = {}, .anchor_a = anchor, .anchor_b = {0.6f, 6}});
    for (int i = 0; i < 3; ++i)
        add_dynamic(scene, {-6.0 + 2 * i, 8}, Circle{.radius = 0.5f});

    const BodyId bob = add_dynamic(scene, {5.5, 7}, Circle{.radius = 0.4f});
    scene.create_joint(DistanceDef{.body_b = bob, .anchor_a = {3, 7}, .min_length = 0, .max_length = 3});

    const BodyId slider = add_dynamic(scene, {4, 1.5}, box(0.6f, 0.3f));
    scene.create_joint(PrismaticDef{.body_b = slider,
                                    .anchor_a = {4, 1.5f},
                                    .axis_a = {1, 0},
                                    .enable_limit = true,
                                    .lower_translation = -2,
                                    .upper_translation = 2,
                                    .enable_motor = true,
                                    .motor_speed = 1.5f,
                                    .max_motor_force = 50});

    const BodyId board = add_dynamic(scene, {9, 5}, box(1.5f, 0.1f));
    scene.create_joint(RevoluteDef{
        .body_b = board, .anchor_a = {7.5f, 5}, .anchor_b = {-1.5f, 0}, .spring_hertz = 2, .spring_damping_ratio = 0.2f});
    return built;
}

constexpr SceneEntry entries[] = {
    {.name = "chain",
     .description = "Twenty links on hinges swing a weight of fifty links.",
     .create = chain,
     .view = {{-13, -14}, {13, 2}}},
    {.name = "cradle",
     .description = "Newton's cradle: gaps of 1 mm pass the blow on one by one, touching balls share it.",
     .create = cradle,
     .h = 1.0f / 1000,
     .frames = 5000,
     .view = {{-11, 0}, {11, 7}}},
    {.name = "springs",
     .description = "Masses on springs: half, one and two hertz, damped, over-damped, very stiff.",
     .create = springs,
     .h = 1.0f / 240,
     .frames = 2400,
     .view = {{-10, -6}, {10, 1}}},
    {.name = "joints",
     .description = "A bridge of planks, a rope, a driven slider and a soft hinge.",
     .create = joints,
     .view = {{-11, -1}, {11.5, 10}}},
};

} // namespace

std::span<const SceneEntry> joint_scenes() { return entries; }

} // namespace carom::scenes
