#pragma once

/// @file
/// The events of a step, or of all steps of one Scene::update. Spans of events are valid until the next step or update; ids in
/// them may be stale where the object was destroyed since. All events of a step are sorted by (step, time, shape_a, shape_b).
/// Normals point from shape_a to shape_b.

#include "carom/function.h"
#include "carom/id.h"
#include "carom/math.h"

namespace carom {

class Scene;

/// Two shapes began to touch.
struct ContactBeginEvent
{
    ShapeId shape_a{};
    ShapeId shape_b{};
    BodyId body_a{};
    BodyId body_b{};
    Position point{};
    Vec2 normal{};
    float time = 0; ///< within the step, s
    int step = 0;   ///< which of those of the last Scene::update, from 0
};

/// Two shapes no longer touch; every begin has its end, also when a shape or body is destroyed or disabled.
struct ContactEndEvent
{
    ShapeId shape_a{};
    ShapeId shape_b{};
    BodyId body_a{};
    BodyId body_b{};
    float time = 0; ///< within the step, s
    int step = 0;   ///< which of those of the last Scene::update, from 0
};

/// A blow: what one contact does to two bodies as they strike. A pair that strikes several times within a step has an event for each.
///
/// In every event the fields agree. Let P = impulse * normal + friction_impulse * perp(normal), the impulse on b; then
///
///     energy_lost = -P · ((velocity_b - velocity_a) + (velocity_after_b - velocity_after_a)) / 2
///
/// The impulse of two bodies that are alone in the blow can be checked by hand, unless friction acts on a long arm:
///
///     impulse = m_a m_b / (m_a + m_b) * ((1 + restitution) * approach_speed + kick_speed)
///
/// with m the effective point masses 1 / (1/m + r²/I). Where others strike the same bodies at the same moment, or hold them by a joint, the impulse is
/// the one that this contact gave, and the velocities before and after tell what the others did.
struct ImpactEvent
{
    ShapeId shape_a{};
    ShapeId shape_b{};
    BodyId body_a{};
    BodyId body_b{};
    Position point{};
    Vec2 normal{};              ///< unit, from a to b
    float approach_speed = 0;   ///< speed_a - speed_b, m/s, > 0
    float impulse = 0;          ///< along the normal, N s, >= 0
    float friction_impulse = 0; ///< along perp(normal) on b, N s
    float energy_lost = 0;      ///< what the contact took from the two, J; negative where a kick or a moving surface added some
    float time = 0;             ///< within the step, s
    int step = 0;               ///< which of those of the last Scene::update, from 0
    float speed_a = 0;          ///< of velocity_a along the normal, m/s
    float speed_b = 0;          ///< of velocity_b along the normal, m/s
    float effective_mass_a = 0; ///< kg; 0 means infinite
    float effective_mass_b = 0; ///< kg; 0 means infinite
    float restitution = 0;      ///< as mixed, at this approach speed
    float friction = 0;         ///< as mixed; limits the friction of all blows of this contact at the same moment together
    float kick_speed = 0;       ///< added separating speed, m/s
    Vec2 velocity_a{};          ///< of body a at the point before the blow, m/s
    Vec2 velocity_b{};          ///< of body b
    Vec2 velocity_after_a{};    ///< of body a at the point after the blow, m/s
    Vec2 velocity_after_b{};    ///< of body b
};

/// A shape came into or went out of a trigger shape. The time is that of the true path; a pair may come and go several times in a step.
struct TriggerEvent
{
    ShapeId trigger{};
    ShapeId visitor{};
    BodyId trigger_body{};
    BodyId visitor_body{};
    float time = 0; ///< within the step, s
    int step = 0;   ///< which of those of the last Scene::update, from 0
};

/// Called at the end of the step from the same events, in the order of the spans: contact begins, impacts, contact ends,
/// trigger enters, insides, exits. In contact events given to a callback, shape_a is the shape that owns it. Everything may be
/// created and destroyed inside, both parties included; events of shapes destroyed meanwhile are still delivered, with stale
/// ids, to the callbacks of shapes that live.
struct ShapeCallbacks
{
    Function<void(Scene&, const ContactBeginEvent&)> on_contact_begin{};
    Function<void(Scene&, const ImpactEvent&)> on_impact{};
    Function<void(Scene&, const ContactEndEvent&)> on_contact_end{};
    Function<void(Scene&, const TriggerEvent&)> on_trigger_enter{};
    Function<void(Scene&, const TriggerEvent&)> on_trigger_inside{}; ///< every step while inside, also asleep
    Function<void(Scene&, const TriggerEvent&)> on_trigger_exit{};
};

} // namespace carom
