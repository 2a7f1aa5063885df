#pragma once

// The one place that knows of threads. A stage gives it a number of independent tasks; whether they run one after another or on the
// user's workers, the result is the same, because each task writes only what is its own.

#include "carom/scene.h"

#include <cstddef>

namespace carom::internal {

template <class Task>
void run_tasks(const TaskHooks& hooks, int count, const Task& task)
{
    if (hooks.run == nullptr || hooks.worker_count <= 1 || count <= 1)
    {
        for (int i = 0; i < count; ++i)
            task(i);
        return;
    }
    hooks.run(
        hooks.user, count, [](void* context, int index) { (*static_cast<const Task*>(context))(index); },
        const_cast<Task*>(&task));
}

/// Calls work(first, last) for parts of 0 ... count, a task each.
template <class Work>
void run_parts(const TaskHooks& hooks, std::size_t count, std::size_t part, const Work& work)
{
    run_tasks(hooks, static_cast<int>((count + part - 1) / part),
              [&](int task)
              {
                  const std::size_t first = static_cast<std::size_t>(task) * part;
                  work(first, first + part < count ? first + part : count);
              });
}

} // namespace carom::internal
