#pragma once

// Motion of bodies in flight, and the paths of all other bodies as flight sees them.

#include "collision/time_of_impact.h"
#include "dynamics/step_context.h"

#include <span>

namespace carom::internal {

/// Impacts of a body in a sub-step: at the limit it stays where it is until the next. If more than a few bodies are solved together, the
/// limit is lower: a rattling body must not keep all of them waiting.
inline constexpr int impact_limit = 64;
inline constexpr int crowd_impact_limit = 16;

/// Sub-steps of the scene in one of the context, at least 1.
[[nodiscard]] int substeps_in(const StepContext& ctx);

/// A sub-step of an island, as flight sees it.
struct FlightSpan
{
    StepContext& ctx;
    SceneState& state;
    Scratch& scratch;
    const Island& island;
    IslandOutput& output;
    int k;
    double h;
    double least_approach; ///< m/s: slower approach is rounding
    int most_impacts;      ///< per body

    FlightSpan(StepContext& context, const Island& u, int substep, IslandOutput& out);

    [[nodiscard]] std::span<Flier> fliers() const;
    [[nodiscard]] std::span<const RestingContact> resting_contacts_of(const Flier& f) const;
    [[nodiscard]] Flier* flier_at(std::int32_t state_index) const; ///< null for a body that does not fly or has landed
    [[nodiscard]] BodyState& state_of(std::int32_t index) const { return scratch.solver.states[static_cast<std::size_t>(index)]; }
    [[nodiscard]] const StateConstants& constants_of(std::int32_t i) const
    {
        return scratch.solver.constants[static_cast<std::size_t>(i)];
    }
    [[nodiscard]] const BodySim& sim_of(int body) const { return state.sims[static_cast<std::size_t>(body)]; }
    /// The state of a dynamic body of this island; none: the body does not move, or belongs to another island.
    [[nodiscard]] std::int32_t state_in_island(int body) const;
    /// Two bodies of finite mass have no resting contact: what presses them together is resolved as micro-collisions.
    [[nodiscard]] MicroCollision press(int body_a, int body_b) const;
    [[nodiscard]] double time_of_step(double time) const { return k * static_cast<double>(ctx.h) + time; }
};

inline constexpr double at_limit = 1e-7; ///< rad: an angle this near is at the limit of its hinge

/// Removes all resting contacts: gravity and forces act alone.
void fall_freely(const FlightSpan& span, Flier& f);

/// Sets the accelerations of the sub-step; a body that leans on its hinge's limit stays there.
void start_flight(const FlightSpan& span, Flier& f);

/// Moves the flier to a time of the sub-step.
void advance(const FlightSpan& span, Flier& f, double time);

/// Moves half its size or more in a sub-step (in a crowd: by what changed in this step): contacts found beforehand do not cover such a body.
[[nodiscard]] bool is_fast(const FlightSpan& span, const Flier& f, double vx, double vy, double w);

/// Speed relative to the carrier, m/s.
[[nodiscard]] double speed_over_carrier(const FlightSpan& span, const Flier& f);

/// True if a body was deflected in this step and leaves the boxes in which pairs were searched: the solver would miss what is there.
[[nodiscard]] bool leaves_its_boxes(const FlightSpan& span, const Flier& f);

/// Visits the state on the other side of each contact constraint outside of lanes that bears a load and belongs to `state`.
template <class Visit>
void for_each_pressed_by(const FlightSpan& span, std::int32_t state, const Visit& visit)
{
    const auto look = [&](std::span<const ContactConstraint> constraints)
    {
        for (const ContactConstraint& constraint : constraints)
        {
            if (bears_load(constraint) && (constraint.a == state || constraint.b == state))
                visit(constraint.a == state ? constraint.b : constraint.a);
        }
    };
    look(constraints_of(span.scratch, span.island));
    look(span.output.late_constraints);
}

/// Does a constraint of a solver-owned body bear a load, in a lane or outside?
[[nodiscard]] bool bears_load_now(const FlightSpan& span, std::int32_t state);

/// Moves a body from the solver into flight at a time of the sub-step and drops its constraints.
void take_off(const FlightSpan& span, Flier& f, double time);

/// A body with too many impacts stays where it is until the sub-step is over.
[[nodiscard]] inline bool is_capped(const FlightSpan& span, const Flier& f) { return f.impacts >= span.most_impacts; }

/// Center of mass and its velocity.
struct CenterMotion
{
    double x;
    double y;
    double vx;
    double vy;
};
[[nodiscard]] CenterMotion center_of(const Flier& f);

/// Angular acceleration of a body at an angle: on a hinge by gravity, force and torque about the pivot; a free body has its own.
[[nodiscard]] double turning_acceleration(const FlightSpan& span, const Flier& f, double angle);

/// The path of any body from `time` on, relative to `origin`. The path of a solver-owned body is traced back from its final pose.
[[nodiscard]] FramePath path_from(const FlightSpan& span, int body, double time, const Position& origin);

} // namespace carom::internal
