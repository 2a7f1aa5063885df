#pragma once

// Memory for reordering contacts and bodies, reused from step to step.

#include "collision/hilbert_order.h"

#include <cstdint>
#include <vector>

namespace carom::internal {

/// The rank of a contact among the awake ones.
struct ContactRank
{
    std::uint32_t color; ///< counted over all islands
    std::int32_t contact;
};

struct ReorderWorkspace
{
    std::vector<ContactRank> contact_order; ///< the order that reorder.cpp computes
    std::vector<ContactRank> sorted_contacts;
    std::vector<std::int32_t> moved_to;    ///< by contact slot
    std::vector<std::int32_t> move_cycles; ///< cycles of the permutation, see reorder.cpp
    HilbertOrder plane_order;              ///< order of the awake bodies
};

} // namespace carom::internal
