#pragma once

// Bodies as the solver has them.

#include "dynamics/state/scene_state.h"

#include <cstdint>

namespace carom::internal {

namespace body_flag {
inline constexpr std::uint16_t dynamic = 1;
inline constexpr std::uint16_t flier = 2; ///< in flight: moved by flight, not by the solver
inline constexpr std::uint16_t unbound =
    4; ///< no forces but those that are even over a sub-step, and joints': it drifts along exact parabolas
inline constexpr std::uint16_t at_lower = 8;    ///< a hinge limit blocks turning clockwise
inline constexpr std::uint16_t at_upper = 16;   ///< a hinge limit blocks turning counter-clockwise
inline constexpr std::uint16_t traced = 32;     ///< its path is recorded: it is near a trigger
inline constexpr std::uint16_t unsound = 64;    ///< its force law gave what is no force: it is put aside after the step
inline constexpr std::uint16_t stopped = 256;   ///< short of where the solver had it, by a wall on the way
inline constexpr std::uint16_t pressed = 512;   ///< into a wall, by far more than contacts can bear: its way is checked
inline constexpr std::uint16_t jointed = 1024;  ///< holds on to a joint that does not stand in a lane
inline constexpr std::uint16_t free_fall = 128; ///< with nothing near that it could meet in this step
} // namespace body_flag

/// What every solver pass touches. Pose changes count from the start of the step.
struct BodyState
{
    Vec2 velocity{};
    float angular_velocity = 0;
    std::uint16_t flags = 0;
    std::int16_t turns = 0; ///< whole ones beside delta_rotation, see turns.h
    Vec2 delta_position{};
    Rotation delta_rotation{};
};
static_assert(sizeof(BodyState) == 32);

/// Of a body, at another time than now; or how much they have changed.
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
    float linear_decay = 1; ///< of the velocity over a sub-step
    float angular_decay = 1;
};

/// A state whose body has a force law, and the accelerations that it has without.
struct LawWork
{
    std::int32_t state = none;
    float angular_acceleration = 0;
    Vec2 acceleration{};
};

} // namespace carom::internal
