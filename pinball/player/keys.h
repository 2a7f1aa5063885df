#pragma once

/// @file
/// What keys and gamepad buttons mean. Keys by scancode: by their place, whatever is printed on them.

#include "pinball/player/buttons.h"

#include <SDL_events.h>

#include <optional>
#include <span>

namespace carom::pinball {

/// What the user wants of the program rather than of the machine.
enum class Wish : std::uint8_t
{
    Pause,
    Restart,
    Mute,
    Quieter,
    Louder,
    Xray,
    Tour,
    Fullscreen,
    Quit,
    SlowMotion,
    SingleStep,
    SubstepBack,
    SubstepForth,
};

struct ButtonPress
{
    Button button = Button::Left;
    bool down = false;
    int source = 0; ///< of ButtonTimeline::push
};

/// The machine's button that this event moves. Repeats of a held key are none.
[[nodiscard]] std::optional<ButtonPress> button_of(const SDL_Event& event);
[[nodiscard]] std::optional<Wish> wish_of(const SDL_Event& event);

/// For the first screen.
struct KeyLine
{
    const char* keys;
    const char* meaning;
};
[[nodiscard]] std::span<const KeyLine> key_lines();
[[nodiscard]] std::span<const KeyLine> xray_key_lines();

} // namespace carom::pinball
