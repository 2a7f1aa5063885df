#pragma once

// A tournament tree: the least of many times, of which one changes at a time. A change replays the matches of that one alone.

#include <cstddef>
#include <cstdint>
#include <span>

namespace carom::internal {

class Tournament
{
public:
    /// times: of all contestants; winners: two for each.
    Tournament(std::span<const double> times, std::span<std::int32_t> winners) : m_times(times), m_winners(winners) {}

    /// Plays all matches.
    void start()
    {
        const std::size_t n = m_times.size();
        for (std::size_t i = 0; i < n; ++i)
            m_winners[n + i] = static_cast<std::int32_t>(i);
        for (std::size_t node = n - 1; node > 0; --node)
            play(node);
    }

    /// The time of one has changed.
    void replay(std::size_t contestant)
    {
        for (std::size_t node = (m_times.size() + contestant) / 2; node > 0; node /= 2)
            play(node);
    }

    /// At equal times, the first in the list.
    [[nodiscard]] std::size_t first() const { return static_cast<std::size_t>(m_times.size() > 1 ? m_winners[1] : 0); }
    [[nodiscard]] double time(std::size_t contestant) const { return m_times[contestant]; }

private:
    void play(std::size_t node)
    {
        const std::int32_t a = m_winners[2 * node];
        const std::int32_t b = m_winners[2 * node + 1];
        const double of_a = m_times[static_cast<std::size_t>(a)];
        const double of_b = m_times[static_cast<std::size_t>(b)];
        m_winners[node] = of_a < of_b || (of_a == of_b && a < b) ? a : b;
    }

    std::span<const double> m_times;
    std::span<std::int32_t> m_winners; ///< by node: 1 is the root, the contestants' own nodes come last
};

} // namespace carom::internal
