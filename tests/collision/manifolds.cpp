// Every entry of the collision table: 10,000 random pairs against brute force, the mirrored entry gives the flipped result.

#include "collision/manifold_pairs.h"

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

TEST(CollisionManifold, CircleCircle) { check_pair(LeafType::Circle, LeafType::Circle); }
TEST(CollisionManifold, CirclePolygon) { check_pair(LeafType::Circle, LeafType::Polygon); }
TEST(CollisionManifold, CircleCapsule) { check_pair(LeafType::Circle, LeafType::Capsule); }
TEST(CollisionManifold, CircleSegment) { check_pair(LeafType::Circle, LeafType::Segment); }
TEST(CollisionManifold, CircleHalfSpace) { check_pair(LeafType::Circle, LeafType::HalfSpace); }
TEST(CollisionManifold, PolygonPolygon) { check_pair(LeafType::Polygon, LeafType::Polygon); }
TEST(CollisionManifold, PolygonSegment) { check_pair(LeafType::Polygon, LeafType::Segment); }
TEST(CollisionManifold, PolygonHalfSpace) { check_pair(LeafType::Polygon, LeafType::HalfSpace); }
TEST(CollisionManifold, CapsuleHalfSpace) { check_pair(LeafType::Capsule, LeafType::HalfSpace); }
TEST(CollisionManifold, SegmentHalfSpace) { check_pair(LeafType::Segment, LeafType::HalfSpace); }

// A circle and an arc: the distance to the curve itself, sampled.
TEST(CollisionManifold, CircleArc)
{
    Random random(77);
    int hits = 0;
    for (int i = 0; i < 10000; ++i)
    {
        SCOPED_TRACE(i);
        const Sample s = random_sample(random, LeafType::Arc, LeafType::Circle);
        const Solid arc = solid_of(s.geometry_a, s.pose_a);
        const Solid circle = solid_of(s.geometry_b, s.pose_b);
        double d = 1e9;
        for (std::size_t k = 1; k < arc.core.size(); ++k)
            d = std::min(d, segment_distance(circle.core[0], arc.core[k - 1], arc.core[k]));
        d -= arc.radius[0] + circle.radius[0];
        const LocalManifold m = collide(view(s.a, s.store), view(s.b, s.store), relative_pose(s.pose_a, s.pose_b), margin);
        if (d > static_cast<double>(margin) + 1e-3)
        {
            ASSERT_EQ(m.count, 0) << d;
        }
        else if (d < static_cast<double>(margin) - 1e-3)
        {
            ASSERT_EQ(m.count, 1) << d;
            ASSERT_NEAR(m.points[0].separation, d, 1e-3);
            ++hits;
        }
    }
    EXPECT_GT(hits, 1000);
}
