#pragma once

// Memory of the broad phase, kept from step to step.

#include "collision/broad_phase.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom::internal {

/// What becomes of a pair of boxes, see pair_update.cpp.
namespace pair_update {
inline constexpr std::uint8_t gets_contact = 1;
inline constexpr std::uint8_t loses_contact = 2;
inline constexpr std::uint8_t goes = 4;
inline constexpr std::uint8_t parted = 8; ///< it stays, but its boxes do not meet
} // namespace pair_update

struct PairUpdate
{
    std::int32_t pair; ///< in SceneState::box_pairs
    std::uint8_t what;
};

/// Shapes whose fat box changed, and what it is now.
struct MovedBoxes
{
    std::vector<std::int32_t> items;
    std::vector<FloatBox> boxes;
    std::vector<std::int32_t> unsound; ///< bodies that would leave all numbers
};

struct BroadPhaseWorkspace
{
    std::vector<float> motion; ///< how far any point of an awake body may move in this step, by place in awake_bodies
    MovedBoxes moved;
    std::vector<MovedBoxes> moved_of_task;
    bool all_fitted = false; ///< the moving layer, in this step
    std::vector<std::uint64_t> new_pairs;
    std::vector<std::vector<std::uint64_t>> pairs_of_task;
    std::vector<std::vector<PairUpdate>> pair_updates_of_task;
    std::vector<std::int32_t> pairs_of_triggers; ///< that get a contact
    std::vector<std::int32_t> made_contacts;     ///< see ContactBatch
    std::vector<std::int32_t> destroyed_contacts;
};

} // namespace carom::internal
