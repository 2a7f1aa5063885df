#pragma once

// Fliers of an island that impacts have led off the paths with which pairs were found: they may be anywhere within their reach. A hash grid over the paths that
// they have left in the sub-step finds those that another flier may meet.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

/// A circle that moves evenly in the world: the body stays inside from `time` to the end of the sub-step.
struct Reach
{
    double x = 0; ///< at `time`
    double y = 0;
    double vx = 0;
    double vy = 0;
    double time = 0;
    double radius = 1e300;
};

class DeflectedFliers
{
public:
    static constexpr std::size_t most_found = 64;

    void clear();
    /// A flier that was not deflected so far; returns its index here. It is found only once it has a reach.
    [[nodiscard]] std::int32_t add(std::int32_t flier);
    [[nodiscard]] bool empty() const { return m_fliers.empty(); }

    /// At the start of a sub-step that ends at `end`; reaches: of all fliers.
    void set_all(double end, std::span<const Reach> reaches);
    /// The reach of the one at an index has changed.
    void set(std::int32_t index, std::span<const Reach> reaches);

    /// Calls visit(flier), in their order, for all whose paths may come to that of `own`, and for some more. Returns the number of calls.
    template <class Visit>
    int for_each_near(const Reach& own, const Visit& visit) const
    {
        std::array<std::int32_t, most_found> found;
        const std::size_t count = find_near(own, found);
        const std::span<const std::int32_t> fliers =
            count > most_found ? std::span(m_fliers) : std::span<const std::int32_t>(found).first(count);
        for (const std::int32_t flier : fliers)
            visit(flier);
        return static_cast<int>(fliers.size());
    }

private:
    struct Entry
    {
        std::int32_t index;
        std::int32_t version;
        std::int32_t next;
        std::int64_t x0, y0; ///< first cell of its path
    };
    struct Cells
    {
        std::int64_t x0, y0, x1, y1;
        [[nodiscard]] bool are_many() const;
    };

    [[nodiscard]] Cells cells_of(const Reach& reach) const;
    [[nodiscard]] std::size_t slot_of(std::int64_t x, std::int64_t y) const;
    void fill_grid(std::span<const Reach> reaches);
    void enter(std::int32_t index, const Reach& reach);
    /// Fliers nearby, in their order; a count of more than most_found: too many to tell.
    [[nodiscard]] std::size_t find_near(const Reach& own, std::span<std::int32_t> found) const;

    std::vector<std::int32_t> m_fliers;   ///< by index
    std::vector<std::int32_t> m_versions; ///< counts changes of a reach: entries of older versions are void
    std::vector<Entry> m_entries;
    std::vector<std::int32_t>
        m_heads; ///< first entry of each slot of the hash table; empty: few fliers, which are looked at one by one
    std::vector<std::int32_t> m_wide; ///< indices of those whose paths cover many cells
    double m_end = 0;
    double m_cell = 1;
};

} // namespace carom::internal
