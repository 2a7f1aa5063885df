#include "scenes/ragdoll.h"

namespace carom::scenes {
namespace {

/// Heights are above the feet; a bone hangs on its parent's hinge and is a capsule along y in its own frame.
struct Bone
{
    std::size_t parent;
    float y;
    float bottom;
    float top;
    float radius;
    float hinge_y;
    float lower; ///< of the hinge, in units of pi
    float upper;
    float friction; ///< share of the hinges' friction torque
    float damping = 0;
    float bend = 0; ///< reference angle, in units of pi
    bool foot = false;
};

constexpr std::size_t hip = 0;
constexpr std::size_t torso = 1;
constexpr Bone upper_leg{hip, 0.775f, -0.125f, 0.125f, 0.06f, 0.9f, -0.05f, 0.4f, 1};
constexpr Bone upper_arm{torso, 1.225f, -0.125f, 0.125f, 0.035f, 1.35f, -0.1f, 0.8f, 0.5f};
constexpr Bone lower_leg(std::size_t thigh)
{
    return {thigh, 0.475f, -0.155f, 0.125f, 0.045f, 0.625f, -0.5f, -0.02f, 0.5f, 0, 0, true};
}
constexpr Bone lower_arm(std::size_t arm) { return {arm, 0.975f, -0.125f, 0.125f, 0.03f, 1.1f, -0.2f, 0.3f, 0.1f, 0.1f, 0.25f}; }

constexpr std::array<Bone, 11> bones{Bone{hip, 0.95f, -0.02f, 0.02f, 0.095f, 0, 0, 0, 0},
                                     Bone{hip, 1.2f, -0.135f, 0.135f, 0.09f, 1, -0.25f, 0, 0.5f},
                                     Bone{torso, 1.475f, -0.038f, 0.039f, 0.075f, 1.4f, -0.3f, 0.1f, 0.25f, 0.1f},
                                     upper_leg,
                                     lower_leg(3),
                                     upper_leg,
                                     lower_leg(5),
                                     upper_arm,
                                     lower_arm(7),
                                     upper_arm,
                                     lower_arm(9)};

constexpr float friction_torque = 0.05f; // N m
constexpr float sleep_speed = 0.1f;      // m/s

BodyId add_bone(Scene& scene, const Bone& bone, Vec2 feet, int number)
{
    const BodyId body = scene.create_body({.type = BodyType::Dynamic,
                                           .position = Position(feet) + Vec2{0, bone.y},
                                           .linear_damping = bone.damping,
                                           .sleep_speed = sleep_speed});
    ShapeDef def{.friction = 0.2f, .filter = {.category = 2, .mask = 1 | 2, .group = -number}};
    scene.create_shape(body, Capsule{{0, bone.bottom}, {0, bone.top}, bone.radius, bone.radius}, def);
    if (bone.foot)
    {
        def.friction = 0.05f;
        def.filter.mask = 1; // feet pass through other figures
        scene.create_shape(
            body, Polygon{.vertices = {{-0.03f, -0.185f}, {0.11f, -0.185f}, {0.11f, -0.16f}, {-0.03f, -0.14f}}, .radius = 0.015f},
            def);
    }
    return body;
}

RevoluteDef hinge(const Bone& bone, BodyId parent, BodyId body)
{
    return {.body_a = parent,
            .body_b = body,
            .anchor_a = {0, bone.hinge_y - bones[bone.parent].y},
            .anchor_b = {0, bone.hinge_y - bone.y},
            .reference_angle = bone.bend * pi,
            .enable_limit = true,
            .lower_angle = bone.lower * pi,
            .upper_angle = bone.upper * pi,
            .enable_motor = true,
            .max_motor_torque = bone.friction * friction_torque,
            .spring_hertz = 5,
            .spring_damping_ratio = 0.5f};
}

} // namespace

Ragdoll add_ragdoll(Scene& scene, Vec2 feet, int number)
{
    Ragdoll ragdoll;
    for (std::size_t i = 0; i < bones.size(); ++i)
    {
        ragdoll[i] = add_bone(scene, bones[i], feet, number);
        if (i != hip)
            scene.create_joint(hinge(bones[i], ragdoll[bones[i].parent], ragdoll[i]));
    }
    return ragdoll;
}

void destroy_ragdoll(Scene& scene, const Ragdoll& ragdoll)
{
    for (const BodyId bone : ragdoll)
        scene.destroy(bone);
}

} // namespace carom::scenes
