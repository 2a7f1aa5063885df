#pragma once

// How bodies in flight move, and how everything else moves as they see it.

#include "collision/time_of_impact.h"
#include "dynamics/step_context.h"

#include <span>

namespace carom::internal {

/// Impacts of a body in a sub-step: then it stays where it is until the next. Where more than a few are solved together, what rattles must not keep all
/// of them waiting.
inline constexpr int impact_limit = 64;
inline constexpr int crowd_impact_limit = 16;

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
    double least_approach; ///< m/s: what is slower is rounding
    int most_impacts;      ///< of a body

    FlightSpan(StepContext& context, const Island& u, int substep, IslandOutput& out);

    [[nodiscard]] std::span<Flier> fliers() const;
    [[nodiscard]] std::span<const RestingContact> resting_contacts_of(const Flier& f) const;
    [[nodiscard]] Flier* flier_at(std::int32_t state_index) const; ///< nothing for what does not fly or has landed
    [[nodiscard]] BodyState& state_of(std::int32_t index) const { return scratch.solver.states[static_cast<std::size_t>(index)]; }
    [[nodiscard]] const StateConstants& constants_of(std::int32_t i) const
    {
        return scratch.solver.constants[static_cast<std::size_t>(i)];
    }
    [[nodiscard]] const BodySim& sim_of(int body) const { return state.sims[static_cast<std::size_t>(body)]; }
    /// The state of a dynamic body of this island; none: it does not move, or belongs elsewhere.
    [[nodiscard]] std::int32_t state_in_island(int body) const;
    /// Of two that both give way none holds the other; what presses them together is taken in small blows.
    [[nodiscard]] MicroCollision press(int body_a, int body_b) const;
    [[nodiscard]] double time_of_step(double time) const { return k * static_cast<double>(ctx.h) + time; }
};

inline constexpr double at_limit = 1e-7; ///< rad: an angle this near is at the limit of its hinge

/// Held by nothing: gravity and forces alone.
void fall_freely(const FlightSpan& span, Flier& f);

/// Forces of the sub-step; a body that leans on its hinge's limit stays there.
void start_flight(const FlightSpan& span, Flier& f);

/// Moves the flier to a time of the sub-step.
void advance(const FlightSpan& span, Flier& f, double time);

/// Goes half its size or more in a sub-step (in a crowd: because of what struck it in this step): such a body is not left to contacts found beforehand.
[[nodiscard]] bool is_fast(const FlightSpan& span, const Flier& f, double vx, double vy, double w);

/// m/s, as what holds it sees it.
[[nodiscard]] double speed_over_carrier(const FlightSpan& span, const Flier& f);

/// Struck in this step, and on its way out of where pairs were looked for: the solver would not see what is there.
[[nodiscard]] bool leaves_its_boxes(const FlightSpan& span, const Flier& f);

/// From the solver's hands into flight, at a time of the sub-step; its constraints are dropped.
void take_off(const FlightSpan& span, Flier& f, double time);

/// What has hit things too often stays where it is until the sub-step is over.
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

/// Angular acceleration of a body on a hinge at an angle: gravity, force and torque about the pivot. That of a free one is its own.
[[nodiscard]] double turning_acceleration(const FlightSpan& span, const Flier& f, double angle);

/// The path of any body from `time` on, relative to `origin`. Of one that the solver moves: back from where it has been put.
[[nodiscard]] FramePath path_from(const FlightSpan& span, int body, double time, const Position& origin);

} // namespace carom::internal
