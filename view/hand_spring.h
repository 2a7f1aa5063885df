#pragma once

/// @file
/// The spring by which a mouse pulls a body: 3 Hz and 0.7 of critical damping, so that it follows the hand and does not swing about it,
/// whatever its mass.

#include "carom/scene.h"

#include <variant>

namespace carom::view {

/// Holds the body at a point of its own frame and pulls it to a place.
inline JointId pull_by_hand(Scene& scene, BodyId body, Vec2 anchor, Position to)
{
    const float rate = 2 * pi * 3;
    const float mass = scene.body(body).mass();
    return scene.create_joint(SpringDef{.body_b = body,
                                        .anchor_a = to_vec2(to),
                                        .anchor_b = anchor,
                                        .stiffness = mass * rate * rate,
                                        .damping = 2 * 0.7f * mass * rate,
                                        .length = 0});
}

/// The hand has gone on to another place.
inline void move_hand(Scene& scene, JointId spring, Position to)
{
    auto def = std::get<SpringDef>(scene.joint(spring).def());
    def.anchor_a = to_vec2(to);
    scene.joint(spring).set_def(def);
}

} // namespace carom::view
