#pragma once

// Wide rows of the largest unit, which stand from step to step while contacts come and go.

#include "dynamics/step_context.h"

#include <algorithm>
#include <bit>
#include <functional>

namespace carom::internal {

/// Stage 3, first: do rows of the last step stand? Then their contacts are followed in their lanes; Scratch::standing says of each what has become of it, and
/// lanes whose contacts are no longer what they were made for are free.
void follow_standing_rows(StepContext& ctx);

/// Of lanes that were looked at one by one.
void add_standing_news(const StepContext& ctx, std::vector<ContactNews>& news);

/// Once all news are known: which lanes touch.
void note_standing_touches(StepContext& ctx);

/// Once places of bodies are known: those of lanes. Where a body has come to move, or to rest, its lanes are let go.
void place_standing_rows(StepContext& ctx);

/// Lanes of contacts that this step's unit of standing rows does not solve, by unit and flight, become links again.
void choose_standing_unit(StepContext& ctx);

/// All lanes become links again.
void give_up_standing_rows(StepContext& ctx);

/// The contact is in a lane that stands.
[[nodiscard]] inline bool stands(const StepContext& ctx, std::int32_t contact)
{
    return ctx.scratch.standing.valid && ctx.state.lane_marks[static_cast<std::size_t>(contact)] == LaneMark::Stands;
}

/// Free lanes of a bin: the least is taken first, so that groups at the end stay empty.
inline void give(std::vector<std::int32_t>& free, std::int32_t lane)
{
    free.push_back(lane);
    std::push_heap(free.begin(), free.end(), std::greater<>());
}

[[nodiscard]] inline std::int32_t take_least(std::vector<std::int32_t>& free)
{
    std::pop_heap(free.begin(), free.end(), std::greater<>());
    const std::int32_t lane = free.back();
    free.pop_back();
    return lane;
}

/// Calls visit(link, touching) for what stands.
template <class Visit>
void for_each_standing(const StandingRows& standing, const Visit& visit)
{
    if (!standing.valid)
        return;
    for (std::size_t lane = 0; lane < standing.lanes.size(); ++lane)
    {
        if (standing.lanes[lane].contact != none)
            visit(standing.lanes[lane], (standing.touching[lane / lane_count] >> lane % lane_count & 1u) != 0);
    }
}

} // namespace carom::internal
