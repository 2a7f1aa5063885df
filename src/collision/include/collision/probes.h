#pragma once

// A leaf as circles fixed to its body, its probes. A leaf touches another with one of them, or with a flat side that meets a probe of the other.

#include "collision/time_of_impact.h"
#include "geometry/leaf_traits.h"
#include "geometry/surface.h"

namespace carom::internal {

struct Probe
{
    Vec2 point{}; ///< in the body's frame
    double radius = 0;
    LeafView piece{}; ///< the segment or arc that the probe is a part of: only some of the circle is surface
    enum class Part : std::uint8_t
    {
        All,
        Start,
        End,
        Bulge
    } part = Part::All;
    Vec2 before{}; ///< for a polygon's vertex: normals of the edges that meet there
    Vec2 after{};
    Vec2 outward{};  ///< direction away from the shape at a vertex or an end; 0 for circles
    double band = 0; ///< depth beyond a line without thickness up to which the probe still counts as on the side of its shape
};

/// Whether the probe's surface faces a direction, given in the probe's frame.
[[nodiscard]] inline bool faces(const Probe& probe, double dx, double dy)
{
    if (probe.part == Probe::Part::All)
        return true;
    const Leaf& leaf = *probe.piece.leaf;
    constexpr double slack = 1e-3;
    if (probe.part == Probe::Part::Start)
    {
        const Vec2 t = start_tangent(probe.piece);
        return static_cast<double>(t.x) * dx + static_cast<double>(t.y) * dy <= slack && start_answers<double>(leaf, t, dx, dy);
    }
    if (probe.part == Probe::Part::End)
    {
        const Vec2 t = end_tangent(probe.piece);
        return static_cast<double>(t.x) * dx + static_cast<double>(t.y) * dy >= -slack && end_answers<double>(leaf, t, dx, dy);
    }
    return (leaf.sides == Sides::Both || leaf.sides == side_of(probe.piece, false)) &&
           dx * static_cast<double>(leaf.p1.x) + dy * static_cast<double>(leaf.p1.y) >=
               static_cast<double>(probe.piece.span->cos_half_sweep);
}

/// Calls visit(probe) for each probe; bands matter only against lines.
template <class Visit>
void for_each_probe(const LeafView& v, bool against_line, Visit&& visit)
{
    const Leaf& leaf = *v.leaf;
    const auto r0 = static_cast<double>(leaf.r0);
    switch (leaf.type)
    {
    case LeafType::HalfSpace: return;
    case LeafType::Circle: visit(Probe{leaf.p0, r0}); return;
    case LeafType::Capsule:
        visit(Probe{.point = leaf.p0, .radius = r0, .outward = leaf.p0 - leaf.p1, .band = 0.5 * r0});
        visit(Probe{.point = leaf.p1,
                    .radius = static_cast<double>(leaf.r1),
                    .outward = leaf.p1 - leaf.p0,
                    .band = 0.5 * static_cast<double>(leaf.r1)});
        return;
    case LeafType::Polygon:
    {
        const double band = against_line ? 0.25 * inner_radius(v) : 0;
        for (int i = 0; i < leaf.count; ++i)
        {
            const Vec2 before = v.normals[i > 0 ? i - 1 : leaf.count - 1];
            const Vec2 after = v.normals[i];
            visit(Probe{
                .point = v.points[i], .radius = r0, .before = before, .after = after, .outward = before + after, .band = band});
        }
        return;
    }
    case LeafType::Arc: visit(Probe{leaf.p0, static_cast<double>(leaf.arc_radius) + r0, v, Probe::Part::Bulge}); [[fallthrough]];
    case LeafType::Segment:
        if (start_may_answer(leaf, start_tangent(v)))
            visit(Probe{start_point(v), r0, v, Probe::Part::Start});
        if (!leaf.has_next)
            visit(Probe{end_point(v), r0, v, Probe::Part::End});
        return;
    }
}

/// Calls visit(probe, number, on_a) for probes of a, which meet the surface of b, and probes of b, which meet that of a. A circle is one probe and needs
/// no others.
template <class Visit>
void for_each_probe_pair(const LeafView& a, const LeafView& b, Visit&& visit)
{
    const bool a_is_circle = a.leaf->type == LeafType::Circle;
    const bool b_is_circle = b.leaf->type == LeafType::Circle;
    const auto is_line = [](const LeafView& v) { return traits_of(*v.leaf).is_line; };
    int number = 0;
    if (!b_is_circle || a_is_circle)
        for_each_probe(a, is_line(b), [&](const Probe& p) { visit(p, number++, true); });
    number = 0;
    if (!a_is_circle)
        for_each_probe(b, is_line(a), [&](const Probe& p) { visit(p, number++, false); });
}

} // namespace carom::internal
