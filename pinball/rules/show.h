#pragma once

/// @file
/// What the rules show: lamps and messages.

#include <cstdint>
#include <string>

namespace carom::pinball {

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
