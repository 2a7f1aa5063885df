#pragma once

// Memory for reordering memory.

#include "collision/hilbert_order.h"

#include <cstdint>
#include <vector>

namespace carom::internal {

/// Where a contact should stand among the awake ones.
struct ContactRank
{
    std::uint32_t color; ///< counted over all islands
    std::int32_t contact;
};

struct ReorderWorkspace
{
    std::vector<ContactRank> contact_order; ///< what tidy() makes of them
    std::vector<ContactRank> sorted_contacts;
    std::vector<std::int32_t> moved_to;    ///< by contact slot
    std::vector<std::int32_t> move_cycles; ///< see reorder.cpp
    HilbertOrder plane_order;              ///< of the awake bodies
};

} // namespace carom::internal
