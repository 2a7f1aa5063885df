// Every operation on lanes against the same on each number by itself, bit for bit, zeros of both signs and what is not a number among them.

#include "core/lane_math.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace carom::internal {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

LaneFloats lanes_of(F8 x)
{
    LaneFloats r;
    store(r, x);
    return r;
}
LaneInts lanes_of(I8 x)
{
    LaneInts r;
    store(r, x);
    return r;
}

// Pairs of eights that bring every number below beside every other.
struct Operands
{
    LaneFloats a;
    LaneFloats b;
};

std::vector<Operands> operands()
{
    const std::array numbers = {0.0f,   -0.0f, 1.0f,     -1.0f,     0.1f,      -3.7e5f,     1e-38f, 1e-42f,
                                -2e30f, 3e38f, infinity, -infinity, no_number, 16777217.0f, 0.25f,  -1e-3f};
    std::vector<Operands> all;
    for (std::size_t shift = 0; shift < numbers.size(); ++shift)
    {
        for (const std::size_t first : {std::size_t{0}, std::size_t{lane_count}})
        {
            Operands o;
            for (std::size_t i = 0; i < lane_count; ++i)
            {
                o.a.v[i] = numbers[first + i];
                o.b.v[i] = numbers[(first + i + shift) % numbers.size()];
            }
            all.push_back(o);
        }
    }
    return all;
}

// Numbers that are none may differ in their bits.
bool are_same(float a, float b)
{
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

template <class Of8, class Of1>
void expect_floats(const char* operation, const Of8& eight, const Of1& one)
{
    for (const Operands& o : operands())
    {
        const LaneFloats r = lanes_of(eight(load(o.a), load(o.b)));
        for (int i = 0; i < lane_count; ++i)
            EXPECT_TRUE(are_same(r.v[i], one(o.a.v[i], o.b.v[i])))
                << operation << " of " << o.a.v[i] << " and " << o.b.v[i] << ": " << r.v[i];
    }
}

template <class Of8, class Of1>
void expect_masks(const char* operation, const Of8& eight, const Of1& one)
{
    for (const Operands& o : operands())
    {
        const I8 mask = eight(load(o.a), load(o.b));
        const LaneInts r = lanes_of(mask);
        for (int i = 0; i < lane_count; ++i)
        {
            const bool holds = one(o.a.v[i], o.b.v[i]);
            EXPECT_EQ(r.v[i], holds ? -1 : 0) << o.a.v[i] << ' ' << operation << ' ' << o.b.v[i];
            EXPECT_EQ(bits(mask) >> i & 1u, holds ? 1u : 0u) << o.a.v[i] << ' ' << operation << ' ' << o.b.v[i];
        }
    }
}

TEST(Lanes, CalculateAsNumbersDo)
{
    expect_floats("+", [](F8 a, F8 b) { return a + b; }, [](float a, float b) { return a + b; });
    expect_floats("-", [](F8 a, F8 b) { return a - b; }, [](float a, float b) { return a - b; });
    expect_floats("*", [](F8 a, F8 b) { return a * b; }, [](float a, float b) { return a * b; });
    expect_floats("/", [](F8 a, F8 b) { return a / b; }, [](float a, float b) { return a / b; });
    expect_floats("negation", [](F8 a, F8) { return -a; }, [](float a, float) { return -a; });
    expect_floats("root", [](F8 a, F8) { return root(a); }, [](float a, float) { return std::sqrt(a); });
    expect_floats("one number", [](F8 a, F8) { return 2.0f - a; }, [](float a, float) { return 2.0f - a; });
    expect_floats("least", [](F8 a, F8 b) { return least(a, b); }, [](float a, float b) { return a < b ? a : b; });
    expect_floats("greatest", [](F8 a, F8 b) { return greatest(a, b); }, [](float a, float b) { return a > b ? a : b; });
    expect_floats("magnitude", [](F8 a, F8) { return magnitude(a); }, [](float a, float) { return a > -a ? a : -a; });
    expect_floats("select", [](F8 a, F8 b) { return select(a < b, a, -b); }, [](float a, float b) { return a < b ? a : -b; });
    expect_floats(
        "sixteen", [](F8 a, F8 b) { return second_eight(sixteen_of(b, a) * sixteen_of(a, b)); },
        [](float a, float b) { return a * b; });
}

TEST(Lanes, CompareAsNumbersDo)
{
    expect_masks("<", [](F8 a, F8 b) { return a < b; }, [](float a, float b) { return a < b; });
    expect_masks(">", [](F8 a, F8 b) { return a > b; }, [](float a, float b) { return a > b; });
    expect_masks("<=", [](F8 a, F8 b) { return a <= b; }, [](float a, float b) { return a <= b; });
    expect_masks(">=", [](F8 a, F8 b) { return a >= b; }, [](float a, float b) { return a >= b; });
    expect_masks("==", [](F8 a, F8 b) { return a == b; }, [](float a, float b) { return a == b; });
    expect_masks("!=", [](F8 a, F8 b) { return a != b; }, [](float a, float b) { return a != b; });
    expect_masks(
        "and not", [](F8 a, F8 b) { return (a < b) & ~(a < all(0)); }, [](float a, float b) { return a < b && !(a < 0); });
    expect_masks("or", [](F8 a, F8 b) { return (a < b) | (b < all(0)); }, [](float a, float b) { return a < b || b < 0; });
}

TEST(Lanes, IntsCompareWithSigns)
{
    const I8 a = eight_of(0, 1, -1, 7, -2147483647 - 1, 2147483647, 5, -5);
    const I8 b = eight_of(0, -1, 1, 7, 2147483647, -2147483647 - 1, -5, 5);
    EXPECT_EQ(bits(a == b), 0b00001001u);
    EXPECT_EQ(bits(a != b), 0b11110110u);
    EXPECT_EQ(bits(a < b), 0b10010100u);
    EXPECT_EQ(bits(a >= b), 0b01101011u);
    EXPECT_EQ(bits((a & all_ints(4)) != I8{}), 0b01101100u);
}

TEST(Lanes, DoublesAreOfFullWidth)
{
    expect_floats(
        "double", [](F8 a, F8 b) { return floats(root(doubles(a) * doubles(a) + doubles(b) * doubles(b)) - 0.1 / doubles(b)); },
        [](float a, float b)
        {
            const double x = static_cast<double>(a);
            const double y = static_cast<double>(b);
            return static_cast<float>(std::sqrt(x * x + y * y) - 0.1 / y);
        });
    expect_floats(
        "selected double", [](F8 a, F8 b) { return floats(select(doubles(a) <= doubles(b), doubles(a), -doubles(b))); },
        [](float a, float b) { return a <= b ? a : -b; });
}

TEST(Lanes, ArcTangentIsThatOfOneNumber)
{
    LaneFloats sine;
    LaneFloats cosine;
    for (int turn = 0; turn < 100; ++turn)
    {
        for (int i = 0; i < lane_count; ++i)
        {
            const SinCos s = sin_cos(0.06 * turn + 0.7 * i - 3.0);
            sine.v[i] = static_cast<float>(s.sin);
            cosine.v[i] = i == 7 ? 0 : static_cast<float>(s.cos);
        }
        const LaneFloats r = lanes_of(arc_tangent(load(sine), load(cosine)));
        for (int i = 0; i < lane_count; ++i)
            EXPECT_TRUE(are_same(
                r.v[i], static_cast<float>(arc_tangent(static_cast<double>(sine.v[i]), static_cast<double>(cosine.v[i])))))
                << sine.v[i] << ' ' << cosine.v[i];
    }
}

TEST(Lanes, RecordsBecomeColumnsAndRecordsAgain)
{
    float records[lane_count][4];
    for (int i = 0; i < lane_count; ++i)
    {
        for (int k = 0; k < 4; ++k)
            records[i][k] = static_cast<float>(10 * i + k);
    }
    F8 columns[4];
    gather4([&](int i) { return reinterpret_cast<const char*>(records[i]); }, columns[0], columns[1], columns[2], columns[3]);
    for (int k = 0; k < 4; ++k)
    {
        for (int i = 0; i < lane_count; ++i)
            EXPECT_EQ(lanes_of(columns[k]).v[i], records[i][k]);
    }
    float again[lane_count][4] = {};
    scatter4([&](int i) { return reinterpret_cast<char*>(again[i]); }, columns[0], columns[1], columns[2], columns[3]);
    for (int i = 0; i < lane_count; ++i)
    {
        for (int k = 0; k < 4; ++k)
            EXPECT_EQ(again[i][k], records[i][k]);
    }
    F8 first;
    F8 second;
    round_pairs([](int i) { return two_of(0.1 + i, -0.2 * i); }, first, second);
    for (int i = 0; i < lane_count; ++i)
    {
        EXPECT_EQ(lanes_of(first).v[i], static_cast<float>(0.1 + i));
        EXPECT_EQ(lanes_of(second).v[i], static_cast<float>(-0.2 * i));
    }
}

TEST(Lanes, FoursMoveAsTheirCommentsSay)
{
    const F4 a = four_of(0, 1, 2, 3);
    const F4 b = four_of(10, 11, 12, 13);
    const auto expect = [](F4 moved, std::array<float, 4> lanes)
    {
        std::array<float, 4> r;
        store4(r.data(), moved);
        EXPECT_EQ(r, lanes);
    };
    expect(low_halves(a, b), {0, 1, 10, 11});
    expect(high_halves(a, b), {2, 3, 12, 13});
    expect(low_and_high(a, b), {0, 1, 12, 13});
    expect(even_lanes(a, b), {0, 2, 10, 12});
    expect(odd_lanes(a, b), {1, 3, 11, 13});
    expect(interleaved_high(a, b), {2, 12, 3, 13});
    expect(swapped_halves(a), {2, 3, 0, 1});
    expect(swapped_neighbours(a), {1, 0, 3, 2});
    expect(with_last(a, b), {0, 1, 2, 13});
    EXPECT_EQ(first_lane(b), 10);
    EXPECT_EQ(bits(a < four_of(1, 1, 3, 3)), 0b0101u);
}

} // namespace
} // namespace carom::internal
