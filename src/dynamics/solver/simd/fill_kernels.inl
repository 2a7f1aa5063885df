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

// The points that bear no load, as may_hit_bit has them; those of empty lanes too.
CAROM_INLINE std::uint32_t unloaded_points(const WideContact& constraint, int points)
{
    const auto unloaded = [&](int k) { return bits(load(constraint.points[k].normal_impulse) <= all(0)); };
    return unloaded(0) | (points == 2 ? unloaded(1) << lane_count : 0);
}

void prepare(WideContact& constraint, std::int32_t points)
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
        store(p.separation, load(p.base));
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

// Fills all but a, b, contact and count, which select the source.
void fill(WideContact& constraint, WideContactNotes& notes, const Contact* contacts, const ContactImpulses* impulses, const StateConstants* constants)
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
    notes.may_hit = unloaded_points(constraint, notes.count);
    notes.unreported = filled & ~lanes_with(flags, contact_flag::touching);
    notes.cached = lanes_with(flags, contact_flag::cached) & ~lanes_with(flags, contact_flag::fresh);
    notes.edge_of_b = lanes_with(flags, contact_flag::edge_of_b);
    notes.nearest = lanes_with(flags, contact_flag::nearest);
    notes.followed = 0;
    prepare(constraint, notes.count);
}

} // namespace fills
