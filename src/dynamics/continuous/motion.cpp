// Motion of bodies in flight. Free flight is exact: a parabola with constant angular acceleration. A body on a hinge has one coordinate, its
// angle, integrated by velocity Verlet between changes of its path: the angular acceleration at the start advances the angle, the mean of
// start and end changes the angular velocity.

#include "dynamics/continuous/motion.h"

#include "core/trigonometry.h"
#include "dynamics/continuous/flight.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace carom::internal {

// A step that is flown at once has the budgets of all its sub-steps.
int substeps_in(const StepContext& ctx)
{
    return std::max(1, static_cast<int>(std::lround(ctx.h * static_cast<float>(ctx.scene.def.substeps) / ctx.dt)));
}

FlightSpan::FlightSpan(StepContext& context, const Island& u, int substep, IslandOutput& out)
    : ctx(context), state(context.state), scratch(context.scratch), island(u), output(out), k(substep),
      h(static_cast<double>(context.h)), least_approach(1e-6 * static_cast<double>(context.scene.def.length_scale)),
      most_impacts(substeps_in(context) * (u.policy.exact_impacts ? impact_limit : crowd_impact_limit))
{}

std::span<Flier> FlightSpan::fliers() const { return fliers_of(scratch, island); }

std::span<const RestingContact> FlightSpan::resting_contacts_of(const Flier& f) const
{
    return f.resting_count == 0 ? std::span<const RestingContact>()
                                : std::span(output.resting_sets[static_cast<std::size_t>(f.resting_set)])
                                      .first(static_cast<std::size_t>(f.resting_count));
}

Flier* FlightSpan::flier_at(std::int32_t state_index) const
{
    if (state_index == none)
        return nullptr;
    const std::int32_t f = scratch.flight.flier_of_state[static_cast<std::size_t>(state_index)];
    if (f == none || scratch.flight.fliers[static_cast<std::size_t>(f)].landed)
        return nullptr;
    return &scratch.flight.fliers[static_cast<std::size_t>(f)];
}

std::int32_t FlightSpan::state_in_island(int body) const
{
    const int place = state.bodies[body].awake_index;
    if (place == none || state.bodies[body].type != BodyType::Dynamic)
        return none;
    const std::int32_t s = scratch.solver.state_of[static_cast<std::size_t>(place)];
    return s >= island.first_state && s < island.first_state + island.state_count ? s : none;
}

MicroCollision FlightSpan::press(int a, int b) const
{
    constexpr double shallow = 0.01; // of the inner radius
    const double size = std::min(sim_of(a).size, sim_of(b).size);
    return {0.25 * h, static_cast<double>(ctx.scene.tolerances.rest_speed), shallow * size};
}

double turning_acceleration(const FlightSpan& span, const Flier& f, double angle)
{
    const StateConstants& c = span.constants_of(f.state);
    if (f.joint == none)
        return static_cast<double>(c.angular_acceleration);
    const BodySim& sim = span.sim_of(f.body);
    const SinCos q = sin_cos(angle);
    const double x = q.cos * f.arm_x - q.sin * f.arm_y;
    const double y = q.sin * f.arm_x + q.cos * f.arm_y;
    const double torque =
        static_cast<double>(sim.mass) * (x * static_cast<double>(c.acceleration.y) - y * static_cast<double>(c.acceleration.x)) +
        static_cast<double>(sim.inertia) * static_cast<double>(c.angular_acceleration);
    return torque * f.inverse_inertia;
}

void fall_freely(const FlightSpan& span, Flier& f)
{
    const StateConstants& c = span.constants_of(f.state);
    f.ax = f.joint == none ? static_cast<double>(c.acceleration.x) : 0;
    f.ay = f.joint == none ? static_cast<double>(c.acceleration.y) : 0;
    f.alpha = turning_acceleration(span, f, f.angle);
    f.resting_count = 0;
    f.curvature_rate = 0;
    f.constrained = false;
}

namespace {

// A body at a limit that is accelerated toward it and does not leave it is held still.
bool leans_on_limit(const Flier& f)
{
    const bool low = f.angle <= f.lower + at_limit && f.alpha <= 0 && f.w <= 0;
    const bool high = f.angle >= f.upper - at_limit && f.alpha >= 0 && f.w >= 0;
    return low || high;
}

void clear_substep(const FlightSpan& span, Flier& f)
{
    fall_freely(span, f);
    f.impacts_before += std::exchange(f.impacts, 0);
    f.impulse_x = f.impulse_y = f.turn_impulse = 0;
    f.start_w = f.w;
    f.rests = false;
    const CenterMotion center = center_of(f);
    f.start_vx = center.vx;
    f.start_vy = center.vy;
}

} // namespace

void start_flight(const FlightSpan& span, Flier& f)
{
    if (f.landed)
        return;
    const StateConstants& c = span.constants_of(f.state);
    f.vx *= c.linear_decay;
    f.vy *= c.linear_decay;
    f.w *= c.angular_decay;
    f.time = 0;
    clear_substep(span, f);
    if (f.joint != none && leans_on_limit(f) && std::fabs(f.w) <= span.h * std::fabs(f.alpha))
    {
        f.w = f.alpha = 0;
        f.constrained = true;
    }
}

namespace {

// A held body follows a surface: the acceleration across its path turns the velocity, the acceleration along it changes the speed. A
// parabola would gain speed by both.
void follow_surface(Flier& f, double t)
{
    f.vx -= f.lead_x;
    f.vy -= f.lead_y;
    f.x += t * f.lead_x;
    f.y += t * f.lead_y;
    const double speed = std::sqrt(f.vx * f.vx + f.vy * f.vy);
    const double along = (f.vx * f.ax + f.vy * f.ay) / speed;
    const double turn = t * (f.vx * f.ay - f.vy * f.ax) / (speed * speed);
    const double displacement = t * (speed + 0.5 * t * along);
    // The chord of an arc of that length and turn.
    const SinCos half = sin_cos(0.5 * turn);
    const double chord = std::fabs(turn) > 1e-4 ? displacement * half.sin / (0.5 * turn) : displacement;
    const double ux = f.vx / speed;
    const double uy = f.vy / speed;
    f.x += chord * (half.cos * ux - half.sin * uy);
    f.y += chord * (half.sin * ux + half.cos * uy);
    const SinCos full = sin_cos(turn);
    const double after = speed + t * along;
    f.vx = after * (full.cos * ux - full.sin * uy) + f.lead_x;
    f.vy = after * (full.sin * ux + full.cos * uy) + f.lead_y;
    const double ax = f.ax;
    f.ax = full.cos * ax - full.sin * f.ay;
    f.ay = full.sin * ax + full.cos * f.ay;
}

void follow_parabola(Flier& f, double t)
{
    f.x += t * (f.vx + 0.5 * t * f.ax);
    f.y += t * (f.vy + 0.5 * t * f.ay);
    f.vx += t * f.ax;
    f.vy += t * f.ay;
}

// Only along a body of infinite mass: two bodies that lean on each other exchange momentum. If the speed is small against the change of
// velocity, a rotation of the velocity means nothing.
bool is_led(const Flier& f, double t)
{
    const double vx = f.vx - f.lead_x;
    const double vy = f.vy - f.lead_y;
    return f.resting_count > 0 && f.led && f.joint == none && 4 * t * t * (f.ax * f.ax + f.ay * f.ay) < vx * vx + vy * vy;
}

// Motion of a flier relative to its carrier.
struct Seen
{
    double x = 0; ///< from the carrier's center
    double y = 0;
    double carrier_vx = 0; ///< velocity of the carrier where the body is
    double carrier_vy = 0;
    double carrier_w = 0;
    double vx = 0;
    double vy = 0;
    double w = 0;
};

Seen as_seen_from_carrier(const FlightSpan& span, const Flier& f)
{
    Seen seen;
    if (f.carrier != carried_by_world)
    {
        const BodySim& own = span.sim_of(f.body);
        const BodySim& carrier = span.sim_of(f.carrier);
        const double since = span.time_of_step(f.time);
        const auto vx = static_cast<double>(carrier.velocity.x);
        const auto vy = static_cast<double>(carrier.velocity.y);
        seen.x = own.center.x - carrier.center.x + f.x - since * vx;
        seen.y = own.center.y - carrier.center.y + f.y - since * vy;
        seen.carrier_w = carrier.angular_velocity;
        seen.carrier_vx = vx - seen.carrier_w * seen.y;
        seen.carrier_vy = vy + seen.carrier_w * seen.x;
    }
    seen.vx = f.vx - seen.carrier_vx;
    seen.vy = f.vy - seen.carrier_vy;
    seen.w = f.w - seen.carrier_w;
    return seen;
}

double over(double value, double inverse_mass) { return inverse_mass > 0 ? value / inverse_mass : 0; }

double twice_kinetic(const Flier& f, const Seen& s)
{
    return over(s.vx * s.vx, f.inverse_mass_x) + over(s.vy * s.vy, f.inverse_mass_y) + over(s.w * s.w, f.inverse_inertia);
}

// Twice the energy in the frame of the carrier, with the centrifugal potential. A surface in uniform motion may only reduce it.
double twice_energy(const Flier& f, const Seen& s)
{
    return twice_kinetic(f, s) -
           s.carrier_w * s.carrier_w * (over(s.x * s.x, f.inverse_mass_x) + over(s.y * s.y, f.inverse_mass_y));
}

// Twice the work of the free acceleration along the path.
double twice_work(const FlightSpan& span, const Flier& f, const Flier& before, const Seen& s, const Seen& s_before)
{
    const StateConstants& c = span.constants_of(f.state);
    const double t = f.time - before.time;
    const auto work = [&](double inverse_mass, float acceleration, double displacement, double carrier_speed)
    { return over(2 * static_cast<double>(acceleration) * (displacement - t * carrier_speed), inverse_mass); };
    return work(f.inverse_mass_x, c.acceleration.x, f.x - before.x, 0.5 * (s.carrier_vx + s_before.carrier_vx)) +
           work(f.inverse_mass_y, c.acceleration.y, f.y - before.y, 0.5 * (s.carrier_vy + s_before.carrier_vy)) +
           work(f.inverse_inertia, c.angular_acceleration, f.angle - before.angle, s.carrier_w);
}

void take_gain(const FlightSpan& span, Flier& f, const Flier& before)
{
    const Seen was = as_seen_from_carrier(span, before);
    const Seen is = as_seen_from_carrier(span, f);
    const double gain = twice_energy(f, is) - twice_energy(f, was) - twice_work(span, f, before, is, was);
    const double moving = twice_kinetic(f, is);
    if (gain <= 0 || moving <= 0)
        return;
    const double less = std::sqrt(std::max(moving - gain, 0.0) / moving) - 1;
    f.vx += less * is.vx;
    f.vy += less * is.vy;
    f.w += less * is.w;
}

} // namespace

double speed_over_carrier(const FlightSpan& span, const Flier& f)
{
    const Seen seen = as_seen_from_carrier(span, f);
    return length_of(seen.vx, seen.vy);
}

namespace {

// A body with a locked axis has no potential on a rotating carrier.
bool may_gain(const FlightSpan& span, const Flier& f)
{
    return f.resting_count > 0 && f.joint == none && f.carrier != none &&
           (f.carrier == carried_by_world || f.inverse_mass_x == f.inverse_mass_y ||
            span.sim_of(f.carrier).angular_velocity == 0);
}

} // namespace

namespace {

// Work of constant forces on a hinged body along its path, divided by the moment of inertia.
double work_on_hinge(const FlightSpan& span, const Flier& f, double from)
{
    const StateConstants& c = span.constants_of(f.state);
    const BodySim& sim = span.sim_of(f.body);
    const SinCos p = sin_cos(from);
    const SinCos q = sin_cos(f.angle);
    const double x = (q.cos - p.cos) * f.arm_x - (q.sin - p.sin) * f.arm_y;
    const double y = (q.sin - p.sin) * f.arm_x + (q.cos - p.cos) * f.arm_y;
    return f.inverse_inertia *
           (static_cast<double>(sim.mass) *
                (static_cast<double>(c.acceleration.x) * x + static_cast<double>(c.acceleration.y) * y) +
            static_cast<double>(sim.inertia) * static_cast<double>(c.angular_acceleration) * (f.angle - from));
}

// The speed from Verlet has an error of third order in the step. The speed from the energy has none, unless the body turns back.
void swing(const FlightSpan& span, Flier& f, double t, double from, double before)
{
    const double there = turning_acceleration(span, f, f.angle);
    f.w += 0.5 * t * (there - f.alpha);
    f.alpha = there;
    const double square = before * before + 2 * work_on_hinge(span, f, from);
    if (f.w * before > 0 && square > 0.25 * f.w * f.w)
        f.w = std::copysign(std::sqrt(square), f.w);
}

} // namespace

void advance(const FlightSpan& span, Flier& f, double time)
{
    const double t = time - f.time;
    const double angle = f.angle;
    const double w = f.w;
    const std::optional<Flier> before = may_gain(span, f) ? std::optional(f) : std::nullopt;
    is_led(f, t) ? follow_surface(f, t) : follow_parabola(f, t);
    f.angle += t * (f.w + 0.5 * t * f.alpha);
    f.w += t * f.alpha;
    f.time = time;
    if (before)
        take_gain(span, f, *before);
    if (f.joint == none || f.constrained || t == 0)
        return;
    swing(span, f, t, angle, w);
}

CenterMotion center_of(const Flier& f)
{
    const SinCos q = f.arm_x != 0 || f.arm_y != 0 ? sin_cos(f.angle) : SinCos{0, 1};
    const double x = q.cos * f.arm_x - q.sin * f.arm_y;
    const double y = q.sin * f.arm_x + q.cos * f.arm_y;
    return {f.x + x, f.y + y, f.vx - f.w * y, f.vy + f.w * x};
}

bool is_fast(const FlightSpan& span, const Flier& f, double vx, double vy, double w)
{
    const BodySim& sim = span.sim_of(f.body);
    if (!span.island.policy.exact_impacts)
    { // a crowd that falls together is not fast: only the change in this step counts
        vx -= static_cast<double>(sim.velocity.x);
        vy -= static_cast<double>(sim.velocity.y);
        w -= static_cast<double>(sim.angular_velocity);
    }
    return span.h * (std::sqrt(vx * vx + vy * vy) + std::fabs(w) * static_cast<double>(sim.extent)) > 0.5 * f.size;
}

namespace {

// True if a surface has led the body aside: a curved wall leads a ball around, away from what lay on its path.
bool is_led_astray(const FlightSpan& span, const BodySim& sim, const BodyState& s)
{
    return span.ctx.dt * length(s.velocity - sim.velocity) > span.ctx.scene.tolerances.box_margin;
}

} // namespace

bool leaves_its_boxes(const FlightSpan& span, const Flier& f)
{
    const BodySim& sim = span.sim_of(f.body);
    const BodyState& s = span.state_of(f.state);
    if (!f.is_deflected() && !is_led_astray(span, sim, s))
        return false;
    const Rotation q = s.delta_rotation * sim.rotation;
    const Pose pose{sim.center + s.delta_position - rotate(q, sim.local_center), q};
    const float ahead = span.ctx.h * (length(s.velocity) + std::fabs(s.angular_velocity) * sim.extent);
    bool leaves = false;
    for_each_leaf(span.state, f.body,
                  [&](int own)
                  {
                      const FloatBox soon = box_of(grown(outer_bounds(leaf_view(span.state, own), pose), ahead));
                      const FloatBox foreseen =
                          grow(swept(span.state.broad_phase.path(own)), span.ctx.scene.tolerances.box_margin);
                      leaves |= !contains(foreseen, soon);
                  });
    return leaves;
}

bool bears_load_now(const FlightSpan& span, std::int32_t state)
{
    bool loaded = false;
    for_each_pressed_by(span, state, [&](std::int32_t) { loaded = true; });
    for (const int index : contacts_of(span.state, span.scratch.solver.state_bodies[static_cast<std::size_t>(state)]))
    {
        const std::int32_t wide = span.state.contacts[index].wide;
        loaded = loaded || (wide != none && bears_load(constraint_of_lane(span.scratch, wide)));
    }
    return loaded;
}

void take_off(const FlightSpan& span, Flier& f, double time)
{
    const BodySim& sim = span.sim_of(f.body);
    const FramePath path = path_from(span, f.body, time, sim.center);
    f.angle = arc_tangent(path.s * static_cast<double>(sim.rotation.c) - path.c * static_cast<double>(sim.rotation.s),
                          path.c * static_cast<double>(sim.rotation.c) + path.s * static_cast<double>(sim.rotation.s));
    if (f.joint == none)
    {
        f.x = path.center.x;
        f.y = path.center.y;
        f.vx = path.center.vx;
        f.vy = path.center.vy;
    }
    f.w = path.w;
    f.landed = false;
    span.output.disturbed = true;
    note_deflected(span.scratch, span.output, span.scratch.flight.flier_of_state[static_cast<std::size_t>(f.state)]);
    span.state_of(f.state).flags |= body_flag::flier;
    const auto drop_constraints = [&](std::span<ContactConstraint> constraints)
    {
        for (ContactConstraint& constraint : constraints)
        {
            if (constraint.a == f.state || constraint.b == f.state)
                drop(constraint);
        }
    };
    drop_constraints(constraints_of(span.scratch, span.island));
    drop_constraints(span.output.late_constraints);
    for (const int index : contacts_of(span.state, f.body))
    {
        if (Contact& contact = span.state.contacts[index]; contact.wide != none)
            drop_lane(span.ctx, contact, span.island.first_state);
    }
    if (f.joint != none)
        forget_impulses(span.state.joints[f.joint]);
    clear_substep(span, f);
    f.time = time;
}

} // namespace carom::internal
