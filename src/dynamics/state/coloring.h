#pragma once

// Graph coloring: constraints of one color share no body that has finite mass, so that they are solved side by side. A contact keeps its color for as
// long as it has a constraint. SceneState::colors holds the colors of each body's contacts, so that only a new constraint searches for one.

#include "dynamics/state/scene_state.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

namespace carom::internal {

inline constexpr int color_limit = 63; ///< no color is left: the constraint stands alone

[[nodiscard]] inline bool is_moving_dynamic(const SceneState& state, int body)
{
    return body != none && state.bodies[body].type == BodyType::Dynamic && state.bodies[body].awake_index != none;
}

[[nodiscard]] inline std::uint64_t& colors_of(SceneState& state, int body)
{
    return state.colors[static_cast<std::size_t>(body)];
}

/// Takes the lowest color that is free at both bodies; only awake dynamic bodies count.
inline void take_color(SceneState& state, Contact& contact)
{
    std::uint64_t taken = 0;
    for (const std::int32_t body : {contact.body_a, contact.body_b})
        taken |= is_moving_dynamic(state, body) ? colors_of(state, body) : 0;
    contact.color = std::min(std::countr_one(taken), color_limit);
    for (const std::int32_t body : {contact.body_a, contact.body_b})
    {
        if (contact.color < color_limit && is_moving_dynamic(state, body))
            colors_of(state, body) |= std::uint64_t{1} << contact.color;
    }
}

/// Threads may call it side by side.
inline void leave_color(SceneState& state, Contact& contact)
{
    const std::int32_t color = std::exchange(contact.color, none);
    if (color == none || color == color_limit)
        return;
    const std::uint64_t bit = std::uint64_t{1} << color;
    for (const std::int32_t body : {contact.body_a, contact.body_b})
    {
        const std::atomic_ref colors(colors_of(state, body));
        if ((colors.load(std::memory_order_relaxed) & bit) != 0)
            colors.fetch_and(~bit, std::memory_order_relaxed);
    }
}

} // namespace carom::internal
