#pragma once

// Contact manifolds: where and how two leaves touch, in the body frame of the first. Separation is negative where they overlap.
// Each point has an anchor on either surface: for round shapes the lever arms are then exact (r x t = R), at any gap.

#include "carom/math.h"
#include "geometry/leaf.h"

#include <cstdint>

namespace carom::internal {

/// Frame of body b as seen from body a. Computed in double, exact far from the world's origin.
struct RelativePose
{
    Vec2 position{};
    Rotation rotation{};

    [[nodiscard]] Vec2 to_a(Vec2 in_b) const { return position + rotate(rotation, in_b); }
    [[nodiscard]] Vec2 to_b(Vec2 in_a) const { return inverse_rotate(rotation, in_a - position); }
};

[[nodiscard]] inline RelativePose relative_pose(const Pose& a, const Pose& b)
{
    return {inverse_rotate(a.rotation, b.position - a.position), inverse(a.rotation) * b.rotation};
}

struct LocalPoint
{
    Vec2 on_a{}; ///< on a's surface, in a's frame
    Vec2 on_b{}; ///< on b's surface, in a's frame
    float separation = 0;
    std::uint32_t feature = 0;
};

/// Cosine of the angle between the normals at two points up to which one normal serves both.
inline constexpr float one_normal = 0.94f;

/// The edges that a manifold was clipped from, in a's frame: as long as these two face each other, its points follow from them.
struct ClippedEdges
{
    Vec2 edge[2];      ///< ends of the reference edge, on the surface
    Vec2 corners[2];   ///< ends of the incident edge, without their radius; the first belongs to the first point
    bool of_b = false; ///< whether the reference edge is b's
    float radius = -1; ///< radius of both corners; negative: no clipped edges, or the radii differ
};

/// Two corners that are nearest to each other, or the centers of circles, in a's frame. As long as the direction from one to the other lies in both cones,
/// nothing is nearer.
struct NearestCorners
{
    Vec2 at[2];
    /// Normal cones at either corner: n with dot(n, cone) >= dot(cone, cone), where cone is the mean of the two edges' normals. 0: any normal.
    Vec2 cones[2];
    float radii[2] = {-1, -1}; ///< negative: the nearest features were not corners
};

struct LocalManifold
{
    Vec2 normal{}; ///< from a to b, in a's frame
    LocalPoint points[2];
    int count = 0;
    ClippedEdges clipped;
    NearestCorners nearest;
    /// Without a point: a lower bound on the gap that would hold for a wider margin too. With one point: the same bound for all but the corners that it was
    /// clipped from. With two: how far the leaves may move before another corner could be one of them.
    float reach = 0;
    /// Without a point, the direction from a to b, in a's frame, along which they are `reach` apart; 0: none is known.
    Vec2 parting{};
    bool is_of_union = false; ///< flush neighbors have turned or emptied the manifold

    /// Separation of the lowest point, m; 3e38 without a point.
    [[nodiscard]] float least_separation() const
    {
        const float first = count > 0 ? points[0].separation : 3e38f;
        const float second = count > 1 ? points[1].separation : 3e38f;
        return second < first ? second : first;
    }

    void part(Vec2 direction, float separation)
    {
        parting = direction;
        reach = separation;
    }

    // `third`: separation of the lowest other corner of the incident leaf. `left_out`: separation of the part of the incident edge that is beyond the margin.
    void bound_by_third(float third, float left_out)
    {
        const float farther = points[0].separation < points[1].separation ? points[1].separation : points[0].separation;
        if (count == 2)
            reach = 0.5f * (third - farther);
        else
            reach = count == 1 || third < left_out ? third : left_out;
    }

    void add(Vec2 on_a, Vec2 on_b, float separation, std::uint32_t feature)
    {
        points[count++] = {on_a, on_b, separation, feature};
    }
};

/// Fills the manifold with points whose separation is at most `margin`. The manifold's reach is set to the margin beforehand; the function may replace it.
using CollideFunction = void (*)(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin,
                                 LocalManifold& out);

/// The table over leaf types: every ordered pair that can meet is there; null where both types are massless
/// or both are half-spaces. One implementation per unordered pair, mirrored for the other order.
[[nodiscard]] CollideFunction collide_function(LeafType a, LeafType b);

/// The whole contact of two leaves; an empty manifold where they do not meet.
[[nodiscard]] LocalManifold collide(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin);

/// Clips b to one edge of a (a polygon, capsule or segment), lengthened by `beyond` at both ends. The normal is that edge's; `out` is empty where
/// no part of b lies before the edge.
void clip_to_own_edge(const LeafView& a, int edge, const LeafView& b, const RelativePose& pose, float margin, float beyond,
                      LocalManifold& out);

// The implementations, one file each.
void collide_surface_circle(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out);
void collide_outlines(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out);
void collide_hull_hull(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out);
void collide_arc_hull(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out);
void collide_half_space_hull(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out);

} // namespace carom::internal
