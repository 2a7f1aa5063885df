#pragma once

// Many short rounds of shared work inside one long task: the colours of a large unit. Tasks of the user's job system are too dear for that, so
// one set of them stays together: the first to come leads, and does everything itself if nobody comes; the others take shares of whatever the
// leader offers, until it is done. Shares write only what is their own; so who takes which does not matter. Each begins with its own part of
// every round, so that what it has worked on before is still in its cache, and then helps the others.

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
        crew.m_members = std::min(hooks.worker_count, most_members);
        run_tasks(hooks, crew.m_members,
                  [&](int)
                  {
                      const int member = crew.m_arrived++;
                      if (member > 0)
                      {
                          crew.help(member);
                          return;
                      }
                      lead(crew);
                      crew.m_over = true;
                  });
    }

    [[nodiscard]] bool has_helpers() const { return m_members > 1; }

    /// Calls work(first, last) for shares of 0 ... count. For the leader.
    template <class Work>
    void share(int count, int share_size, const Work& work)
    {
        const int shares = (count + share_size - 1) / share_size;
        if (shares <= 1 || !has_helpers())
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
        ++m_round;
        for (int p = 0; p < m_members; ++p)
            m_parts[p].tickets = std::uint64_t{m_round} << 32 | static_cast<std::uint32_t>(part_end(p) - part_end(p - 1));
        while (take_share(0))
        {
        }
        while (m_done != shares)
        {
        }
    }

private:
    static constexpr int most_members = 16;

    struct alignas(64) Part
    {
        std::atomic<std::uint64_t> tickets{0}; ///< round, and in the lower half how many of its shares nobody has taken
    };

    [[nodiscard]] int part_end(int part) const { return (part + 1) * m_shares / m_members; }

    bool take_share(int member)
    {
        for (int i = 0; i < m_members; ++i)
        {
            if (take_share_of((member + i) % m_members))
                return true;
        }
        return false;
    }

    // Who holds a ticket keeps its round from ending.
    bool take_share_of(int part)
    {
        std::atomic<std::uint64_t>& at = m_parts[part].tickets;
        std::uint64_t tickets = at;
        do
        {
            if (static_cast<std::uint32_t>(tickets) == 0)
                return false;
        } while (!at.compare_exchange_weak(tickets, tickets - 1));
        const int first = (part_end(part) - static_cast<int>(static_cast<std::uint32_t>(tickets))) * m_share_size;
        m_work(m_context, first, std::min(first + m_share_size, m_count));
        ++m_done;
        return true;
    }

    void help(int member)
    {
        while (!m_over)
            take_share(member);
    }

    using Work = void (*)(const void*, int, int);

    std::atomic<int> m_arrived{0};
    std::atomic<bool> m_over{false};
    int m_members = 1;
    Part m_parts[most_members];
    alignas(64) std::atomic<int> m_done{0};
    // Of the round; they stay until all its shares are done.
    alignas(64) std::uint32_t m_round = 0;
    int m_count = 0;
    int m_share_size = 1;
    int m_shares = 0;
    Work m_work = nullptr;
    const void* m_context = nullptr;
};

} // namespace carom::internal
