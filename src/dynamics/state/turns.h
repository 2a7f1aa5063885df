#pragma once

// Whole turns of bodies, so that a hinge's angle can grow beyond pi. A rotation has an angle from -pi to pi; the turns beside it are counted
// wherever a body rotates, in the sub-steps and when the step is committed.

#include "dynamics/solver/body_state.h"
#include "dynamics/state/scene_state.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

/// As turns_by, for any two rotations.
[[nodiscard]] std::int32_t whole_turns(Rotation before, Rotation after, double displacement);

/// The whole turns that the angles of two rotations leave out when a body rotates by `displacement` from one to the other, rad.
[[nodiscard]] inline std::int32_t turns_by(Rotation before, Rotation after, double displacement)
{
    const bool is_far_from_pi = before.c >= 0 && after.c >= 0 && std::fabs(displacement) < 3;
    return is_far_from_pi ? 0 : whole_turns(before, after, displacement);
}

/// Rotates a body within a step by an angle, rad.
inline void turn_by(BodyState& s, float angle)
{
    const Rotation before = s.delta_rotation;
    s.delta_rotation = Rotation::from_angle(angle) * before;
    s.turns = static_cast<std::int16_t>(s.turns + turns_by(before, s.delta_rotation, static_cast<double>(angle)));
}

/// Sets a body's rotation since the start of the step, rad.
inline void turn_from_start(BodyState& s, double angle)
{
    s.delta_rotation = angle != 0 ? Rotation::from_angle(static_cast<float>(angle)) : Rotation{};
    s.turns = static_cast<std::int16_t>(turns_by({}, s.delta_rotation, angle));
}

/// The rotation of a body in half a step of dt at a constant angular velocity, rad/s; of at most half a radian a step, as contacts of bodies that
/// turn faster do not turn with them.
[[nodiscard]] inline Rotation half_turn(float angular_velocity, float dt)
{
    const float t = std::clamp((0.25f * dt) * angular_velocity, -most_tangent, most_tangent);
    const float part = 1 / (1 + t * t);
    return {(1 - t * t) * part, 2 * t * part};
}

/// Lets a body's rotation within the step count from the orientation that it reaches in the middle of it, after turning by `half`: lever arms
/// of that orientation are right in the mean. BodySim::rotation holds it until the step is committed.
void begin_at_middle(SceneState& state, std::int32_t body, Rotation half, BodyState& s);
/// Lets it count from the start of the step again.
void begin_at_start(SceneState& state, std::int32_t body, BodyState& s);
/// While a step is solved, the rotation with which a body has begun it; other bodies than dynamic ones get a new one when it is committed.
[[nodiscard]] inline Rotation rotation_at_start(const SceneState& state, std::int32_t body)
{
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    const BodyRecord& record = state.bodies[body];
    return record.type == BodyType::Dynamic && record.awake_index != none ? sim.previous_rotation : sim.rotation;
}

/// Adds to the turns of a body those between two rotations by `displacement`, rad.
void count_turns(std::int32_t& turns, Rotation before, Rotation after, double displacement);
/// The same for the smallest rotation between the two.
void count_turns(std::int32_t& turns, Rotation before, Rotation after);
/// The same for a step that has been solved.
void count_turns(std::int32_t& turns, Rotation before, Rotation after, const BodyState& s);

/// angle_b - angle_a - reference_angle, rad, with all turns since the joint was made, when it was within -pi and pi.
[[nodiscard]] float hinge_angle(const SceneState& state, const JointRecord& joint);
/// The same without turns, always within -pi and pi: the error of an angle that is held.
[[nodiscard]] float shortest_angle(const SceneState& state, const JointRecord& joint);

/// Starts the count of a joint that is being made: it has no turns.
void begin_counting(const SceneState& state, JointRecord& joint);

} // namespace carom::internal
