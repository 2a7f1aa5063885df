#pragma once

// Memory of the narrow phase, which keeps its capacity from step to step.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom::internal {

/// Contact change that an update has found.
enum class TouchChange : std::uint8_t
{
    Nothing,
    Begins,
    Ends,
    MayHit ///< something fast may hit a sleeper
};

struct ContactChange
{
    std::int32_t contact;
    TouchChange what;
};

/// Contact changes of a task: `begins` and `ends` are of contacts that concern no other, `others` of the rest.
struct ContactChanges
{
    std::vector<std::int32_t> begins{};
    std::vector<std::int32_t> ends{};
    std::vector<ContactChange> others{};
    std::vector<std::int32_t> left_loads{}; ///< shapes that have left a piece of a chain that bore their load
    std::vector<std::int32_t> of_others{};  ///< contacts that other contacts may still affect
};

struct NarrowPhaseWorkspace
{
    std::vector<ContactChange> changes;
    std::vector<std::int32_t> left_loads; ///< sorted
    std::vector<std::int32_t> of_others;  ///< those of all tasks
    std::vector<ContactChanges> changes_of_task;
    std::vector<std::uint8_t> bounced;      ///< by index of an island's begins, see touch_tracker.cpp
    std::vector<std::uint8_t> borne;        ///< by state: a contact bears the body
    std::vector<std::uint8_t> is_looked_at; ///< by contact slot: updated in this step already; empty: none
};

} // namespace carom::internal
