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
    NudgeLeft,
    NudgeRight,
    NudgeUp,
};
inline constexpr std::size_t button_count = 7;

/// Presses and releases wait here until the step in which they fall. Two keys may share a button: it is down while
/// either is.
class ButtonTimeline
{
public:
    /// No finger is faster: a release that comes sooner was seen together with its press, and its true time is not known.
    static constexpr double shortest_press_ms = 20;

    /// `source` tells keys apart that share a button, 0 to 31. Time in ms.
    void push(double time_ms, Button button, bool down, int source = 0);
    /// A stick holds the rod back by this much from now on.
    void hold_rod(double time_ms, std::uint8_t rod);
    /// Everything up, at once, and nothing left waiting: the window lost its focus.
    void release_all();
    /// The buttons during the step that ends at this time.
    [[nodiscard]] Input advance_to(double time_ms);

private:
    static constexpr std::size_t sources = 32;
    struct Change
    {
        double time_ms = 0;
        Button button = Button::Left;
        bool down = false;
        int source = 0;
        int rod = -1; ///< not negative: this is a movement of the rod, and no button
    };
    void insert(const Change& change);
    void apply(const Change& change);

    std::deque<Change> m_waiting{};
    std::array<std::uint32_t, button_count> m_sources{}; ///< a bit for each key that is down
    std::array<std::array<double, sources>, button_count> m_pressed_at{};
    std::uint8_t m_rod = 0;
    std::array<bool, button_count> m_pressed_now{}; ///< in the step that is being gathered
};

} // namespace carom::pinball
