#pragma once

// Many short rounds of shared work inside one long task: the colours of a large unit. Tasks of the user's job system are too dear for that, so
// one set of them stays together: the first to come leads, and does everything itself if nobody comes; the others take shares of whatever the
// leader offers, until it is done. Shares write only what is their own; so who takes which does not matter.

#include "core/task_pool.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace carom::internal {

class Crew
{
public:
    /// Runs lead(crew) once, with the others of the hooks' workers at hand.
    template <class Lead>
    static void run(const TaskHooks& hooks, const Lead& lead)
    {
        Crew crew;
        if (hooks.run == nullptr || hooks.worker_count <= 1)
        {
            lead(crew);
            return;
        }
        crew.m_has_helpers = true;
        run_tasks(hooks, hooks.worker_count,
                  [&](int)
                  {
                      if (crew.m_has_leader.exchange(true))
                      {
                          crew.help();
                          return;
                      }
                      lead(crew);
                      crew.m_over = true;
                  });
    }

    [[nodiscard]] bool has_helpers() const { return m_has_helpers; }

    /// Calls work(first, last) for shares of 0 ... count. For the leader.
    template <class Work>
    void share(int count, int share_size, const Work& work)
    {
        const int shares = (count + share_size - 1) / share_size;
        if (shares <= 1 || !m_has_helpers)
        {
            if (count > 0)
                work(0, count);
            return;
        }
        m_context = &work;
        m_work = [](const void* context, int first, int last) { (*static_cast<const Work*>(context))(first, last); };
        m_count = count;
        m_share_size = share_size;
        m_shares = shares;
        m_done = 0;
        m_tickets = std::uint64_t{++m_round} << 32 | static_cast<std::uint32_t>(shares);
        while (take_share())
        {
        }
        while (m_done != shares)
        {
        }
    }

private:
    // Who holds a ticket keeps its round from ending.
    bool take_share()
    {
        std::uint64_t tickets = m_tickets;
        do
        {
            if (static_cast<std::uint32_t>(tickets) == 0)
                return false;
        } while (!m_tickets.compare_exchange_weak(tickets, tickets - 1));
        const int first = (m_shares - static_cast<int>(static_cast<std::uint32_t>(tickets))) * m_share_size;
        m_work(m_context, first, std::min(first + m_share_size, m_count));
        ++m_done;
        return true;
    }

    void help()
    {
        while (!m_over)
            take_share();
    }

    using Work = void (*)(const void*, int, int);

    std::atomic<bool> m_has_leader{false};
    std::atomic<bool> m_over{false};
    alignas(64) std::atomic<std::uint64_t> m_tickets{0}; ///< round, and in the lower half how many of its shares nobody has taken
    alignas(64) std::atomic<int> m_done{0};
    bool m_has_helpers = false;
    // Of the round; they stay until all its shares are done.
    std::uint32_t m_round = 0;
    int m_count = 0;
    int m_share_size = 1;
    int m_shares = 0;
    Work m_work = nullptr;
    const void* m_context = nullptr;
};

} // namespace carom::internal
