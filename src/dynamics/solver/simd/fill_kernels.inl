// Fills constraints from their contacts and impulses, and computes effective masses; refill_lane does the same for one lane. Part of kernels.inl.

namespace fills {

// Empty lanes read these: no impulse comes of them.
constexpr Contact nobody{};
constexpr ContactImpulses nothing{};

// Lanes whose flags include that flag.
CAROM_INLINE unsigned lanes_with(I8 flags, std::uint32_t flag) { return bits((flags & all_ints(flag)) != I8{}); }

// Fills a point from the contacts' k-th points.
CAROM_INLINE void fill_point(WidePoint& p, const Contact* const (&contacts)[lane_count], int k, F8 nx, F8 ny)
{
    static_assert(offsetof(ManifoldPoint, anchor_b) == offsetof(ManifoldPoint, anchor_a) + 8);
    const auto point = [&](int i) -> const ManifoldPoint& { return contacts[i]->manifold.points[k]; };
    F8 ax, ay, bx, by;
    gather4([&](int i) { return reinterpret_cast<const char*>(&point(i).anchor_a); }, ax, ay, bx, by);
    store(p.across_a, ax * ny - ay * nx);
    store(p.along_a, ax * nx + ay * ny);
    store(p.across_b, bx * ny - by * nx);
    store(p.along_b, bx * nx + by * ny);
    store(p.base, lanes_from([&](int i) { return point(i).separation; }));
    store(p.total_impulse, all(0));
    store(p.total_tangent, all(0));
}

CAROM_INLINE void fill_impulses(WideContact& constraint, const WideContactNotes& notes, const ContactImpulses* impulses)
{
    for (int k = 0; k < notes.count; ++k)
    {
        F8 normal, tangent, total_normal, total_tangent;
        const auto at = [&](int i)
        { return reinterpret_cast<const char*>((notes.contact.v[i] < 0 ? nothing : impulses[notes.contact.v[i]]).points + k); };
        gather4(at, normal, tangent, total_normal, total_tangent);
        store(constraint.points[k].normal_impulse, normal);
        store(constraint.points[k].tangent_impulse, tangent);
    }
}

// Finds the points that may be struck, and those that are halfway through a blow: they bear a load farther apart than `far`.
CAROM_INLINE void note_unloaded(const WideContact& constraint, WideContactNotes& notes, float far)
{
    notes.may_hit = 0;
    notes.paused = notes.halfway = 0;
    for (int k = 0; k < notes.count; ++k)
    {
        const I8 unloaded = load(constraint.points[k].normal_impulse) <= all(0);
        const std::uint32_t halfway = bits(~unloaded & (load(constraint.points[k].separation) > all(far)));
        notes.may_hit |= (bits(unloaded) | halfway) << k * lane_count;
        notes.halfway = static_cast<std::uint16_t>(notes.halfway | halfway << k * lane_count);
    }
}

// Half of what bodies turn by within the step; as half_turn in turns.h.
CAROM_INLINE Turn half_turns(F8 angular_velocity, float dt)
{
    const F8 t = clamp((0.25f * dt) * angular_velocity, all(-most_tangent), all(most_tangent));
    const F8 part = 1 / (1 + t * t);
    return {(1 - t * t) * part, 2 * t * part + all(0)}; // no -0
}

// n · (R r - r) of a body that turns back by q
CAROM_INLINE F8 turned_back(const Turn& q, const LaneFloats& along, const LaneFloats& across)
{
    return (q.c - 1) * load(along) - q.s * load(across);
}

// The points of a circle about the center of mass do not turn with it.
CAROM_INLINE void turn_arm(const Turn& q, LaneFloats& along, LaneFloats& across)
{
    const F8 n = load(along);
    const F8 t = load(across);
    const I8 turns = t * t > (round_arm * round_arm) * (n * n);
    store(along, select(turns, q.c * n + q.s * t, n));
    store(across, select(turns, q.c * t - q.s * n, t));
}

// Turns arms of the step's start to its middle, where bodies have turned by a and b.
CAROM_INLINE void turn_arms(WideContact& constraint, const WideContactNotes& notes, const Turn& a, const Turn& b)
{
    for (int k = 0; k < notes.count; ++k)
    {
        WidePoint& p = constraint.points[k];
        turn_arm(a, p.along_a, p.across_a);
        turn_arm(b, p.along_b, p.across_b);
        const F8 separation = load(p.base);
        store(p.separation, separation);
        store(p.base, separation + (turned_back(a, p.along_a, p.across_a) - turned_back(b, p.along_b, p.across_b)));
    }
}

CAROM_INLINE void weigh(WideContact& constraint, std::int32_t points)
{
    const F8 mass = load(constraint.inverse_mass_a) + load(constraint.inverse_mass_b);
    const F8 ia = load(constraint.inverse_inertia_a);
    const F8 ib = load(constraint.inverse_inertia_b);
    for (int i = 0; i < points; ++i)
    {
        WidePoint& p = constraint.points[i];
        const F8 ta = load(p.along_a);
        const F8 tb = load(p.along_b);
        const F8 tangent_k = mass + ta * ta * ia + tb * tb * ib;
        store(p.tangent_mass, select(tangent_k > all(0), all(1) / tangent_k, all(0)));
    }
    if (points < 2)
        return;
    const auto k = [&](int i, int j)
    {
        const WidePoint& p = constraint.points[i];
        const WidePoint& q = constraint.points[j];
        return mass + load(p.across_a) * load(q.across_a) * ia + load(p.across_b) * load(q.across_b) * ib;
    };
    // Points that nearly coincide share their load anyway; solving for both would only divide noise.
    const F8 limit = 0.9995f * root(k(0, 0) * k(1, 1));
    store(constraint.coupling, clamp(k(0, 1), -limit, limit));
}

void prepare(WideContact& constraint, WideContactNotes& notes, const BodySim* sims, float dt, float far)
{
    const auto turns = [&](const LaneInts& bodies)
    { return half_turns(lanes_from([&](int i) { return notes.contact.v[i] < 0 ? 0 : sims[bodies.v[i]].angular_velocity; }), dt); };
    turn_arms(constraint, notes, turns(notes.body_a), turns(notes.body_b));
    weigh(constraint, notes.count);
    note_unloaded(constraint, notes, far);
}

// The half turns by which states have been turned back.
CAROM_INLINE Turn half_turns_of(const BodyState* states, const LaneInts& index)
{
    static_assert(offsetof(BodyState, delta_rotation) == offsetof(BodyState, delta_position) + 8);
    F8 x, y, c, s;
    gather4([&](int i) { return reinterpret_cast<const char*>(&states[index.v[i]].delta_position); }, x, y, c, s);
    return {c, 0 - s};
}

// Fills all but a, b, contact and count, which select the source.
void fill(WideContact& constraint, WideContactNotes& notes, const Contact* contacts, const ContactImpulses* impulses, const BodyState* states,
          const StateConstants* constants, float far)
{
    static_assert(offsetof(Contact, body_b) == offsetof(Contact, shape_a) + 12 &&
                  offsetof(Contact, friction) == offsetof(Contact, flags) + 4 && offsetof(Manifold, normal) == 0);
    const Contact* of_lane[lane_count];
    for (int i = 0; i < lane_count; ++i)
        of_lane[i] = notes.contact.v[i] < 0 ? &nobody : contacts + notes.contact.v[i];
    F8 x, y, body_a, body_b, flag_bits, friction, nx, ny;
    gather4([&](int i) { return reinterpret_cast<const char*>(&of_lane[i]->shape_a); }, x, y, body_a, body_b);
    store(notes.body_a, as_ints(body_a));
    store(notes.body_b, as_ints(body_b));
    gather4([&](int i) { return reinterpret_cast<const char*>(&of_lane[i]->flags); }, flag_bits, friction, x, y);
    store(constraint.friction, friction);
    gather4([&](int i) { return reinterpret_cast<const char*>(&of_lane[i]->manifold.normal); }, nx, ny, x, y);
    store(constraint.nx, nx);
    store(constraint.ny, ny);
    fill_masses(constraint, constants);
    for (int k = 0; k < notes.count; ++k)
        fill_point(constraint.points[k], of_lane, k, nx, ny);
    fill_impulses(constraint, notes, impulses);
    const I8 flags = as_ints(flag_bits);
    const unsigned filled = bits(load(notes.contact) >= I8{});
    store(notes.approach[0], all(0));
    store(notes.approach[1], all(0));
    notes.loaded = filled & lanes_with(flags, contact_flag::loaded);
    notes.unreported = filled & ~lanes_with(flags, contact_flag::touching);
    notes.cached = lanes_with(flags, contact_flag::cached) & ~lanes_with(flags, contact_flag::fresh);
    notes.edge_of_b = lanes_with(flags, contact_flag::edge_of_b);
    notes.nearest = lanes_with(flags, contact_flag::nearest);
    notes.followed = 0;
    turn_arms(constraint, notes, half_turns_of(states, constraint.a), half_turns_of(states, constraint.b));
    weigh(constraint, notes.count);
    note_unloaded(constraint, notes, far);
}

} // namespace fills
