#pragma once

// Many short rounds of shared work inside one long task: passes over a large island. Tasks of the user's job system are too expensive for that, so
// one set of them stays together: the first to arrive leads, the others serve. A round has a part for each worker. A worker takes its own part of every
// round, so that its data is still in its cache, and an idle worker takes the parts of workers that have not arrived. A part writes only its own data, so
// the result does not depend on which worker takes it.

#include "core/task_pool.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace carom::internal {

class WorkerTeam
{
public:
    /// Runs lead(worker team) once, with the hooks' other workers available to it.
    template <class Lead>
    static void run(const TaskHooks& hooks, const Lead& lead)
    {
        run(hooks, lead, 0, [](int) {});
    }

    /// The same, and background(i) for each of 0 ... count: by workers that have had no part for a while, and by all when the leader is done.
    template <class Lead, class BackgroundTask>
    static void run(const TaskHooks& hooks, const Lead& lead, int count, const BackgroundTask& background)
    {
        WorkerTeam team;
        std::atomic<int> next{0};
        const auto take_background_task = [&]
        {
            const int i = next.load(std::memory_order_relaxed) < count ? next.fetch_add(1, std::memory_order_relaxed) : count;
            if (i < count)
                background(i);
            return i < count;
        };
        team.m_workers = hooks.run == nullptr ? 1 : std::min(hooks.worker_count, most_workers);
        run_tasks(hooks, hooks.worker_count,
                  [&](int)
                  {
                      const int worker = team.m_arrived++;
                      if (worker == 0)
                      {
                          lead(team);
                          team.m_over.store(true, std::memory_order_release);
                      }
                      else if (worker < team.m_workers)
                      {
                          team.serve(worker, take_background_task);
                      }
                      while (take_background_task())
                      {
                      }
                  });
    }

    [[nodiscard]] int workers() const { return m_workers; }
    [[nodiscard]] bool has_helpers() const { return m_workers > 1; }

    /// Calls work(part, parts) for each part. Only the leader calls this.
    template <class Work>
    void in_parts(const Work& work)
    {
        in_parts(&work, call_of<Work>, m_workers);
    }

    /// Calls work(piece) for each of 0 ... pieces. A worker begins with its own share of them, from either end, and then takes pieces that are left of the
    /// other shares: which worker does which piece is left to chance.
    template <class Work>
    void in_pieces(int pieces, bool backwards, const Work& work)
    {
        if (pieces == 0)
            return;
        std::atomic<int> next[most_workers];
        for (int m = 0; m < m_workers; ++m)
            next[m].store(bound(pieces, m, m_workers), std::memory_order_relaxed);
        in_parts(
            [&](int worker, int workers)
            {
                for (int i = 0; i < workers; ++i)
                {
                    const int owner = (worker + i) % workers;
                    const int first = bound(pieces, owner, workers);
                    const int last = bound(pieces, owner + 1, workers);
                    for (int piece; (piece = next[owner].fetch_add(1, std::memory_order_relaxed)) < last;)
                        work(backwards ? first + last - 1 - piece : piece);
                }
            });
    }

    /// Calls work(first, last) for a share of 0 ... count per part, or for all of it at once where `count` is below `enough`.
    template <class Work>
    void share(int count, int enough, const Work& work)
    {
        if (count == 0)
            return;
        const auto slice = [&](int part, int parts) { work(bound(count, part, parts), bound(count, part + 1, parts)); };
        in_parts(&slice, call_of<decltype(slice)>, count < enough ? 1 : m_workers);
    }

    /// Index at which the share of a part begins.
    [[nodiscard]] static int bound(int count, int part, int parts)
    {
        return static_cast<int>(std::int64_t{count} * part / parts);
    }

private:
    static constexpr int most_workers = 16;
    static constexpr int looks_at_own = 64;   // looks between those at the parts of other workers
    static constexpr int looks_at_all = 1024; // looks before a worker takes a background task: some microseconds

    // Work is passed by its address, as in run_tasks.
    using Call = void (*)(const void*, int, int);

    template <class Work>
    static void call_of(const void* work, int part, int parts)
    {
        (*static_cast<const Work*>(work))(part, parts);
    }

    struct alignas(64) Part
    {
        std::atomic<std::uint32_t> offered{0}; ///< the round in which the part is offered and not yet taken; 0: none
        std::atomic<std::uint32_t> done{0};    ///< the last round in which the part was done
        Call work = nullptr;                   ///< unchanged until the part is done
        const void* context = nullptr;
    };

    void in_parts(const void* work, Call call, int parts);
    bool take(int p);

    template <class TakeTask>
    void serve(int worker, const TakeTask& take_background_task)
    {
        for (int look = 1; !m_over.load(std::memory_order_acquire); ++look)
        {
            bool took = take(worker);
            for (int p = 1; !took && look % looks_at_own == 0 && p < m_workers; ++p)
                took = take(p);
            if (took || (look % looks_at_all == 0 && take_background_task()))
                look = 0;
        }
    }

    std::atomic<int> m_arrived{0};
    alignas(64) std::atomic<bool> m_over{false};
    alignas(64) std::uint32_t m_round = 0; ///< used by the leader only
    int m_workers = 1;
    Part m_parts[most_workers];
};

} // namespace carom::internal
