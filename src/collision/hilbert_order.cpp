// Codes along a Hilbert curve, and the radix sort by them.

#include "collision/hilbert_order.h"

#include <utility>

namespace carom::internal {

namespace {

constexpr int digit_bits = 11;
constexpr int digits = 3;
constexpr std::uint32_t digit_values = 1u << digit_bits;

// Each quarter of a square is traversed by the same curve, mirrored so that it begins where the previous one ends. What two bits of a position mean depends on
// the mirrors set by the bits before. A table handles four bits of each coordinate at a time.
struct Walk
{
    std::uint8_t code;
    std::uint8_t mirrors;
};
struct WalkTable
{
    Walk of[4][16][16]; ///< by mirrors, and four bits of x and y

    constexpr WalkTable() : of{}
    {
        for (unsigned mirrors = 0; mirrors < 4; ++mirrors)
        {
            for (unsigned x = 0; x < 16; ++x)
            {
                for (unsigned y = 0; y < 16; ++y)
                    of[mirrors][x][y] = four_bits(mirrors, x, y);
            }
        }
    }

    static constexpr Walk four_bits(unsigned mirrors, unsigned x, unsigned y)
    {
        bool swapped = (mirrors & 1) != 0;
        bool flipped = (mirrors & 2) != 0;
        unsigned code = 0;
        for (int bit = 3; bit >= 0; --bit)
        {
            const bool is_right = (x >> bit & 1) != 0;
            const bool is_above = (y >> bit & 1) != 0;
            const bool right = (swapped ? is_above : is_right) != flipped;
            const bool above = (swapped ? is_right : is_above) != flipped;
            code = code << 2 | ((right ? 3u : 0u) ^ (above ? 1u : 0u));
            swapped = swapped != !above;
            flipped = flipped != (right && !above);
        }
        return {static_cast<std::uint8_t>(code), static_cast<std::uint8_t>((swapped ? 1u : 0u) | (flipped ? 2u : 0u))};
    }
};

std::uint32_t digit(const HilbertOrder::Key& k, int d) { return k.code >> (d * digit_bits) & (digit_values - 1); }

} // namespace

std::uint32_t HilbertOrder::along_curve(std::uint32_t x, std::uint32_t y)
{
    static constexpr WalkTable table;
    std::uint32_t code = 0;
    unsigned mirrors = 0;
    for (int shift = 12; shift >= 0; shift -= 4)
    {
        const Walk& walk = table.of[mirrors][x >> shift & 15u][y >> shift & 15u];
        code = code << 8 | walk.code;
        mirrors = walk.mirrors;
    }
    return code;
}

// Least significant digit first; stable, so that equal codes keep their order.
void HilbertOrder::radix_sort()
{
    std::uint32_t counts[digits][digit_values] = {};
    for (const Key& k : m_keys)
    {
        for (int d = 0; d < digits; ++d)
            ++counts[d][digit(k, d)];
    }
    set_size(m_other, m_keys.size());
    for (int d = 0; d < digits; ++d)
    {
        std::uint32_t start = 0;
        for (std::uint32_t& count : counts[d])
            start += std::exchange(count, start);
        for (const Key& k : m_keys)
            m_other[counts[d][digit(k, d)]++] = k;
        m_keys.swap(m_other);
    }
}

} // namespace carom::internal
