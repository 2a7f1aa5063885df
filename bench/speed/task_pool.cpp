#include "speed/task_pool.h"

namespace speed {

namespace {

constexpr int looks = 60000; // before a thread goes to sleep: about a millisecond, what one thread has to do alone within a step

void pause()
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#else
    std::this_thread::yield();
#endif
}

} // namespace

TaskPool::TaskPool(int count) : m_shares(static_cast<std::size_t>(count))
{
    for (int i = 1; i < count; ++i)
        m_threads.emplace_back([this, i] { serve(i); });
}

TaskPool::~TaskPool()
{
    m_over = true;
    ++m_round;
    m_round.notify_all();
    for (std::thread& thread : m_threads)
        thread.join();
}

carom::TaskHooks TaskPool::hooks()
{
    if (m_threads.empty())
        return {};
    const auto run_on = [](void* pool, int count, Task task, void* context)
    { static_cast<TaskPool*>(pool)->run(count, task, context); };
    return {.worker_count = static_cast<int>(m_threads.size()) + 1, .run = run_on, .user = this};
}

void TaskPool::run(int count, Task task, void* context)
{
    m_count = count;
    m_task = task;
    m_context = context;
    m_done = 0;
    const std::uint32_t round = m_round + 1;
    int first = 0;
    for (int i = 0; i < static_cast<int>(m_shares.size()); ++i)
    {
        const int end = end_of_share(i);
        m_shares[static_cast<std::size_t>(i)].tickets = std::uint64_t{round} << 32 | static_cast<std::uint32_t>(end - first);
        first = end;
    }
    m_round = round;
    m_round.notify_all();
    work_off(0);
    while (m_done != count)
        pause();
}

int TaskPool::end_of_share(int thread) const
{
    return static_cast<int>(std::int64_t{m_count} * (thread + 1) / static_cast<std::int64_t>(m_shares.size()));
}

// Tells what is done share by share: others look at the number all the time.
void TaskPool::work_off(int thread)
{
    const int threads = static_cast<int>(m_shares.size());
    for (int i = 0; i < threads; ++i)
    {
        int done = 0;
        while (take_task((thread + i) % threads))
            ++done;
        if (done > 0)
            m_done += done;
    }
}

// A thread that holds a ticket, or has not reported what it did with one, keeps its round from ending.
bool TaskPool::take_task(int thread)
{
    std::atomic<std::uint64_t>& share = m_shares[static_cast<std::size_t>(thread)].tickets;
    std::uint64_t tickets = share;
    do
    {
        if (static_cast<std::uint32_t>(tickets) == 0)
            return false;
    } while (!share.compare_exchange_weak(tickets, tickets - 1));
    m_task(m_context, end_of_share(thread) - static_cast<int>(static_cast<std::uint32_t>(tickets)));
    return true;
}

void TaskPool::serve(int thread)
{
    for (std::uint32_t seen = 0;;)
    {
        wait_for_round(seen);
        seen = m_round;
        if (m_over)
            return;
        work_off(thread);
    }
}

void TaskPool::wait_for_round(std::uint32_t seen) const
{
    for (int i = 0; i < looks; ++i)
    {
        if (m_round != seen)
            return;
        pause();
    }
    m_round.wait(seen);
}

} // namespace speed
