#include "pinball/player/buttons.h"

#include <algorithm>

namespace carom::pinball {

void ButtonTimeline::push(double time_ms, Button button, bool down, int source)
{
    double& pressed_at = m_pressed_at[static_cast<std::size_t>(button)][static_cast<std::size_t>(source)];
    if (down)
    { // a release that still waits comes before the key is down again
        for (Change& waiting : m_waiting)
        {
            if (waiting.rod < 0 && waiting.button == button && waiting.source == source && !waiting.down)
                waiting.time_ms = std::min(waiting.time_ms, time_ms);
        }
        std::ranges::stable_sort(m_waiting, {}, &Change::time_ms);
        pressed_at = time_ms;
    }
    insert({down ? time_ms : std::max(time_ms, pressed_at + shortest_press_ms), button, down, source});
}

void ButtonTimeline::hold_rod(double time_ms, std::uint8_t rod) { insert({.time_ms = time_ms, .rod = rod}); }

// After all that come no later.
void ButtonTimeline::insert(const Change& change)
{
    m_waiting.insert(std::ranges::upper_bound(m_waiting, change.time_ms, {}, &Change::time_ms), change);
}

void ButtonTimeline::release_all()
{
    m_waiting.clear();
    m_sources.fill(0);
    m_rod = 0;
}

void ButtonTimeline::apply(const Change& change)
{
    if (change.rod >= 0)
    {
        m_rod = static_cast<std::uint8_t>(change.rod);
        return;
    }
    const auto index = static_cast<std::size_t>(change.button);
    const std::uint32_t bit = 1u << change.source;
    if (change.down)
        m_sources[index] |= bit;
    else
        m_sources[index] &= ~bit;
    if (change.down)
        m_pressed_now[index] = true;
}

Input ButtonTimeline::advance_to(double time_ms)
{
    m_pressed_now.fill(false);
    while (!m_waiting.empty() && m_waiting.front().time_ms <= time_ms)
    {
        apply(m_waiting.front());
        m_waiting.pop_front();
    }
    const auto held = [this](Button button)
    {
        const auto index = static_cast<std::size_t>(button);
        return m_sources[index] != 0 || m_pressed_now[index];
    };
    return {.left = held(Button::Left),
            .right = held(Button::Right),
            .plunger = held(Button::Plunger),
            .start = held(Button::Start),
            .nudge_left = held(Button::NudgeLeft),
            .nudge_right = held(Button::NudgeRight),
            .nudge_up = held(Button::NudgeUp),
            .rod = m_rod};
}

} // namespace carom::pinball
