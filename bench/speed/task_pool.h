#pragma once

/// @file
/// Threads for carom::TaskHooks.

#include "carom/scene.h"

#include <atomic>
#include <thread>
#include <vector>

namespace speed {

/// Runs tasks on the calling thread and count - 1 more. One scene at a time.
class TaskPool
{
public:
    explicit TaskPool(int count);
    ~TaskPool();
    TaskPool(const TaskPool&) = delete;
    TaskPool& operator=(const TaskPool&) = delete;

    /// For SceneDef::tasks of scenes that live shorter than the pool.
    [[nodiscard]] carom::TaskHooks hooks();

private:
    using Task = void (*)(void*, int);

    void run(int count, Task task, void* context);
    void take_tasks();
    void serve();

    std::atomic<unsigned> m_round{0};
    std::atomic<int> m_working{0};
    std::atomic<int> m_next{0};
    std::atomic<bool> m_over{false};
    int m_count = 0;
    Task m_task = nullptr;
    void* m_context = nullptr;
    std::vector<std::thread> m_threads{};
};

} // namespace speed
