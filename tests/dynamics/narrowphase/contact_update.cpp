// Which points of a fresh manifold are those of the old one.

#include "dynamics/narrowphase/contact_update.h"

#include "collision/edge_rules.h"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <initializer_list>

using namespace carom;
using internal::corner_feature;
using internal::feature_id;
using internal::Manifold;
using internal::match_points;
using internal::none;

namespace {

struct Place
{
    float x;
    std::uint32_t feature;
};

Manifold manifold_of(std::initializer_list<Place> places)
{
    Manifold m;
    m.normal = {0, 1};
    for (const Place& place : places)
    {
        m.points[m.count].anchor_a = {place.x, 0.5f};
        m.points[m.count].feature = place.feature;
        ++m.count;
    }
    return m;
}

using Matches = std::array<int, 2>;

TEST(MatchPoints, KeepsFeaturesWhateverTheirOrderAndPlace)
{
    const Manifold old = manifold_of({{-1, feature_id(false, 2, 0)}, {1, feature_id(false, 2, 1)}});
    EXPECT_EQ(match_points(old, old), (Matches{0, 1}));
    EXPECT_EQ(match_points(old, manifold_of({{-1, feature_id(false, 2, 1)}, {1, feature_id(false, 2, 0)}})), (Matches{1, 0}));
}

// As of two faces that are nearly parallel: either may be the reference.
TEST(MatchPoints, GoesByPlaceOnceTheReferenceIsTheOtherShapes)
{
    const Manifold old = manifold_of({{-1, feature_id(false, 2, 0)}, {1, feature_id(false, 2, 1)}});
    EXPECT_EQ(match_points(old, manifold_of({{1.01f, feature_id(true, 0, 2)}, {-0.99f, feature_id(true, 0, 3)}})),
              (Matches{1, 0}));
    EXPECT_EQ(match_points(old, manifold_of({{0.9f, feature_id(true, 0, 2)}})), (Matches{1, none}));
}

TEST(MatchPoints, TakesAnotherFaceForAnotherPlace)
{
    const Manifold old = manifold_of({{-1, feature_id(false, 2, 0)}, {1, feature_id(false, 2, 1)}});
    Manifold side = manifold_of({{1, feature_id(true, 0, 2)}});
    side.normal = {1, 0};
    EXPECT_EQ(match_points(old, side), (Matches{none, none}));
    EXPECT_EQ(match_points(manifold_of({{-1, corner_feature}, {1, 7}}), manifold_of({{1, feature_id(true, 0, 2)}, {2, 9}})),
              (Matches{1, none}));
}

TEST(MatchPoints, GivesNoOldPointToTwoNewOnes)
{
    const Manifold old = manifold_of({{1, feature_id(false, 2, 0)}});
    EXPECT_EQ(match_points(old, manifold_of({{-1, feature_id(true, 0, 2)}, {0.9f, feature_id(true, 0, 3)}})), (Matches{none, 0}));
    EXPECT_EQ(match_points(old, manifold_of({{0.9f, feature_id(true, 0, 2)}, {-1, feature_id(true, 0, 3)}})), (Matches{0, none}));
}

TEST(MatchPoints, TakesAnotherEdgeOfTheSameReferenceForAnotherPlace)
{
    const Manifold old = manifold_of({{-1, feature_id(false, 2, 0)}, {1, feature_id(false, 2, 1)}});
    EXPECT_EQ(match_points(old, manifold_of({{1, feature_id(false, 2, 1)}, {3, feature_id(false, 2, 2)}})), (Matches{1, none}));
    EXPECT_EQ(match_points(old, manifold_of({{3, feature_id(false, 2, 2)}})), (Matches{none, none}));
}

TEST(MatchPoints, KeepsTheLoadOfASinglePoint)
{
    EXPECT_EQ(match_points(manifold_of({{0, 5}}), manifold_of({{1, 6}})), (Matches{0, none}));
}

} // namespace
