#pragma once

// Bodies as the solver sees them: velocities, pose changes within the step, and the constants of a sub-step.

#include "dynamics/solver/effective_mass.h"
#include "dynamics/state/scene_state.h"

#include <cstdint>

namespace carom::internal {

namespace body_flag {
inline constexpr std::uint16_t dynamic = 1;
inline constexpr std::uint16_t flier = 2; ///< in flight: moved by flight, not by the solver
/// Only joints and forces that are constant over a sub-step act on it: it drifts along exact parabolas.
inline constexpr std::uint16_t unbound = 4;
inline constexpr std::uint16_t at_lower = 8;    ///< a hinge limit blocks clockwise rotation
inline constexpr std::uint16_t at_upper = 16;   ///< a hinge limit blocks counter-clockwise rotation
inline constexpr std::uint16_t traced = 32;     ///< its path is recorded: it is near a trigger
inline constexpr std::uint16_t unsound = 64;    ///< invalid load of its force law or invalid state: put aside after the step
inline constexpr std::uint16_t stopped = 256;   ///< a wall in its path stopped it short of the solver's position
inline constexpr std::uint16_t pressed = 512;   ///< pressed into a wall, by far more than contacts can bear: its path is checked
inline constexpr std::uint16_t jointed = 1024;  ///< held by a joint outside of lanes
inline constexpr std::uint16_t free_fall = 128; ///< nothing is near that it could meet in this step
} // namespace body_flag

inline constexpr float round_arm = 1e-5f; ///< an arm turned from the normal by less is that of a circle about the center of mass
inline constexpr float most_tangent = 0.125f; ///< of a quarter of the rotation within a step, see half_turn()

/// The state that every solver pass touches. Pose changes count from the pose in BodySim: that of the start of the step, or the orientation of its
/// middle, see begin_at_middle().
struct BodyState
{
    Vec2 velocity{};
    float angular_velocity = 0;
    std::uint16_t flags = 0;
    std::int16_t turns = 0; ///< whole turns beyond delta_rotation, see turns.h
    Vec2 delta_position{};
    Rotation delta_rotation{};
};
static_assert(sizeof(BodyState) == 32);

/// Speeds of a body at another time, or a change of its speeds.
struct BodySpeeds
{
    Vec2 velocity{};
    float angular_velocity = 0;
    float padding = 0;
};

struct StateConstants
{
    Vec2 inverse_mass{};
    float inverse_inertia = 0;
    float angular_acceleration = 0;
    Vec2 acceleration{};
    float linear_decay = 1; ///< factor on the velocity over a sub-step
    float angular_decay = 1;

    [[nodiscard]] InverseMass<float> inverse() const { return {inverse_mass.x, inverse_mass.y, inverse_inertia}; }
};

/// A state whose body has a force law, and its accelerations without that law.
struct LawWork
{
    std::int32_t state = none;
    float angular_acceleration = 0;
    Vec2 acceleration{};
};

} // namespace carom::internal
