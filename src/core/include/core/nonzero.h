#pragma once

// Iteration over the bytes of an array that are not 0.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace carom::internal {

/// Calls visit(i) for each of `count` bytes that is not 0, in order. Eight bytes that are all 0 are skipped at once.
template <class Visit>
void for_each_nonzero(const std::uint8_t* bytes, std::size_t count, const Visit& visit)
{
    constexpr std::size_t at_once = sizeof(std::uint64_t);
    for (std::size_t first = 0; first < count; first += at_once)
    {
        const std::size_t last = std::min(first + at_once, count);
        std::uint64_t any = 0;
        std::memcpy(&any, bytes + first, last - first);
        for (std::size_t i = first; any != 0 && i < last; ++i)
        {
            if (bytes[i] != 0)
                visit(i);
        }
    }
}

} // namespace carom::internal
