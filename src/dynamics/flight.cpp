// A ball in flight is not a pile. Its path is a parabola until it meets something; the time of that is found on both true paths, the
// impulse is given there, and the rest of the sub-step is flown from there: no time is lost and no gap is left.
//
//   u  = approach speed along n at the point of contact                 j = ((1 + e) u + kick) / k
//   k  = n M^-1 n of both bodies, with lever arms                       friction: |jt| <= mu j, towards no slip
//
// A bounce so small that gravity would end it within the sub-step (e u <= a_n h / 2) is rest: e = 0, the ball slides along the surface for
// the rest of the sub-step and is then the solver's. Zero gravity never rests by that rule, nor does a slow ball with room to bounce.

#include "dynamics/flight.h"

#include "collision/time_of_impact.h"
#include "core/trigonometry.h"
#include "dynamics/body_store.h"
#include "dynamics/contact_store.h"
#include "dynamics/contact_update.h"
#include "dynamics/half_space_box.h"
#include "dynamics/material.h"
#include "dynamics/prepare.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr int impact_limit = 64; // per ball and sub-step
constexpr int settling_rounds = 8;

/// What a ball may hit, where it is and how it moves at a time of the sub-step.
struct Target
{
    std::int32_t body = none;
    std::int32_t state = none; ///< in this unit; none: outside
    FramePath path{};          ///< from the time asked for on, relative to the ball's place at the start of the step
    double inverse_mass_x = 0;
    double inverse_mass_y = 0;
    double inverse_inertia = 0;
    std::uint32_t flags = 0;
};

class Flight
{
public:
    Flight(StepContext& ctx, const Unit& unit, int k, UnitOutput& output)
        : m_ctx(ctx), m_state(ctx.state), m_scratch(ctx.scratch), m_unit(unit), m_k(k), m_h(ctx.h),
          m_tiny(1e-6 * static_cast<double>(ctx.scene.def.length_scale)), m_output(output)
    {}

    void run()
    {
        for (Flier& flier : fliers())
            start(flier);
        for (Flier& flier : fliers())
            find_next_event(flier);
        while (Flier* next = earliest())
            process(*next);
        for (Flier& flier : fliers())
            finish(flier);
    }

private:
    [[nodiscard]] std::span<Flier> fliers()
    {
        return std::span(m_scratch.fliers)
            .subspan(static_cast<std::size_t>(m_unit.first_flier), static_cast<std::size_t>(m_unit.flier_count));
    }
    [[nodiscard]] BodyState& state_of(const Flier& f) { return m_scratch.states[static_cast<std::size_t>(f.state)]; }
    [[nodiscard]] const StateConstants& constants_of(std::int32_t state) const
    {
        return m_scratch.constants[static_cast<std::size_t>(state)];
    }
    [[nodiscard]] const BodySim& sim_of(int body) const { return m_state.sims[static_cast<std::size_t>(body)]; }
    [[nodiscard]] double radius_of(const Flier& f) const { return m_state.shapes[f.shape].leaf.r0; }
    [[nodiscard]] double time_of_step(double time) const { return m_k * static_cast<double>(m_h) + time; }

    // --- paths ----------------------------------------------------------------------------------------------------------------------

    void start(Flier& f)
    {
        if (f.landed)
            return;
        const StateConstants& c = constants_of(f.state);
        f.vx *= c.linear_decay;
        f.vy *= c.linear_decay;
        f.ax = c.acceleration.x;
        f.ay = c.acceleration.y;
        f.time = 0;
        f.impacts = 0;
        f.held_count = 0;
        BodyState& s = state_of(f);
        s.angular_velocity = (s.angular_velocity + m_h * c.angular_acceleration) * c.angular_decay;
    }

    static void advance(Flier& f, double time)
    {
        const double t = time - f.time;
        f.x += t * f.vx + 0.5 * t * t * f.ax;
        f.y += t * f.vy + 0.5 * t * t * f.ay;
        f.vx += t * f.ax;
        f.vy += t * f.ay;
        f.time = time;
    }

    [[nodiscard]] std::int32_t state_in_unit(int body) const
    {
        const int place = m_state.bodies[body].awake_index;
        if (place == none || m_state.bodies[body].type != BodyType::Dynamic)
            return none;
        const std::int32_t s = m_scratch.state_of[static_cast<std::size_t>(place)];
        return s >= m_unit.first_state && s < m_unit.first_state + m_unit.state_count ? s : none;
    }

    [[nodiscard]] Flier* flier_at(std::int32_t state)
    {
        if (state == none)
            return nullptr;
        const std::int32_t f = m_scratch.flier_of_state[static_cast<std::size_t>(state)];
        return f != none && !m_scratch.fliers[static_cast<std::size_t>(f)].landed ? &m_scratch.fliers[static_cast<std::size_t>(f)]
                                                                                  : nullptr;
    }

    // The target as it moves from `time` on.
    [[nodiscard]] Target target_at(const Flier& ball, int body, double time)
    {
        const BodySim& sim = sim_of(body);
        Target t;
        t.body = body;
        t.state = state_in_unit(body);
        t.path.local_center = sim.local_center;
        const Position origin = sim_of(ball.body).center;
        CenterPath& c = t.path.center;
        c.x = sim.center.x - origin.x;
        c.y = sim.center.y - origin.y;
        t.path.c = sim.rotation.c;
        t.path.s = sim.rotation.s;
        if (m_state.bodies[body].type == BodyType::Dynamic)
        {
            t.inverse_mass_x = sim.inverse_mass.x;
            t.inverse_mass_y = sim.inverse_mass.y;
            t.inverse_inertia = sim.inverse_inertia;
        }
        if (const Flier* other = flier_at(t.state))
            follow_flier(*other, time, t);
        else if (t.state != none)
            follow_solved(t, time);
        else if (m_state.bodies[body].awake_index != none)
            follow_straight(sim, time, t); // kinematic, or of another unit
        return t;
    }

    static void follow_flier(const Flier& other, double time, Target& t)
    {
        Flier copy = other;
        advance(copy, time);
        CenterPath& c = t.path.center;
        c.x += copy.x;
        c.y += copy.y;
        c.vx = copy.vx;
        c.vy = copy.vy;
        c.ax = copy.ax;
        c.ay = copy.ay;
    }

    // The solver has already moved it to the end of the sub-step.
    void follow_solved(Target& t, double time)
    {
        const BodyState& s = m_scratch.states[static_cast<std::size_t>(t.state)];
        const double left = static_cast<double>(m_h) - time;
        CenterPath& c = t.path.center;
        c.vx = s.velocity.x;
        c.vy = s.velocity.y;
        if ((s.flags & body_flag::unbound) != 0)
        {
            c.ax = constants_of(t.state).acceleration.x;
            c.ay = constants_of(t.state).acceleration.y;
        }
        // Back from the end: position and velocity at `time`.
        c.x += s.delta_position.x - left * c.vx + 0.5 * left * left * c.ax;
        c.y += s.delta_position.y - left * c.vy + 0.5 * left * left * c.ay;
        c.vx -= left * c.ax;
        c.vy -= left * c.ay;
        const Rotation q = s.delta_rotation * Rotation{static_cast<float>(t.path.c), static_cast<float>(t.path.s)};
        t.path.w = s.angular_velocity;
        t.flags = s.flags;
        turn_frame(q, -left * t.path.w, t);
    }

    void follow_straight(const BodySim& sim, double time, Target& t)
    {
        const double since = time_of_step(time);
        CenterPath& c = t.path.center;
        c.vx = sim.velocity.x;
        c.vy = sim.velocity.y;
        c.x += since * c.vx;
        c.y += since * c.vy;
        t.path.w = sim.angular_velocity;
        turn_frame(sim.rotation, since * t.path.w, t);
    }

    static void turn_frame(Rotation q, double angle, Target& t)
    {
        const SinCos turn = angle != 0 ? sin_cos(angle) : SinCos{0, 1};
        t.path.c = turn.cos * q.c - turn.sin * q.s;
        t.path.s = turn.sin * q.c + turn.cos * q.s;
    }

    // --- events ---------------------------------------------------------------------------------------------------------------------

    void find_next_event(Flier& f)
    {
        f.event_time = 1e300;
        if (f.landed || f.impacts >= impact_limit || f.time >= static_cast<double>(m_h))
            return;
        for (int edge = m_state.bodies[f.body].first_contact; edge != none;)
        {
            const int index = edge >> 1;
            Contact& contact = m_state.contacts[index];
            edge = contact.next[edge & 1];
            if ((contact.flags & (contact_flag::trigger | contact_flag::passing)) != 0)
                continue;
            if (contact.shape_a == f.shape || contact.shape_b == f.shape)
                consider(f, contact.shape_a == f.shape ? contact.shape_b : contact.shape_a, index);
        }
        look_beyond_box(f);
    }

    // A bounce or a kick may lead out of the box that the pairs were found with.
    void look_beyond_box(Flier& f)
    {
        Flier end = f;
        advance(end, m_h);
        const Position origin = sim_of(f.body).center;
        const double r = radius_of(f);
        const FloatBox path = round_outwards(origin.x + std::min(f.x, end.x) - r, origin.y + std::min(f.y, end.y) - r,
                                             origin.x + std::max(f.x, end.x) + r, origin.y + std::max(f.y, end.y) + r);
        if (contains(m_state.broad_phase.box(f.shape), path))
            return;
        const auto visit = [&](int shape)
        {
            if (shape != f.shape && !m_state.pairs.contains(pair_key(f.shape, shape)) && !m_state.shapes[shape].trigger &&
                may_collide(m_state, f.shape, shape))
                consider(f, shape, none);
            return true;
        };
        m_state.broad_phase.query(Layer::Moving, path, visit);
        m_state.broad_phase.query(Layer::Resting, path, visit);
        for (const std::int32_t half_space : m_state.broad_phase.unbounded())
        {
            if (reaches_half_space(m_state, half_space, path, 0))
                visit(half_space);
        }
    }

    void consider(Flier& f, int shape, int contact)
    {
        if (holds(f, shape))
            return;
        const Target target = target_at(f, m_state.shapes[shape].body, f.time);
        const double left = std::min(static_cast<double>(m_h), f.event_time) - f.time;
        const CenterPath ball{f.x, f.y, f.vx, f.vy, f.ax, f.ay};
        const std::optional<BallHit> hit =
            ball_time_of_impact(ball, radius_of(f), leaf_view(m_state, shape), target.path, left, m_tiny);
        if (!hit || f.time + hit->time >= f.event_time)
            return;
        // The ball is b as the material sees it: the normal runs from the shape to the ball.
        if (lets_pass(m_ctx.scene, shape, f.shape, {static_cast<float>(hit->nx), static_cast<float>(hit->ny)}))
        {
            if (contact != none)
                m_state.contacts[contact].flags |= contact_flag::passing;
            return;
        }
        f.event_time = f.time + hit->time;
        f.nx = hit->nx;
        f.ny = hit->ny;
        f.curvature = hit->curvature;
        f.event_shape = shape;
        f.event_contact = contact;
        f.event_state = target.state;
        f.event_version = version(target.state);
    }

    [[nodiscard]] std::int32_t version(std::int32_t state) const
    {
        return state == none ? 0 : m_scratch.versions[static_cast<std::size_t>(state)];
    }
    void path_changed(std::int32_t state)
    {
        if (state != none)
            ++m_scratch.versions[static_cast<std::size_t>(state)];
    }

    // The first by time; of equals the first in the unit.
    [[nodiscard]] Flier* earliest()
    {
        Flier* best = nullptr;
        for (Flier& f : fliers())
        {
            if (f.event_time <= static_cast<double>(m_h) && (best == nullptr || f.event_time < best->event_time))
                best = &f;
        }
        return best;
    }

    void process(Flier& f)
    {
        if (f.event_version != version(f.event_state))
        {
            find_next_event(f);
            return;
        }
        Flier* other = flier_at(f.event_state);
        const double time = f.event_time;
        advance(f, time);
        if (other != nullptr)
            advance(*other, time);
        // A few rounds between two holds settle how they share; after that, what holds the ball keeps holding it.
        if (f.impacts < settling_rounds)
        {
            release(f);
            if (other != nullptr)
                release(*other);
        }
        collide_ball(f, other);
        if (other != nullptr && holds(f, f.event_shape))
            add_hold(*other, f.shape, -f.nx, -f.ny);
        respect_holds(f);
        if (other != nullptr)
            respect_holds(*other);
        path_changed(f.state);
        path_changed(f.event_state);
        const std::int32_t struck = other == nullptr ? f.event_state : none;
        note_path(f);
        if (other != nullptr)
        {
            note_path(*other);
            find_next_event(*other);
        }
        find_next_event(f);
        if (struck != none)
            reconsider_neighbours(struck);
    }

    [[nodiscard]] static bool holds(const Flier& f, int shape)
    {
        return std::find(f.held, f.held + f.held_count, shape) != f.held + f.held_count;
    }
    void add_hold(Flier& f, int shape, double nx, double ny)
    {
        if (holds(f, shape) || f.held_count >= Flier::most_held)
            return;
        const bool fixed = m_state.bodies[m_state.shapes[shape].body].type == BodyType::Static;
        f.held[f.held_count] = shape;
        f.held_nx[f.held_count] = fixed ? nx : 0;
        f.held_ny[f.held_count] = fixed ? ny : 0;
        ++f.held_count;
    }

    // What holds a ball and does not give way is no longer looked for, so nothing may push the ball into it. Two rounds, for a wedge.
    static void respect_holds(Flier& f)
    {
        for (int round = 0; round < 2; ++round)
        {
            for (int i = 0; i < f.held_count; ++i)
            {
                const double into = std::min(f.vx * f.held_nx[i] + f.vy * f.held_ny[i], 0.0);
                f.vx -= into * f.held_nx[i];
                f.vy -= into * f.held_ny[i];
            }
        }
    }

    // Pushed anew: what held it may be in the way again, or left behind.
    void release(Flier& f)
    {
        f.held_count = 0;
        f.ax = constants_of(f.state).acceleration.x;
        f.ay = constants_of(f.state).acceleration.y;
    }

    // Other balls near a struck body of the solver's may now meet it sooner.
    void reconsider_neighbours(std::int32_t struck)
    {
        const int body = m_scratch.state_bodies[static_cast<std::size_t>(struck)];
        for (int edge = m_state.bodies[body].first_contact; edge != none; edge = m_state.contacts[edge >> 1].next[edge & 1])
        {
            if (Flier* f = flier_at(state_in_unit(other_body(m_state.contacts[edge >> 1], body))))
                find_next_event(*f);
        }
    }

    void note_path(const Flier& f) { m_output.path.push_back({f.body, static_cast<float>(time_of_step(f.time)), f.x, f.y}); }

    // --- impact ---------------------------------------------------------------------------------------------------------------------

    struct Impact
    {
        double u = 0; ///< approach speed
        double e = 0;
        double kick = 0;
        double k = 0;
        double normal = 0;  ///< impulse
        double tangent = 0; ///< along perp(n), on the ball
        double arm_x = 0;   ///< from the target's center to the point
        double arm_y = 0;
        double speed_target = 0;
        double energy_lost = 0;
        double slide = 0;    ///< speed along perp(n)
        double pressing = 0; ///< acceleration towards the surface, its bend included
    };

    void collide_ball(Flier& f, Flier* other)
    {
        ++f.impacts;
        m_output.capped |= f.impacts >= impact_limit;
        f.crowded |= f.impacts >= settling_rounds;
        Target target = target_at(f, m_state.shapes[f.event_shape].body, f.time);
        BodyState& ball = state_of(f);
        const double r = radius_of(f);
        Impact impact;
        impact.arm_x = f.x - r * f.nx - target.path.center.x;
        impact.arm_y = f.y - r * f.ny - target.path.center.y;
        block_at_stop(f, impact, target);
        // Normal.
        const double turn = impact.arm_x * f.ny - impact.arm_y * f.nx; // arm x n
        const double inverse_mass = sim_of(f.body).inverse_mass.x;
        impact.k = inverse_mass + f.nx * f.nx * target.inverse_mass_x + f.ny * f.ny * target.inverse_mass_y +
                   turn * turn * target.inverse_inertia;
        const double tvx = target.path.center.vx - target_w(target, other) * impact.arm_y;
        const double tvy = target.path.center.vy + target_w(target, other) * impact.arm_x;
        impact.u = (tvx - f.vx) * f.nx + (tvy - f.vy) * f.ny;
        impact.speed_target = tvx * f.nx + tvy * f.ny;
        const double before = energy(f, ball, target, other);
        choose_restitution(f, target, impact, tvx, tvy);
        impact.normal = ((1 + impact.e) * impact.u + impact.kick) / impact.k;
        apply(f, other, target, impact, impact.normal * f.nx, impact.normal * f.ny);
        apply_friction(f, other, target, impact);
        impact.energy_lost = before - energy(f, ball, target, other);
        report(f, impact);
    }

    // A flipper that leans on its stop cannot give way towards it.
    static void block_at_stop(const Flier& f, const Impact& impact, Target& target)
    {
        const double turn = -(impact.arm_x * f.ny - impact.arm_y * f.nx); // sense in which the impact turns the target
        if ((turn < 0 && (target.flags & body_flag::at_lower) != 0) || (turn > 0 && (target.flags & body_flag::at_upper) != 0))
            target.inverse_inertia = 0;
    }

    [[nodiscard]] double target_w(const Target& target, const Flier* other)
    {
        return other != nullptr ? static_cast<double>(state_of(*other).angular_velocity) : target.path.w;
    }

    void choose_restitution(Flier& f, const Target& target, Impact& impact, double tvx, double tvy)
    {
        const auto u = static_cast<float>(impact.u);
        impact.e = mixed_restitution(m_ctx.scene, f.shape, f.event_shape, u);
        const KickResult kick = kick_speed(m_ctx.scene, f.shape, f.event_shape, u);
        impact.kick = kick.speed;
        if (kick.a_fired)
            m_output.kicked_shapes.push_back(f.shape);
        if (kick.b_fired)
            m_output.kicked_shapes.push_back(f.event_shape);
        // What presses the ball on: acceleration, and the bend of the surface under its slide.
        impact.slide = (f.vx - tvx) * -f.ny + (f.vy - tvy) * f.nx;
        impact.pressing = -(f.ax - target.path.center.ax) * f.nx - (f.ay - target.path.center.ay) * f.ny -
                          f.curvature * impact.slide * impact.slide;
        if (impact.kick == 0 && impact.e * impact.u <= std::max(0.5 * impact.pressing * static_cast<double>(m_h), 0.0) + m_tiny)
            hold(f, impact);
    }

    void hold(Flier& f, Impact& impact)
    {
        impact.e = 0;
        add_hold(f, f.event_shape, f.nx, f.ny);
        f.hold_curvature = target_is_still(f) ? f.curvature : 0;
        if (impact.pressing > 0)
        { // the surface takes the part of the acceleration that presses
            const double an = f.ax * f.nx + f.ay * f.ny;
            f.ax -= an * f.nx;
            f.ay -= an * f.ny;
        }
    }

    [[nodiscard]] bool target_is_still(const Flier& f) const
    {
        return m_state.bodies[m_state.shapes[f.event_shape].body].awake_index == none;
    }

    void apply_friction(Flier& f, Flier* other, const Target& target, Impact& impact)
    {
        const double mu = friction_of(f);
        const double r = radius_of(f);
        const double tx = -f.ny;
        const double ty = f.nx;
        const BodyState& ball = state_of(f);
        const double inertia = sim_of(f.body).inverse_inertia;
        const double turn = impact.arm_x * ty - impact.arm_y * tx;
        const double k = static_cast<double>(sim_of(f.body).inverse_mass.x) + r * r * inertia + tx * tx * target.inverse_mass_x +
                         ty * ty * target.inverse_mass_y + turn * turn * target.inverse_inertia;
        const Vec2 tv = target_velocity(target, other);
        const double tw = target_spin(target);
        // The ball's arm is -r n, so that its surface moves by -r w along t.
        const double slip = (f.vx - tv.x + tw * impact.arm_y) * tx + (f.vy - tv.y - tw * impact.arm_x) * ty -
                            r * static_cast<double>(ball.angular_velocity) - surface_speed(f);
        impact.tangent = std::clamp(-slip / k, -mu * impact.normal, mu * impact.normal);
        apply(f, other, target, impact, impact.tangent * tx, impact.tangent * ty);
        state_of(f).angular_velocity -= static_cast<float>(r * inertia * impact.tangent);
    }

    [[nodiscard]] double friction_of(const Flier& f) const
    {
        return f.event_contact != none ? m_state.contacts[f.event_contact].friction
                                       : mixed_friction(m_ctx.scene, f.shape, f.event_shape);
    }
    [[nodiscard]] double surface_speed(const Flier& f) const
    {
        return static_cast<double>(m_state.shapes[f.shape].surface_speed) + m_state.shapes[f.event_shape].surface_speed;
    }

    // Velocity of the target's center now: after the normal impulse it has changed.
    [[nodiscard]] Vec2 target_velocity(const Target& target, const Flier* other) const
    {
        if (other != nullptr)
            return {static_cast<float>(other->vx), static_cast<float>(other->vy)};
        if (target.state == none)
            return {static_cast<float>(target.path.center.vx), static_cast<float>(target.path.center.vy)};
        return m_scratch.states[static_cast<std::size_t>(target.state)].velocity;
    }

    [[nodiscard]] double target_spin(const Target& target) const
    {
        return target.state == none
                   ? target.path.w
                   : static_cast<double>(m_scratch.states[static_cast<std::size_t>(target.state)].angular_velocity);
    }

    // The impulse (px, py) on the ball at the point of contact, its opposite on the target there.
    void apply(Flier& f, Flier* other, const Target& target, const Impact& impact, double px, double py)
    {
        const double inverse_mass = sim_of(f.body).inverse_mass.x;
        f.vx += inverse_mass * px;
        f.vy += inverse_mass * py;
        if (target.inverse_mass_x == 0 && target.inverse_mass_y == 0 && target.inverse_inertia == 0)
            return;
        const auto spin = static_cast<float>(-target.inverse_inertia * (impact.arm_x * py - impact.arm_y * px));
        if (target.state == none)
        {
            m_output.deferred.push_back({target.body,
                                         {static_cast<float>(-px), static_cast<float>(-py)},
                                         {static_cast<float>(impact.arm_x), static_cast<float>(impact.arm_y)}});
            return;
        }
        BodyState& s = m_scratch.states[static_cast<std::size_t>(target.state)];
        s.angular_velocity += spin;
        if (other != nullptr)
        {
            other->vx -= target.inverse_mass_x * px;
            other->vy -= target.inverse_mass_y * py;
            return;
        }
        // The solver moved it to the end of the sub-step already: correct velocity and the rest of the way.
        const auto left = static_cast<float>(static_cast<double>(m_h) - f.time);
        const Vec2 change = {static_cast<float>(-target.inverse_mass_x * px), static_cast<float>(-target.inverse_mass_y * py)};
        s.velocity += change;
        s.delta_position += left * change;
        s.delta_rotation = s.delta_rotation * Rotation::from_angle(left * spin);
    }

    [[nodiscard]] double energy(const Flier& f, const BodyState& ball, const Target& target, const Flier* other) const
    {
        const auto part = [](double inverse, double v) { return inverse > 0 ? 0.5 * v * v / inverse : 0; };
        const BodySim& sim = sim_of(f.body);
        const Vec2 tv = target_velocity(target, other);
        return part(sim.inverse_mass.x, f.vx) + part(sim.inverse_mass.y, f.vy) +
               part(sim.inverse_inertia, ball.angular_velocity) + part(target.inverse_mass_x, tv.x) +
               part(target.inverse_mass_y, tv.y) + part(target.inverse_inertia, target_spin(target));
    }

    // --- reporting ------------------------------------------------------------------------------------------------------------------

    // Slower than what presses the ball on gives in a sub-step is settling; shallower than half a degree along a chain is rolling.
    [[nodiscard]] bool is_worth_telling(const Flier& f, const Impact& impact) const
    {
        const bool along_chain = m_state.shapes[f.event_shape].owner != f.event_shape;
        const double shallow = along_chain ? 0.01 * std::fabs(impact.slide) : 0;
        return impact.u > std::max({static_cast<double>(m_ctx.scene.tolerances.rest_speed),
                                    impact.pressing * static_cast<double>(m_h), shallow});
    }

    void report(const Flier& f, const Impact& impact)
    {
        const bool ball_is_a = f.event_contact != none ? m_state.contacts[f.event_contact].shape_a == f.shape : true;
        const Vec2 to_ball = {static_cast<float>(f.nx), static_cast<float>(f.ny)};
        const auto r = static_cast<float>(radius_of(f));
        const Position center = sim_of(f.body).center;
        ImpactEvent e;
        e.point = Position{center.x + f.x, center.y + f.y} - r * to_ball;
        e.normal = ball_is_a ? -to_ball : to_ball;
        e.time = static_cast<float>(time_of_step(f.time));
        e.approach_speed = static_cast<float>(impact.u);
        e.impulse = static_cast<float>(impact.normal);
        e.friction_impulse = static_cast<float>(impact.tangent);
        e.energy_lost = static_cast<float>(impact.energy_lost);
        e.restitution = static_cast<float>(impact.e);
        e.kick_speed = static_cast<float>(impact.kick);
        const double sign = ball_is_a ? -1 : 1;
        const auto speed_target = static_cast<float>(sign * impact.speed_target);
        const auto speed_ball = static_cast<float>(sign * (impact.speed_target - impact.u));
        const double inverse_ball = sim_of(f.body).inverse_mass.x;
        const double inverse_target = impact.k - inverse_ball;
        const auto mass_ball = static_cast<float>(1 / inverse_ball);
        const float mass_target = inverse_target > 0 ? static_cast<float>(1 / inverse_target) : 0;
        e.speed_a = ball_is_a ? speed_ball : speed_target;
        e.speed_b = ball_is_a ? speed_target : speed_ball;
        e.effective_mass_a = ball_is_a ? mass_ball : mass_target;
        e.effective_mass_b = ball_is_a ? mass_target : mass_ball;
        const std::int32_t shape_a = ball_is_a ? f.shape : f.event_shape;
        const std::int32_t shape_b = ball_is_a ? f.event_shape : f.shape;
        if (is_worth_telling(f, impact))
        {
            m_output.impacts.push_back({shape_a, shape_b, e});
            ++m_output.flight_impacts;
        }
        const bool touching = f.event_contact != none && (m_state.contacts[f.event_contact].flags & contact_flag::touching) != 0;
        if (touching)
            return;
        m_output.begins.push_back({f.event_contact, shape_a, shape_b, e.point, e.normal, e.time});
        if (f.event_contact != none)
            m_state.contacts[f.event_contact].flags |= contact_flag::touching;
    }

    // --- the end of the sub-step ----------------------------------------------------------------------------------------------------

    void finish(Flier& f)
    {
        if (f.landed)
            return;
        if (f.impacts < impact_limit)
            f.held_count == 1 && f.hold_curvature != 0 ? slide_around(f, m_h) : advance(f, m_h);
        BodyState& s = state_of(f);
        s.velocity = {static_cast<float>(f.vx), static_cast<float>(f.vy)};
        s.delta_position = {static_cast<float>(f.x), static_cast<float>(f.y)};
        s.delta_rotation = Rotation::from_angle(m_h * s.angular_velocity) * s.delta_rotation;
        if (f.held_count > 0)
            land(f);
    }

    // Held by a curved surface: around its center of curvature, at the speed that the tangential acceleration gives.
    static void slide_around(Flier& f, double time)
    {
        const double t = time - f.time;
        const double radius = 1 / f.hold_curvature; // negative on the hollow side: the center lies ahead along n
        const double tx = -f.ny;
        const double ty = f.nx;
        const double speed = f.vx * tx + f.vy * ty;
        const double pull = f.ax * tx + f.ay * ty;
        const SinCos turn = sin_cos((speed * t + 0.5 * pull * t * t) / radius);
        const double nx = turn.cos * f.nx - turn.sin * f.ny;
        const double ny = turn.sin * f.nx + turn.cos * f.ny;
        f.x += radius * (nx - f.nx);
        f.y += radius * (ny - f.ny);
        f.vx = -(speed + pull * t) * ny;
        f.vy = (speed + pull * t) * nx;
        f.time = time;
    }

    // From now on the solver has the ball: rows for everything near it.
    void land(Flier& f)
    {
        f.landed = true;
        BodyState& s = state_of(f);
        s.flags &= ~(body_flag::flier | body_flag::unbound);
        const float margin = m_ctx.scene.tolerances.speculation + length(s.velocity) * m_ctx.dt;
        for (int edge = m_state.bodies[f.body].first_contact; edge != none; edge = m_state.contacts[edge >> 1].next[edge & 1])
        {
            const int index = edge >> 1;
            const Contact& contact = m_state.contacts[index];
            if ((contact.flags & (contact_flag::trigger | contact_flag::passing)) == 0)
                add_late_row(f, index, margin);
        }
    }

    void add_late_row(const Flier& f, int index, float margin)
    {
        const Contact& contact = m_state.contacts[index];
        const int body = other_body(contact, f.body);
        const std::int32_t other = m_state.bodies[body].awake_index == none
                                       ? m_unit.first_state
                                       : m_scratch.state_of[static_cast<std::size_t>(m_state.bodies[body].awake_index)];
        if (other < m_unit.first_state || other >= m_unit.first_state + m_unit.state_count || flier_at(other) != nullptr)
            return; // another unit's, or still in flight: the next step links them
        const Manifold manifold =
            world_manifold(m_state, contact, pose_now(contact.body_a, f, other), pose_now(contact.body_b, f, other), margin);
        if (manifold.count == 0)
            return;
        const bool ball_is_a = contact.body_a == f.body;
        ContactRow row = prepare_row(m_ctx, index, manifold, ball_is_a ? f.state : other, ball_is_a ? other : f.state);
        row.refreshed = m_unit.precise;
        m_scratch.states[static_cast<std::size_t>(other)].flags &= ~body_flag::unbound;
        m_output.late_rows.push_back(row);
    }

    [[nodiscard]] BodyPose pose_now(int body, const Flier& f, std::int32_t other)
    {
        const BodySim& sim = sim_of(body);
        const BodyState& s = m_scratch.states[static_cast<std::size_t>(body == f.body ? f.state : other)];
        return {sim.center + s.delta_position, s.delta_rotation * sim.rotation, sim.local_center};
    }

    StepContext& m_ctx;
    SceneState& m_state;
    Scratch& m_scratch;
    const Unit& m_unit;
    int m_k;
    float m_h;
    double m_tiny; ///< approach that is rounding, m/s
    UnitOutput& m_output;
};

} // namespace

void advance_fliers(StepContext& ctx, const Unit& unit, int k, UnitOutput& output)
{
    if (unit.flier_count > 0)
        Flight(ctx, unit, k, output).run();
}

} // namespace carom::internal
