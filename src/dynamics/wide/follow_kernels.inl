// Manifolds that are followed where they stand, in the lanes of their rows; kept_manifold.cpp has the same for one at a time, and what is kept. Part of
// kernels.inl.

namespace follows {

// Of eight contacts, what is kept of them, and their bodies.
struct Places
{
    const KeptManifold* kept[lane_count];
    const BodySim* a[lane_count];
    const BodySim* b[lane_count];

    // Empty lanes see what another sees.
    CAROM_INLINE Places(const WideRow& row, const FollowedScene& scene)
    {
        int some = 0;
        for (int i = 0; i < lane_count; ++i)
            some = row.contact.v[i] < 0 ? some : i;
        for (int i = 0; i < lane_count; ++i)
        {
            const int lane = row.contact.v[i] < 0 ? some : i;
            kept[i] = scene.kept + row.contact.v[lane];
            a[i] = scene.sims + row.body_a.v[lane];
            b[i] = scene.sims + row.body_b.v[lane];
        }
    }

    CAROM_INLINE Places(const LaneInts& contacts, const FollowedScene& scene)
    {
        for (int i = 0; i < lane_count; ++i)
        {
            const Contact& contact = scene.contacts[contacts.v[i]];
            kept[i] = scene.kept + contacts.v[i];
            a[i] = scene.sims + contact.body_a;
            b[i] = scene.sims + contact.body_b;
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

// How the bodies of eight contacts stand to each other, and what is kept of them.
struct Stand
{
    Turn a, b;
    Arrow apart;
    Arrow n;
    F8 way;
    I8 edge_of_b;

    CAROM_INLINE Stand(const Places& places, I8 edges_of_b)
        : a(turns_of(places.a)), b(turns_of(places.b)), apart(centers_apart(places)), edge_of_b(edges_of_b)
    {
        static_assert(offsetof(KeptManifold, points) == 0 && offsetof(KeptManifold, normal) == 32 &&
                      offsetof(KeptManifold, center) == 40);
        Arrow normal;
        Arrow kept_center;
        gather4([&](int i) { return reinterpret_cast<const char*>(places.kept[i]) + 32; }, normal.x, normal.y, kept_center.x,
                kept_center.y);
        way = way_since(places, a, b, apart, kept_center);
        n = turned({select(edge_of_b, b.c, a.c), select(edge_of_b, b.s, a.s)}, normal);
    }
};

struct Point
{
    Arrow a, b; ///< anchors
    F8 separation;
};

// The point of the other body stays where it is on it; opposite, on the edge, it slides along.
CAROM_INLINE Point follow_point(const Places& places, std::size_t k, const Stand& s)
{
    Point p;
    gather4([&](int i) { return reinterpret_cast<const char*>(places.kept[i]) + 16 * k; }, p.a.x, p.a.y, p.b.x, p.b.y);
    p.a = turned(s.a, p.a);
    p.b = turned(s.b, p.b);
    const Arrow gap = {s.apart.x + (p.b.x - p.a.x), s.apart.y + (p.b.y - p.a.y)};
    p.separation = s.n.x * gap.x + s.n.y * gap.y;
    const Arrow slid = {gap.x - p.separation * s.n.x, gap.y - p.separation * s.n.y};
    p.b = {select(s.edge_of_b, p.b.x - slid.x, p.b.x), select(s.edge_of_b, p.b.y - slid.y, p.b.y)};
    p.a = {select(s.edge_of_b, p.a.x, p.a.x + slid.x), select(s.edge_of_b, p.a.y, p.a.y + slid.y)};
    return p;
}

CAROM_INLINE void put(WidePoint& to, const Point& p, const Arrow& n, I8 filled)
{
    const F8 none = all(0);
    store(to.across_a, select(filled, p.a.x * n.y - p.a.y * n.x, none));
    store(to.along_a, select(filled, p.a.x * n.x + p.a.y * n.y, none));
    store(to.across_b, select(filled, p.b.x * n.y - p.b.y * n.x, none));
    store(to.along_b, select(filled, p.b.x * n.x + p.b.y * n.y, none));
    store(to.base, select(filled, p.separation, none));
}

// It bore a load when the last step ended.
CAROM_INLINE I8 bears(const WideRow& row)
{
    I8 loaded = load(row.points[0].normal_impulse) > all(0);
    if (row.count == 2)
        loaded |= load(row.points[1].normal_impulse) > all(0);
    return loaded;
}

// Lanes by what has become of their contacts.
CAROM_INLINE void tell(const WideRow& row, F8 way, F8 separation, I8 filled, const FollowedScene& scene, FollowedRow& found)
{
    const I8 touching = ~lanes_of(row.untold);
    const I8 loaded = bears(row);
    const I8 sure = lanes_of(row.kept) & (way < all(scene.sure_way));
    const I8 near = separation <= select(touching, all(2 * scene.slop), all(scene.slop));
    const I8 borne = loaded & (separation <= all(scene.speculation));
    found.unsure = bits(filled & ~sure);
    found.begins_or_ends = bits(filled & (near != touching));
    found.borne = bits(filled & borne);
    found.sunk = bits(filled & ~borne & (separation < all(-scene.slop)));
    found.unloaded = bits(filled & ~loaded);
    store(found.way, way);
}

void follow(WideRow& row, const FollowedScene& scene, FollowedRow& found)
{
    const Places places(row, scene);
    const I8 filled = load(row.contact) >= I8{};
    const Stand stand(places, lanes_of(row.edge_of_b));
    store(row.nx, select(filled, stand.n.x, all(0)));
    store(row.ny, select(filled, stand.n.y, all(0)));
    const Point first = follow_point(places, 0, stand);
    put(row.points[0], first, stand.n, filled);
    F8 separation = first.separation;
    if (row.count == 2)
    {
        const Point second = follow_point(places, 1, stand);
        put(row.points[1], second, stand.n, filled);
        separation = least(separation, second.separation);
    }
    store(found.separation, separation);
    tell(row, stand.way, separation, filled, scene, found);
}

// The same for eight contacts of two points that are in no row now: into their manifolds.
void follow_contacts(const LaneInts& contacts, Contact* into, const FollowedScene& scene, FollowedContacts& found)
{
    static_assert(offsetof(ManifoldPoint, anchor_b) == offsetof(ManifoldPoint, anchor_a) + 8);
    const Places places(contacts, scene);
    std::uint32_t of_b = 0;
    std::uint32_t touching = 0;
    for (int i = 0; i < lane_count; ++i)
    {
        const Contact& contact = into[contacts.v[i]];
        of_b |= (contact.manifold.points[0].feature >> 31) << i;
        touching |= (contact.flags & contact_flag::touching) != 0 ? 1u << i : 0;
    }
    const Stand stand(places, lanes_of(of_b));
    const auto manifold = [&](int i) -> Manifold& { return into[contacts.v[i]].manifold; };
    LaneFloats nx;
    LaneFloats ny;
    store(nx, stand.n.x);
    store(ny, stand.n.y);
    F8 least_separation = all(3e38f);
    for (std::size_t k = 0; k < 2; ++k)
    {
        const Point p = follow_point(places, k, stand);
        least_separation = least(least_separation, p.separation);
        scatter4([&](int i) { return reinterpret_cast<char*>(&manifold(i).points[k].anchor_a); }, p.a.x, p.a.y, p.b.x, p.b.y);
        LaneFloats separation;
        store(separation, p.separation);
        for (int i = 0; i < lane_count; ++i)
            manifold(i).points[k].separation = separation.v[i];
    }
    for (int i = 0; i < lane_count; ++i)
        manifold(i).normal = {nx.v[i], ny.v[i]};
    const I8 near = least_separation <= all(2 * scene.slop);
    found.sure = bits(stand.way < all(scene.sure_way));
    found.touch_on = bits(near) & touching;
}

// Impulses of a point, side by side in a row, one after the other in a contact.
void take_impulses(const WideRow& row, Contact* contacts)
{
    static_assert(offsetof(ManifoldPoint, tangent_impulse) == offsetof(ManifoldPoint, normal_impulse) + 4 &&
                  offsetof(ManifoldPoint, total_impulse) == offsetof(ManifoldPoint, normal_impulse) + 8 &&
                  offsetof(ManifoldPoint, total_tangent) == offsetof(ManifoldPoint, normal_impulse) + 12);
    alignas(ManifoldPoint) char unused[lane_count * sizeof(F4)];
    I8 loaded{};
    for (int k = 0; k < row.count; ++k)
    {
        const WidePoint& p = row.points[k];
        const F8 normal_impulse = load(p.normal_impulse);
        loaded |= normal_impulse > all(0);
        const auto at = [&](int i)
        {
            return row.contact.v[i] < 0 ? unused + i * static_cast<int>(sizeof(F4))
                                        : reinterpret_cast<char*>(&contacts[row.contact.v[i]].manifold.points[k].normal_impulse);
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
