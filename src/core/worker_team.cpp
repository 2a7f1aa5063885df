// Rounds of work that the workers of a team share.

#include "core/worker_team.h"

namespace carom::internal {

void WorkerTeam::in_parts(const void* work, Call call, int parts)
{
    if (parts == 1)
    {
        call(work, 0, 1);
        return;
    }
    ++m_round;
    for (int p = 1; p < parts; ++p)
    {
        Part& part = m_parts[p];
        part.context = work;
        part.work = call;
        part.offered.store(m_round, std::memory_order_release);
    }
    call(work, 0, parts);
    for (int p = 1; p < parts; ++p)
        take(p);
    for (int p = 1; p < parts; ++p)
    {
        while (m_parts[p].done.load(std::memory_order_acquire) != m_round)
        {
        }
    }
}

// A round does not end before every part that was taken is done, so the part stays valid while a worker runs it.
bool WorkerTeam::take(int p)
{
    Part& part = m_parts[p];
    std::uint32_t round = part.offered.load(std::memory_order_relaxed);
    if (round == 0 || !part.offered.compare_exchange_strong(round, 0, std::memory_order_acquire))
        return false;
    part.work(part.context, p, m_workers);
    part.done.store(round, std::memory_order_release);
    return true;
}

} // namespace carom::internal
