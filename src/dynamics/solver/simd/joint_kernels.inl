// The passes over hinges, eight side by side; joint_solver.cpp has the same for one joint at a time. Part of kernels.inl.
//
//   C = gap,  dC = vb + wb x rb - va - wa x ra            two rows solved as one: K = J M^-1 J^T is 2 x 2
//   angle = angle at the start + rotation of b against a  a spring, a motor, and limits on either side, solved as one: joint_axis.cpp

namespace joints {

// Empty lanes read the first; an anchor in the world has the second as its body.
constexpr JointRecord nothing{};
constexpr BodySim world{};

// Anchors of eight bodies relative to their centers of mass, in the axes of the bodies.
CAROM_INLINE void place_anchors(const BodySim* const (&sims)[lane_count], F8 x, F8 y, LaneFloats& local_x, LaneFloats& local_y)
{
    static_assert(offsetof(BodySim, rotation) == 16 && offsetof(BodySim, local_center) == 24);
    F8 unused_c, unused_s, center_x, center_y;
    gather4([&](int i) { return reinterpret_cast<const char*>(sims[i]) + 16; }, unused_c, unused_s, center_x, center_y);
    store(local_x, x - center_x);
    store(local_y, y - center_y);
}

CAROM_INLINE void turn(const Turn& q, const LaneFloats& x, const LaneFloats& y, LaneFloats& arm_x, LaneFloats& arm_y)
{
    store(arm_x, q.c * load(x) - q.s * load(y));
    store(arm_y, q.s * load(x) + q.c * load(y));
}

// Sets arms and gaps at the poses where the step begins.
CAROM_INLINE void start(WideJoint& j, const BodySim* const (&a)[lane_count], const BodySim* const (&b)[lane_count])
{
    WideArms& arms = j.start;
    turn(turns_of(a), j.anchors.ax, j.anchors.ay, arms.ax, arms.ay);
    turn(turns_of(b), j.anchors.bx, j.anchors.by, arms.bx, arms.by);
    const auto gap = [&](int i)
    { // in double: both anchors may be far out
        const D2 from = load2(&a[i]->center.x) + two_of(static_cast<double>(arms.ax.v[i]), static_cast<double>(arms.ay.v[i]));
        const D2 to = load2(&b[i]->center.x) + two_of(static_cast<double>(arms.bx.v[i]), static_cast<double>(arms.by.v[i]));
        return to - from;
    };
    F8 gap_x;
    F8 gap_y;
    round_pairs(gap, gap_x, gap_y);
    store(arms.gap_x, gap_x);
    store(arms.gap_y, gap_y);
    j.now = arms;
    store(j.sum_x, all(0));
    store(j.sum_y, all(0));
}

CAROM_INLINE const BodySim* sim_of(const BodySim* sims, std::int32_t body) { return body < 0 ? &world : sims + body; }

CAROM_INLINE Turn operator*(const Turn& a, const Turn& b) { return {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s}; }

// To the nearest whole number, for magnitudes below four million.
CAROM_INLINE F8 rounded(F8 x)
{
    const F8 large = all(12582912.0f);
    return (x + large) - large;
}

// As hinge_angle of turns.cpp; `turns` are the whole turns of each body.
CAROM_INLINE F8 hinge_angles(const JointRecord* const (&joints)[lane_count], const Turn& a, const Turn& b, const std::int32_t* turns)
{
    Rotation references[lane_count];
    for (int i = 0; i < lane_count; ++i)
    {
        const float angle = joints[i]->reference_angle;
        references[i] = angle != 0 ? Rotation::from_angle(-angle) : Rotation{};
    }
    const Turn reference = {lanes_from([&](int i) { return references[i].c; }), lanes_from([&](int i) { return references[i].s; })};
    const Turn relative = b * Turn{a.c, -a.s} * reference;
    const F8 angle = arc_tangent(relative.s, relative.c);
    const auto turns_of = [&](std::int32_t body) { return body < 0 ? 0 : turns[body]; };
    const F8 whole = lanes_from(
        [&](int i) { return static_cast<float>(turns_of(joints[i]->body_b) - turns_of(joints[i]->body_a) - joints[i]->turns); });
    const F8 part = arc_tangent(b.s, b.c) - arc_tangent(a.s, a.c) - lanes_from([&](int i) { return joints[i]->reference_angle; }) - angle;
    return angle + all(2 * pi) * (whole + rounded(part * all(0.5f / pi)));
}

// The inverse inertia of bodies about their hinges: 1 / (I + m r²).
CAROM_INLINE F8 inverse_inertia_about(F8 inverse_mass, F8 inverse_inertia, F8 x, F8 y)
{
    const F8 r2 = x * x + y * y;
    return select(r2 > all(0), inverse_inertia / (1 + r2 * inverse_inertia / inverse_mass), inverse_inertia);
}

// Fills what drives and limits the angle.
CAROM_INLINE void fill_drive(WideJoint& j, const JointRecord* const (&joints)[lane_count], float h)
{
    WideAngle& t = j.angle;
    static_assert(offsetof(JointRecord, max_motor) == offsetof(JointRecord, lower) + 12 &&
                  offsetof(JointRecord, spring_target) == offsetof(JointRecord, motor_speed) + 12 && slot_spring == slot_lower + 3);
    constexpr float no_limit = 1e9f; // rad
    const F8 none = all(0);
    F8 lower, upper, speed, most, ratio, target;
    gather4([&](int i) { return reinterpret_cast<const char*>(&joints[i]->lower); }, lower, upper, speed, most);
    gather4([&](int i) { return reinterpret_cast<const char*>(&joints[i]->motor_speed); }, speed, most, ratio, target);
    F8 lower_impulse, upper_impulse, motor_impulse, spring_impulse;
    gather4([&](int i) { return reinterpret_cast<const char*>(joints[i]->impulses + slot_lower); }, lower_impulse, upper_impulse,
            motor_impulse, spring_impulse);
    const I8 limited = lanes_from([&](int i) { return joints[i]->enable_limit ? -1 : 0; });
    store(t.lower, select(limited, lower, all(-no_limit)));
    store(t.upper, select(limited, upper, all(no_limit)));
    store(t.lower_impulse, select(limited, lower_impulse, none));
    store(t.upper_impulse, select(limited, upper_impulse, none));
    const I8 driven = lanes_from([&](int i) { return joints[i]->enable_motor ? -1 : 0; });
    store(t.motor_speed, select(driven, speed, none));
    store(t.motor_max, select(driven, h * most, none));
    store(t.motor_impulse, select(driven, motor_impulse, none));
    // As make_spring with soft_spring_turn.
    const F8 k = inverse_inertia_about(load(j.inverse_mass_a), load(j.inverse_inertia_a), load(j.anchors.ax), load(j.anchors.ay)) +
                 inverse_inertia_about(load(j.inverse_mass_b), load(j.inverse_inertia_b), load(j.anchors.bx), load(j.anchors.by));
    const F8 hertz = lanes_from([&](int i) { return joints[i]->hertz; });
    const I8 sprung = (hertz > none) & (k > none);
    const F8 turn = h * (2 * pi) * hertz;
    const F8 stiffness = least(turn * turn, all(soft_spring_turn * soft_spring_turn)); // h² k / J
    const F8 drag = stiffness + least(2 * ratio * turn, all(soft_spring_turn));         // and h c / J
    store(t.target, select(sprung, target, none));
    store(t.spring_rate, select(sprung, -stiffness / (h * drag), none));
    store(t.spring_conductance, select(sprung, drag / k, none));
    store(t.spring_impulse, select(sprung, spring_impulse, none));
    store(t.torque_sum, none);
}

// Fills all but a, b, joint and turns, which select the source.
void fill(WideJoint& j, const JointRecord* joints, const BodySim* sims, const std::int32_t* turns, const StateConstants* constants, float h)
{
    static_assert(offsetof(JointRecord, anchor_b) == offsetof(JointRecord, anchor_a) + 8 && slot_held == 0);
    const JointRecord* of_lane[lane_count];
    const BodySim* a[lane_count];
    const BodySim* b[lane_count];
    for (int i = 0; i < lane_count; ++i)
    {
        of_lane[i] = j.joint.v[i] < 0 ? &nothing : joints + j.joint.v[i];
        j.anchors.body_a.v[i] = of_lane[i]->body_a;
        j.anchors.body_b.v[i] = of_lane[i]->body_b;
        a[i] = sim_of(sims, of_lane[i]->body_a);
        b[i] = sim_of(sims, of_lane[i]->body_b);
    }
    F8 ax, ay, bx, by, impulse_x, impulse_y, unused_x, unused_y;
    gather4([&](int i) { return reinterpret_cast<const char*>(&of_lane[i]->anchor_a); }, ax, ay, bx, by);
    gather4([&](int i) { return reinterpret_cast<const char*>(of_lane[i]->impulses); }, impulse_x, impulse_y, unused_x, unused_y);
    store(j.impulse_x, impulse_x);
    store(j.impulse_y, impulse_y);
    place_anchors(a, ax, ay, j.anchors.ax, j.anchors.ay);
    place_anchors(b, bx, by, j.anchors.bx, j.anchors.by);
    start(j, a, b);
    if (j.turns != 0)
    {
        const F8 angles = hinge_angles(of_lane, turns_of(a), turns_of(b), turns);
        store(j.angle.start, angles);
        store(j.angle.now, angles);
    }
    fill_masses(j, constants);
    if (j.turns != 0)
        fill_drive(j, of_lane, h);
    j.fixed_a = bits(are_fixed(load(j.inverse_mass_a), load(j.inverse_inertia_a)));
    j.fixed_b = bits(are_fixed(load(j.inverse_mass_b), load(j.inverse_inertia_b)));
}

void follow(WideJoint& j, const BodySim* sims)
{
    const BodySim* a[lane_count];
    const BodySim* b[lane_count];
    for (int i = 0; i < lane_count; ++i)
    {
        a[i] = sim_of(sims, j.anchors.body_a.v[i]);
        b[i] = sim_of(sims, j.anchors.body_b.v[i]);
    }
    start(j, a, b);
}

// A hinge uses no other slots than these.
void take_impulses(const WideJoint& j, JointRecord* joints, float dt)
{
    static_assert(offsetof(JointRecord, impulses) == offsetof(JointRecord, force) + 8 && slot_held == 0);
    static_assert(slot_upper == slot_lower + 1 && slot_motor == slot_lower + 2 && slot_spring == slot_lower + 3);
    JointRecord unused;
    const auto record = [&](int i) { return j.joint.v[i] < 0 ? &unused : joints + j.joint.v[i]; };
    const WideAngle& t = j.angle;
    const auto of_angle = [&](const LaneFloats& impulse) { return j.turns != 0 ? load(impulse) : all(0); };
    scatter4([&](int i) { return reinterpret_cast<char*>(&record(i)->force); }, load(j.sum_x) / dt, load(j.sum_y) / dt, load(j.impulse_x),
             load(j.impulse_y));
    scatter4([&](int i) { return reinterpret_cast<char*>(record(i)->impulses + slot_lower); }, of_angle(t.lower_impulse),
             of_angle(t.upper_impulse), of_angle(t.motor_impulse), of_angle(t.spring_impulse));
    LaneFloats torque;
    store(torque, of_angle(t.torque_sum) / dt);
    for (int i = 0; i < lane_count; ++i)
        record(i)->torque = torque.v[i];
}

struct Hinge
{
    F8 mass_a, mass_b, inertia_a, inertia_b;
    Speeds<F8> a, b;
    F8 ax, ay, bx, by; ///< present arms

    CAROM_INLINE Hinge(const WideJoint& j, const BodyState* states)
    {
        mass_a = load(j.inverse_mass_a);
        mass_b = load(j.inverse_mass_b);
        inertia_a = load(j.inverse_inertia_a);
        inertia_b = load(j.inverse_inertia_b);
        a = speeds_of(states, j.a);
        b = speeds_of(states, j.b);
        ax = load(j.now.ax);
        ay = load(j.now.ay);
        bx = load(j.now.bx);
        by = load(j.now.by);
    }

    CAROM_INLINE void push(F8 x, F8 y)
    {
        a.x -= mass_a * x;
        a.y -= mass_a * y;
        a.w -= inertia_a * (ax * y - ay * x);
        b.x += mass_b * x;
        b.y += mass_b * y;
        b.w += inertia_b * (bx * y - by * x);
    }

    CAROM_INLINE void twist(F8 impulse)
    {
        a.w -= inertia_a * impulse;
        b.w += inertia_b * impulse;
    }

    CAROM_INLINE void finish(const WideJoint& j, BodyState* states) const
    {
        put(states, j.a, a, j.fixed_a);
        put(states, j.b, b, j.fixed_b);
    }
};

// The angle of (c, s) from its quarter, whose arc tangent has a short series: exact to a float's rounding up to a quarter turn in a step.
CAROM_INLINE F8 angle_of(F8 c, F8 s)
{
    const F8 half = s / greatest(1 + c, all(1e-6f));
    const F8 u = half / (1 + root(1 + half * half));
    const F8 z = u * u;
    const F8 series = 1 - z * (1.0f / 3 - z * (1.0f / 5 - z * (1.0f / 7 - z * (1.0f / 9 - z * (1.0f / 11)))));
    return 4 * (u * series);
}

// Updates arms, gaps and angles to the new poses.
CAROM_INLINE void place(WideJoint& j, const BodyState* states)
{
    const Poses<F8> a = poses_of(states, j.a);
    const Poses<F8> b = poses_of(states, j.b);
    const F8 ax0 = load(j.start.ax);
    const F8 ay0 = load(j.start.ay);
    const F8 bx0 = load(j.start.bx);
    const F8 by0 = load(j.start.by);
    const F8 ax = a.c * ax0 - a.s * ay0;
    const F8 ay = a.s * ax0 + a.c * ay0;
    const F8 bx = b.c * bx0 - b.s * by0;
    const F8 by = b.s * bx0 + b.c * by0;
    store(j.now.ax, ax);
    store(j.now.ay, ay);
    store(j.now.bx, bx);
    store(j.now.by, by);
    store(j.now.gap_x, load(j.start.gap_x) + (b.x - a.x) + (bx - bx0) - (ax - ax0));
    store(j.now.gap_y, load(j.start.gap_y) + (b.y - a.y) + (by - by0) - (ay - ay0));
    if (j.turns != 0)
    {
        const F8 turned = angle_of(b.c * a.c + b.s * a.s, b.s * a.c - b.c * a.s);
        const F8 beside = angle_of(b.c, b.s) - angle_of(a.c, a.s) - turned;
        const F8 turns = lanes_from([&](int i) { return static_cast<float>(states[j.b.v[i]].turns - states[j.a.v[i]].turns); });
        store(j.angle.now, load(j.angle.start) + turned + all(2 * pi) * (turns + rounded(beside * all(0.5f / pi))));
    }
}

// Holds the anchors together.
CAROM_INLINE void hold(Hinge& h, WideJoint& j, F8 bias_rate, F8 mass_scale, F8 impulse_scale)
{
    const F8 mass = h.mass_a + h.mass_b;
    const F8 k11 = mass + h.inertia_a * h.ay * h.ay + h.inertia_b * h.by * h.by;
    const F8 k12 = -(h.inertia_a * h.ax * h.ay + h.inertia_b * h.bx * h.by);
    const F8 k22 = mass + h.inertia_a * h.ax * h.ax + h.inertia_b * h.bx * h.bx;
    const F8 det = k11 * k22 - k12 * k12;
    const F8 inverse_det = select(det > all(0), all(1) / det, all(0)); // empty lanes have no inverse mass
    const F8 cx = (h.b.x - h.b.w * h.by) - (h.a.x - h.a.w * h.ay) + bias_rate * load(j.now.gap_x);
    const F8 cy = (h.b.y + h.b.w * h.bx) - (h.a.y + h.a.w * h.ax) + bias_rate * load(j.now.gap_y);
    const F8 old_x = load(j.impulse_x);
    const F8 old_y = load(j.impulse_y);
    const F8 x = -mass_scale * (inverse_det * (k22 * cx - k12 * cy)) - impulse_scale * old_x;
    const F8 y = -mass_scale * (inverse_det * (k11 * cy - k12 * cx)) - impulse_scale * old_y;
    store(j.impulse_x, old_x + x);
    store(j.impulse_y, old_y + y);
    h.push(x, y);
}

// The effective mass of the angle while the anchors are held: the angle is solved after them, and then both are satisfied.
struct AngleMass
{
    F8 k;      ///< inverse effective mass
    F8 fx, fy; ///< reaction of the anchors to a twist of 1

    CAROM_INLINE AngleMass(const Hinge& h, float held)
    {
        const F8 mass = h.mass_a + h.mass_b;
        const F8 k11 = mass + h.inertia_a * h.ay * h.ay + h.inertia_b * h.by * h.by;
        const F8 k12 = -(h.inertia_a * h.ax * h.ay + h.inertia_b * h.bx * h.by);
        const F8 k22 = mass + h.inertia_a * h.ax * h.ax + h.inertia_b * h.bx * h.bx;
        const F8 det = k11 * k22 - k12 * k12;
        const F8 inverse_det = select(det > all(0), all(1) / det, all(0));
        const F8 cx = -(h.inertia_a * h.ay + h.inertia_b * h.by);
        const F8 cy = h.inertia_a * h.ax + h.inertia_b * h.bx;
        fx = held * inverse_det * (k12 * cy - k22 * cx);
        fy = held * inverse_det * (k12 * cx - k11 * cy);
        k = greatest(h.inertia_a + h.inertia_b + fx * cx + fy * cy, all(0));
    }
};

// A share of the error beyond a stop is corrected in each sub-step; while relaxing, a stop that bears a load counts as reached. As in joint_axis.cpp.
CAROM_INLINE F8 stop_rate(F8 error, const LaneFloats& borne, const JointSoftness& s, bool use_bias)
{
    constexpr float way_back = 0.2f;
    const F8 apart = select(load(borne) > all(0), all(0), greatest(error, all(0)));
    return -s.inverse_h * (use_bias ? select(error > all(0), error, way_back * error) : apart);
}

// Solves spring, motor and limits as one: AxisLaw in joint_axis.cpp.
CAROM_INLINE void hold_angle(Hinge& h, WideJoint& j, const JointSoftness& s, bool use_bias)
{
    WideAngle& t = j.angle;
    const F8 none = all(0);
    const AngleMass mass(h, use_bias ? s.soft.mass_scale : 1);
    const I8 moves = mass.k > none;
    const F8 angle = load(t.now);
    const F8 most = load(t.motor_max);
    const F8 target = load(t.motor_speed);
    const F8 spring_before = load(t.spring_impulse);
    const F8 driven_before = load(t.motor_impulse) + load(t.lower_impulse) - load(t.upper_impulse);
    const F8 before = use_bias ? driven_before + spring_before : driven_before;
    const F8 free_rate = h.b.w - h.a.w - mass.k * before;
    const F8 conductance = use_bias ? load(t.spring_conductance) : none;
    const F8 rest = load(t.spring_rate) * (angle - load(t.target));
    const F8 sprung = (free_rate + mass.k * conductance * rest) / (1 + mass.k * conductance);
    const F8 reach = most * mass.k / (1 + mass.k * conductance);
    const F8 driven = clamp(target, sprung - reach, sprung + reach);
    const F8 low = stop_rate(angle - load(t.lower), t.lower_impulse, s, use_bias);
    const F8 high = -stop_rate(load(t.upper) - angle, t.upper_impulse, s, use_bias);
    const F8 rate = greatest(least(driven, high), low);
    const F8 after = select(moves, (rate - free_rate) / mass.k, before);
    const F8 spring = use_bias ? conductance * (rest - rate) : spring_before;
    const F8 of_others = use_bias ? after - spring : after;
    const F8 wanted = target - rate;
    const F8 some = clamp(of_others, -most, most);
    const I8 stopped = (rate <= low) | (rate >= high);
    const F8 motor = select(stopped, select(wanted > none, most, select(wanted < none, -most, some)), some);
    store(t.spring_impulse, select(moves, spring, spring_before));
    store(t.motor_impulse, select(moves, motor, load(t.motor_impulse)));
    store(t.lower_impulse, select(moves & (rate <= low), greatest(of_others - motor, none), select(moves, none, load(t.lower_impulse))));
    store(t.upper_impulse, select(moves & (rate >= high), greatest(motor - of_others, none), select(moves, none, load(t.upper_impulse))));
    const F8 change = after - before;
    h.twist(change);
    h.push(change * mass.fx, change * mass.fy);
    store(j.impulse_x, load(j.impulse_x) + change * mass.fx);
    store(j.impulse_y, load(j.impulse_y) + change * mass.fy);
}

void warm_start(WideJoint* joints, std::int32_t count, BodyState* states)
{
    for (WideJoint* j = joints; j < joints + count; ++j)
    {
        Hinge h(*j, states);
        const WideAngle& t = j->angle;
        if (j->turns != 0)
            h.twist(load(t.spring_impulse) + load(t.motor_impulse) + load(t.lower_impulse) - load(t.upper_impulse));
        h.push(load(j->impulse_x), load(j->impulse_y));
        h.finish(*j, states);
    }
}

void solve(WideJoint* joints, std::int32_t count, BodyState* states, const JointSoftness& s)
{
    for (WideJoint* j = joints; j < joints + count; ++j)
    {
        Hinge h(*j, states);
        hold(h, *j, all(s.soft.bias_rate), all(s.soft.mass_scale), all(s.soft.impulse_scale));
        if (j->turns != 0)
            hold_angle(h, *j, s, true);
        h.finish(*j, states);
    }
}

void relax(WideJoint* joints, std::int32_t count, BodyState* states, const JointSoftness& s)
{
    for (WideJoint* j = joints; j < joints + count; ++j)
    {
        place(*j, states);
        Hinge h(*j, states);
        WideAngle& t = j->angle;
        hold(h, *j, all(0), all(1), all(0));
        if (j->turns != 0)
        {
            hold_angle(h, *j, s, false);
            store(t.torque_sum, load(t.torque_sum) + s.share * (load(t.spring_impulse) + load(t.motor_impulse) + load(t.lower_impulse) -
                                                      load(t.upper_impulse)));
        }
        store(j->sum_x, load(j->sum_x) + s.share * load(j->impulse_x));
        store(j->sum_y, load(j->sum_y) + s.share * load(j->impulse_y));
        h.finish(*j, states);
    }
}

} // namespace joints
