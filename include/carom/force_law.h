#pragma once

/// @file
/// Force laws: forces that depend on how a body moves, worked out in every sub-step.

#include "carom/event.h"
#include "carom/math.h"

#include <span>

namespace carom {

/// How a body moves at the start of a sub-step, and what struck it in the one before.
struct BodyMotion
{
    double time = 0;            ///< s since the step began
    float h = 0;                ///< length of the sub-step, s
    Pose pose{};                ///< of the body's frame
    Vec2 velocity{};            ///< of the centre of mass, m/s
    float angular_velocity = 0; ///< rad/s
    /// Impacts on the body since the law was last called, in the order in which they were resolved; those of the end of the
    /// last step come with the first call of this one (their times are within that step). Valid during the call.
    std::span<const ImpactEvent> impacts{};
};

/// A load that acts on a body evenly through one sub-step, at the centre of mass.
struct Load
{
    Vec2 force{};     ///< N
    float torque = 0; ///< N m
};

/// A force that depends on how the body moves: a coil, a motor's curve, drag, friction on the ground.
///
/// The function is called once at the start of every sub-step of an awake dynamic body, in the order of time, also in the
/// shorter sub-steps that the engine cuts where a contact turns fast (BodyMotion::h says how long). Its load acts through that
/// sub-step on top of gravity, fields and applied forces. It is not called for a body that is asleep, disabled, static or
/// kinematic, and does not wake it.
///
/// It is called in the middle of a step, from the thread that solves the body: it must not throw or call the scene, and may change
/// what `user` points to only if that belongs to this body alone. With that, and if it depends on nothing but its arguments and
/// what it keeps, results do not depend on the threads.
///
/// A load that is not finite is dropped, and the body put aside at the end of the step (StepFlag::BodyQuarantined).
struct ForceLaw
{
    Load (*function)(void* user, const BodyMotion& motion) = nullptr;
    void* user = nullptr;
    /// The most that the law gives, N and N m, >= 0. The engine looks as far ahead as that may lead in a step for what the body may
    /// meet; then the law is as safe as an applied force of that size. A law may give more: what is met beyond that is found on
    /// the way where the body flies free, but bodies are met late, and a push by many times the body's size in a step may lead
    /// through things.
    float greatest_force = 0;
    float greatest_torque = 0;
};

} // namespace carom
