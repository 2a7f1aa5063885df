#include "core/grow.h"

#include <gtest/gtest.h>
#include <vector>

namespace carom::internal {
namespace {

TEST(Grow, AQuarterOrAThirdMore)
{
    std::vector<int> items(100);
    items.shrink_to_fit();
    make_room(items, 101);
    EXPECT_EQ(items.capacity(), 125u);
    make_room<Growth::Third>(items, 126);
    EXPECT_EQ(items.capacity(), 166u);
    make_room(items, 1000);
    EXPECT_EQ(items.capacity(), 1000u);
    EXPECT_EQ(items.size(), 100u);
    grow(items, 1001);
    EXPECT_EQ(items.capacity(), 1250u);
    EXPECT_EQ(items.size(), 1001u);
    set_size(items, 7);
    EXPECT_EQ(items.capacity(), 1250u);
    EXPECT_EQ(items.size(), 7u);
}

TEST(Grow, AppendsOneOfItsOwn)
{
    std::vector<int> items{1, 2, 3};
    items.shrink_to_fit();
    append(items, items.front());
    EXPECT_EQ(items, (std::vector<int>{1, 2, 3, 1}));
}

} // namespace
} // namespace carom::internal
