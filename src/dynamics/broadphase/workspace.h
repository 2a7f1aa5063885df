#pragma once

// Memory of the broad phase, which keeps its capacity from step to step.

#include "collision/broad_phase.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom::internal {

/// Update of a pair of boxes, see pair_update.cpp.
namespace pair_update {
inline constexpr std::uint8_t gets_contact = 1;
inline constexpr std::uint8_t loses_contact = 2;
inline constexpr std::uint8_t goes = 4;
inline constexpr std::uint8_t parted = 8; ///< the pair stays, but its boxes do not overlap
} // namespace pair_update

struct PairUpdate
{
    std::int32_t pair; ///< index in SceneState::box_pairs
    std::uint8_t what;
};

/// Shapes whose fat boxes have changed, and the new boxes.
struct MovedBoxes
{
    std::vector<std::int32_t> items;
    std::vector<FloatBox> boxes;
    std::vector<std::int32_t> unsound; ///< bodies whose motion would exceed all finite numbers
};

struct BroadPhaseWorkspace
{
    std::vector<float> motion; ///< bound on the displacement of any point of an awake body in this step, by awake index
    MovedBoxes moved;
    std::vector<MovedBoxes> moved_of_task;
    bool all_fitted = false; ///< all boxes of the moving layer were fitted anew in this step
    std::vector<std::uint64_t> new_pairs;
    std::vector<std::vector<std::uint64_t>> pairs_of_task;
    std::vector<std::vector<PairUpdate>> pair_updates_of_task;
    std::vector<std::int32_t> pairs_of_triggers; ///< pairs of triggers that get a contact
    std::vector<std::int32_t> made_contacts;     ///< see ContactBatch
    std::vector<std::int32_t> destroyed_contacts;
};

} // namespace carom::internal
