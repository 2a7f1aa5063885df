// Every entry of the collision table: 10,000 random pairs against brute force, the mirrored entry gives the flipped result.

#include "collision/manifold_pairs.h"

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

TEST(CollisionManifold, PairsOfConvexLeaves)
{
    using enum LeafType;
    const std::pair<LeafType, LeafType> pairs[] = {
        {Circle, Circle},   {Circle, Polygon},    {Circle, Capsule},  {Circle, Segment},    {Circle, HalfSpace},
        {Polygon, Polygon}, {Polygon, Capsule},   {Polygon, Segment}, {Polygon, HalfSpace}, {Capsule, Capsule},
        {Capsule, Segment}, {Capsule, HalfSpace}, {Segment, Segment}, {Segment, HalfSpace}};
    for (const auto& [a, b] : pairs)
        check_pair(a, b);
}

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

TEST(CollisionManifold, CapsulesInLine)
{
    for (const Geometry& other : {Geometry{Capsule{}}, Geometry{Segment{{-0.5f, 0}, {0.5f, 0}, 0.25f}}})
        for (const float gap : {0.05f, -0.01f})
        {
            LeafStore store;
            const Leaf a = make_leaves(Capsule{}, store)[0];
            const Leaf b = make_leaves(other, store)[0];
            const LocalManifold m = collide(view(a, store), view(b, store), {{1.5f + gap, 0}, {}}, 0.1f);
            ASSERT_EQ(m.count, 1);
            EXPECT_NEAR(m.points[0].separation, gap, 1e-5);
            EXPECT_NEAR(m.normal.x, 1, 1e-5);
            EXPECT_EQ(collide(view(a, store), view(b, store), {{1.7f, 0}, {}}, 0.1f).count, 0);
        }
}
