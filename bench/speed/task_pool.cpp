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

TaskPool::TaskPool(int count)
{
    for (int i = 1; i < count; ++i)
        m_threads.emplace_back([this] { serve(); });
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
    m_tickets = std::uint64_t{round} << 32 | static_cast<std::uint32_t>(count);
    m_round = round;
    m_round.notify_all();
    while (take_task())
    {
    }
    while (m_done != count)
        pause();
}

// Who holds a ticket keeps its round from ending.
bool TaskPool::take_task()
{
    std::uint64_t tickets = m_tickets;
    do
    {
        if (static_cast<std::uint32_t>(tickets) == 0)
            return false;
    } while (!m_tickets.compare_exchange_weak(tickets, tickets - 1));
    m_task(m_context, m_count - static_cast<int>(static_cast<std::uint32_t>(tickets)));
    ++m_done;
    return true;
}

void TaskPool::serve()
{
    for (std::uint32_t seen = 0;;)
    {
        wait_for_round(seen);
        seen = m_round;
        if (m_over)
            return;
        while (take_task())
        {
        }
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
