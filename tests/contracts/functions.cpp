// carom::Function holds what scenes call back.

#include "carom/function.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <utility>

using carom::Function;

namespace {

int twice(int x) { return 2 * x; }

} // namespace

TEST(Functions, AreEmptyWhereTheyAreMadeOfNothing)
{
    int (*const no_pointer)(int) = nullptr;
    const std::function<int(int)> no_function;
    EXPECT_FALSE(Function<int(int)>{});
    EXPECT_FALSE(Function<int(int)>(nullptr));
    EXPECT_FALSE(Function<int(int)>(no_pointer));
    EXPECT_FALSE(Function<int(int)>(no_function));
    EXPECT_TRUE(Function<int(int)>(twice));
    EXPECT_TRUE(Function<int(int)>{} == nullptr);
}

TEST(Functions, CallLambdasPointersAndOtherFunctions)
{
    const std::array<int, 100> large{3};
    EXPECT_EQ(Function<int(int)>(twice)(4), 8);
    EXPECT_EQ(Function<int(int)>([large](int x) { return large[0] + x; })(4), 7);
    EXPECT_EQ(Function<int(int)>(std::function<int(int)>(twice))(4), 8);
    EXPECT_EQ(Function<double(int)>(Function<int(int)>(twice))(4), 8.0);
    const Function<void(int)> without_result = twice;
    without_result(4);
    int seen = 0;
    const Function<void(int&)> by_reference = [&seen](int& x) { seen = ++x; };
    int given = 1;
    by_reference(given);
    EXPECT_EQ(seen, 2);
    EXPECT_EQ(given, 2);
}

TEST(Functions, CopiesHaveTheirOwnState)
{
    Function<int()> counter = [n = 0]() mutable { return ++n; };
    EXPECT_EQ(counter(), 1);
    Function<int()> copy = counter;
    EXPECT_EQ(counter(), 2);
    EXPECT_EQ(copy(), 2);
    EXPECT_EQ(copy(), 3);
    copy = counter;
    EXPECT_EQ(copy(), 3);
    const Function<int()> moved = std::move(copy);
    EXPECT_EQ(moved(), 4);
}

TEST(Functions, LetGoOfWhatTheyCaptured)
{
    const auto token = std::make_shared<int>(0);
    {
        Function<long()> f = [token] { return token.use_count(); };
        Function<long()> g = f;
        EXPECT_EQ(token.use_count(), 3);
        g = nullptr;
        EXPECT_EQ(token.use_count(), 2);
        f = Function<long()>(std::exchange(g, {}));
        EXPECT_EQ(token.use_count(), 1);
    }
    EXPECT_EQ(token.use_count(), 1);
}
