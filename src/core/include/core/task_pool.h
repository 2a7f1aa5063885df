#pragma once

// The only place that knows of threads. A stage gives it a number of independent tasks. Whether they run one after another or on the
// user's workers, the result is the same, because each task writes only its own data.

#include "carom/scene.h"

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace carom::internal {

/// A task is called by its address: whether tasks run here or on workers, the compiler makes one function of them.
using TaskCall = void (*)(const void* task, int index);

void run_tasks(const TaskHooks& hooks, int count, const void* task, TaskCall call);

/// Calls task(i) for each of 0 ... count.
template <class Task>
void run_tasks(const TaskHooks& hooks, int count, const Task& task)
{
    run_tasks(hooks, count, &task, [](const void* context, int index) { (*static_cast<const Task*>(context))(index); });
}

/// Raises a flag that any of several concurrent tasks may raise. It is written once, so that threads that read it do not wait for each other.
inline void raise(std::atomic<bool>& flag)
{
    if (!flag.load(std::memory_order_relaxed))
        flag.store(true, std::memory_order_relaxed);
}

/// Calls both, concurrently where there are threads.
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

/// Calls work(first, last) for chunks of 0 ... count, one task per chunk.
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

/// Calls visit(i) for each of 0 ... count, one task per chunk.
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

/// Calls work(first, last, found) for chunks of 0 ... count; the results are in the order of the chunks. `results` keeps its memory: the span
/// holds the results of this call, and they are not cleared before it.
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
