// Capsules and segments against hulls: 10,000 random pairs each.

#include "collision/manifold_pairs.h"

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

TEST(CollisionManifold, PolygonCapsule) { check_pair(LeafType::Polygon, LeafType::Capsule); }
TEST(CollisionManifold, CapsuleCapsule) { check_pair(LeafType::Capsule, LeafType::Capsule); }
TEST(CollisionManifold, CapsuleSegment) { check_pair(LeafType::Capsule, LeafType::Segment); }
TEST(CollisionManifold, SegmentSegment) { check_pair(LeafType::Segment, LeafType::Segment); }

TEST(CollisionManifold, CapsulesInLine)
{
    for (const Geometry& other : {Geometry{Capsule{}}, Geometry{Segment{{-0.5f, 0}, {0.5f, 0}, 0.25f}}})
        for (const float gap : {0.05f, -0.01f})
        {
            VertexStore store;
            const Leaf a = make_leaves(Capsule{}, store)[0];
            const Leaf b = make_leaves(other, store)[0];
            const LocalManifold m = collide(view(a, store), view(b, store), {{1.5f + gap, 0}, {}}, 0.1f);
            ASSERT_EQ(m.count, 1);
            EXPECT_NEAR(m.points[0].separation, gap, 1e-5);
            EXPECT_NEAR(m.normal.x, 1, 1e-5);
            EXPECT_EQ(collide(view(a, store), view(b, store), {{1.7f, 0}, {}}, 0.1f).count, 0);
        }
}
