// Follows cached manifolds in the lanes of their constraints; manifold_cache.cpp
// does the same for one at a time, and says what is cached. Part of kernels.inl.

namespace follows {

using carom::internal::select;

// The lane whose data empty lanes read as well.
CAROM_INLINE int filled_lane(const LaneInts& contacts)
{
    int some = 0;
    for (int i = 0; i < lane_count; ++i)
        some = contacts.v[i] < 0 ? some : i;
    return some;
}

CAROM_INLINE LaneInts with_all_lanes(LaneInts contacts)
{
    const int some = filled_lane(contacts);
    for (std::int32_t& contact : contacts.v)
        contact = contact < 0 ? contacts.v[some] : contact;
    return contacts;
}

// The cached manifolds of eight contacts, and their bodies.
struct Places
{
    const CachedManifold* cached[lane_count];
    const BodySim* a[lane_count];
    const BodySim* b[lane_count];

    CAROM_INLINE Places(const WideContactNotes& notes, const FollowedScene& scene)
    {
        const int some = filled_lane(notes.contact);
        for (int i = 0; i < lane_count; ++i)
        {
            const int lane = notes.contact.v[i] < 0 ? some : i;
            cached[i] = scene.cached + notes.contact.v[lane];
            a[i] = scene.sims + notes.body_a.v[lane];
            b[i] = scene.sims + notes.body_b.v[lane];
        }
    }

    CAROM_INLINE Places(const LaneInts& contacts, const FollowedScene& scene)
    {
        for (int i = 0; i < lane_count; ++i)
        {
            const Contact& contact = scene.contacts[contacts.v[i]];
            cached[i] = scene.cached + contacts.v[i];
            a[i] = scene.sims + contact.body_a;
            b[i] = scene.sims + contact.body_b;
        }
    }
};

struct Arrow
{
    F8 x, y;
};

CAROM_INLINE F8 dot(const Arrow& v, const Arrow& w) { return v.x * w.x + v.y * w.y; }

CAROM_INLINE Arrow select(I8 mask, const Arrow& v, const Arrow& w)
{
    return {select(mask, v.x, w.x), select(mask, v.y, w.y)};
}

CAROM_INLINE Turn select(I8 mask, const Turn& p, const Turn& q)
{
    return {select(mask, p.c, q.c), select(mask, p.s, q.s)};
}

CAROM_INLINE Arrow turned(const Turn& q, const Arrow& v) { return {q.c * v.x - q.s * v.y, q.s * v.x + q.c * v.y}; }

// The vector from center to center, subtracted in double.
CAROM_INLINE Arrow centers_apart(const Places& places)
{
    const auto apart = [&](int i) { return load2(&places.b[i]->center.x) - load2(&places.a[i]->center.x); };
    Arrow arrow;
    round_pairs(apart, arrow.x, arrow.y);
    return arrow;
}

CAROM_INLINE F8 length_of(const Arrow& v) { return root(v.x * v.x + v.y * v.y); }

// Two bodies; a cached manifold lies in the axes of the own one.
struct Two
{
    Turn a, b;
    Arrow apart; ///< from the center of a to that of b
    I8 own_is_b;
    Turn own, other;
    Arrow offset; ///< from the own center to the other's

    CAROM_INLINE Two(const Places& places, I8 seen_from_b)
        : a(turns_of(places.a)), b(turns_of(places.b)), apart(centers_apart(places)), own_is_b(seen_from_b),
          own(select(own_is_b, b, a)), other(select(own_is_b, a, b)), offset(select(own_is_b, {-apart.x, -apart.y}, apart))
    {}
};

// How the other body has moved relative to the own one since the manifold was cached.
struct Change
{
    Arrow displacement; ///< of its center
    F8 cosine, sine;

    CAROM_INLINE Change(const Two& two, const Arrow& center, const Turn& then)
    {
        const Turn& own = two.own;
        const Turn& other = two.other;
        const Turn now = {own.c * other.c + own.s * other.s, own.c * other.s - own.s * other.c};
        displacement = {own.c * two.offset.x + own.s * two.offset.y - center.x, own.c * two.offset.y - own.s * two.offset.x - center.y};
        cosine = now.c * then.c + now.s * then.s;
        sine = now.s * then.c - now.c * then.s;
    }

    // The chord of the rotation on a circle of radius 1.
    CAROM_INLINE F8 chord() const { return length_of({sine, 1 - cosine}); }
};

CAROM_INLINE I8 lanes_of(std::uint32_t bits)
{
    return (all_ints(bits) & eight_of(1, 2, 4, 8, 16, 32, 64, 128)) != I8{};
}

// The cached manifolds of eight contacts, as they lie in memory.
struct Cached
{
    Arrow first[2];  ///< the edge, or both corners
    Arrow second[2]; ///< the corners that face the edge, or the cones of both
    Arrow last;      ///< the normal, or both radii
    Arrow center;
    Turn rotation;
    F8 reach, radius;

    CAROM_INLINE explicit Cached(const Places& places)
    {
        static_assert(offsetof(CachedManifold, found) == 0 &&
                      offsetof(CachedManifold, center) == 40 && offsetof(CachedManifold, rotation) == 48 &&
                      offsetof(CachedManifold, reach) == 56 && offsetof(CachedManifold, radius) == 60);
        static_assert(offsetof(CachedEdge, corners) == 16 && offsetof(CachedEdge, normal) == 32 && offsetof(CachedCorners, cones) == 16 &&
                      offsetof(CachedCorners, radii) == 32);
        const auto at = [&](int offset)
        { return [&places, offset](int i) { return reinterpret_cast<const char*>(places.cached[i]) + offset; }; };
        gather4(at(0), first[0].x, first[0].y, first[1].x, first[1].y);
        gather4(at(16), second[0].x, second[0].y, second[1].x, second[1].y);
        gather4(at(32), last.x, last.y, center.x, center.y);
        gather4(at(48), rotation.c, rotation.s, reach, radius);
    }
};

struct Point
{
    Arrow a, b; ///< anchors
    F8 separation;
    I8 inside; ///< it is the corner itself that faces the edge
};

// The relative placement of the bodies of eight contacts, and of an edge and the corners that face it; as Facing in manifold_cache.cpp.
struct Stand : Two
{
    Arrow n;       ///< from a to b
    Arrow outward; ///< of the edge
    Arrow start;
    Arrow corners[2];
    F8 along[2];
    F8 end;
    F8 reach, radius;
    F8 displacement; ///< bound for any point of the other relative to the edge's body, since the manifold was found
    F8 cosine; ///< of the relative rotation since then

    CAROM_INLINE Stand(const Places& places, const Cached& cached, std::uint32_t edges_of_b)
        : Two(places, lanes_of(edges_of_b)), reach(cached.reach), radius(cached.radius)
    {
        n = turned(own, cached.last);
        outward = select(own_is_b, {-n.x, -n.y}, n);
        start = turned(own, cached.first[0]);
        const Arrow stop = turned(own, cached.first[1]);
        const Arrow edge = {stop.x - start.x, stop.y - start.y};
        end = edge.x * edge.x + edge.y * edge.y;
        for (int i = 0; i < 2; ++i)
        {
            const Arrow corner = turned(other, cached.second[i]);
            corners[i] = {offset.x + corner.x, offset.y + corner.y};
            along[i] = edge.x * (corners[i].x - start.x) + edge.y * (corners[i].y - start.y);
        }
        const F8 extent = lanes_from([&](int i) { return ((edges_of_b >> i & 1u) != 0 ? places.a : places.b)[i]->extent; });
        const Change change(*this, cached.center, cached.rotation);
        displacement = length_of(change.displacement) + extent * change.chord();
        cosine = change.cosine;
    }

    CAROM_INLINE I8 meets() const
    {
        return ~(((along[0] < all(0)) & (along[1] < all(0))) | ((along[0] > end) & (along[1] > end)));
    }

    CAROM_INLINE I8 is_steep() const
    {
        const F8 rise = outward.x * (corners[1].x - corners[0].x) + outward.y * (corners[1].y - corners[0].y);
        const F8 run = along[1] - along[0];
        return rise * rise * end > run * run;
    }

    CAROM_INLINE I8 is_round() const { return (corners[0].x == corners[1].x) & (corners[0].y == corners[1].y); }
};

CAROM_INLINE Point follow_point(int k, const Stand& s)
{
    const F8 inside = least(greatest(s.along[k], all(0)), s.end);
    const F8 beyond = inside - s.along[k];
    const F8 t = select(beyond != all(0), beyond / (s.along[1 - k] - s.along[k]), all(0));
    const Arrow core = {s.corners[k].x + t * (s.corners[1 - k].x - s.corners[k].x),
                        s.corners[k].y + t * (s.corners[1 - k].y - s.corners[k].y)};
    Point p;
    p.inside = beyond == all(0);
    p.separation = (s.outward.x * (core.x - s.start.x) + s.outward.y * (core.y - s.start.y)) - s.radius;
    const Arrow on_other = {core.x - s.radius * s.outward.x, core.y - s.radius * s.outward.y};
    const Arrow on_edge = {on_other.x - p.separation * s.outward.x, on_other.y - p.separation * s.outward.y};
    const Arrow there = {on_other.x - s.offset.x, on_other.y - s.offset.y};
    p.a = select(s.own_is_b, there, on_edge);
    p.b = select(s.own_is_b, on_edge, there);
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

// Lanes that bore a load when the last step ended.
CAROM_INLINE I8 bears(const WideContact& constraint, int points)
{
    I8 loaded = load(constraint.points[0].normal_impulse) > all(0);
    if (points == 2)
        loaded |= load(constraint.points[1].normal_impulse) > all(0);
    return loaded;
}

// The result of following eight manifolds.
struct Found
{
    Arrow n;
    Point points[2];
    F8 separation; ///< the least
    F8 second;     ///< with one point: that of a potential second one
    F8 displacement, reach;
    I8 holds; ///< the cached manifold is still valid
};

CAROM_INLINE I8 is_best_still(const Stand& s, I8 inside, F8 lowest, const FollowedScene& scene)
{
    const I8 is_outside = inside & (lowest + s.radius > all(0));
    return is_outside | ((s.displacement < all(scene.sure_displacement)) & (s.cosine > all(scene.sure_cosine)));
}

// Flags of eight contacts, as bits of lanes.
struct Kinds
{
    std::uint32_t edge_of_b = 0;
    std::uint32_t nearest = 0;
};

// Contacts from corner to corner, as Nearest in manifold_cache.cpp.
CAROM_INLINE void take_nearest(I8 lanes, const Cached& cached, const Stand& s, Found& found)
{
    const Arrow from = turned(s.a, cached.first[0]);
    const Arrow to = turned(s.b, cached.first[1]);
    const Arrow gap = {s.apart.x + to.x - from.x, s.apart.y + to.y - from.y};
    const F8 distance = length_of(gap);
    const Arrow n = {gap.x / distance, gap.y / distance};
    const F8 separation = distance - (cached.last.x + cached.last.y);
    const Arrow back = {-n.x, -n.y};
    const I8 leads_out = (distance > all(CachedCorners::least_distance)) &
                         (dot(n, turned(s.a, cached.second[0])) >= dot(cached.second[0], cached.second[0])) &
                         (dot(back, turned(s.b, cached.second[1])) >= dot(cached.second[1], cached.second[1]));
    Point& p = found.points[0];
    found.n = select(lanes, n, found.n);
    p.a = select(lanes, {from.x + cached.last.x * n.x, from.y + cached.last.x * n.y}, p.a);
    p.b = select(lanes, {to.x - cached.last.y * n.x, to.y - cached.last.y * n.y}, p.b);
    p.separation = found.separation = select(lanes, separation, p.separation);
    found.second = select(lanes, all(3e38f), found.second);
    found.displacement = select(lanes, all(0), found.displacement);
    found.reach = select(lanes, all(3e38f), found.reach);
    found.holds = (found.holds & ~lanes) | (leads_out & lanes);
}

// The margin within which there are points: as margin_of in manifold_cache.cpp.
CAROM_INLINE F8 margins_of(const LaneInts& contacts, const FollowedScene& scene)
{
    static_assert(offsetof(SweptBox, path) == 0 && offsetof(BoxPath, shift) == 16 && offsetof(BoxPath, any_displacement) == 24);
    F8 ax, ay, displacement_a, bx, by, displacement_b, unused;
    const auto path_of = [&](std::int32_t shape) { return reinterpret_cast<const char*>(scene.boxes + shape) + 16; };
    gather4([&](int i) { return path_of(scene.contacts[contacts.v[i]].shape_a); }, ax, ay, displacement_a, unused);
    gather4([&](int i) { return path_of(scene.contacts[contacts.v[i]].shape_b); }, bx, by, displacement_b, unused);
    return all(scene.speculation) + (length_of({bx - ax, by - ay}) + displacement_a + displacement_b);
}

// True where the single point gets no second one and would be found again: as has_one_point in manifold_cache.cpp.
CAROM_INLINE I8 are_alone(const Found& now, F8 margin, const FollowedScene& scene)
{
    return (margin + now.displacement < all(scene.surely) * now.reach) & (now.separation <= margin) & (now.second > margin);
}

template <int points>
CAROM_INLINE Found follow_points(const Places& places, const Kinds& kinds, const FollowedScene& scene)
{
    const Cached cached(places);
    const Stand stand(places, cached, kinds.edge_of_b);
    Found found;
    found.n = stand.n;
    found.displacement = stand.displacement;
    found.reach = stand.reach;
    found.points[0] = follow_point(0, stand);
    found.points[1] = follow_point(1, stand);
    const F8 first = found.points[0].separation;
    const F8 second = found.points[1].separation;
    if (points == 2)
    {
        const I8 second_is_lower = second < first;
        found.separation = select(second_is_lower, second, first);
        const I8 inside = (second_is_lower & found.points[1].inside) | (~second_is_lower & found.points[0].inside);
        found.holds = stand.meets() & (inside | ~stand.is_steep()) & (found.separation < all(scene.sure_displacement)) & (found.displacement < found.reach * scene.surely) & is_best_still(stand, inside, found.separation, scene);
        return found;
    }
    found.separation = first;
    found.second = select(stand.is_round(), all(3e38f), second);
    found.holds = found.points[0].inside & is_best_still(stand, found.points[0].inside, first, scene);
    if (kinds.nearest != 0)
        take_nearest(lanes_of(kinds.nearest), cached, stand, found);
    return found;
}

// Sorts lanes by what has become of their contacts.
CAROM_INLINE void report(I8 loaded, const WideContactNotes& notes, const Found& now, I8 filled, const FollowedScene& scene, RefreshedContacts& found)
{
    const I8 touching = ~lanes_of(notes.unreported);
    const I8 near = now.separation <= select(touching, all(2 * scene.slop), all(scene.slop));
    const I8 borne = loaded & (now.separation <= all(scene.speculation));
    found.unsure = bits(filled & ~(lanes_of(notes.cached) & now.holds));
    found.begins_or_ends = bits(filled & (near != touching));
    found.borne = bits(filled & borne);
    found.sunk = bits(filled & ~borne & (now.separation < all(-scene.slop)));
    store(found.separation, now.separation);
}

template <int points>
void refresh_contact(WideContact& constraint, const WideContactNotes& notes, const FollowedScene& scene, RefreshedContacts& found)
{
    const Places places(notes, scene);
    const I8 filled = load(notes.contact) >= I8{};
    Found now = follow_points<points>(places, {notes.edge_of_b, notes.nearest}, scene);
    if (points == 1)
        now.holds &= are_alone(now, margins_of(with_all_lanes(notes.contact), scene), scene);
    store(constraint.nx, select(filled, now.n.x, all(0)));
    store(constraint.ny, select(filled, now.n.y, all(0)));
    for (int k = 0; k < points; ++k)
        put(constraint.points[k], now.points[k], now.n, filled);
    report(bears(constraint, points), notes, now, filled, scene, found);
}

void follow(WideContact& constraint, const WideContactNotes& notes, const FollowedScene& scene, RefreshedContacts& found)
{
    const auto follow_points_of = notes.count == 2 ? refresh_contact<2> : refresh_contact<1>;
    follow_points_of(constraint, notes, scene, found);
}

CAROM_INLINE std::uint32_t lanes_with_flag(const LaneInts& contacts, const FollowedScene& scene, std::uint32_t flag)
{
    std::uint32_t lanes = 0;
    for (int i = 0; i < lane_count; ++i)
        lanes |= (scene.contacts[contacts.v[i]].flags & flag) != 0 ? 1u << i : 0;
    return lanes;
}

// The same for eight contacts that have the same number of points and are in no constraint now: writes into their manifolds.
template <int points>
void follow_eight(const LaneInts& contacts, Contact* into, const FollowedScene& scene, FollowedContacts& found)
{
    static_assert(offsetof(ManifoldPoint, anchor_b) == offsetof(ManifoldPoint, anchor_a) + 8);
    const Places places(contacts, scene);
    const Kinds kinds = {lanes_with_flag(contacts, scene, contact_flag::edge_of_b),
                         lanes_with_flag(contacts, scene, contact_flag::nearest)};
    Found now = follow_points<points>(places, kinds, scene);
    if (points == 1)
        now.holds &= are_alone(now, margins_of(contacts, scene), scene);
    const auto manifold = [&](int i) -> Manifold& { return into[contacts.v[i]].manifold; };
    for (int k = 0; k < points; ++k)
    {
        const Point& p = now.points[k];
        scatter4([&](int i) { return reinterpret_cast<char*>(&manifold(i).points[k].anchor_a); }, p.a.x, p.a.y, p.b.x, p.b.y);
        LaneFloats separation;
        store(separation, p.separation);
        for (int i = 0; i < lane_count; ++i)
            manifold(i).points[k].separation = separation.v[i];
    }
    LaneFloats nx;
    LaneFloats ny;
    store(nx, now.n.x);
    store(ny, now.n.y);
    for (int i = 0; i < lane_count; ++i)
        manifold(i).normal = {nx.v[i], ny.v[i]};
    const I8 near = now.separation <= all(2 * scene.slop);
    found.sure = bits(now.holds);
    found.touch_on = bits(near) & lanes_with_flag(contacts, scene, contact_flag::touching);
}

void follow_contacts(const LaneInts& contacts, int points, Contact* into, const FollowedScene& scene, FollowedContacts& found)
{
    const auto follow_points_of = points == 2 ? follow_eight<2> : follow_eight<1>;
    follow_points_of(contacts, into, scene, found);
}

// Tests along the direction that parted the bodies, or with the whole displacement if
// none is known: as room() in manifold_cache.cpp, which decides close cases.
std::uint32_t stay_apart(const LaneInts& contacts, const FollowedScene& scene)
{
    static_assert(offsetof(CachedParting, direction) == 0 && offsetof(CachedParting, arm) == 8);
    constexpr float rounding = 1e-5f;
    const Places places(contacts, scene);
    const auto kept_at = [&](int offset)
    { return [&places, offset](int i) { return reinterpret_cast<const char*>(places.cached[i]) + offset; }; };
    Arrow direction, center;
    Turn cached;
    F8 arm, reach, unused, unused_too;
    gather4(kept_at(0), direction.x, direction.y, arm, unused);
    gather4(kept_at(32), unused, unused_too, center.x, center.y);
    gather4(kept_at(48), cached.c, cached.s, reach, unused);
    const Two two(places, lanes_of(lanes_with_flag(contacts, scene, contact_flag::edge_of_b)));
    const Change change(two, center, cached);
    const I8 any_direction = (direction.x == all(0)) & (direction.y == all(0));
    const F8 gain = select(any_direction, -length_of(change.displacement), dot(direction, change.displacement));
    const F8 room = reach + gain - arm * change.chord();
    const F8 slack = rounding * (length_of(two.offset) + reach + arm);
    return bits(margins_of(contacts, scene) + slack < room);
}

// Copies the impulses of each point, which are side by side in a constraint and one after the other in a contact.
void take_impulses(const WideContact& constraint, WideContactNotes& notes, Contact* contacts, ContactImpulses* impulses)
{
    static_assert(sizeof(PointImpulses) == 4 * sizeof(float) && offsetof(PointImpulses, normal) == 0 && offsetof(PointImpulses, tangent) == 4 &&
                  offsetof(PointImpulses, total_normal) == 8);
    PointImpulses unused[lane_count];
    I8 loaded{};
    for (int k = 0; k < notes.count; ++k)
    {
        const WidePoint& p = constraint.points[k];
        const F8 normal_impulse = load(p.normal_impulse);
        loaded |= normal_impulse > all(0);
        const auto at = [&](int i)
        { return reinterpret_cast<char*>(notes.contact.v[i] < 0 ? unused + i : impulses[notes.contact.v[i]].points + k); };
        scatter4(at, normal_impulse, load(p.tangent_impulse), load(p.total_impulse), load(p.total_tangent));
    }
    const unsigned bears = bits(loaded & (load(notes.contact) >= I8{}));
    for (unsigned changed = bears ^ notes.loaded; changed != 0; changed &= changed - 1)
        contacts[notes.contact.v[std::countr_zero(changed)]].flags ^= contact_flag::loaded;
    notes.loaded = bears;
}

} // namespace follows
