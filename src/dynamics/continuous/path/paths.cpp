// Paths of bodies over the rest of a sub-step, on which times of impact are searched.

#include "core/trigonometry.h"
#include "dynamics/continuous/motion.h"

#include <cmath>

namespace carom::internal {

namespace {

void turn_frame(Rotation q, double angle, FramePath& path)
{
    const SinCos turn = angle != 0 ? sin_cos(angle) : SinCos{0, 1};
    path.c = turn.cos * static_cast<double>(q.c) - turn.sin * static_cast<double>(q.s);
    path.s = turn.sin * static_cast<double>(q.c) + turn.cos * static_cast<double>(q.s);
}

void follow_flier(const FlightSpan& span, const Flier& f, const BodySim& sim, double time, FramePath& path)
{
    const bool capped = is_capped(span, f);
    const double t = capped ? 0 : time - f.time;
    CenterPath& c = path.center;
    c.x += f.x + t * (f.vx + 0.5 * t * f.ax);
    c.y += f.y + t * (f.vy + 0.5 * t * f.ay);
    path.local_center = f.local_reference;
    turn_frame(sim.rotation, f.angle + t * (f.w + 0.5 * t * f.alpha), path);
    if (capped)
        return;
    c.vx = f.vx + t * f.ax;
    c.vy = f.vy + t * f.ay;
    c.ax = f.ax;
    c.ay = f.ay;
    path.w = f.w + t * f.alpha;
    path.alpha = f.alpha;
}

// The solver has already moved the body to the end of the sub-step.
void follow_solved(const FlightSpan& span, std::int32_t index, const BodySim& sim, double time, FramePath& path)
{
    const BodyState& s = span.state_of(index);
    const double left = span.h - time;
    CenterPath& c = path.center;
    c.vx = s.velocity.x;
    c.vy = s.velocity.y;
    if ((s.flags & body_flag::unbound) != 0)
    {
        c.ax = span.constants_of(index).acceleration.x;
        c.ay = span.constants_of(index).acceleration.y;
    }
    // Position and velocity at `time`, traced back from the end.
    c.x += static_cast<double>(s.delta_position.x) - left * c.vx + 0.5 * left * left * c.ax;
    c.y += static_cast<double>(s.delta_position.y) - left * c.vy + 0.5 * left * left * c.ay;
    c.vx -= left * c.ax;
    c.vy -= left * c.ay;
    path.w = s.angular_velocity;
    turn_frame(s.delta_rotation * sim.rotation, -left * path.w, path);
}

void follow_straight(const FlightSpan& span, int body, const BodySim& sim, double time, FramePath& path)
{
    const double since = span.time_of_step(time);
    CenterPath& c = path.center;
    c.vx = sim.velocity.x;
    c.vy = sim.velocity.y;
    c.x += since * c.vx;
    c.y += since * c.vy;
    path.w = sim.angular_velocity;
    double angle = since * path.w;
    for (const DeferredImpulse& d : span.output.deferred)
    { // an impact in this island changes the path from then on
        if (d.body != body)
            continue;
        const auto dvx = static_cast<double>(sim.inverse_mass.x * d.impulse.x);
        const auto dvy = static_cast<double>(sim.inverse_mass.y * d.impulse.y);
        const auto dw = static_cast<double>(sim.inverse_inertia * cross(d.arm, d.impulse));
        c.vx += dvx;
        c.vy += dvy;
        c.x += (since - d.time) * dvx;
        c.y += (since - d.time) * dvy;
        path.w += dw;
        angle += (since - d.time) * dw;
    }
    turn_frame(rotation_at_start(span.ctx.state, body), angle, path);
}

} // namespace

FramePath path_from(const FlightSpan& span, int body, double time, const Position& origin)
{
    const BodySim& sim = span.sim_of(body);
    FramePath path;
    path.local_center = sim.local_center;
    path.center.x = sim.center.x - origin.x;
    path.center.y = sim.center.y - origin.y;
    path.c = sim.rotation.c;
    path.s = sim.rotation.s;
    const std::int32_t index = span.state_in_island(body);
    if (const Flier* f = span.flier_at(index))
        follow_flier(span, *f, sim, time, path);
    else if (index != none)
        follow_solved(span, index, sim, time, path);
    else if (span.state.bodies[body].awake_index != none || span.state.bodies[body].type == BodyType::Dynamic)
        follow_straight(span, body, sim, time, path); // kinematic, of another island, or asleep
    return path;
}

} // namespace carom::internal
