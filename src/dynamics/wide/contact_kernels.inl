// The contact passes, from equation to lanes; contact_solver.cpp has the same for a row at a time, and the equations. Part of kernels.inl.

namespace contacts {

// The bodies of a group and their relative velocity in the contact's frame.
struct Group
{
    F8 nx, ny, mass_a, mass_b, inertia_a, inertia_b, mass;
    Speeds a, b;
    F8 vn, vt; ///< of b's center against a's
    F8 pn, pt; ///< impulses of this pass

    CAROM_INLINE Group(const WideRow& row, const BodyState* states)
    {
        nx = load(row.nx);
        ny = load(row.ny);
        mass_a = load(row.inverse_mass_a);
        mass_b = load(row.inverse_mass_b);
        inertia_a = load(row.inverse_inertia_a);
        inertia_b = load(row.inverse_inertia_b);
        mass = mass_a + mass_b;
        a = speeds_of(states, row.a);
        b = speeds_of(states, row.b);
        const F8 dx = b.x - a.x;
        const F8 dy = b.y - a.y;
        vn = dx * nx + dy * ny;
        vt = dy * nx - dx * ny;
        pn = pt = all(0);
    }

    CAROM_INLINE F8 normal_speed(const WidePoint& p) const { return vn + load(p.across_b) * b.w - load(p.across_a) * a.w; }
    CAROM_INLINE F8 tangent_speed(const WidePoint& p) const { return vt + load(p.along_b) * b.w - load(p.along_a) * a.w; }

    CAROM_INLINE void push(const WidePoint& p, F8 impulse)
    {
        vn += mass * impulse;
        a.w -= inertia_a * load(p.across_a) * impulse;
        b.w += inertia_b * load(p.across_b) * impulse;
        pn += impulse;
    }

    CAROM_INLINE void rub(const WidePoint& p, F8 impulse)
    {
        vt += mass * impulse;
        a.w -= inertia_a * load(p.along_a) * impulse;
        b.w += inertia_b * load(p.along_b) * impulse;
        pt += impulse;
    }

    CAROM_INLINE void finish(const WideRow& row, BodyState* states)
    {
        const F8 px = pn * nx - pt * ny;
        const F8 py = pn * ny + pt * nx;
        a.x -= mass_a * px;
        a.y -= mass_a * py;
        b.x += mass_b * px;
        b.y += mass_b * py;
        put(states, row.a, a, row.fixed_a);
        put(states, row.b, b, row.fixed_b);
    }
};

// n · (displacement of the anchors): the centers' and, with c and s the cosine and sine of the turn, n · (R r - r).
struct Displacement
{
    F8 centers, turned_a, turned_b, sin_a, sin_b;

    CAROM_INLINE Displacement(const WideRow& row, const Group& g, const BodyState* states)
    {
        const Poses a = poses_of(states, row.a);
        const Poses b = poses_of(states, row.b);
        centers = (b.x - a.x) * g.nx + (b.y - a.y) * g.ny;
        turned_a = a.c - 1;
        turned_b = b.c - 1;
        sin_a = a.s;
        sin_b = b.s;
    }

    CAROM_INLINE F8 separation(const WidePoint& p) const
    {
        return load(p.base) + centers + (turned_b * load(p.along_b) + sin_b * load(p.across_b)) -
               (turned_a * load(p.along_a) + sin_a * load(p.across_a));
    }
};

struct Soft
{
    F8 bias_rate, give;

    CAROM_INLINE Soft(const WideRow& row, const WideSoftness& s)
    {
        const I8 stiff = load(row.stiff);
        bias_rate = select(stiff, all(s.stiff.bias_rate), all(s.contact.bias_rate));
        give = select(stiff, all(1 / s.stiff.mass_scale), all(1 / s.contact.mass_scale));
    }
};

// What a normal is solved for: its speed should become -bias, give = 1 / mass_scale is the softness.
struct Target
{
    F8 speed, bias, give;
};

CAROM_INLINE Target target_of(const Group& g, const WidePoint& p, const Soft& soft, const WideSoftness& s)
{
    const F8 separation = load(p.separation);
    const I8 apart = separation > all(0);
    return {g.normal_speed(p), select(apart, separation * s.inverse_h, greatest(soft.bias_rate * separation, all(-s.push_speed))),
            select(apart, all(1), soft.give)};
}

// At new poses, which stay until the next sub-step's turn.
CAROM_INLINE Target relaxed(const Group& g, WidePoint& p, const Displacement& d, const WideSoftness& s)
{
    const F8 separation = d.separation(p);
    store(p.separation, separation);
    return {g.normal_speed(p), greatest(separation, all(0)) * s.inverse_h, all(1)};
}

CAROM_INLINE F8 set_normal(Group& g, WidePoint& p, F8 old, F8 impulse)
{
    store(p.normal_impulse, impulse);
    g.push(p, impulse - old);
    return impulse;
}

CAROM_INLINE void solve_normal(Group& g, WidePoint& p, const Target& t)
{
    // k give x + (speed + bias - k old) = 0, x >= 0: softness is compliance beside k.
    const F8 k = load(p.k);
    const F8 old = load(p.normal_impulse);
    set_normal(g, p, old, greatest((k * old - (t.speed + t.bias)) / (k * t.give), all(0)));
}

// Two points at once. One after the other they never agree within a pass: each turns the body a little on the other's account and stacks lean.
// A x + b >= 0, x >= 0, and of each pair one is 0; four cases.
CAROM_INLINE void solve_normals(Group& g, WideRow& row, const Target& t1, const Target& t2)
{
    WidePoint& p = row.points[0];
    WidePoint& q = row.points[1];
    const F8 k11 = load(p.k);
    const F8 k22 = load(q.k);
    const F8 k12 = load(row.coupling);
    const F8 old1 = load(p.normal_impulse);
    const F8 old2 = load(q.normal_impulse);
    const F8 a11 = k11 * t1.give;
    const F8 a22 = k22 * t2.give;
    const F8 b1 = t1.speed + t1.bias - (k11 * old1 + k12 * old2);
    const F8 b2 = t2.speed + t2.bias - (k12 * old1 + k22 * old2);
    const F8 inverse_det = all(1) / (a11 * a22 - k12 * k12);
    const F8 both1 = inverse_det * (k12 * b2 - a22 * b1);
    const F8 both2 = inverse_det * (k12 * b1 - a11 * b2);
    const F8 only1 = greatest(-b1 / a11, all(0));
    const F8 only2 = greatest(-b2 / a22, all(0));
    const I8 second_sinks = k12 * only1 + b2 < all(0);
    const I8 both = (both1 >= all(0)) & (both2 >= all(0));
    set_normal(g, p, old1, select(both, both1, select(second_sinks, all(0), only1)));
    set_normal(g, q, old2, select(both, both2, select(second_sinks, only2, all(0))));
}

CAROM_INLINE F8 solve_friction(Group& g, WidePoint& p, F8 friction)
{
    const F8 limit = friction * load(p.normal_impulse);
    const F8 old = load(p.tangent_impulse);
    const F8 updated = clamp(old - load(p.tangent_mass) * g.tangent_speed(p), -limit, limit);
    store(p.tangent_impulse, updated);
    g.rub(p, updated - old);
    return updated;
}

template <int points>
CAROM_INLINE void solve_group(WideRow& row, BodyState* states, const WideSoftness& s)
{
    Group g(row, states);
    const Soft soft(row, s);
    const Target t = target_of(g, row.points[0], soft, s);
    if (points == 2)
        solve_normals(g, row, t, target_of(g, row.points[1], soft, s));
    else
        solve_normal(g, row.points[0], t);
    const F8 friction = load(row.friction);
    for (int i = 0; i < points; ++i)
        solve_friction(g, row.points[i], friction);
    g.finish(row, states);
}

// How fast the points of a group came together when the sub-step began.
template <int points>
CAROM_INLINE void note_approach(WideRow& row, const BodySpeeds* before)
{
    const Speeds a = speeds_of(before, row.a);
    const Speeds b = speeds_of(before, row.b);
    const F8 vn = (b.x - a.x) * load(row.nx) + (b.y - a.y) * load(row.ny);
    for (int i = 0; i < points; ++i)
    {
        WidePoint& p = row.points[i];
        store(p.approach, -(vn + load(p.across_b) * b.w - load(p.across_a) * a.w));
    }
}

// Lanes that bear a load: struck harder than rest, or touching for the first time.
template <int points>
CAROM_INLINE std::uint8_t struck_lanes(WideRow& row, const BodySpeeds* before, float rest_speed)
{
    if ((row.may_hit | row.untold) == 0)
        return 0;
    const I8 first = load(row.points[0].normal_impulse) > all(0);
    const I8 second = points == 2 ? load(row.points[1].normal_impulse) > all(0) : I8{};
    const unsigned loaded = bits(first | second);
    if ((loaded & row.may_hit) == 0)
        return static_cast<std::uint8_t>(loaded & row.untold);
    note_approach<points>(row, before);
    I8 struck = first & (load(row.points[0].approach) > all(rest_speed));
    if (points == 2)
        struck |= second & (load(row.points[1].approach) > all(rest_speed));
    return static_cast<std::uint8_t>((loaded & row.untold) | (bits(struck) & row.may_hit));
}

template <int points>
CAROM_INLINE void relax_group(WideRow& row, BodyState* states, const WideSoftness& s)
{
    Group g(row, states);
    const Displacement d(row, g, states);
    const Target t = relaxed(g, row.points[0], d, s);
    if (points == 2)
        solve_normals(g, row, t, relaxed(g, row.points[1], d, s));
    else
        solve_normal(g, row.points[0], t);
    for (int i = 0; i < points; ++i)
        store(row.points[i].total_impulse, load(row.points[i].total_impulse) + s.share * load(row.points[i].normal_impulse));
    const F8 friction = load(row.friction);
    for (int i = 0; i < points; ++i)
    {
        const F8 tangent = solve_friction(g, row.points[i], friction);
        store(row.points[i].total_tangent, load(row.points[i].total_tangent) + s.share * tangent);
    }
    g.finish(row, states);
}

void warm_start(WideRow* rows, std::int32_t count, BodyState* states)
{
    for (WideRow* row = rows; row < rows + count; ++row)
    {
        Group g(*row, states);
        for (int i = 0; i < row->count; ++i)
        {
            g.push(row->points[i], load(row->points[i].normal_impulse));
            g.rub(row->points[i], load(row->points[i].tangent_impulse));
        }
        g.finish(*row, states);
    }
}

void solve(WideRow* rows, std::int32_t count, BodyState* states, const WideSoftness& s)
{
    for (WideRow* row = rows; row < rows + count; ++row)
    {
        if (row->count == 2)
            solve_group<2>(*row, states, s);
        else
            solve_group<1>(*row, states, s);
    }
}

void relax(WideRow* rows, std::int32_t count, BodyState* states, const WideSoftness& s, const BodySpeeds* before,
           std::uint8_t* struck)
{
    for (WideRow* row = rows; row < rows + count; ++row, ++struck)
    {
        if (row->count == 2)
        {
            relax_group<2>(*row, states, s);
            *struck = struck_lanes<2>(*row, before, s.rest_speed);
        }
        else
        {
            relax_group<1>(*row, states, s);
            *struck = struck_lanes<1>(*row, before, s.rest_speed);
        }
    }
}

} // namespace contacts
