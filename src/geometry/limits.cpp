// Checks that a shape's fields and mass are within what floats can handle.

#include "geometry/limits.h"

#include "core/refuse.h"
#include "geometry/leaf.h"
#include "geometry/mass.h"

#include <cmath>

namespace carom::internal {

namespace {

// Floats are 8 m apart there: a shape that far from its body's origin has lost its form.
constexpr float max_reach = 1e8f;
// Far enough within the range of floats that inverses are finite and a body may have a thousand such shapes.
constexpr double least_mass = 1e-35;
constexpr double most_mass = 1e35;

bool is_near(Vec2 point) { return std::fabs(point.x) <= max_reach && std::fabs(point.y) <= max_reach; }

/// Checks the reach of the fields of one shape.
struct ReachChecker
{
    Checker check;

    [[nodiscard]] bool point(const char* field, Vec2 value) const
    {
        return is_near(value) || check.holds(false, field, to_text(value), "must be within 1e8 m of the body's origin");
    }
    [[nodiscard]] bool size(const char* field, float value) const
    {
        return value <= max_reach || check.holds(false, field, to_text(value), "must be at most 1e8 m");
    }

    [[nodiscard]] bool operator()(const Circle& c) const
    {
        return point("Circle.center", c.center) && size("Circle.radius", c.radius);
    }
    [[nodiscard]] bool operator()(const Polygon& p) const
    {
        for (const Vec2 v : p.vertices)
        {
            if (!point("Polygon.vertices", v))
                return false;
        }
        return size("Polygon.radius", p.radius);
    }
    [[nodiscard]] bool operator()(const Capsule& c) const
    {
        return point("Capsule.a", c.a) && point("Capsule.b", c.b) && size("Capsule.radius_a", c.radius_a) &&
               size("Capsule.radius_b", c.radius_b);
    }
    [[nodiscard]] bool operator()(const Segment& s) const
    {
        return point("Segment.a", s.a) && point("Segment.b", s.b) && size("Segment.half_thickness", s.half_thickness);
    }
    [[nodiscard]] bool operator()(const Arc& a) const { return point("Arc.center", a.center) && size("Arc.radius", a.radius); }
    [[nodiscard]] bool operator()(const Chain& c) const
    {
        if (!point("Chain.start", c.start) || !size("Chain.half_thickness", c.half_thickness))
            return false;
        Vec2 from = c.start;
        for (const ChainPiece& piece : c.pieces)
        {
            if (!point("Chain.pieces.end", piece.end) || !bend(from, piece))
                return false;
            from = piece.end;
        }
        return true;
    }
    [[nodiscard]] bool operator()(const HalfSpace& h) const
    {
        return std::fabs(h.offset) <= max_reach ||
               check.holds(false, "HalfSpace.offset", to_text(h.offset), "must be within 1e8 m of the body's origin");
    }

    // The radius is the chord over 2 sin(sweep / 2); for the small sweeps in question that is the chord over the sweep.
    [[nodiscard]] bool bend(Vec2 from, const ChainPiece& piece) const
    {
        return piece.sweep == 0 || length(piece.end - from) <= max_reach * std::fabs(piece.sweep) ||
               check.holds(false, "Chain.pieces.sweep", to_text(piece.sweep),
                           "must be 0 for a straight piece, or bend it by a radius of at most 1e8 m");
    }
};

bool check_amount(const Checker& check, const char* field, double value)
{
    return value == 0 || check.holds(value >= least_mass && value <= most_mass, field, to_text(value),
                                     "must be 0 or from 1e-35 to 1e35 (change density or size)");
}

} // namespace

bool check_reach(const char* function, const Geometry& geometry) { return std::visit(ReachChecker{{function}}, geometry); }

bool check_mass(const char* function, const Geometry& geometry, float density)
{
    const bool massless = std::holds_alternative<Arc>(geometry) || std::holds_alternative<Chain>(geometry) ||
                          std::holds_alternative<HalfSpace>(geometry);
    if (massless || density == 0)
        return true;
    const Checker check{function};
    LeafStore store;
    const Leaf leaf = make_leaves(geometry, store).front();
    const LeafMass mass = leaf_mass(view(leaf, store), density);
    return check_amount(check, "the shape's mass", mass.mass) &&
           check_amount(check, "the shape's moment of inertia", mass.inertia);
}

} // namespace carom::internal
