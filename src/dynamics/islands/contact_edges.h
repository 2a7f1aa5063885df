#pragma once

// Which contacts take part in a step. Each is asked by the task that has updated it, while it is in the cache.

#include "dynamics/step_context.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

class ContactEdges
{
public:
    /// For tasks that update so many of the awake contacts each.
    ContactEdges(StepContext& ctx, std::size_t contacts_to_a_task);

    /// By a task, of its contacts first ... last. Those of whose news others may have more to say are put into `later`.
    void ask(std::size_t first, std::size_t last, std::vector<std::int32_t>& later);

    /// After all tasks: of the latter, and of those that have woken meanwhile. Their links come behind.
    void ask_later(std::span<const std::int32_t> contacts);

    /// Fills Scratch::graph.links, and says whether they are those of the last step.
    void join();

private:
    [[nodiscard]] EdgesOfTask& edges_of(std::size_t task);
    void add_tasks(std::size_t contacts, std::size_t contacts_to_a_task);

    StepContext& m_ctx;
    std::size_t m_contacts_to_a_task;
    bool m_alone; ///< one thread puts all of them where they go at once
    std::size_t m_tasks = 0;
};

} // namespace carom::internal
