#pragma once

// The wide constraints of an island lie in buckets, two to a color. A large island is cut into partitions of the plane, each with buckets of its own. No
// two partitions share a body that has finite mass, so that threads solve them side by side, and the bodies of a partition stay in the cache. Boundary
// constraints, between bodies of two partitions, have buckets behind those of all partitions and are solved before them, color by color.

#include "core/worker_team.h"
#include "dynamics/step_context.h"

namespace carom::internal {

class Partitions
{
public:
    /// `buckets`: in each partition, and of boundary constraints.
    Partitions(const std::vector<std::int32_t>& starts, std::int32_t first, std::int32_t partitions, std::int32_t buckets)
        : m_starts(starts.data() + first), m_parts(partitions), m_buckets(buckets)
    {}

    /// Calls pass(first, last) for blocks of one bucket, no two of which share a body that has finite mass. Calls that run side by side share none either.
    template <class Pass>
    void by_color(WorkerTeam& team, const Pass& pass)
    {
        boundary(team, pass);
        in_parts(team, [&](int partition) { of_part(partition, pass); });
    }

    /// The same for the boundary constraints.
    template <class Pass>
    void boundary(WorkerTeam& team, const Pass& pass) const
    {
        for (int bucket = m_parts * m_buckets; bucket < (m_parts + 1) * m_buckets; ++bucket)
            share_bucket(team, bucket, pass);
    }

    /// The same for one partition, on this thread.
    template <class Pass>
    void of_part(int partition, const Pass& pass) const
    {
        for (int bucket = partition * m_buckets; bucket < (partition + 1) * m_buckets; ++bucket)
        {
            if (start(bucket) < start(bucket + 1))
                pass(start(bucket), start(bucket + 1));
        }
    }

    /// Calls work(partition) for all of them, side by side. Directions alternate: a pass begins with the partitions that the last one left in the cache.
    template <class Work>
    void in_parts(WorkerTeam& team, const Work& work)
    {
        m_backwards = !m_backwards;
        team.in_pieces(m_parts, m_backwards, work);
    }

    /// Calls pass(first, last) for blocks in any order, mostly on the worker that solves them.
    template <class Pass>
    void all(WorkerTeam& team, const Pass& pass) const
    {
        const auto those = [&](int first, int last)
        {
            if (first < last)
                pass(first, last);
        };
        const int boundary = m_parts * m_buckets;
        const int end = boundary + m_buckets;
        if (m_parts == 0 || start(end) < enough_blocks)
        {
            team.share(start(end), enough_blocks, those);
            return;
        }
        constexpr int quarters = 4; // of a partition: no worker waits long for the last
        const auto slice = [&](int first, int last, int i, int slices)
        { those(first + WorkerTeam::bound(last - first, i, slices), first + WorkerTeam::bound(last - first, i + 1, slices)); };
        team.in_pieces(quarters * m_parts, false,
                       [&](int piece)
                       {
                           const int partition = piece / quarters;
                           slice(start(partition * m_buckets), start((partition + 1) * m_buckets), piece % quarters, quarters);
                           slice(start(boundary), start(end), piece, quarters * m_parts);
                       });
    }

    /// Calls work(first, last, partition) for the blocks of each partition, side by side. Returns where the boundary constraints begin.
    template <class Work>
    int by_part(WorkerTeam& team, const Work& work) const
    {
        team.in_pieces(m_parts, false,
                       [&](int partition) { work(start(partition * m_buckets), start((partition + 1) * m_buckets), partition); });
        return start(m_parts * m_buckets);
    }

    /// Calls visit(block), mostly on the worker that solves it.
    template <class Visit>
    void for_each(WorkerTeam& team, const Visit& visit) const
    {
        all(team,
            [&](int first, int last)
            {
                for (int block = first; block < last; ++block)
                    visit(block);
            });
    }

private:
    static constexpr int enough_blocks = 24; // to share among workers

    // All workers take some blocks of one bucket.
    template <class Pass>
    void share_bucket(WorkerTeam& team, int bucket, const Pass& pass) const
    {
        team.share(start(bucket + 1) - start(bucket), enough_blocks,
                   [&](int first, int last)
                   {
                       if (first < last)
                           pass(start(bucket) + first, start(bucket) + last);
                   });
    }

    [[nodiscard]] int start(int bucket) const { return m_starts[bucket]; }

    const std::int32_t* m_starts; ///< with the end of the last bucket
    int m_parts;
    int m_buckets;
    bool m_backwards = false;
};

/// True if all threads solve it together.
[[nodiscard]] inline bool is_shared(const Island& island)
{
    return is_worth_all_threads(island.partitions, island.wide_joint_count);
}

/// True if its constraints come from memory, not from a cache.
[[nodiscard]] inline bool are_constraints_far(const Island& island) { return is_beyond_caches(island.wide_count); }

[[nodiscard]] inline Partitions contact_buckets(const Scratch& scratch, const Island& island)
{
    return {scratch.solver.bucket_starts, island.first_bucket, island.partitions, island.bucket_count};
}

[[nodiscard]] inline Partitions joint_buckets(const Scratch& scratch, const Island& island)
{
    return {scratch.solver.joint_bucket_starts, island.first_joint_bucket, 0, island.joint_bucket_count};
}

} // namespace carom::internal
