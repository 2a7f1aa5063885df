#pragma once

// Wide rows of a unit stand in bins, two to a colour. A large unit is cut into parts of the plane, each with bins of its own: no two parts share a body that
// gives way, so that threads solve them side by side, and bodies of a part stay in the cache. What crosses from one part to another has bins behind all parts' and
// is solved before them, colour by colour.

#include "core/crew.h"
#include "dynamics/step_context.h"

namespace carom::internal {

class UnitBins
{
public:
    /// `bins` of each part, and of what crosses; of bin i the groups starts[i] ... ends[i], with room behind them.
    UnitBins(const std::int32_t* starts, const std::int32_t* ends, std::int32_t parts, std::int32_t bins)
        : m_starts(starts), m_ends(ends), m_parts(parts), m_bins(bins)
    {}

    /// Calls pass(first, last) for groups of one bin, of which no two share a body that gives way. What threads do side by side shares none either.
    template <class Pass>
    void by_color(Crew& crew, const Pass& pass)
    {
        m_backwards = !m_backwards;
        for (int bin = crossing(); bin < end(); ++bin)
            share_bin(crew, bin, pass);
        if (m_parts > 0)
            crew.in_parts([&](int member, int members) { solve_parts(member, members, pass); });
    }

    /// Calls pass(first, last) for groups of one bin, in any order, those of a part by the member that solves them.
    template <class Pass>
    void all(Crew& crew, const Pass& pass) const
    {
        if (m_parts == 0 && !is_worth_sharing())
        {
            one_by_one(0, end(), pass);
            return;
        }
        crew.in_parts(
            [&](int member, int members)
            {
                one_by_one(Crew::bound(m_parts, member, members) * m_bins, Crew::bound(m_parts, member + 1, members) * m_bins,
                           pass);
                one_by_one(crossing() + Crew::bound(m_bins, member, members),
                           crossing() + Crew::bound(m_bins, member + 1, members), pass);
            });
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

    /// Calls pass(first, last) for the groups of one bin after the other.
    template <class Pass>
    void in_order(const Pass& pass) const
    {
        one_by_one(0, end(), pass);
    }

private:
    static constexpr int enough_groups = 12; // to share

    [[nodiscard]] int crossing() const { return m_parts * m_bins; }
    [[nodiscard]] int end() const { return (m_parts + 1) * m_bins; }

    [[nodiscard]] bool is_worth_sharing() const
    {
        int groups = 0;
        for (int bin = 0; bin < end(); ++bin)
            groups += m_ends[bin] - m_starts[bin];
        return groups >= enough_groups;
    }

    // To and fro: a pass begins with the parts that the last one has left in the cache.
    template <class Pass>
    void solve_parts(int member, int members, const Pass& pass) const
    {
        const int first = Crew::bound(m_parts, member, members);
        const int last = Crew::bound(m_parts, member + 1, members);
        for (int i = first; i < last; ++i)
        {
            const int part = m_backwards ? first + last - 1 - i : i;
            one_by_one(part * m_bins, (part + 1) * m_bins, pass);
        }
    }

    template <class Pass>
    void one_by_one(int first_bin, int last_bin, const Pass& pass) const
    {
        for (int bin = first_bin; bin < last_bin; ++bin)
        {
            if (m_starts[bin] < m_ends[bin])
                pass(m_starts[bin], m_ends[bin]);
        }
    }

    // All members take some of one bin's groups.
    template <class Pass>
    void share_bin(Crew& crew, int bin, const Pass& pass) const
    {
        crew.share(m_ends[bin] - m_starts[bin], enough_groups,
                   [&](int first, int last)
                   {
                       if (first < last)
                           pass(m_starts[bin] + first, m_starts[bin] + last);
                   });
    }

    const std::int32_t* m_starts;
    const std::int32_t* m_ends;
    int m_parts;
    int m_bins;
    bool m_backwards = false;
};

/// Hinges that are worth all threads: with fewer, waiting at the end of each colour costs more than a second thread gains.
inline constexpr int worth_all_threads = 1536; // groups
[[nodiscard]] inline bool is_large(const Unit& unit) { return unit.parts > 0 || unit.wide_joint_count >= worth_all_threads; }

[[nodiscard]] inline UnitBins contact_bins(const Scratch& scratch, const Unit& unit)
{
    return {scratch.bin_starts.data() + unit.first_bin, scratch.bin_ends.data() + unit.first_bin, unit.parts, unit.bin_count};
}

[[nodiscard]] inline UnitBins joint_bins(const Scratch& scratch, const Unit& unit)
{
    const std::int32_t* starts = scratch.joint_bin_starts.data() + unit.first_joint_bin;
    return {starts, starts + 1, 0, unit.joint_bin_count};
}

} // namespace carom::internal
