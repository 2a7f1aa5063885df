#pragma once

// Wide rows of a unit stand in bins, two to a colour. A bin is cut into cells: what lies in one part of the plane. Members of a crew take the same cells of
// all bins, so that each keeps to its own bodies.

#include "core/crew.h"
#include "dynamics/step_context.h"

namespace carom::internal {

class UnitBins
{
public:
    UnitBins(const std::vector<std::int32_t>& starts, std::int32_t first, std::int32_t count, std::int32_t cells)
        : m_starts(starts.data() + first), m_count(count), m_cells(cells)
    {}

    /// Calls pass(first, last) for groups, colour by colour: within one no two share a body that gives way.
    template <class Pass>
    void by_color(Crew& crew, const Pass& pass) const
    {
        if (!crew.has_helpers())
        {
            of_bins(crew, 0, m_count, pass);
            return;
        }
        for (int bin = 0; bin < m_count;)
        {
            int next = bin + 2;
            if (is_small(bin, next))
            { // with others as small, one after the other
                while (next < m_count && is_small(next, next + 2))
                    next += 2;
                if (start(bin) < start(next))
                    pass(start(bin), start(next));
            }
            else
            {
                of_bins(crew, bin, next, pass);
            }
            bin = next;
        }
    }

    /// In any order.
    template <class Pass>
    void all(Crew& crew, const Pass& pass) const
    {
        of_bins(crew, 0, m_count, pass);
    }

    /// Calls visit(group), each by the member that solves it.
    template <class Visit>
    void for_each(Crew& crew, const Visit& visit) const
    {
        all(crew,
            [&](int first, int last)
            {
                for (int group = first; group < last; ++group)
                    visit(group);
            });
    }

private:
    static constexpr int enough_groups = 12; // to share

    template <class Pass>
    void of_bins(Crew& crew, int first_bin, int last_bin, const Pass& pass) const
    {
        if (!crew.has_helpers() || is_small(first_bin, last_bin))
        {
            if (start(first_bin) < start(last_bin))
                pass(start(first_bin), start(last_bin));
            return;
        }
        crew.in_parts(
            [&](int part, int parts)
            {
                for (int bin = first_bin; bin < last_bin; ++bin)
                {
                    const int begin = start(bin, part, parts);
                    const int end = start(bin, part + 1, parts);
                    if (begin < end)
                        pass(begin, end);
                }
            });
    }

    [[nodiscard]] bool is_small(int first_bin, int last_bin) const { return start(last_bin) - start(first_bin) < enough_groups; }
    [[nodiscard]] int start(int bin) const { return m_starts[bin * m_cells]; }
    // Parts are made of whole cells, where there are any.
    [[nodiscard]] int start(int bin, int part, int parts) const
    {
        return m_cells > 1 ? m_starts[bin * m_cells + Crew::bound(m_cells, part, parts)]
                           : start(bin) + Crew::bound(start(bin + 1) - start(bin), part, parts);
    }

    const std::int32_t* m_starts; ///< of each cell; and where the last ends
    int m_count;
    int m_cells;
};

/// Groups that are worth all threads: with fewer, waiting at the end of each colour costs more than a second thread gains.
inline constexpr int worth_all_threads = 1536;
[[nodiscard]] inline bool is_large(const Unit& unit) { return unit.wide_count + unit.wide_joint_count >= worth_all_threads; }

[[nodiscard]] inline UnitBins contact_bins(const Scratch& scratch, const Unit& unit)
{
    return {scratch.bin_starts, unit.first_bin, unit.bin_count, unit.cells};
}

[[nodiscard]] inline UnitBins joint_bins(const Scratch& scratch, const Unit& unit)
{
    return {scratch.joint_bin_starts, unit.first_joint_bin, unit.joint_bin_count, 1};
}

} // namespace carom::internal
