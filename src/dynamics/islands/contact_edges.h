#pragma once

// Contact edges: the contacts that take part in a step. The task that has updated a contact examines it next, while it is in the cache.

#include "dynamics/step_context.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

class ContactEdges
{
public:
    /// Each task updates contacts_to_a_task of the awake contacts.
    ContactEdges(StepContext& ctx, std::size_t contacts_to_a_task);

    /// Called by a task for its contacts first ... last. Contacts that other contacts may still affect are put into `later`.
    void ask(std::size_t first, std::size_t last, std::vector<std::int32_t>& later);

    /// Called after all tasks, for the contacts that they have put off and for those that have woken meanwhile. Their edges come last.
    void ask_later(std::span<const std::int32_t> contacts);

    /// Fills Scratch::graph.edges and determines whether they equal those of the last step.
    void join();

private:
    [[nodiscard]] EdgesOfTask& edges_of(std::size_t task);
    void add_tasks(std::size_t contacts, std::size_t contacts_to_a_task);

    StepContext& m_ctx;
    std::size_t m_contacts_to_a_task;
    bool m_alone; ///< a single thread writes all edges to their final slots at once
    std::size_t m_tasks = 0;
};

} // namespace carom::internal
