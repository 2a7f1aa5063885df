#pragma once

// The one place that knows of threads. A stage gives it a number of independent tasks; whether they run one after another or on the
// user's workers, the result is the same, because each task writes only what is its own.

#include "carom/scene.h"

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace carom::internal {

/// A task by its address: whether tasks run here or on workers, the compiler makes one function of them.
using TaskCall = void (*)(const void* task, int index);

void run_tasks(const TaskHooks& hooks, int count, const void* task, TaskCall call);

/// Calls task(i) for each of 0 ... count.
template <class Task>
void run_tasks(const TaskHooks& hooks, int count, const Task& task)
{
    run_tasks(hooks, count, &task, [](const void* context, int index) { (*static_cast<const Task*>(context))(index); });
}

/// Of tasks that run side by side any may raise a flag. Written once: threads that read it do not wait for each other.
inline void raise(std::atomic<bool>& flag)
{
    if (!flag.load(std::memory_order_relaxed))
        flag.store(true, std::memory_order_relaxed);
}

/// Calls both, side by side where there are threads.
template <class One, class Other>
void run_both(const TaskHooks& hooks, const One& one, const Other& other)
{
    run_tasks(hooks, 2,
              [&](int task)
              {
                  if (task == 0)
                      one();
                  else
                      other();
              });
}

/// Calls work(first, last) for parts of 0 ... count, a task each.
template <class Work>
void run_chunks(const TaskHooks& hooks, std::size_t count, std::size_t part, const Work& work)
{
    run_tasks(hooks, static_cast<int>((count + part - 1) / part),
              [&](int task)
              {
                  const std::size_t first = static_cast<std::size_t>(task) * part;
                  work(first, first + part < count ? first + part : count);
              });
}

/// Calls visit(i) for each of 0 ... count, a part of them to a task.
template <class Visit>
void for_each_in_chunks(const TaskHooks& hooks, std::size_t count, std::size_t part, const Visit& visit)
{
    run_chunks(hooks, count, part,
               [&](std::size_t first, std::size_t last)
               {
                   for (std::size_t i = first; i < last; ++i)
                       visit(i);
               });
}

/// Calls work(first, last, found) for parts of 0 ... count; what each finds stands in the order of the parts. Results keep their memory: the span
/// holds those of this call, not cleared.
template <class Found, class Work>
[[nodiscard]] std::span<Found> find_in_chunks(const TaskHooks& hooks, std::size_t count, std::size_t part,
                                              std::vector<Found>& results, const Work& work)
{
    const std::size_t parts = (count + part - 1) / part;
    if (results.size() < parts)
        results.resize(parts);
    run_chunks(hooks, count, part, [&](std::size_t first, std::size_t last) { work(first, last, results[first / part]); });
    return std::span(results).first(parts);
}

} // namespace carom::internal
