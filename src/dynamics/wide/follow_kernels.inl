// Manifolds that are followed where they stand, in the lanes of their rows; kept_manifold.cpp has the same for one at a time, and what is kept. Part of
// kernels.inl.

namespace follows {

// Of eight contacts, their bodies and what is kept of them. Empty lanes see what the first sees.
struct Places
{
    const KeptManifold* kept[lane_count];
    const BodySim* a[lane_count];
    const BodySim* b[lane_count];

    CAROM_INLINE Places(const WideRow& row, const FollowedScene& scene)
    {
        for (int i = 0; i < lane_count; ++i)
        {
            const std::int32_t contact = row.contact.v[row.contact.v[i] < 0 ? 0 : i];
            kept[i] = scene.kept + contact;
            a[i] = scene.sims + scene.contacts[contact].body_a;
            b[i] = scene.sims + scene.contacts[contact].body_b;
        }
    }
};

struct Turn
{
    F8 c, s;
};

struct Arrow
{
    F8 x, y;
};

CAROM_INLINE Turn turns_of(const BodySim* const (&sims)[lane_count])
{
    static_assert(offsetof(BodySim, rotation) == 16);
    Turn q;
    F8 unused_x;
    F8 unused_y;
    gather4([&](int i) { return reinterpret_cast<const char*>(sims[i]) + 16; }, q.c, q.s, unused_x, unused_y);
    return q;
}

CAROM_INLINE Arrow turned(const Turn& q, const Arrow& v) { return {q.c * v.x - q.s * v.y, q.s * v.x + q.c * v.y}; }

// From center to center, taken in double.
CAROM_INLINE Arrow centers_apart(const Places& places)
{
    static_assert(offsetof(BodySim, center) == 0);
    using D2 = double __attribute__((vector_size(16)));
    LaneFloats x;
    LaneFloats y;
    for (int i = 0; i < lane_count; ++i)
    {
        D2 from;
        D2 to;
        std::memcpy(&from, places.a[i], sizeof from);
        std::memcpy(&to, places.b[i], sizeof to);
        const D2 apart = to - from;
        x.v[i] = static_cast<float>(apart[0]);
        y.v[i] = static_cast<float>(apart[1]);
    }
    return {load(x), load(y)};
}

CAROM_INLINE F8 length_of(const Arrow& v) { return root(v.x * v.x + v.y * v.y); }

// How far any point of b has moved against a since the manifold was found; more where it has turned by a right angle.
CAROM_INLINE F8 way_since(const Places& places, const Turn& a, const Turn& b, const Arrow& apart, const Arrow& kept_center)
{
    Turn kept;
    F8 margin;
    F8 unused;
    static_assert(offsetof(KeptManifold, rotation) == 48);
    gather4([&](int i) { return reinterpret_cast<const char*>(places.kept[i]) + 48; }, kept.c, kept.s, margin, unused);
    const Turn now = {a.c * b.c + a.s * b.s, a.c * b.s - a.s * b.c};
    const F8 cosine = now.c * kept.c + now.s * kept.s;
    const F8 sine = now.s * kept.c - now.c * kept.s;
    const Arrow moved = {a.c * apart.x + a.s * apart.y - kept_center.x, a.c * apart.y - a.s * apart.x - kept_center.y};
    LaneFloats extent;
    for (int i = 0; i < lane_count; ++i)
        extent.v[i] = places.b[i]->extent;
    const F8 way = length_of(moved) + load(extent) * greatest(sine, -sine);
    return select(cosine > all(0), way, all(3e38f));
}

CAROM_INLINE I8 lanes_of(std::uint32_t bits)
{
    const auto b = static_cast<std::int32_t>(bits);
    return (I8{b, b, b, b, b, b, b, b} & I8{1, 2, 4, 8, 16, 32, 64, 128}) != I8{};
}

// The point of the other body stays where it is on it; opposite, on the edge, it slides along. Gives the separation.
CAROM_INLINE F8 follow_point(WidePoint& p, const Places& places, std::size_t offset, const Turn& turn_a, const Turn& turn_b,
                             const Arrow& apart, const Arrow& n, I8 edge_of_b, I8 filled)
{
    Arrow a;
    Arrow b;
    gather4([&](int i) { return reinterpret_cast<const char*>(places.kept[i]) + offset; }, a.x, a.y, b.x, b.y);
    a = turned(turn_a, a);
    b = turned(turn_b, b);
    const Arrow gap = {apart.x + (b.x - a.x), apart.y + (b.y - a.y)};
    const F8 separation = n.x * gap.x + n.y * gap.y;
    const Arrow slid = {gap.x - separation * n.x, gap.y - separation * n.y};
    b = {select(edge_of_b, b.x - slid.x, b.x), select(edge_of_b, b.y - slid.y, b.y)};
    a = {select(edge_of_b, a.x, a.x + slid.x), select(edge_of_b, a.y, a.y + slid.y)};
    const F8 none = all(0);
    store(p.across_a, select(filled, a.x * n.y - a.y * n.x, none));
    store(p.along_a, select(filled, a.x * n.x + a.y * n.y, none));
    store(p.across_b, select(filled, b.x * n.y - b.y * n.x, none));
    store(p.along_b, select(filled, b.x * n.x + b.y * n.y, none));
    store(p.base, select(filled, separation, none));
    return separation;
}

CAROM_INLINE I8 has(I8 flags, std::uint32_t flag)
{
    const auto f = static_cast<std::int32_t>(flag);
    return (flags & I8{f, f, f, f, f, f, f, f}) != I8{};
}

// What a contact says of itself.
struct Papers
{
    I8 flags;
    F8 friction, rolling_resistance, surface_speed;

    CAROM_INLINE Papers(const WideRow& row, const Contact* contacts)
    {
        static_assert(offsetof(Contact, flags) == 40 && offsetof(Contact, friction) == 44);
        static_assert(offsetof(Contact, rolling_resistance) == 48 && offsetof(Contact, surface_speed) == 52);
        F8 bits_of_flags;
        gather4([&](int i)
                { return reinterpret_cast<const char*>(contacts + row.contact.v[row.contact.v[i] < 0 ? 0 : i]) + 40; },
                bits_of_flags, friction, rolling_resistance, surface_speed);
        std::memcpy(&flags, &bits_of_flags, sizeof flags);
    }
};

// Lanes by what has become of their contacts.
CAROM_INLINE void tell(const WideRow& row, const Papers& papers, F8 way, F8 separation, I8 filled, const FollowedScene& scene,
                       FollowedRow& found)
{
    const I8 touching = has(papers.flags, contact_flag::touching);
    const I8 loaded = has(papers.flags, contact_flag::loaded);
    const I8 strange = has(papers.flags, contact_flag::trigger | contact_flag::passing | contact_flag::fresh | contact_flag::one_way) |
                       (papers.rolling_resistance != all(0)) | (papers.surface_speed != all(0)) | (touching == lanes_of(row.untold));
    const I8 sure = has(papers.flags, contact_flag::kept) & (way < all(scene.sure_way));
    const I8 near = separation <= select(touching, all(2 * scene.slop), all(scene.slop));
    const I8 borne = loaded & (separation <= all(scene.speculation));
    found.strange = bits(filled & strange);
    found.unsure = bits(filled & ~sure);
    found.begins_or_ends = bits(filled & (near != touching));
    found.borne = bits(filled & borne);
    found.sunk = bits(filled & ~borne & (separation < all(-scene.slop)));
    found.unloaded = bits(filled & ~loaded);
    found.unnoted = bits(filled & ~has(papers.flags, contact_flag::followed));
    store(found.way, way);
}

void follow(WideRow& row, const FollowedScene& scene, FollowedRow& found)
{
    static_assert(offsetof(KeptManifold, points) == 0 && offsetof(KeptManifold, normal) == 32 && offsetof(KeptManifold, center) == 40);
    const Places places(row, scene);
    const Papers papers(row, scene.contacts);
    const I8 filled = load(row.contact) >= I8{};
    const I8 edge_of_b = lanes_of(row.edge_of_b);
    const Turn a = turns_of(places.a);
    const Turn b = turns_of(places.b);
    const Arrow apart = centers_apart(places);
    Arrow normal;
    Arrow kept_center;
    gather4([&](int i) { return reinterpret_cast<const char*>(places.kept[i]) + 32; }, normal.x, normal.y, kept_center.x,
            kept_center.y);
    const F8 way = way_since(places, a, b, apart, kept_center);
    const Turn edge = {select(edge_of_b, b.c, a.c), select(edge_of_b, b.s, a.s)};
    const Arrow n = turned(edge, normal);
    store(row.nx, select(filled, n.x, all(0)));
    store(row.ny, select(filled, n.y, all(0)));
    store(row.friction, select(filled, papers.friction, all(0)));
    F8 separation = follow_point(row.points[0], places, 0, a, b, apart, n, edge_of_b, filled);
    if (row.count == 2)
        separation = least(separation, follow_point(row.points[1], places, 16, a, b, apart, n, edge_of_b, filled));
    store(found.separation, separation);
    tell(row, papers, way, separation, filled, scene, found);
}

// Impulses of a point, side by side in a row, one after the other in a contact.
void take_impulses(const WideRow& row, Contact* contacts)
{
    static_assert(offsetof(ManifoldPoint, tangent_impulse) == offsetof(ManifoldPoint, normal_impulse) + 4 &&
                  offsetof(ManifoldPoint, total_impulse) == offsetof(ManifoldPoint, normal_impulse) + 8 &&
                  offsetof(ManifoldPoint, total_tangent) == offsetof(ManifoldPoint, normal_impulse) + 12);
    Contact unused;
    I8 loaded{};
    for (int k = 0; k < row.count; ++k)
    {
        const WidePoint& p = row.points[k];
        const F8 normal_impulse = load(p.normal_impulse);
        loaded |= normal_impulse > all(0);
        const auto at = [&](int i)
        {
            Contact& contact = row.contact.v[i] < 0 ? unused : contacts[row.contact.v[i]];
            return reinterpret_cast<char*>(&contact.manifold.points[k].normal_impulse);
        };
        scatter4(at, normal_impulse, load(p.tangent_impulse), load(p.total_impulse), load(p.total_tangent));
    }
    const unsigned bears = bits(loaded);
    for (int i = 0; i < lane_count; ++i)
    {
        if (row.contact.v[i] < 0)
            continue;
        std::uint32_t& flags = contacts[row.contact.v[i]].flags;
        flags = (flags & ~contact_flag::loaded) | ((bears >> i & 1u) != 0 ? contact_flag::loaded : 0);
    }
}

} // namespace follows
