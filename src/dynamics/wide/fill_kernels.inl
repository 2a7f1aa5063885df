// Rows are filled from their contacts and impulses, and get their effective masses; refill_lane has the same for one lane. Part of kernels.inl.

namespace fills {

// What empty lanes read: nothing pushes.
constexpr Contact nobody{};
constexpr ContactImpulses nothing{};

// Lanes with that flag.
CAROM_INLINE unsigned lanes_with(I8 flags, std::uint32_t flag) { return bits((flags & all_ints(flag)) != I8{}); }

// From the contacts' k-th points.
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
    store(p.approach, all(0));
}

CAROM_INLINE void fill_impulses(WideRow& row, const ContactImpulses* impulses)
{
    for (int k = 0; k < row.count; ++k)
    {
        F8 normal, tangent, total_normal, total_tangent;
        const auto at = [&](int i)
        { return reinterpret_cast<const char*>((row.contact.v[i] < 0 ? nothing : impulses[row.contact.v[i]]).points + k); };
        gather4(at, normal, tangent, total_normal, total_tangent);
        store(row.points[k].normal_impulse, normal);
        store(row.points[k].tangent_impulse, tangent);
    }
}

CAROM_INLINE void prepare_row(WideRow& row)
{
    const F8 mass = load(row.inverse_mass_a) + load(row.inverse_mass_b);
    const F8 ia = load(row.inverse_inertia_a);
    const F8 ib = load(row.inverse_inertia_b);
    mark_fixed(row);
    for (int i = 0; i < row.count; ++i)
    {
        WidePoint& p = row.points[i];
        const F8 na = load(p.across_a);
        const F8 nb = load(p.across_b);
        const F8 ta = load(p.along_a);
        const F8 tb = load(p.along_b);
        const F8 k = mass + na * na * ia + nb * nb * ib;
        const F8 tangent_k = mass + ta * ta * ia + tb * tb * ib;
        store(p.k, select(k > all(0), k, all(1)));
        store(p.separation, load(p.base));
        store(p.tangent_mass, select(tangent_k > all(0), all(1) / tangent_k, all(0)));
    }
    if (row.count < 2)
        return;
    const F8 coupling = mass + load(row.points[0].across_a) * load(row.points[1].across_a) * ia +
                        load(row.points[0].across_b) * load(row.points[1].across_b) * ib;
    // Points nearly in one place share their load anyhow; solving for both would only divide noise.
    const F8 limit = 0.9995f * root(load(row.points[0].k) * load(row.points[1].k));
    store(row.coupling, clamp(coupling, -limit, limit));
}

void prepare(WideRow* rows, std::int32_t count)
{
    for (WideRow* row = rows; row < rows + count; ++row)
        prepare_row(*row);
}

// All but a, b, contact and count, which say what goes there.
void fill(WideRow& row, const Contact* contacts, const ContactImpulses* impulses, const StateConstants* constants)
{
    static_assert(offsetof(Contact, body_b) == offsetof(Contact, shape_a) + 12 &&
                  offsetof(Contact, friction) == offsetof(Contact, flags) + 4 && offsetof(Manifold, normal) == 0);
    const Contact* of_lane[lane_count];
    for (int i = 0; i < lane_count; ++i)
        of_lane[i] = row.contact.v[i] < 0 ? &nobody : contacts + row.contact.v[i];
    F8 x, y, body_a, body_b, flag_bits, friction, nx, ny;
    gather4([&](int i) { return reinterpret_cast<const char*>(&of_lane[i]->shape_a); }, x, y, body_a, body_b);
    store(row.body_a, as_ints(body_a));
    store(row.body_b, as_ints(body_b));
    gather4([&](int i) { return reinterpret_cast<const char*>(&of_lane[i]->flags); }, flag_bits, friction, x, y);
    store(row.friction, friction);
    gather4([&](int i) { return reinterpret_cast<const char*>(&of_lane[i]->manifold.normal); }, nx, ny, x, y);
    store(row.nx, nx);
    store(row.ny, ny);
    fill_masses(row, constants);
    store(row.stiff, (load(row.inverse_mass_a) == all(0)) | (load(row.inverse_mass_b) == all(0)));
    for (int k = 0; k < row.count; ++k)
        fill_point(row.points[k], of_lane, k, nx, ny);
    fill_impulses(row, impulses);
    const I8 flags = as_ints(flag_bits);
    const unsigned filled = bits(load(row.contact) >= I8{});
    row.loaded = filled & lanes_with(flags, contact_flag::loaded);
    row.may_hit = filled & ~row.loaded;
    row.untold = filled & ~lanes_with(flags, contact_flag::touching);
    row.kept = lanes_with(flags, contact_flag::kept) & ~lanes_with(flags, contact_flag::fresh);
    row.edge_of_b = lanes_with(flags, contact_flag::edge_of_b);
    row.nearest = lanes_with(flags, contact_flag::nearest);
    row.followed = 0;
    prepare_row(row);
}

} // namespace fills
