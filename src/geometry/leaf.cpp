#include "geometry/leaf.h"

#include "core/grow.h"
#include "core/refuse.h"
#include "core/trigonometry.h"

#include <cmath>

namespace carom::internal {

int VertexStore::allocate(int count)
{
    for (std::size_t i = 0; i < m_holes.size(); ++i)
    {
        if (m_holes[i].count == count)
        {
            const int first = m_holes[i].first;
            m_holes.erase(m_holes.begin() + static_cast<std::ptrdiff_t>(i));
            return first;
        }
    }
    const int first = static_cast<int>(m_points.size());
    grow(m_points, m_points.size() + static_cast<std::size_t>(count));
    grow(m_normals, m_points.size());
    return first;
}

void VertexStore::release(int first, int count) { m_holes.push_back({first, count}); }

Vec2 start_tangent(const Leaf& leaf)
{
    if (leaf.type == LeafType::Segment)
        return normalize(leaf.p1 - leaf.p0);
    const Vec2 radial = (1 / leaf.arc_radius) * (leaf.arc_start - leaf.p0);
    return leaf.sweep > 0 ? perp(radial) : -perp(radial);
}

Vec2 end_tangent(const Leaf& leaf)
{
    if (leaf.type == LeafType::Segment)
        return normalize(leaf.p1 - leaf.p0);
    const Vec2 radial = (1 / leaf.arc_radius) * (leaf.arc_end - leaf.p0);
    return leaf.sweep > 0 ? perp(radial) : -perp(radial);
}

Vec2 start_point(const Leaf& leaf) { return leaf.type == LeafType::Segment ? leaf.p0 : leaf.arc_start; }
Vec2 end_point(const Leaf& leaf) { return leaf.type == LeafType::Segment ? leaf.p1 : leaf.arc_end; }

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

// Twice the area of the triangle in double: floats would lose thin corners far from the origin of the body.
double turn(Vec2 a, Vec2 b, Vec2 c)
{
    const double abx = static_cast<double>(b.x) - a.x;
    const double aby = static_cast<double>(b.y) - a.y;
    const double bcx = static_cast<double>(c.x) - b.x;
    const double bcy = static_cast<double>(c.y) - b.y;
    return abx * bcy - aby * bcx;
}

bool is_redundant(Vec2 a, Vec2 b, Vec2 c, float tolerance)
{
    if (length(b - a) <= tolerance)
        return true;
    const float base = length(c - a);
    return base > 0 && std::fabs(turn(a, b, c)) <= static_cast<double>(tolerance) * base && dot(b - a, c - b) >= 0;
}

} // namespace

std::vector<Vec2> clean_outline(std::span<const Vec2> outline, float tolerance)
{
    std::vector<Vec2> points(outline.begin(), outline.end());
    if (signed_area(points) < 0)
        points = {points.rbegin(), points.rend()};
    for (std::size_t i = 0; i < points.size() && points.size() >= 3;)
    {
        const std::size_t n = points.size();
        if (is_redundant(points[(i + n - 1) % n], points[i], points[(i + 1) % n], tolerance))
        {
            points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
            i = i > 0 ? i - 1 : 0;
        }
        else
        {
            ++i;
        }
    }
    return points;
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
    // A star turns left everywhere too, but more than once around.
    return turned < 1.5 * 2 * static_cast<double>(pi);
}

// ---------------------------------------------------------------------------------------------------------------------------------
// Normalisation: one function per shape, refusing in the caller's name.

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
           check.holds(length(s.b - s.a) > min_length, "Segment.b", to_text(s.b), "must differ from a");
}

bool normalize_shape(const Checker& check, Arc& a)
{
    return check.finite("Arc.center", a.center) && check.positive("Arc.radius", a.radius) &&
           check.finite("Arc.start_angle", a.start_angle) && check.in_range("Arc.sweep", a.sweep, -2.0001f * pi, 2.0001f * pi) &&
           check.holds(std::fabs(a.sweep) * a.radius > min_length, "Arc.sweep", to_text(a.sweep), "must not be 0") &&
           check.not_negative("Arc.half_thickness", a.half_thickness) &&
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
    if (!check.finite("Chain.start", c.start) || !check.not_negative("Chain.half_thickness", c.half_thickness) ||
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
    // A last point within rounding of the start is the start; anything farther gets a straight piece.
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

// The polygon of the corners plus each arc's circular segment, (sweep - sin sweep) r²/2.
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

Leaf make_arc(const Arc& arc)
{
    Leaf leaf;
    leaf.type = LeafType::Arc;
    leaf.sides = arc.sides;
    leaf.p0 = arc.center;
    leaf.r0 = arc.half_thickness;
    leaf.arc_radius = arc.radius;
    leaf.start_angle = arc.start_angle;
    leaf.sweep = arc.sweep;
    const double half = 0.5 * static_cast<double>(arc.sweep);
    leaf.p1 = direction(static_cast<double>(arc.start_angle) + half);
    leaf.cos_half_sweep = std::fabs(arc.sweep) >= 2 * pi ? -2.0f : static_cast<float>(sin_cos(half).cos);
    leaf.arc_start = arc.center + arc.radius * direction(arc.start_angle);
    leaf.arc_end = arc.center + arc.radius * direction(static_cast<double>(arc.start_angle) + static_cast<double>(arc.sweep));
    return leaf;
}

// Center = middle of the chord, offset along its left by the distance chord/2 / tan(sweep/2).
Leaf make_chain_arc(Vec2 from, Vec2 to, float sweep, float half_thickness, Sides sides)
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
    Leaf leaf = make_arc(arc);
    leaf.arc_start = from;
    leaf.arc_end = to;
    return leaf;
}

std::vector<Leaf> leaves_of(const Circle& c, VertexStore&)
{
    Leaf leaf;
    leaf.type = LeafType::Circle;
    leaf.p0 = c.center;
    leaf.r0 = c.radius;
    return {leaf};
}

std::vector<Leaf> leaves_of(const Polygon& p, VertexStore& store)
{
    Leaf leaf;
    leaf.type = LeafType::Polygon;
    leaf.r0 = leaf.r1 = p.radius;
    leaf.count = static_cast<std::int32_t>(p.vertices.size());
    leaf.first = store.allocate(leaf.count);
    Vec2* points = store.points(leaf.first);
    Vec2* normals = store.normals(leaf.first);
    for (int i = 0; i < leaf.count; ++i)
        points[i] = p.vertices[static_cast<std::size_t>(i)];
    for (int i = 0; i < leaf.count; ++i)
        normals[i] = -perp(normalize(points[(i + 1) % leaf.count] - points[i]));
    return {leaf};
}

std::vector<Leaf> leaves_of(const Capsule& c, VertexStore&)
{
    Leaf leaf;
    leaf.type = LeafType::Capsule;
    leaf.p0 = c.a;
    leaf.p1 = c.b;
    leaf.r0 = c.radius_a;
    leaf.r1 = c.radius_b;
    return {leaf};
}

std::vector<Leaf> leaves_of(const Segment& s, VertexStore&) { return {make_segment(s.a, s.b, s.half_thickness, s.sides)}; }
std::vector<Leaf> leaves_of(const Arc& a, VertexStore&) { return {make_arc(a)}; }

std::vector<Leaf> leaves_of(const HalfSpace& h, VertexStore&)
{
    Leaf leaf;
    leaf.type = LeafType::HalfSpace;
    leaf.p0 = h.normal;
    leaf.r0 = h.offset;
    return {leaf};
}

std::vector<Leaf> leaves_of(const Chain& c, VertexStore&)
{
    std::vector<Leaf> leaves;
    Vec2 from = c.start;
    for (const ChainPiece& piece : c.pieces)
    {
        leaves.push_back(piece.sweep == 0 ? make_segment(from, piece.end, c.half_thickness, c.sides)
                                          : make_chain_arc(from, piece.end, piece.sweep, c.half_thickness, c.sides));
        from = piece.end;
    }
    const std::size_t n = leaves.size();
    for (std::size_t i = 0; i < n; ++i)
    {
        if (i > 0 || c.closed)
        {
            leaves[i].has_previous = true;
            leaves[i].previous_tangent = end_tangent(leaves[(i + n - 1) % n]);
        }
        if (i + 1 < n || c.closed)
        {
            leaves[i].has_next = true;
            leaves[i].next_tangent = start_tangent(leaves[(i + 1) % n]);
        }
    }
    return leaves;
}

} // namespace

std::vector<Leaf> make_leaves(const Geometry& geometry, VertexStore& store)
{
    return std::visit([&](const auto& shape) { return leaves_of(shape, store); }, geometry);
}

Geometry geometry_of(const LeafView& view)
{
    const Leaf& leaf = *view.leaf;
    switch (leaf.type)
    {
    case LeafType::HalfSpace: return HalfSpace{leaf.p0, leaf.r0};
    case LeafType::Circle: return Circle{leaf.p0, leaf.r0};
    case LeafType::Polygon: return Polygon{{view.points, view.points + leaf.count}, leaf.r0};
    case LeafType::Capsule: return Capsule{leaf.p0, leaf.p1, leaf.r0, leaf.r1};
    case LeafType::Segment: return Segment{leaf.p0, leaf.p1, leaf.r0, leaf.sides};
    case LeafType::Arc: return Arc{leaf.p0, leaf.arc_radius, leaf.start_angle, leaf.sweep, leaf.r0, leaf.sides};
    }
    return {};
}

Chain chain_of(std::span<const LeafView> pieces)
{
    const Leaf& first = *pieces.front().leaf;
    Chain chain{.start = start_point(first), .closed = first.has_previous, .half_thickness = first.r0, .sides = first.sides};
    for (const LeafView& piece : pieces)
        chain.pieces.push_back({end_point(*piece.leaf), piece.leaf->sweep});
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
