#pragma once

/// @file
/// The visible state of the rules: the phase of the game, lamps and messages.

#include <cstdint>
#include <string>

namespace carom::pinball {

enum class Phase : std::uint8_t
{
    Attract,  ///< no game yet; start begins one
    Ready,    ///< the ball lies before the plunger
    InPlay,   ///< it has touched the first switch of the playfield
    Bonus,    ///< the end-of-ball bonus is counted
    Match,    ///< all balls are played; a number is drawn
    GameOver, ///< the score stands; start begins a new game
};

enum class LampState : std::uint8_t
{
    Off,
    On,
    Blink,
};

/// A line for the score display.
struct Message
{
    std::string text{};
    int priority = 0;       ///< the highest one shows; of equals, the latest
    std::int64_t until = 0; ///< step after which it is gone
};

} // namespace carom::pinball
