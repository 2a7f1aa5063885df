// The contact passes for eight or sixteen lanes; contact_solver.cpp has them for one constraint at a time. Part of kernels.inl.

namespace contacts {

// How passes read and write data: of one block, with F8, or of two adjacent blocks that share no body that has
// finite mass, with F16. Arguments name the first block; the data of the second lie one constraint further on.
template <class F>
struct Constraints;

template <>
struct Constraints<F8>
{
    static CAROM_INLINE F8 read(const LaneFloats& a) { return load(a); }
    static CAROM_INLINE I8 read(const LaneInts& a) { return load(a); }
    static CAROM_INLINE void write(LaneFloats& a, F8 x) { store(a, x); }
    static CAROM_INLINE Speeds<F8> speeds(const BodyState* states, const LaneInts& index) { return speeds_of(states, index); }
    static CAROM_INLINE Poses<F8> poses(const BodyState* states, const LaneInts& index) { return poses_of(states, index); }
    static CAROM_INLINE void put_speeds(BodyState* states, const LaneInts& index, const Speeds<F8>& v, I8 fixed)
    {
        put(states, index, v, bits(fixed));
    }
};

template <>
struct Constraints<F16>
{
    using F = F16;

    template <class Field>
    static CAROM_INLINE Field& next(Field& a)
    {
        using Byte = std::conditional_t<std::is_const_v<Field>, const char, char>;
        return *reinterpret_cast<Field*>(reinterpret_cast<Byte*>(&a) + sizeof(WideContact));
    }

    static CAROM_INLINE F read(const LaneFloats& a) { return sixteen_of(load(a), load(next(a))); }
    static CAROM_INLINE I16 read(const LaneInts& a) { return sixteen_of(load(a), load(next(a))); }
    static CAROM_INLINE void write(LaneFloats& a, F x)
    {
        store(a, first_eight(x));
        store(next(a), second_eight(x));
    }
    static CAROM_INLINE Speeds<F> speeds(const BodyState* states, const LaneInts& index)
    {
        const Speeds<F8> a = speeds_of(states, index);
        const Speeds<F8> b = speeds_of(states, next(index));
        return {sixteen_of(a.x, b.x), sixteen_of(a.y, b.y), sixteen_of(a.w, b.w), sixteen_of(a.flags, b.flags)};
    }
    static CAROM_INLINE Poses<F> poses(const BodyState* states, const LaneInts& index)
    {
        const Poses<F8> a = poses_of(states, index);
        const Poses<F8> b = poses_of(states, next(index));
        return {sixteen_of(a.x, b.x), sixteen_of(a.y, b.y), sixteen_of(a.c, b.c), sixteen_of(a.s, b.s)};
    }
    static CAROM_INLINE void put_speeds(BodyState* states, const LaneInts& index, const Speeds<F>& v, I16 fixed)
    {
        put(states, index, {first_eight(v.x), first_eight(v.y), first_eight(v.w), first_eight(v.flags)}, bits(first_eight(fixed)));
        put(states, next(index), {second_eight(v.x), second_eight(v.y), second_eight(v.w), second_eight(v.flags)}, bits(second_eight(fixed)));
    }
};

template <class F>
CAROM_INLINE F read(const LaneFloats& a)
{
    return Constraints<F>::read(a);
}

template <class F>
CAROM_INLINE void write(LaneFloats& a, F x)
{
    Constraints<F>::write(a, x);
}

// Prefetches two blocks that a later iteration solves together. The hardware prefetcher stops at the
// end of each page, after four constraints. Prefetching beyond the last block does no harm.
CAROM_INLINE void fetch(const WideContact* constraints, const WideContactNotes* notes)
{
    for (const std::size_t later : {prefetch_distance, prefetch_distance + 1})
    {
        prefetch(constraints[later]);
        prefetch_line(&notes[later].count); // and masks
    }
}

// Calls pass(constraint, features, F()) for the blocks of a bucket, two at a time as long as there are two and they have no features.
template <class Features, class Pass>
CAROM_INLINE void for_each_block(const WideBucket& bucket, const Pass& pass)
{
    for (std::int32_t i = 0; i < bucket.count; i += 2)
    {
        if (bucket.are_far)
            fetch(bucket.constraints + i, bucket.notes + i);
        if constexpr (Features::in_pairs)
        {
            if (i + 1 < bucket.count)
                pass(bucket.constraints[i], Features(bucket.features[i]), F16());
            else
                pass(bucket.constraints[i], Features(bucket.features[i]), F8());
        }
        else
        {
            for (std::int32_t k = i; k < std::min(i + 2, bucket.count); ++k)
                pass(bucket.constraints[k], Features(bucket.features[k]), F8());
        }
    }
}

constexpr float least_k = std::numeric_limits<float>::min();
constexpr float unyielding = 1e15f; // 1/kg; its square is finite

// The bodies of a block, and their relative velocity in the contact's frame.
template <class F>
struct Group
{
    F nx, ny, mass_a, mass_b, inertia_a, inertia_b, mass;
    Speeds<F> a, b;
    F vn, vt; ///< of b's center relative to a's
    F pn, pt; ///< impulses of this pass

    CAROM_INLINE Group(const WideContact& constraint, const BodyState* states)
    {
        nx = read<F>(constraint.nx);
        ny = read<F>(constraint.ny);
        mass_a = read<F>(constraint.inverse_mass_a);
        mass_b = read<F>(constraint.inverse_mass_b);
        inertia_a = read<F>(constraint.inverse_inertia_a);
        inertia_b = read<F>(constraint.inverse_inertia_b);
        mass = mass_a + mass_b;
        a = Constraints<F>::speeds(states, constraint.a);
        b = Constraints<F>::speeds(states, constraint.b);
        const F dx = b.x - a.x;
        const F dy = b.y - a.y;
        vn = dx * nx + dy * ny;
        vt = dy * nx - dx * ny;
        pn = pt = F(0);
    }

    // J M^-1 J^T of the normal. Where no body can move, as in empty lanes, the value is so large that impulses are negligible.
    CAROM_INLINE F k(const WidePoint& p) const
    {
        const F across_a = read<F>(p.across_a);
        const F across_b = read<F>(p.across_b);
        const F sum = mass + across_a * across_a * inertia_a + across_b * across_b * inertia_b;
        return select(sum > F(least_k), sum, F(unyielding));
    }

    CAROM_INLINE F normal_speed(const WidePoint& p) const { return vn + read<F>(p.across_b) * b.w - read<F>(p.across_a) * a.w; }
    CAROM_INLINE F tangent_speed(const WidePoint& p) const { return vt + read<F>(p.along_b) * b.w - read<F>(p.along_a) * a.w; }

    CAROM_INLINE void push(const WidePoint& p, F impulse)
    {
        vn += mass * impulse;
        a.w -= inertia_a * read<F>(p.across_a) * impulse;
        b.w += inertia_b * read<F>(p.across_b) * impulse;
        pn += impulse;
    }

    CAROM_INLINE void rub(const WidePoint& p, F impulse)
    {
        vt += mass * impulse;
        a.w -= inertia_a * read<F>(p.along_a) * impulse;
        b.w += inertia_b * read<F>(p.along_b) * impulse;
        pt += impulse;
    }

    CAROM_INLINE void twist(F impulse)
    {
        a.w -= inertia_a * impulse;
        b.w += inertia_b * impulse;
    }

    CAROM_INLINE void finish(const WideContact& constraint, BodyState* states)
    {
        const F px = pn * nx - pt * ny;
        const F py = pn * ny + pt * nx;
        a.x -= mass_a * px;
        a.y -= mass_a * py;
        b.x += mass_b * px;
        b.y += mass_b * py;
        Constraints<F>::put_speeds(states, constraint.a, a, are_fixed(mass_a, inertia_a));
        Constraints<F>::put_speeds(states, constraint.b, b, are_fixed(mass_b, inertia_b));
    }
};

// n · (displacement of the anchors): that of the centers and, with c and s the cosine and sine of the rotation, n · (R r - r).
template <class F>
struct Displacement
{
    F centers, turned_a, turned_b, sin_a, sin_b;

    CAROM_INLINE Displacement(const WideContact& constraint, const Group<F>& g, const BodyState* states)
    {
        const Poses<F> a = Constraints<F>::poses(states, constraint.a);
        const Poses<F> b = Constraints<F>::poses(states, constraint.b);
        centers = (b.x - a.x) * g.nx + (b.y - a.y) * g.ny;
        turned_a = a.c - 1;
        turned_b = b.c - 1;
        sin_a = a.s;
        sin_b = b.s;
    }

    CAROM_INLINE F separation(const WidePoint& p) const
    {
        return read<F>(p.base) + centers + (turned_b * read<F>(p.along_b) + sin_b * read<F>(p.across_b)) -
               (turned_a * read<F>(p.along_a) + sin_a * read<F>(p.across_a));
    }
};

template <class F>
struct Soft
{
    F bias_rate, mass_scale, give;

    // Stiff against bodies of infinite mass.
    CAROM_INLINE Soft(const Group<F>& g, const WideSoftness& s)
    {
        const auto stiff = (g.mass_a == F(0)) | (g.mass_b == F(0));
        bias_rate = select(stiff, F(s.stiff.bias_rate), F(s.contact.bias_rate));
        mass_scale = select(stiff, F(s.stiff.mass_scale), F(s.contact.mass_scale));
        give = select(stiff, F(1 / s.stiff.mass_scale), F(1 / s.contact.mass_scale));
    }
};

template <class F>
CAROM_INLINE NormalTarget<F> target_of(const Group<F>& g, const WidePoint& p, const Soft<F>& soft, const WideSoftness& s)
{
    const F separation = read<F>(p.separation);
    const auto apart = separation > F(0);
    return {g.normal_speed(p), select(apart, separation * s.inverse_h, greatest(soft.bias_rate * separation, F(-s.push_speed))),
            select(apart, F(1), soft.mass_scale), select(apart, F(1), soft.give)};
}

// The target at the new poses, which stay valid until the next sub-step is solved.
template <class F>
CAROM_INLINE NormalTarget<F> relaxed(const Group<F>& g, WidePoint& p, const Displacement<F>& d, const WideSoftness& s)
{
    const F separation = d.separation(p);
    write(p.separation, separation);
    return {g.normal_speed(p), greatest(separation, F(0)) * s.inverse_h, F(1), F(1)};
}

template <class F>
CAROM_INLINE void set_normal(Group<F>& g, WidePoint& p, F old, F impulse)
{
    write(p.normal_impulse, impulse);
    g.push(p, impulse - old);
}

template <class F>
CAROM_INLINE void solve_normal(Group<F>& g, WidePoint& p, const NormalTarget<F>& t)
{
    const F old = read<F>(p.normal_impulse);
    set_normal(g, p, old, normal_impulse(F(1) / g.k(p), old, t));
}

template <class F>
CAROM_INLINE void solve_normals(Group<F>& g, WideContact& constraint, const NormalTarget<F>& t1, const NormalTarget<F>& t2)
{
    WidePoint& p = constraint.points[0];
    WidePoint& q = constraint.points[1];
    const F old1 = read<F>(p.normal_impulse);
    const F old2 = read<F>(q.normal_impulse);
    const NormalImpulses<F> now = normal_impulses(g.k(p), g.k(q), read<F>(constraint.coupling), old1, old2, t1, t2);
    set_normal(g, p, old1, now.first);
    set_normal(g, q, old2, now.second);
}

template <class F>
CAROM_INLINE F solve_friction(Group<F>& g, WidePoint& p, F friction, F surface_speed)
{
    const F old = read<F>(p.tangent_impulse);
    const F updated =
        friction_impulse(old, read<F>(p.tangent_mass), g.tangent_speed(p) - surface_speed, friction * read<F>(p.normal_impulse));
    write(p.tangent_impulse, updated);
    g.rub(p, updated - old);
    return updated;
}

template <class F, int points, class Features>
CAROM_INLINE void solve_block(WideContact& constraint, const Features& features, BodyState* states, const WideSoftness& s)
{
    Group<F> g(constraint, states);
    const Soft<F> soft(g, s);
    const NormalTarget<F> t = target_of(g, constraint.points[0], soft, s);
    if (points == 2)
        solve_normals(g, constraint, t, target_of(g, constraint.points[1], soft, s));
    else
        solve_normal(g, constraint.points[0], t);
    features.roll(g, constraint, points);
    const F friction = read<F>(constraint.friction);
    for (int i = 0; i < points; ++i)
        solve_friction(g, constraint.points[i], friction, features.template surface_speed<F>());
    g.finish(constraint, states);
}

// The lesser of both blocks, lane by lane.
CAROM_INLINE F8 of_both(F8 x) { return x; }
CAROM_INLINE F8 of_both(F16 x) { return least(first_eight(x), second_eight(x)); }

template <class F, int points, class Features>
CAROM_INLINE F8 relax_block(WideContact& constraint, const Features& features, BodyState* states, const WideSoftness& s)
{
    Group<F> g(constraint, states);
    const Displacement<F> d(constraint, g, states);
    const NormalTarget<F> t = relaxed(g, constraint.points[0], d, s);
    if (points == 2)
        solve_normals(g, constraint, t, relaxed(g, constraint.points[1], d, s));
    else
        solve_normal(g, constraint.points[0], t);
    for (int i = 0; i < points; ++i)
        write(constraint.points[i].total_impulse, read<F>(constraint.points[i].total_impulse) + read<F>(constraint.points[i].normal_impulse));
    features.roll(g, constraint, points);
    const F friction = read<F>(constraint.friction);
    for (int i = 0; i < points; ++i)
    {
        const F tangent = solve_friction(g, constraint.points[i], friction, features.template surface_speed<F>());
        write(constraint.points[i].total_tangent, read<F>(constraint.points[i].total_tangent) + tangent);
    }
    g.finish(constraint, states);
    const F separation = read<F>(constraint.points[0].separation);
    return of_both(points == 2 ? least(separation, read<F>(constraint.points[points - 1].separation)) : separation);
}

// The approach speeds of the points of a block when the sub-step began.
template <int points>
CAROM_INLINE void note_approach(const WideContact& constraint, WideContactNotes& notes, const BodySpeeds* before)
{
    const Speeds a = speeds_of(before, constraint.a);
    const Speeds b = speeds_of(before, constraint.b);
    const F8 vn = (b.x - a.x) * load(constraint.nx) + (b.y - a.y) * load(constraint.ny);
    for (int i = 0; i < points; ++i)
    {
        const WidePoint& p = constraint.points[i];
        store(notes.approach[i], -(vn + load(p.across_b) * b.w - load(p.across_a) * a.w));
    }
}

// The lanes that bear a load and were struck by no less than the least blow, or touch for the first time; and those that have lost a load.
template <int points>
CAROM_INLINE void find_blows(const WideContact& constraint, WideContactNotes& notes, const BodySpeeds* before, float least_blow, BlowBits found)
{
    const I8 first = load(constraint.points[0].normal_impulse) > all(0);
    const I8 second = points == 2 ? load(constraint.points[1].normal_impulse) > all(0) : I8{};
    const unsigned of_first = bits(first);
    const unsigned of_second = bits(second);
    const unsigned second_may = notes.may_hit >> lane_count;
    const unsigned idle = notes.may_hit | notes.may_hit >> 2 * lane_count;
    unsigned relieved = ~(of_first | idle);
    if (points == 2)
        relieved |= ~(of_second | idle >> lane_count);
    unsigned struck = (of_first | of_second) & notes.unreported;
    unsigned approach = 0;
    if (((of_first & notes.may_hit) | (of_second & second_may)) != 0)
    {
        note_approach<points>(constraint, notes, before);
        approach = bits(first & (load(notes.approach[0]) > all(least_blow)));
        if (points == 2)
            approach |= bits(second & (load(notes.approach[1]) > all(least_blow))) << lane_count;
        struck |= (approach & notes.may_hit) | (approach >> lane_count & second_may);
    }
    notes.halfway = static_cast<std::uint16_t>(notes.halfway & approach);
    *found.struck = static_cast<std::uint8_t>(struck);
    *found.relieved = static_cast<std::uint8_t>(relieved);
}

template <class F, int points, class Features>
CAROM_INLINE void warm_start_block(WideContact& constraint, const Features& features, BodyState* states)
{
    Group<F> g(constraint, states);
    features.start(g);
    for (int i = 0; i < points; ++i)
    {
        g.push(constraint.points[i], read<F>(constraint.points[i].normal_impulse));
        g.rub(constraint.points[i], read<F>(constraint.points[i].tangent_impulse));
    }
    g.finish(constraint, states);
}

// The passes over a block as functors, whose calls are always inlined: g++ calls the lambdas, and large pyramids take 2 % longer.
template <int points>
struct Solve
{
    BodyState* states;
    const WideSoftness& s;

    template <class Features, class F>
    CAROM_INLINE void operator()(WideContact& constraint, const Features& features, F) const
    {
        solve_block<F, points>(constraint, features, states, s);
    }
};

template <int points>
struct Relax
{
    BodyState* states;
    const WideSoftness& s;
    F8& deepest;

    template <class Features, class F>
    CAROM_INLINE void operator()(WideContact& constraint, const Features& features, F) const
    {
        deepest = least(deepest, relax_block<F, points>(constraint, features, states, s));
    }
};

template <int points>
struct Start
{
    BodyState* states;

    template <class Features, class F>
    CAROM_INLINE void operator()(WideContact& constraint, const Features& features, F) const
    {
        warm_start_block<F, points>(constraint, features, states);
    }
};

template <int points, class Features>
void solve_bucket(WideBucket bucket, BodyState* states, WideSoftness s)
{
    for_each_block<Features>(bucket, Solve<points>{states, s});
}

template <int points, class Features>
float relax_bucket(WideBucket bucket, BodyState* states, WideSoftness s, const BodySpeeds* before, BlowBits blows)
{
    F8 deepest = all(0);
    for_each_block<Features>(bucket, Relax<points>{states, s, deepest});
    for (int i = 0; i < bucket.count; ++i)
        find_blows<points>(bucket.constraints[i], bucket.notes[i], before, s.least_blow, {blows.struck + i, blows.relieved + i});
    LaneFloats of_lanes;
    store(of_lanes, deepest);
    return *std::min_element(std::begin(of_lanes.v), std::end(of_lanes.v));
}

template <int points, class Features>
void warm_start_bucket(WideBucket bucket, BodyState* states)
{
    bucket.are_far = true; // the first pass over constraints that no near cache holds
    for_each_block<Features>(bucket, Start<points>{states});
}

// The function for the number of points and the features of a bucket.
template <class Function>
CAROM_INLINE Function* of_bucket(const WideBucket& bucket, Function* one, Function* two, Function* featured_one, Function* featured_two)
{
    const bool has_two = bucket.notes->count == 2;
    return bucket.notes->featured != 0 ? (has_two ? featured_two : featured_one) : (has_two ? two : one);
}

void warm_start(const WideBucket& bucket, BodyState* states)
{
    of_bucket(bucket, warm_start_bucket<1, NoFeatures>, warm_start_bucket<2, NoFeatures>, warm_start_bucket<1, Featured>,
              warm_start_bucket<2, Featured>)(bucket, states);
}

void solve(const WideBucket& bucket, BodyState* states, const WideSoftness& s)
{
    of_bucket(bucket, solve_bucket<1, NoFeatures>, solve_bucket<2, NoFeatures>, solve_bucket<1, Featured>, solve_bucket<2, Featured>)(
        bucket, states, s);
}

float relax(const WideBucket& bucket, BodyState* states, const WideSoftness& s, const BodySpeeds* before, BlowBits blows)
{
    return of_bucket(bucket, relax_bucket<1, NoFeatures>, relax_bucket<2, NoFeatures>, relax_bucket<1, Featured>, relax_bucket<2, Featured>)(
        bucket, states, s, before, blows);
}

} // namespace contacts
