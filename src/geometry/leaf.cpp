// Normalization of shapes, and their conversion to leaves and back.

#include "geometry/leaf.h"

#include "core/refuse.h"
#include "core/trigonometry.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

Vec2 tangent_of_arc(const LeafView& v, Vec2 point)
{
    const Vec2 radial = (1 / v.leaf->arc_radius) * (point - v.leaf->p0);
    return v.span->sweep > 0 ? perp(radial) : -perp(radial);
}

Vec2 tangent_of_segment(const Leaf& leaf) { return normalize(leaf.p1 - leaf.p0); }

} // namespace

Vec2 start_tangent(const LeafView& v)
{
    return v.span == nullptr ? tangent_of_segment(*v.leaf) : tangent_of_arc(v, v.span->start);
}
Vec2 end_tangent(const LeafView& v) { return v.span == nullptr ? tangent_of_segment(*v.leaf) : tangent_of_arc(v, v.span->end); }

Vec2 start_point(const LeafView& v) { return v.span == nullptr ? v.leaf->p0 : v.span->start; }
Vec2 end_point(const LeafView& v) { return v.span == nullptr ? v.leaf->p1 : v.span->end; }

// ---------------------------------------------------------------------------------------------------------------------------------
// Outlines

double signed_area(std::span<const Vec2> outline)
{
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const Vec2 a = outline[i];
        const Vec2 b = outline[(i + 1) % outline.size()];
        twice += static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
    }
    return 0.5 * twice;
}

namespace {

// Twice the area of the triangle, in doubles: floats would lose thin corners far from the origin of the body.
double turn(Vec2 a, Vec2 b, Vec2 c)
{
    const double abx = static_cast<double>(b.x) - a.x;
    const double aby = static_cast<double>(b.y) - a.y;
    const double bcx = static_cast<double>(c.x) - b.x;
    const double bcy = static_cast<double>(c.y) - b.y;
    return abx * bcy - aby * bcx;
}

/// Directions from a corner along which a line leaves all points passed within the tolerance: a cone.
class Line
{
public:
    Line(Vec2 from, double tolerance) : m_from(from), m_tolerance(tolerance) {}

    [[nodiscard]] bool may_end_at(Vec2 p) const
    {
        const Vec2 way = p - m_from;
        const auto far = static_cast<double>(length(way));
        if (far < m_far)
            return false; // the outline goes back
        if (m_far <= m_tolerance)
            return true; // every point so far is within the tolerance of the corner
        const double angle = angle_of(way);
        return angle >= m_least && angle <= m_most;
    }

    void pass(Vec2 p)
    {
        const Vec2 way = p - m_from;
        const auto far = static_cast<double>(length(way));
        m_far = std::max(m_far, far);
        if (far <= m_tolerance)
            return;
        if (m_along == Vec2{})
            m_along = way;
        const double angle = angle_of(way);
        const double reach = m_tolerance / far; // a bound on the sine, which is less than the angle
        m_least = std::max(m_least, angle - reach);
        m_most = std::min(m_most, angle + reach);
    }

private:
    [[nodiscard]] double angle_of(Vec2 way) const
    {
        const double across = static_cast<double>(m_along.x) * way.y - static_cast<double>(m_along.y) * way.x;
        const double along = static_cast<double>(m_along.x) * way.x + static_cast<double>(m_along.y) * way.y;
        return arc_tangent(across, along);
    }

    Vec2 m_from;
    Vec2 m_along{}; ///< displacement to the first point passed outside the tolerance; angles are measured from it
    double m_tolerance;
    double m_far = 0;
    double m_least = -4; ///< rad
    double m_most = 4;
};

// The leftmost point, the lowest of these, is a corner for certain.
std::size_t surely_a_corner(std::span<const Vec2> points)
{
    const auto before = [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
    return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), before) - points.begin());
}

} // namespace

std::vector<Vec2> clean_outline(std::span<const Vec2> outline, float tolerance)
{
    std::vector<Vec2> points(outline.begin(), outline.end());
    if (signed_area(points) < 0)
        points = {points.rbegin(), points.rend()};
    const std::size_t n = points.size();
    if (n < 3)
        return points;
    std::vector<bool> is_kept(n, false);
    std::size_t last = surely_a_corner(points);
    const std::size_t end = last + n;
    is_kept[last] = true;
    while (last < end)
    {
        const Vec2 from = points[last % n];
        Line line(from, static_cast<double>(tolerance));
        std::size_t next = last + 1;
        while (next < end)
        {
            line.pass(points[next % n]);
            if (!line.may_end_at(points[(next + 1) % n]))
                break;
            ++next;
        }
        last = next;
        is_kept[last % n] = true;
    }
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < n; ++i)
    {
        if (is_kept[i])
            kept.push_back(points[i]);
    }
    return kept;
}

bool is_convex(std::span<const Vec2> points)
{
    const std::size_t n = points.size();
    double turned = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
        const Vec2 a = points[i];
        const Vec2 b = points[(i + 1) % n];
        const Vec2 c = points[(i + 2) % n];
        if (turn(a, b, c) <= 0)
            return false;
        turned += arc_tangent(cross(b - a, c - b), dot(b - a, c - b));
    }
    // A star turns left everywhere too, but winds around more than once.
    return turned < 1.5 * 2 * static_cast<double>(pi);
}

// ---------------------------------------------------------------------------------------------------------------------------------
// Normalization: one function per shape, which refuses bad input in the caller's name.

namespace {

// Shapes thinner than this have no useful normals in floats.
constexpr float min_length = 1e-6f;

bool normalize_shape(const Checker& check, Circle& c)
{
    return check.finite("Circle.center", c.center) && check.positive("Circle.radius", c.radius);
}

bool normalize_shape(const Checker& check, Polygon& p)
{
    if (!check.not_negative("Polygon.radius", p.radius))
        return false;
    for (Vec2 v : p.vertices)
    {
        if (!check.finite("Polygon.vertices", v))
            return false;
    }
    float size = 0;
    for (Vec2 v : p.vertices)
        size = std::fmax(size, length(v - p.vertices.front()));
    std::vector<Vec2> clean = clean_outline(p.vertices, std::fmax(1e-5f * size, min_length));
    if (!check.holds(clean.size() >= 3, "Polygon.vertices",
                     std::to_string(p.vertices.size()) + " points, " + std::to_string(clean.size()) + " of them distinct corners",
                     "a polygon needs at least 3 corners that are not in line"))
        return false;
    if (!check.holds(is_convex(clean), "Polygon.vertices", "a concave or self-crossing outline",
                     "must be convex; split_concave splits concave ones"))
        return false;
    p.vertices = std::move(clean);
    return true;
}

bool normalize_shape(const Checker& check, Capsule& c)
{
    return check.finite("Capsule.a", c.a) && check.finite("Capsule.b", c.b) && check.positive("Capsule.radius_a", c.radius_a) &&
           check.positive("Capsule.radius_b", c.radius_b) &&
           check.holds(length(c.b - c.a) > std::fabs(c.radius_a - c.radius_b) + min_length, "Capsule.b", to_text(c.b),
                       "must be farther from a than the radii differ, or one circle holds the other");
}

bool normalize_shape(const Checker& check, Segment& s)
{
    return check.finite("Segment.a", s.a) && check.finite("Segment.b", s.b) &&
           check.not_negative("Segment.half_thickness", s.half_thickness) &&
           check.one_of("Segment.sides", s.sides, Sides::Right) &&
           check.holds(length(s.b - s.a) > min_length, "Segment.b", to_text(s.b), "must differ from a");
}

bool normalize_shape(const Checker& check, Arc& a)
{
    return check.finite("Arc.center", a.center) && check.positive("Arc.radius", a.radius) &&
           check.finite("Arc.start_angle", a.start_angle) && check.in_range("Arc.sweep", a.sweep, -2.0001f * pi, 2.0001f * pi) &&
           check.holds(std::fabs(a.sweep) * a.radius > min_length, "Arc.sweep", to_text(a.sweep), "must not be 0") &&
           check.not_negative("Arc.half_thickness", a.half_thickness) && check.one_of("Arc.sides", a.sides, Sides::Right) &&
           check.holds(a.half_thickness < a.radius, "Arc.half_thickness", to_text(a.half_thickness),
                       "must be less than the radius");
}

bool normalize_shape(const Checker& check, HalfSpace& h)
{
    if (!check.finite("HalfSpace.normal", h.normal) || !check.finite("HalfSpace.offset", h.offset))
        return false;
    const Vec2 unit = normalize(h.normal);
    if (!check.holds(dot(unit, unit) > 0.5f, "HalfSpace.normal", to_text(h.normal), "must not be zero"))
        return false;
    h.normal = unit;
    return true;
}

bool normalize_piece(const Checker& check, Vec2 from, const ChainPiece& piece)
{
    return check.finite("Chain.pieces.end", piece.end) &&
           check.in_range("Chain.pieces.sweep", piece.sweep, -1.999f * pi, 1.999f * pi) &&
           check.holds(length(piece.end - from) > min_length, "Chain.pieces.end", to_text(piece.end),
                       "must differ from the point before it");
}

double chain_area(const Chain& chain);
void reverse_chain(Chain& chain);

bool normalize_shape(const Checker& check, Chain& c)
{
    if (!check.finite("Chain.start", c.start) || !check.one_of("Chain.sides", c.sides, Sides::Right) ||
        !check.not_negative("Chain.half_thickness", c.half_thickness) ||
        !check.holds(!c.pieces.empty(), "Chain.pieces", "empty", "must hold at least one piece"))
        return false;
    Vec2 from = c.start;
    for (const ChainPiece& piece : c.pieces)
    {
        if (!normalize_piece(check, from, piece))
            return false;
        from = piece.end;
    }
    if (!c.closed)
        return true;
    // A last point within rounding of the start is the start; a last point farther away gets a straight piece.
    if (length(from - c.start) <= 1e-5f * std::fmax(1.0f, std::fmax(length(c.start), length(from))))
        c.pieces.back().end = c.start;
    else
        c.pieces.push_back({.end = c.start});
    if (!check.holds(c.pieces.size() >= 2, "Chain.pieces", "one piece", "a closed chain needs at least two"))
        return false;
    if (chain_area(c) < 0)
        reverse_chain(c);
    return true;
}

// The area of the polygon of the corners plus each arc's circular segment, (sweep - sin sweep) r²/2.
double chain_area(const Chain& chain)
{
    std::vector<Vec2> corners;
    double bulges = 0;
    Vec2 from = chain.start;
    for (const ChainPiece& piece : chain.pieces)
    {
        corners.push_back(piece.end);
        if (piece.sweep != 0)
        {
            const double chord = length(piece.end - from);
            const double radius = chord / (2 * sin_cos(0.5 * static_cast<double>(piece.sweep)).sin);
            bulges += 0.5 * radius * radius * (static_cast<double>(piece.sweep) - sin_cos(piece.sweep).sin);
        }
        from = piece.end;
    }
    return signed_area(corners) + bulges;
}

void reverse_chain(Chain& chain)
{
    Chain reversed = chain;
    reversed.pieces.clear();
    for (std::size_t i = chain.pieces.size(); i-- > 0;)
    {
        const Vec2 end = i == 0 ? chain.start : chain.pieces[i - 1].end;
        reversed.pieces.push_back({.end = end, .sweep = -chain.pieces[i].sweep});
    }
    chain = reversed;
}

} // namespace

bool normalize_geometry(const char* function, Geometry& geometry)
{
    const Checker check{function};
    return std::visit([&](auto& shape) { return normalize_shape(check, shape); }, geometry);
}

// ---------------------------------------------------------------------------------------------------------------------------------
// Leaves

namespace {

Vec2 direction(double angle)
{
    const SinCos sc = sin_cos(angle);
    return {static_cast<float>(sc.cos), static_cast<float>(sc.sin)};
}

Leaf make_segment(Vec2 a, Vec2 b, float half_thickness, Sides sides)
{
    Leaf leaf;
    leaf.type = LeafType::Segment;
    leaf.sides = sides;
    leaf.p0 = a;
    leaf.p1 = b;
    leaf.r0 = leaf.r1 = half_thickness;
    return leaf;
}

struct ArcEnds
{
    Vec2 start;
    Vec2 end;
};

ArcEnds ends_of(const Arc& arc)
{
    const auto at = [&](double angle) { return arc.center + arc.radius * direction(angle); };
    return {at(arc.start_angle), at(static_cast<double>(arc.start_angle) + static_cast<double>(arc.sweep))};
}

Leaf make_arc(const Arc& arc, const ArcEnds& ends, LeafStore& store)
{
    Leaf leaf;
    leaf.type = LeafType::Arc;
    leaf.sides = arc.sides;
    leaf.p0 = arc.center;
    leaf.r0 = arc.half_thickness;
    leaf.arc_radius = arc.radius;
    const double half = 0.5 * static_cast<double>(arc.sweep);
    leaf.p1 = direction(static_cast<double>(arc.start_angle) + half);
    const float cos_half_sweep = std::fabs(arc.sweep) >= 2 * pi ? -2.0f : static_cast<float>(sin_cos(half).cos);
    leaf.first = store.add_span({arc.start_angle, arc.sweep, cos_half_sweep, ends.start, ends.end});
    return leaf;
}

// The center is the middle of the chord, offset to its left by the distance chord/2 / tan(sweep/2).
Leaf make_chain_arc(Vec2 from, Vec2 to, float sweep, float half_thickness, Sides sides, LeafStore& store)
{
    const SinCos half = sin_cos(0.5 * static_cast<double>(sweep));
    const double cx = static_cast<double>(to.x) - from.x;
    const double cy = static_cast<double>(to.y) - from.y;
    const double chord = std::sqrt(cx * cx + cy * cy);
    const double cotangent = half.cos / half.sin;
    const double mx = 0.5 * (static_cast<double>(from.x) + to.x) - 0.5 * cy * cotangent;
    const double my = 0.5 * (static_cast<double>(from.y) + to.y) + 0.5 * cx * cotangent;
    const Arc arc{.center = {static_cast<float>(mx), static_cast<float>(my)},
                  .radius = static_cast<float>(std::fabs(chord / (2 * half.sin))),
                  .start_angle = static_cast<float>(arc_tangent(from.y - my, from.x - mx)),
                  .sweep = sweep,
                  .half_thickness = half_thickness,
                  .sides = sides};
    return make_arc(arc, {from, to}, store);
}

std::vector<Leaf> leaves_of(const Circle& c, LeafStore&)
{
    Leaf leaf;
    leaf.type = LeafType::Circle;
    leaf.p0 = c.center;
    leaf.r0 = c.radius;
    return {leaf};
}

std::vector<Leaf> leaves_of(const Polygon& p, LeafStore& store)
{
    Leaf leaf;
    leaf.type = LeafType::Polygon;
    leaf.r0 = leaf.r1 = p.radius;
    leaf.count = static_cast<std::int32_t>(p.vertices.size());
    leaf.first = store.add_outline(p.vertices);
    return {leaf};
}

std::vector<Leaf> leaves_of(const Capsule& c, LeafStore&)
{
    Leaf leaf;
    leaf.type = LeafType::Capsule;
    leaf.p0 = c.a;
    leaf.p1 = c.b;
    leaf.r0 = c.radius_a;
    leaf.r1 = c.radius_b;
    return {leaf};
}

std::vector<Leaf> leaves_of(const Segment& s, LeafStore&) { return {make_segment(s.a, s.b, s.half_thickness, s.sides)}; }
std::vector<Leaf> leaves_of(const Arc& a, LeafStore& store) { return {make_arc(a, ends_of(a), store)}; }

std::vector<Leaf> leaves_of(const HalfSpace& h, LeafStore&)
{
    Leaf leaf;
    leaf.type = LeafType::HalfSpace;
    leaf.p0 = h.normal;
    leaf.r0 = h.offset;
    return {leaf};
}

std::vector<Leaf> leaves_of(const Chain& c, LeafStore& store)
{
    std::vector<Leaf> leaves;
    Vec2 from = c.start;
    for (const ChainPiece& piece : c.pieces)
    {
        leaves.push_back(piece.sweep == 0 ? make_segment(from, piece.end, c.half_thickness, c.sides)
                                          : make_chain_arc(from, piece.end, piece.sweep, c.half_thickness, c.sides, store));
        from = piece.end;
    }
    const std::size_t n = leaves.size();
    for (std::size_t i = 0; i < n; ++i)
    {
        if (i > 0 || c.closed)
        {
            leaves[i].has_previous = true;
            leaves[i].previous_tangent = end_tangent(view(leaves[(i + n - 1) % n], store));
        }
        if (i + 1 < n || c.closed)
        {
            leaves[i].has_next = true;
            leaves[i].next_tangent = start_tangent(view(leaves[(i + 1) % n], store));
        }
    }
    return leaves;
}

} // namespace

std::vector<Leaf> make_leaves(const Geometry& geometry, LeafStore& store)
{
    return std::visit([&](const auto& shape) { return leaves_of(shape, store); }, geometry);
}

Geometry geometry_of(const LeafView& v)
{
    const Leaf& leaf = *v.leaf;
    switch (leaf.type)
    {
    case LeafType::HalfSpace: return HalfSpace{leaf.p0, leaf.r0};
    case LeafType::Circle: return Circle{leaf.p0, leaf.r0};
    case LeafType::Polygon: return Polygon{{v.points, v.points + leaf.count}, leaf.r0};
    case LeafType::Capsule: return Capsule{leaf.p0, leaf.p1, leaf.r0, leaf.r1};
    case LeafType::Segment: return Segment{leaf.p0, leaf.p1, leaf.r0, leaf.sides};
    case LeafType::Arc: return Arc{leaf.p0, leaf.arc_radius, v.span->start_angle, v.span->sweep, leaf.r0, leaf.sides};
    }
    return {};
}

Chain chain_of(std::span<const LeafView> pieces)
{
    const Leaf& first = *pieces.front().leaf;
    Chain chain{
        .start = start_point(pieces.front()), .closed = first.has_previous, .half_thickness = first.r0, .sides = first.sides};
    for (const LeafView& piece : pieces)
        chain.pieces.push_back({end_point(piece), piece.span == nullptr ? 0 : piece.span->sweep});
    return chain;
}

} // namespace carom::internal

namespace carom {

Polygon box(float half_width, float half_height, Vec2 center, float angle, float radius)
{
    const internal::Checker check{"box"};
    if (!check.positive("half_width", half_width) || !check.positive("half_height", half_height) ||
        !check.finite("center", center) || !check.finite("angle", angle) || !check.not_negative("radius", radius))
        return {};
    const Rotation q = Rotation::from_angle(angle);
    const Vec2 x = rotate(q, {half_width, 0});
    const Vec2 y = rotate(q, {0, half_height});
    return {.vertices = {center - x - y, center + x - y, center + x + y, center - x + y}, .radius = radius};
}

} // namespace carom
