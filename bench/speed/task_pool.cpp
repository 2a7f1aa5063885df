#include "speed/task_pool.h"

namespace speed {

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
    m_next = 0;
    m_working = static_cast<int>(m_threads.size());
    ++m_round;
    m_round.notify_all();
    take_tasks();
    // A thread that came late may still hold the number of a task.
    for (int working = m_working; working != 0; working = m_working)
        m_working.wait(working);
}

void TaskPool::take_tasks()
{
    for (int i = m_next++; i < m_count; i = m_next++)
        m_task(m_context, i);
}

void TaskPool::serve()
{
    for (unsigned round = 0;;)
    {
        m_round.wait(round);
        ++round;
        if (m_over)
            return;
        take_tasks();
        if (--m_working == 0)
            m_working.notify_one();
    }
}

} // namespace speed
