// Runs independent tasks here or on the user's workers.

#include "core/task_pool.h"

#include "core/rounding.h"

namespace carom::internal {

void run_tasks(const TaskHooks& hooks, int count, const void* task, TaskCall call)
{
    if (hooks.run == nullptr || hooks.worker_count <= 1 || count <= 1)
    {
        for (int i = 0; i < count; ++i)
            call(task, i);
        return;
    }
    struct Job
    {
        const void* task;
        TaskCall call;
    } job{task, call};
    hooks.run(
        hooks.user, count,
        [](void* context, int index)
        {
            const RoundToNearest rounding; // a worker's thread may have started with another rounding mode
            const Job& j = *static_cast<const Job*>(context);
            j.call(j.task, index);
        },
        &job);
}

} // namespace carom::internal
