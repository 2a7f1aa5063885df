// Data that leaves keep beside themselves: shared by polygons that are alike, used again once nothing needs it.

#include "geometry/leaf.h"

#include <gtest/gtest.h>

using namespace carom;
using namespace carom::internal;

namespace {

Leaf leaf_of(const Geometry& geometry, LeafStore& store) { return make_leaves(geometry, store).front(); }

} // namespace

TEST(GeometryLeafStore, PolygonsThatAreAlikeShareAnOutline)
{
    LeafStore store;
    const Leaf first = leaf_of(box(0.5f, 0.25f), store);
    const Leaf other = leaf_of(box(0.25f, 0.5f), store);
    const Leaf second = leaf_of(box(0.5f, 0.25f), store);
    EXPECT_EQ(first.first, second.first);
    EXPECT_NE(first.first, other.first);
    EXPECT_EQ(view(other, store).points[0], (Vec2{-0.25f, -0.5f}));
    EXPECT_EQ(view(other, store).normals[0], (Vec2{0, -1}));
}

TEST(GeometryLeafStore, AnOutlineStaysAsLongAsOneUsesIt)
{
    LeafStore store;
    const Leaf first = leaf_of(box(0.5f, 0.25f), store);
    const Leaf second = leaf_of(box(0.5f, 0.25f), store);
    store.release(first);
    EXPECT_NE(leaf_of(box(1, 2), store).first, second.first);
    EXPECT_EQ(leaf_of(box(0.5f, 0.25f), store).first, second.first);
}

TEST(GeometryLeafStore, ReleasedOutlinesMakeRoomForOthersOfTheirLength)
{
    LeafStore store;
    const Leaf first = leaf_of(box(0.5f, 0.25f), store);
    const int end = leaf_of(box(4, 4), store).first + 4;
    store.release(first);
    const Leaf triangle = leaf_of(Polygon{{{0, 0}, {1, 0}, {0, 1}}}, store);
    EXPECT_EQ(triangle.first, end);
    const Leaf next = leaf_of(box(3, 1), store);
    EXPECT_EQ(next.first, first.first);
    EXPECT_EQ(view(next, store).points[2], (Vec2{3, 1}));
    const Leaf again = leaf_of(box(0.5f, 0.25f), store);
    EXPECT_NE(again.first, first.first) << "what was released is not found as one given lately";
    EXPECT_EQ(view(next, store).points[2], (Vec2{3, 1}));
}

// Read back, a vertex is what was given, and a zero keeps its sign.
TEST(GeometryLeafStore, AlikeIsBitByBit)
{
    LeafStore store;
    const Leaf plus = leaf_of(Polygon{{{0.0f, 0}, {1, 0}, {0, 1}}}, store);
    const Leaf minus = leaf_of(Polygon{{{-0.0f, 0}, {1, 0}, {0, 1}}}, store);
    EXPECT_NE(plus.first, minus.first);
}

TEST(GeometryLeafStore, ManyDifferentOutlines)
{
    LeafStore store;
    std::vector<Leaf> leaves;
    for (int round = 0; round < 3; ++round)
    {
        for (int i = 0; i < 1000; ++i)
            leaves.push_back(leaf_of(box(1 + 0.01f * static_cast<float>(i), 1), store));
        for (std::size_t i = 0; i < leaves.size(); ++i)
            EXPECT_EQ(view(leaves[i], store).points[2].x, 1 + 0.01f * static_cast<float>(i));
        for (const Leaf& leaf : leaves)
            store.release(leaf);
        leaves.clear();
    }
}

TEST(GeometryLeafStore, SpansOfArcs)
{
    LeafStore store;
    const Leaf first = leaf_of(Arc{.radius = 2, .start_angle = 0, .sweep = 1}, store);
    const Leaf second = leaf_of(Arc{.radius = 2, .start_angle = 1, .sweep = -1}, store);
    EXPECT_EQ(start_point(view(first, store)), (Vec2{2, 0}));
    EXPECT_EQ(view(second, store).span->sweep, -1);
    store.release(first);
    EXPECT_EQ(leaf_of(Arc{.sweep = 0.5f}, store).first, first.first);
}
