#pragma once

// Many short rounds of shared work inside one long task: passes over a large island. Tasks of the user's job system are too dear for that, so
// one set of them stays together: the first to come leads, the others serve. A round has a part for each; a member takes its own part of every round, so
// that what it has worked on before is still in its cache, and whoever is ready takes those of members that have not come. Parts write only what
// is their own; so who takes which does not matter.

#include "core/task_pool.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace carom::internal {

class WorkerTeam
{
public:
    /// Runs lead(worker team) once, with the others of the hooks' workers at hand.
    template <class Lead>
    static void run(const TaskHooks& hooks, const Lead& lead)
    {
        run(hooks, lead, 0, [](int) {});
    }

    /// The same, and aside(i) for each of 0 ... count: by members that the leader has had nothing for in a while, and by all when it is done.
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

    /// Calls work(part, parts) for each part. For the leader.
    template <class Work>
    void in_parts(const Work& work)
    {
        in_parts(&work, call_of<Work>, m_workers);
    }

    /// Calls work(piece) for each of 0 ... pieces. A member begins with its own slice of them, from either end, and then takes what others have
    /// left of theirs: who does which is chance.
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

    /// Calls work(first, last) for a slice of 0 ... count to each part, where there is enough to share.
    template <class Work>
    void share(int count, int enough, const Work& work)
    {
        if (count == 0)
            return;
        const auto slice = [&](int part, int parts) { work(bound(count, part, parts), bound(count, part + 1, parts)); };
        in_parts(&slice, call_of<decltype(slice)>, count < enough ? 1 : m_workers);
    }

    /// Where the slice of a part begins.
    [[nodiscard]] static int bound(int count, int part, int parts)
    {
        return static_cast<int>(std::int64_t{count} * part / parts);
    }

private:
    static constexpr int most_workers = 16;
    static constexpr int looks_at_own = 64;   // before a member looks for parts of others
    static constexpr int looks_at_all = 1024; // before it takes what is to be done aside: some microseconds

    // By its address, as in run_tasks.
    using Call = void (*)(const void*, int, int);

    template <class Work>
    static void call_of(const void* work, int part, int parts)
    {
        (*static_cast<const Work*>(work))(part, parts);
    }

    struct alignas(64) Part
    {
        std::atomic<std::uint32_t> offered{0}; ///< in this round, and nobody has taken it; 0: none
        std::atomic<std::uint32_t> done{0};    ///< the last round in which it was
        Call work = nullptr;                   ///< stays until it is done
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
    alignas(64) std::uint32_t m_round = 0; ///< the leader's
    int m_workers = 1;
    Part m_parts[most_workers];
};

} // namespace carom::internal
