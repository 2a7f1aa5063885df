#pragma once

// Sorts edges, joints and bodies by island for the layout. Neighbors in a list mostly belong to one island, so they are counted and moved in runs, on all
// threads.

#include "core/grow.h"
#include "core/task_pool.h"
#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace carom::internal {

/// Calls visit(run) for each run of successive items in first ... last that belong to one island. Items without an island are skipped.
template <class IslandOf, class Visit>
void for_each_run(std::size_t first, std::size_t last, const IslandOf& island_of, const Visit& visit)
{
    while (first < last)
    {
        const std::int32_t island = island_of(first);
        std::size_t end = first + 1;
        while (end < last && island_of(end) == island)
            ++end;
        if (island != none)
            visit(IslandRun{island, static_cast<std::int32_t>(first), static_cast<std::int32_t>(end - first)});
        first = end;
    }
}

/// A stable counting sort of the `count` items item_at(index) by island_of(index), which works on runs: fills `sorted` and calls set_range(island, first,
/// count). Items for which island_of returns none are left out.
template <class Item, class ItemAt, class IslandOf, class SetRange>
void sort_by_island(const TaskHooks& tasks, Scratch& scratch, std::size_t count, std::vector<Item>& sorted,
                    std::size_t items_per_task, const ItemAt& item_at, const IslandOf& island_of, const SetRange& set_range)
{
    using Runs = std::vector<IslandRun>;
    const std::span<Runs> partitions =
        find_in_chunks(tasks, count, items_per_task, scratch.layout.runs_of_task,
                       [&](std::size_t first, std::size_t last, Runs& runs)
                       {
                           runs.clear();
                           for_each_run(first, last, island_of, [&](const IslandRun& run) { append(runs, run); });
                       });
    std::vector<std::int32_t>& starts = scratch.layout.island_starts;
    starts.assign(scratch.solver.islands.size() + 1, 0);
    for (const Runs& runs : partitions)
    {
        for (const IslandRun& run : runs)
            starts[static_cast<std::size_t>(run.island) + 1] += run.count;
    }
    for (std::size_t u = 0; u < scratch.solver.islands.size(); ++u)
    {
        set_range(scratch.solver.islands[u], starts[u], starts[u + 1]);
        starts[u + 1] += starts[u];
    }
    for (Runs& runs : partitions)
    {
        for (IslandRun& run : runs)
            run.sorted_first = std::exchange(starts[static_cast<std::size_t>(run.island)],
                                             starts[static_cast<std::size_t>(run.island)] + run.count);
    }
    set_size(sorted, static_cast<std::size_t>(starts[scratch.solver.islands.empty() ? 0 : scratch.solver.islands.size() - 1]));
    run_tasks(tasks, static_cast<int>(partitions.size()),
              [&](int task)
              {
                  for (const IslandRun& run : partitions[static_cast<std::size_t>(task)])
                  {
                      for (std::int32_t i = 0; i < run.count; ++i)
                          sorted[static_cast<std::size_t>(run.sorted_first + i)] =
                              item_at(static_cast<std::size_t>(run.first + i));
                  }
              });
}

} // namespace carom::internal
