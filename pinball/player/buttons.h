#pragma once

/// @file
/// From presses with time stamps to the buttons of each step.

#include "pinball/game/game.h"

#include <array>
#include <cstdint>
#include <deque>

namespace carom::pinball {

enum class Button : std::uint8_t
{
    Left,
    Right,
    Plunger,
    Start,
};
inline constexpr std::size_t button_count = 4;

/// Presses and releases wait here until the step in which they fall. Two keys may share a button: it is down while
/// either is. A tap shorter than a step is still down for one step.
class ButtonTimeline
{
public:
    /// `source` tells keys apart that share a button, 0 to 31. Time in ms, never earlier than the one before.
    void push(double time_ms, Button button, bool down, int source = 0);
    /// Everything up, at once, and nothing left waiting: the window lost its focus.
    void release_all();
    /// The buttons during the step that ends at this time.
    [[nodiscard]] Input advance_to(double time_ms);

private:
    struct Change
    {
        double time_ms = 0;
        Button button = Button::Left;
        bool down = false;
        int source = 0;
    };
    void apply(const Change& change);

    std::deque<Change> m_waiting{};
    std::array<std::uint32_t, button_count> m_sources{}; ///< a bit for each key that is down
    std::array<bool, button_count> m_pressed_now{};      ///< in the step that is being gathered
};

} // namespace carom::pinball
