#pragma once

/// @file
/// Threads for carom::TaskHooks.

#include "carom/scene.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace speed {

/// Runs tasks on the calling thread and count - 1 more. One scene at a time. A step runs many short rounds of tasks: a thread that has
/// nothing to do keeps looking for a while before it goes to sleep, and one that comes too late is not waited for. In every round a thread begins with
/// its own share, in order, so that it comes back to what it has in its cache, and then helps the others.
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

    static constexpr std::size_t line = 64; ///< bytes of memory that one thread has or another

    /// State of a thread in this round: the round, and in the lower half how many of its tasks are left.
    struct alignas(line) Share
    {
        std::atomic<std::uint64_t> tickets{0};
    };

    void run(int count, Task task, void* context);
    void work_off(int thread);
    [[nodiscard]] bool take_task(int thread);
    [[nodiscard]] int end_of_share(int thread) const;
    void serve(int thread);
    void wait_for_round(std::uint32_t seen) const;

    std::vector<Share> m_shares;
    std::vector<std::thread> m_threads{};
    // Data of the round; they stay until all its tasks are done. A thread that sees the round begin sees all of it.
    alignas(line) std::atomic<std::uint32_t> m_round{0};
    std::atomic<bool> m_over{false};
    int m_count = 0;
    Task m_task = nullptr;
    void* m_context = nullptr;
    alignas(line) std::atomic<int> m_done{0};
};

} // namespace speed
