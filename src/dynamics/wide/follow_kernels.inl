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

// How far any point of b has moved against a since the manifold was found; 3e38 where it has turned too far.
CAROM_INLINE F8 way_since(const Places& places, const Turn& a, const Turn& b, const Arrow& apart, const Arrow& kept_center,
                          const Turn& kept, float sure_cosine)
{
    const Turn now = {a.c * b.c + a.s * b.s, a.c * b.s - a.s * b.c};
    const F8 cosine = now.c * kept.c + now.s * kept.s;
    const F8 sine = now.s * kept.c - now.c * kept.s;
    const Arrow moved = {a.c * apart.x + a.s * apart.y - kept_center.x, a.c * apart.y - a.s * apart.x - kept_center.y};
    LaneFloats extent;
    for (int i = 0; i < lane_count; ++i)
        extent.v[i] = places.b[i]->extent;
    const F8 way = length_of(moved) + load(extent) * length_of({sine, 1 - cosine});
    return select(cosine > all(sure_cosine), way, all(3e38f));
}

CAROM_INLINE I8 lanes_of(std::uint32_t bits)
{
    const auto b = static_cast<std::int32_t>(bits);
    return (I8{b, b, b, b, b, b, b, b} & I8{1, 2, 4, 8, 16, 32, 64, 128}) != I8{};
}

// How the bodies of eight contacts stand to each other, and what is kept of them; as Facing in kept_manifold.cpp.
struct Stand
{
    Arrow n;       ///< from a to b
    Arrow outward; ///< of the edge
    Arrow offset;  ///< from the center of the edge's body to the other's
    Arrow start;
    Arrow corners[2];
    F8 along[2];
    F8 end;
    F8 way, reach, radius;
    I8 edge_of_b;

    CAROM_INLINE Stand(const Places& places, I8 edges_of_b, const FollowedScene& scene) : edge_of_b(edges_of_b)
    {
        static_assert(offsetof(KeptManifold, edge) == 0 && offsetof(KeptManifold, corners) == 16 &&
                      offsetof(KeptManifold, normal) == 32 && offsetof(KeptManifold, center) == 40 &&
                      offsetof(KeptManifold, rotation) == 48 && offsetof(KeptManifold, reach) == 56 &&
                      offsetof(KeptManifold, radius) == 60);
        const auto kept_at = [&](int offset_of)
        { return [&places, offset_of](int i) { return reinterpret_cast<const char*>(places.kept[i]) + offset_of; }; };
        const Turn a = turns_of(places.a);
        const Turn b = turns_of(places.b);
        const Arrow apart = centers_apart(places);
        Arrow normal;
        Arrow kept_center;
        gather4(kept_at(32), normal.x, normal.y, kept_center.x, kept_center.y);
        Turn kept;
        gather4(kept_at(48), kept.c, kept.s, reach, radius);
        way = way_since(places, a, b, apart, kept_center, kept, scene.sure_cosine);
        const Turn own = {select(edge_of_b, b.c, a.c), select(edge_of_b, b.s, a.s)};
        const Turn other = {select(edge_of_b, a.c, b.c), select(edge_of_b, a.s, b.s)};
        n = turned(own, normal);
        outward = {select(edge_of_b, -n.x, n.x), select(edge_of_b, -n.y, n.y)};
        offset = {select(edge_of_b, -apart.x, apart.x), select(edge_of_b, -apart.y, apart.y)};
        Arrow stop;
        gather4(kept_at(0), start.x, start.y, stop.x, stop.y);
        gather4(kept_at(16), corners[0].x, corners[0].y, corners[1].x, corners[1].y);
        start = turned(own, start);
        stop = turned(own, stop);
        const Arrow edge = {stop.x - start.x, stop.y - start.y};
        end = edge.x * edge.x + edge.y * edge.y;
        for (int i = 0; i < 2; ++i)
        {
            const Arrow corner = turned(other, corners[i]);
            corners[i] = {offset.x + corner.x, offset.y + corner.y};
            along[i] = edge.x * (corners[i].x - start.x) + edge.y * (corners[i].y - start.y);
        }
    }

    CAROM_INLINE I8 meets(int points) const
    {
        I8 left = along[0] < all(0);
        I8 right = along[0] > end;
        if (points == 2)
        {
            left &= along[1] < all(0);
            right &= along[1] > end;
        }
        return ~(left | right);
    }
};

struct Point
{
    Arrow a, b; ///< anchors
    F8 separation;
};

CAROM_INLINE Point follow_point(int k, const Stand& s)
{
    const F8 inside = least(greatest(s.along[k], all(0)), s.end);
    const F8 beyond = inside - s.along[k];
    const F8 t = select(beyond != all(0), beyond / (s.along[1 - k] - s.along[k]), all(0));
    const Arrow core = {s.corners[k].x + t * (s.corners[1 - k].x - s.corners[k].x),
                        s.corners[k].y + t * (s.corners[1 - k].y - s.corners[k].y)};
    Point p;
    p.separation = (s.outward.x * (core.x - s.start.x) + s.outward.y * (core.y - s.start.y)) - s.radius;
    const Arrow on_other = {core.x - s.radius * s.outward.x, core.y - s.radius * s.outward.y};
    const Arrow on_edge = {on_other.x - p.separation * s.outward.x, on_other.y - p.separation * s.outward.y};
    const Arrow there = {on_other.x - s.offset.x, on_other.y - s.offset.y};
    p.a = {select(s.edge_of_b, there.x, on_edge.x), select(s.edge_of_b, there.y, on_edge.y)};
    p.b = {select(s.edge_of_b, on_edge.x, there.x), select(s.edge_of_b, on_edge.y, there.y)};
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
CAROM_INLINE void tell(const WideRow& row, const Stand& stand, F8 separation, I8 filled, const FollowedScene& scene, FollowedRow& found)
{
    const I8 touching = ~lanes_of(row.untold);
    const I8 loaded = bears(row);
    I8 sure = lanes_of(row.kept) & (stand.way < all(scene.sure_way)) & stand.meets(row.count);
    if (row.count == 2)
        sure &= stand.way < stand.reach * scene.surely;
    const I8 near = separation <= select(touching, all(2 * scene.slop), all(scene.slop));
    const I8 borne = loaded & (separation <= all(scene.speculation));
    found.unsure = bits(filled & ~sure);
    found.begins_or_ends = bits(filled & (near != touching));
    found.borne = bits(filled & borne);
    found.sunk = bits(filled & ~borne & (separation < all(-scene.slop)));
    found.unloaded = bits(filled & ~loaded);
    store(found.way, stand.way);
    store(found.reach, stand.reach);
}

void follow(WideRow& row, const FollowedScene& scene, FollowedRow& found)
{
    const Places places(row, scene);
    const I8 filled = load(row.contact) >= I8{};
    const Stand stand(places, lanes_of(row.edge_of_b), scene);
    store(row.nx, select(filled, stand.n.x, all(0)));
    store(row.ny, select(filled, stand.n.y, all(0)));
    const Point first = follow_point(0, stand);
    put(row.points[0], first, stand.n, filled);
    F8 separation = first.separation;
    if (row.count == 2)
    {
        const Point second = follow_point(1, stand);
        put(row.points[1], second, stand.n, filled);
        separation = least(separation, second.separation);
    }
    store(found.separation, separation);
    tell(row, stand, separation, filled, scene, found);
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
        of_b |= (contact.flags & contact_flag::edge_of_b) != 0 ? 1u << i : 0;
        touching |= (contact.flags & contact_flag::touching) != 0 ? 1u << i : 0;
    }
    const Stand stand(places, lanes_of(of_b), scene);
    const auto manifold = [&](int i) -> Manifold& { return into[contacts.v[i]].manifold; };
    LaneFloats nx;
    LaneFloats ny;
    store(nx, stand.n.x);
    store(ny, stand.n.y);
    F8 least_separation = all(3e38f);
    for (int k = 0; k < 2; ++k)
    {
        const Point p = follow_point(k, stand);
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
    found.sure = bits((stand.way < all(scene.sure_way)) & (stand.way < stand.reach * scene.surely) & stand.meets(2));
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
