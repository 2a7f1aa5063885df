#pragma once

// The rows that the solver iterates over, made from contacts and joints once per step. Symbols: a, b the bodies; n the normal from a to b, t = perp(n);
// r the lever arm; m the effective mass of a row, 1 / (J M^-1 J^T).

#include "carom/math.h"
#include "dynamics/scene_state.h"

#include <cstdint>

namespace carom::internal {

/// A constraint as a damped spring solved implicitly over h (the "soft constraint" of Catto, GDC 2011):
/// impulse = -mass_scale m (v + bias_rate C) - impulse_scale accumulated.
struct Softness
{
    float bias_rate = 0;
    float mass_scale = 1;
    float impulse_scale = 0;
};

[[nodiscard]] inline Softness make_softness(float hertz, float damping_ratio, float h)
{
    if (!(hertz > 0))
        return {};
    const float omega = 2 * pi * hertz;
    const float a1 = 2 * damping_ratio + h * omega;
    const float a2 = h * omega * a1;
    const float a3 = 1 / (1 + a2);
    return {omega / a1, a2 * a3, a3};
}

struct StateConstants
{
    Vec2 inverse_mass{};
    float inverse_inertia = 0;
    float angular_acceleration = 0;
    Vec2 acceleration{};
    float linear_decay = 1; ///< of the velocity over a sub-step
    float angular_decay = 1;
};

struct RowPoint
{
    Vec2 ra{}; ///< lever arms of the Jacobian
    Vec2 rb{};
    Vec2 ra0{}; ///< the same anchors in the orientation at the start of the step
    Vec2 rb0{};
    float base = 0; ///< separation = base + n · (relative displacement of the anchors)
    float predicted_bend =
        0; ///< what a straight-line prediction of the separation misses over the next sub-step (round contacts)
    float normal_impulse = 0;
    float tangent_impulse = 0;
    float normal_mass = 0;
    float tangent_mass = 0;
    float approach = 0;      ///< speed at the start of the sub-step, of rows that bear nothing yet
    float total_impulse = 0; ///< over the step
    float total_tangent = 0;
};

struct ContactRow
{
    std::int32_t a = 0; ///< states
    std::int32_t b = 0;
    std::int32_t contact = none;
    std::int32_t count = 0;
    Vec2 n{};
    float friction = 0;
    float surface_speed = 0;
    float coupling = 0; ///< J1 M^-1 J2 of two points; 0 where they are too near each other to be told apart
    float rolling = 0;  ///< torque limit over normal impulse, m
    float rolling_impulse = 0;
    float rolling_mass = 0;
    float core = 0;               ///< half the radius of a ball against what does not give way; 0 elsewhere
    std::uint8_t refreshed = 0;   ///< looked at anew in every sub-step
    std::uint8_t hit = 0;         ///< its impact was reported
    std::uint8_t active_from = 0; ///< first sub-step in which it counts
    Softness softness{};
    RowPoint points[2];
};

/// A joint in the solver: its record and the states of its bodies.
struct JointWork
{
    std::int32_t joint = none;
    std::int32_t a = 0;
    std::int32_t b = 0;
    std::int32_t spring_count = 0; ///< springs on the body that has most, where this is one
    float spring_speed = 0;        ///< a spring's impulse: mass (these · speed, -stretch, acceleration)
    float spring_stretch = 0;
    float spring_acceleration = 0;
    Vec2 ra0{}; ///< anchors from the centers of mass at the start of the step, world axes
    Vec2 rb0{};
    Vec2 axis0{};           ///< slider's axis at the start of the step
    Vec2 gap0{};            ///< anchor b - anchor a at the start of the step
    float angle0 = 0;       ///< joint angle at the start of the step
    float approach[2] = {}; ///< towards the lower and upper limit, before a sub-step's forces
    Vec2 force_sum{};       ///< impulses over the step
    float torque_sum = 0;
};

/// A ball in free flight: position and velocity in double, along an exact parabola.
struct Flier
{
    std::int32_t state = none;
    std::int32_t body = none;
    std::int32_t shape = none;
    static constexpr int most_held = 4;
    std::int32_t held[most_held] = {none, none, none, none}; ///< shapes it came to rest against in this sub-step
    double held_nx[most_held] = {};                          ///< away from them, where they do not give way; 0 elsewhere
    double held_ny[most_held] = {};
    std::int32_t held_count = 0;
    double hold_curvature = 0; ///< of the surface that holds it, if that does not move
    double x = 0;              ///< center, relative to the body's center at the start of the step
    double y = 0;
    double vx = 0;
    double vy = 0;
    double ax = 0;
    double ay = 0;
    double time = 0;          ///< within the sub-step up to which it has flown
    std::int32_t impacts = 0; ///< in this sub-step
    // The next event, as last computed.
    double event_time = 0; ///< beyond the sub-step: none
    double nx = 0;         ///< from what is hit to the ball
    double ny = 0;
    double curvature = 0;
    std::int32_t event_shape = none;
    std::int32_t event_contact = none; ///< none: found in flight, the pair has no contact yet
    std::int32_t event_state = none;   ///< of the body that is hit, in this unit; none: it does not move or belongs elsewhere
    std::int32_t event_version = 0;    ///< of that state when the event was computed
    bool crowded = false; ///< was pinched between others in this step: its way is checked against static shapes at the end
    bool landed = false;  ///< no longer flies: the solver has it from the next sub-step on
};

} // namespace carom::internal
