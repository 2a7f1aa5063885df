// Room that is not cleared.

#include "core/blank_array.h"

#include <gtest/gtest.h>

using namespace carom::internal;

namespace {

TEST(BlankArray, StaysWhereThereIsRoom)
{
    BlankArray<int> items;
    items.make_room(8);
    ASSERT_GE(items.size(), 8u);
    for (int i = 0; i < 8; ++i)
        items[static_cast<std::size_t>(i)] = i;
    const int* const before = items.data();
    items.make_room(3);
    EXPECT_EQ(items.data(), before);
    EXPECT_GE(items.size(), 8u);
    for (int i = 0; i < 8; ++i)
        EXPECT_EQ(items[static_cast<std::size_t>(i)], i);
}

TEST(BlankArray, GrowsByAQuarterAtLeast)
{
    BlankArray<int> items;
    items.make_room(100);
    items.make_room(items.size() + 1);
    EXPECT_GE(items.size(), 125u);
    items.make_room(1000);
    EXPECT_GE(items.size(), 1000u);
    items[999] = 1;
    EXPECT_EQ(items[999], 1);
}

} // namespace
