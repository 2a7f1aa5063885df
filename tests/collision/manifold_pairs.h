#pragma once

/// @file
/// Random pairs of leaves for every entry of the collision table, checked against brute force.

#include "collision/brute_force.h"
#include "collision/manifold.h"
#include "support/effort.h"

#include <string>

namespace carom::test {

using namespace carom::internal;

inline Geometry random_geometry(Random& random, LeafType type)
{
    const auto polygon = [&]
    {
        const int n = 3 + random.below(7);
        Polygon p;
        for (int i = 0; i < n; ++i)
        {
            const double angle = 2 * 3.14159265358979 * (i + random.range(-0.3, 0.3)) / n;
            p.vertices.push_back(
                {static_cast<float>(random.range(0.99, 1.0) * std::cos(angle)), static_cast<float>(0.6 * std::sin(angle))});
        }
        p.radius = random.chance(0.5) ? 0 : random.rangef(0.01, 0.3);
        return p;
    };
    switch (type)
    {
    case LeafType::HalfSpace: return HalfSpace{.normal = {random.rangef(-1, 1), 1.1f}, .offset = random.rangef(-0.5, 0.5)};
    case LeafType::Circle: return Circle{.center = random.vec(0.3), .radius = random.rangef(0.05, 0.8)};
    case LeafType::Polygon: return polygon();
    case LeafType::Capsule:
    {
        const float r = random.rangef(0.1, 0.4);
        return Capsule{{random.rangef(-1, -0.4), random.rangef(-0.2, 0.2)},
                       {random.rangef(0.4, 1), 0},
                       r,
                       random.chance(0.5) ? r : random.rangef(0.05, 0.4)};
    }
    case LeafType::Segment:
        return Segment{{random.rangef(-1, -0.3), random.rangef(-0.3, 0.3)},
                       {random.rangef(0.3, 1), 0},
                       random.chance(0.5) ? 0 : random.rangef(0.01, 0.3)};
    case LeafType::Arc:
        return Arc{.center = random.vec(0.2),
                   .radius = random.rangef(0.6, 2),
                   .start_angle = random.rangef(-3, 3),
                   .sweep = (random.chance(0.5) ? 1.0f : -1.0f) * random.rangef(0.3, 2.9),
                   .half_thickness = random.chance(0.5) ? 0 : random.rangef(0.01, 0.2)};
    }
    return Circle{};
}

struct Sample
{
    LeafStore store;
    Geometry geometry_a;
    Geometry geometry_b;
    Leaf a;
    Leaf b;
    Pose pose_a;
    Pose pose_b;
};

inline Leaf leaf_of(Geometry& geometry, LeafStore& store)
{
    EXPECT_TRUE(normalize_geometry("test", geometry));
    return make_leaves(geometry, store)[0];
}

inline Sample random_sample(Random& random, LeafType a, LeafType b)
{
    Sample s;
    s.geometry_a = random_geometry(random, a);
    s.geometry_b = random_geometry(random, b);
    s.a = leaf_of(s.geometry_a, s.store);
    s.b = leaf_of(s.geometry_b, s.store);
    s.pose_a = {{random.range(-5, 5), random.range(-5, 5)}, Rotation::from_angle(random.rangef(-3, 3))};
    s.pose_b = {s.pose_a.position + random.vec(1.8), Rotation::from_angle(random.rangef(-3, 3))};
    return s;
}

inline constexpr const char* names[] = {"half-space", "circle", "polygon", "capsule", "segment", "arc"};

inline double least(const LocalManifold& m)
{
    double d = 1e9;
    for (int i = 0; i < m.count; ++i)
        d = std::min(d, static_cast<double>(m.points[i].separation));
    return d;
}

inline constexpr float margin = 0.1f;

// The engine's separation for a pair of hulls may be that of the best edge instead of the true depth where they overlap; it must never be
// deeper than the truth by more than rounding, nor miss a touch.
inline void check(const Sample& s, bool arc, bool plane, int& hits, int& overlaps)
{
    const LocalManifold m = collide(view(s.a, s.store), view(s.b, s.store), relative_pose(s.pose_a, s.pose_b), margin);
    const Solid a = solid_of(s.geometry_a, s.pose_a);
    const Solid b = solid_of(s.geometry_b, s.pose_b);
    double truth = 0;
    if (plane)
        truth = a.plane ? plane_separation(a, b) : plane_separation(b, a);
    else if (!arc)
        truth = convex_separation(a, b);
    if (!arc)
    {
        if (truth > static_cast<double>(margin) + 1e-4)
        {
            ASSERT_EQ(m.count, 0) << "apart by " << truth;
            return;
        }
        if (truth > static_cast<double>(margin) - 1e-4)
            return;
        ASSERT_GT(m.count, 0) << "near by " << truth;
        ++hits;
        overlaps += truth < 0;
        // Deep overlap is measured along the best edge, which need not be the shortest way out.
        ASSERT_NEAR(least(m), truth, truth < -0.05 ? 0.3 * -truth : 1e-3);
    }
    else
    {
        hits += m.count > 0;
        overlaps += m.count > 0 && least(m) < 0;
    }
    if (m.count == 0)
        return;
    ASSERT_NEAR(dot(m.normal, m.normal), 1, 1e-4);
    for (int i = 0; i < m.count; ++i)
    {
        const LocalPoint& p = m.points[i];
        ASSERT_LE(p.separation, margin + 1e-4f);
        ASSERT_NEAR(dot(p.on_b - p.on_a, m.normal), p.separation, 2e-3) << "the anchors are as far apart as it says";
    }
    if (m.count == 2)
    {
        ASSERT_NE(m.points[0].feature, m.points[1].feature);
    }
    // The other order gives the flipped result: of two types exactly, as one is the mirror of the other; of one type another of two
    // nearly parallel edges may be the reference.
    const bool mirror = s.a.type != s.b.type;
    if (!mirror && least(m) < -0.05)
        return;
    const LocalManifold f = collide(view(s.b, s.store), view(s.a, s.store), relative_pose(s.pose_b, s.pose_a), margin);
    if (mirror)
    {
        ASSERT_EQ(f.count, m.count);
    }
    const Rotation turn = inverse(s.pose_b.rotation) * s.pose_a.rotation;
    const Vec2 flipped = -rotate(turn, m.normal);
    ASSERT_NEAR(flipped.x, f.normal.x, mirror ? 1e-4 : 0.3);
    ASSERT_NEAR(flipped.y, f.normal.y, mirror ? 1e-4 : 0.3);
    ASSERT_NEAR(least(f), least(m), mirror ? 1e-4 : 0.02);
}

inline void check_pair(LeafType a, LeafType b)
{
    SCOPED_TRACE(std::string(names[static_cast<int>(a)]) + " and " + names[static_cast<int>(b)]);
    const bool arc = a == LeafType::Arc || b == LeafType::Arc;
    const bool plane = a == LeafType::HalfSpace || b == LeafType::HalfSpace;
    Random random(1000 + 10 * static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
    int hits = 0;
    int overlaps = 0;
    constexpr int count = slow_build ? 2000 : 10000;
    for (int i = 0; i < count; ++i)
    {
        SCOPED_TRACE(i);
        check(random_sample(random, a, b), arc, plane, hits, overlaps);
        if (::testing::Test::HasFatalFailure())
            return;
    }
    EXPECT_GT(hits, count / 20);
    EXPECT_GT(overlaps, count / 40);
    EXPECT_LT(hits, count);
}

} // namespace carom::test
