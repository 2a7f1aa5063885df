#pragma once

// Bodies in flight, and their resting contacts.

#include "carom/math.h"
#include "dynamics/state/scene_state.h"

#include <array>
#include <cstdint>

namespace carom::internal {

/// A point at which two shapes rest against each other in flight, for the rest of the sub-step.
struct RestingContact
{
    std::int32_t own = none;
    std::int32_t other = none;
    Vec2 point{};                  ///< in the world
    Vec2 normal{};                 ///< from the other to the own shape
    float force = 0;               ///< on the own shape, along the normal, N
    float friction = 0;            ///< along perp(normal), N
    double start = 0;              ///< time of the sub-step
    std::int32_t solved = none;    ///< state of the other body, if it is solver-owned
    std::uint32_t own_corners = 0; ///< corners that rest, one bit each
    std::uint32_t other_corners = 0;
};

inline constexpr std::int32_t carried_by_world = -2; ///< in Flier::carrier: a body that does not move holds it

/// A body in flight. It moves along a parabola with constant angular acceleration; a body hinged to the world only turns about its pivot.
/// The reference point is the center of rotation: the center of mass, or the pivot. All of it is relative to the center of mass at the
/// start of the step, in double.
struct Flier
{
    std::int32_t state = none;
    std::int32_t body = none;
    std::int32_t joint = none;       ///< the hinge to the world; none: free
    std::int32_t impacts = 0;        ///< in this sub-step
    std::int32_t impacts_before = 0; ///< in the step before this sub-step
    std::int64_t looks = 0;          ///< looks at candidates for the next event, not yet charged
    std::int64_t union_looks = 0;    ///< those of them that ask flush neighbors
    double x = 0;                    ///< reference point
    double y = 0;
    double vx = 0;
    double vy = 0;
    double ax = 0;
    double ay = 0;
    double angle = 0; ///< rotation since the step began
    double w = 0;
    double alpha = 0;
    double time = 0;  ///< of the sub-step up to which it has moved
    double arm_x = 0; ///< from the reference point to the center of mass, at the start of the step
    double arm_y = 0;
    double inverse_mass_x = 0; ///< of the reference point: 0 for a pivot
    double inverse_mass_y = 0;
    double inverse_inertia = 0; ///< about the reference point
    double lower = -1e300;      ///< range of the angle, from the hinge's limits
    double upper = 1e300;
    Vec2 local_reference{}; ///< in the body's frame
    double size = 0;        ///< the least inner radius of its shapes
    // For the reaction of a hinge's pivot: the change of the center's momentum less the impulses of contacts and of acceleration.
    double start_vx = 0; ///< of the center of mass, at the start of the sub-step
    double start_vy = 0;
    double impulse_x = 0; ///< of contacts, in this sub-step
    double impulse_y = 0;
    double start_w = 0;
    double turn_impulse = 0;  ///< of contacts about the pivot
    Vec2 reaction{};          ///< over the step
    float limit_reaction = 0; ///< N m s, by the limits, over the step

    static constexpr int most_resting = 12;
    std::int32_t resting_set = none; ///< in IslandOutput::resting_sets; none: it had no resting contact in this step
    std::int32_t resting_count = 0;
    bool rests = false; ///< against a body of finite mass
    bool led = false;   ///< all its resting contacts are with bodies that are not dynamic
    double lead_x = 0;  ///< velocity of such a body that does not rotate
    double lead_y = 0;
    std::int32_t carrier = none; ///< the one body that holds it, or carried_by_world; none: several, dynamic, or a conveyor
    double curvature_rate = 0;   ///< rad/s at which the path along the surface turns
    double rests_until = 0;      ///< time of the sub-step at which the resting contact is renewed, for the surface has turned

    // The next event, as last computed.
    double event_time = 0; ///< beyond the sub-step: none
    std::int32_t event_own = none;
    std::int32_t event_shape = none;     ///< none: a limit of the hinge, or a resting contact to be renewed
    std::int32_t event_state = none;     ///< of the body that is hit; none: it does not move, or belongs to another island
    std::int32_t passes = none;          ///< contact with a one-way shape that it passes through, not yet noted
    std::int32_t event_version = 0;      ///< of that state when the event was computed
    std::int32_t deflected_index = none; ///< in IslandOutput::deflected; none: it has not been deflected
    bool needs_wall_check = false;       ///< struck: its path is checked against static shapes at the end of the step
    bool constrained = false;            ///< its accelerations are those of a resting contact or limit
    bool landed = false;                 ///< not in flight: solver-owned until an impact makes it fast

    /// Its path is no longer the one with which the pairs of this step were found.
    [[nodiscard]] bool is_deflected() const { return deflected_index != none; }
};

using RestingContacts = std::array<RestingContact, Flier::most_resting>;

} // namespace carom::internal
