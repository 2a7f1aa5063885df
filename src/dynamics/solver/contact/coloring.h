#pragma once

// Constraints of one colour share no body that gives way, so that they are solved side by side. A contact keeps its colour for as long as it has a constraint; which
// colours a body's contacts have stands in SceneState::colors, so that only a new constraint looks for one.

#include "dynamics/state/scene_state.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

namespace carom::internal {

inline constexpr int color_limit = 63; ///< no colour is left: the constraint stands alone

[[nodiscard]] inline bool is_moving_dynamic(const SceneState& state, int body)
{
    return body != none && state.bodies[body].type == BodyType::Dynamic && state.bodies[body].awake_index != none;
}

[[nodiscard]] inline std::uint64_t& colors_of(SceneState& state, int body)
{
    return state.colors[static_cast<std::size_t>(body)];
}

/// The least that neither of its bodies has yet, of those that give way.
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

/// Threads may do so side by side.
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
