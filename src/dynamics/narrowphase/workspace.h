#pragma once

// Memory of the narrow phase, kept from step to step.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom::internal {

/// What the update of a contact found that others must hear of.
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

/// Of a task's contacts: of those whose news concern nobody else, who has begun or ended to touch; and the news of the others.
struct ContactChanges
{
    std::vector<std::int32_t> begins{};
    std::vector<std::int32_t> ends{};
    std::vector<ContactChange> others{};
    std::vector<std::int32_t> left_loads{}; ///< shapes that have left a piece of a chain which bore a load of theirs
    std::vector<std::int32_t> of_others{};  ///< contacts of whose news others may have more to say
};

struct NarrowPhaseWorkspace
{
    std::vector<ContactChange> changes;
    std::vector<std::int32_t> left_loads; ///< in order
    std::vector<std::int32_t> of_others;  ///< contacts, of all tasks
    std::vector<ContactChanges> changes_of_task;
    std::vector<std::uint8_t> bounced;      ///< of an island's begins, see commit.cpp
    std::vector<std::uint8_t> borne;        ///< by state: a contact bears it
    std::vector<std::uint8_t> is_looked_at; ///< by contact slot, in this step; empty: none
};

} // namespace carom::internal
