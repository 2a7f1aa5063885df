#pragma once

/// @file
/// Finds geometry that cannot work: what the loader accepts key by key and a ball would still not survive.

#include "pinball/table/table.h"

#include <string>
#include <string_view>
#include <vector>

namespace carom::pinball {

enum class FindingKind : std::uint8_t
{
    Overlap,       ///< two parts, or a part and a ball, overlap at the start
    OutsideTable,  ///< an element or the ball's start lies outside the outline
    BadOutline,    ///< an outline that crosses itself
    Leak,          ///< a ball can leave the outline without a drain
    NoDrain,       ///< no ball can ever be lost
    FlipperStroke, ///< a flipper sweeps through something
    NoRoom,        ///< a plunger or sprung target moves into something
    NarrowGap,     ///< a ball fits too tightly between two parts
    RestingPlace,  ///< a ball can come to rest where nothing moves it on
    Unreachable,   ///< no ball ever touches it
    Plunger,       ///< the ball does not start in front of its plunger
    Step,          ///< a ball that rolls from a guide onto a flipper is thrown up
    NoFlipper,     ///< nothing to play with
};

[[nodiscard]] std::string_view name(FindingKind kind);

struct Finding
{
    FindingKind kind{};
    std::vector<std::string> elements{}; ///< ids; empty where the table as a whole is meant
    Vec2 where{};
    std::string sentence{};
};

/// "narrow gap: "post_1", "wall_2": ...", in one line.
[[nodiscard]] std::string to_string(const Finding& finding);

/// Everything that is wrong, in a fixed order. A gap counts as too narrow from 0.4 to 1.02 ball diameters where a ball
/// gets at it: through less a ball does not even start to fall. Gaps that hold a captive ball are meant to be narrow.
[[nodiscard]] std::vector<Finding> check(const Table& table);

} // namespace carom::pinball
