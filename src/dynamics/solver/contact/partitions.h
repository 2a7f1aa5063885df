#pragma once

// Wide constraints of an island stand in bins, two to a colour. A large island is cut into parts of the plane, each with bins of its own: no two parts share a body that
// gives way, so that threads solve them side by side, and bodies of a part stay in the cache. What crosses from one part to another has bins behind all parts' and
// is solved before them, colour by colour.

#include "core/worker_team.h"
#include "dynamics/step_context.h"

namespace carom::internal {

class Partitions
{
public:
    /// `bins` of each part, and of what crosses.
    Partitions(const std::vector<std::int32_t>& starts, std::int32_t first, std::int32_t parts, std::int32_t bins)
        : m_starts(starts.data() + first), m_parts(parts), m_bins(bins)
    {}

    /// Calls pass(first, last) for groups of one bin, of which no two share a body that gives way. What threads do side by side shares none either.
    template <class Pass>
    void by_color(WorkerTeam& team, const Pass& pass)
    {
        crossing(team, pass);
        in_parts(team, [&](int part) { of_part(part, pass); });
    }

    /// Of what crosses from one part to another.
    template <class Pass>
    void crossing(WorkerTeam& team, const Pass& pass) const
    {
        for (int bin = m_parts * m_bins; bin < (m_parts + 1) * m_bins; ++bin)
            share_bin(team, bin, pass);
    }

    /// Of one part.
    template <class Pass>
    void of_part(int part, const Pass& pass) const
    {
        for (int bin = part * m_bins; bin < (part + 1) * m_bins; ++bin)
        {
            if (start(bin) < start(bin + 1))
                pass(start(bin), start(bin + 1));
        }
    }

    /// Calls work(part) for all of them, side by side. To and fro: a walk begins with the parts that the last one has left in the cache.
    template <class Work>
    void in_parts(WorkerTeam& team, const Work& work)
    {
        m_backwards = !m_backwards;
        team.in_pieces(m_parts, m_backwards, work);
    }

    /// Calls pass(first, last) for groups in any order, mostly by the member that solves them.
    template <class Pass>
    void all(WorkerTeam& team, const Pass& pass) const
    {
        const auto those = [&](int first, int last)
        {
            if (first < last)
                pass(first, last);
        };
        const int crossing = m_parts * m_bins;
        const int end = crossing + m_bins;
        if (m_parts == 0 || start(end) < enough_groups)
        {
            team.share(start(end), enough_groups, those);
            return;
        }
        constexpr int quarters = 4; // of a part: nobody waits long for the last
        const auto slice = [&](int first, int last, int i, int slices)
        { those(first + WorkerTeam::bound(last - first, i, slices), first + WorkerTeam::bound(last - first, i + 1, slices)); };
        team.in_pieces(quarters * m_parts, false,
                       [&](int piece)
                       {
                           const int part = piece / quarters;
                           slice(start(part * m_bins), start((part + 1) * m_bins), piece % quarters, quarters);
                           slice(start(crossing), start(end), piece, quarters * m_parts);
                       });
    }

    /// Calls work(first, last, part) for the groups of each part, side by side. Returns where what crosses begins.
    template <class Work>
    int by_part(WorkerTeam& team, const Work& work) const
    {
        team.in_pieces(m_parts, false, [&](int part) { work(start(part * m_bins), start((part + 1) * m_bins), part); });
        return start(m_parts * m_bins);
    }

    /// Calls visit(group), mostly by the member that solves it.
    template <class Visit>
    void for_each(WorkerTeam& team, const Visit& visit) const
    {
        all(team,
            [&](int first, int last)
            {
                for (int group = first; group < last; ++group)
                    visit(group);
            });
    }

private:
    static constexpr int enough_groups = 24; // to share

    // All members take some of one bin's groups.
    template <class Pass>
    void share_bin(WorkerTeam& team, int bin, const Pass& pass) const
    {
        team.share(start(bin + 1) - start(bin), enough_groups,
                   [&](int first, int last)
                   {
                       if (first < last)
                           pass(start(bin) + first, start(bin) + last);
                   });
    }

    [[nodiscard]] int start(int bin) const { return m_starts[bin]; }

    const std::int32_t* m_starts; ///< and where the last ends
    int m_parts;
    int m_bins;
    bool m_backwards = false;
};

/// All threads solve it together.
[[nodiscard]] inline bool is_shared(const Island& island) { return is_worth_all_threads(island.parts, island.wide_joint_count); }

/// Its constraints come from memory.
[[nodiscard]] inline bool are_constraints_far(const Island& island) { return is_beyond_caches(island.wide_count); }

[[nodiscard]] inline Partitions contact_bins(const Scratch& scratch, const Island& island)
{
    return {scratch.solver.bin_starts, island.first_bin, island.parts, island.bin_count};
}

[[nodiscard]] inline Partitions joint_bins(const Scratch& scratch, const Island& island)
{
    return {scratch.solver.joint_bin_starts, island.first_joint_bin, 0, island.joint_bin_count};
}

} // namespace carom::internal
