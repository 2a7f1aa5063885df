#pragma once

/// @file
/// Where things are in the window. Landscape: the table in the middle, the score beside it. Portrait: the score above it.

#include "carom/math.h"
#include "pinball/table/table.h"

namespace carom::pinball {

/// Points from the top left corner of the window; empty where there is no such part.
struct Area
{
    Vec2 min{};
    Vec2 max{};

    [[nodiscard]] Vec2 size() const { return max - min; }
    [[nodiscard]] bool empty() const { return max.x - min.x < 1 || max.y - min.y < 1; }
};

struct Layout
{
    bool landscape = false;
    Area table{};
    Area score{};
    Area side{};         ///< keys and high scores, or the x-ray; in portrait only the x-ray
    float dot_pitch = 1; ///< of the score display, points
    float unit = 1;      ///< how big small things are: 1 in a window of 1280x800
};

[[nodiscard]] Layout lay_out(Vec2 window, const Table& table, bool xray);

/// The table with the cabinet around it, world metres.
[[nodiscard]] Box cabinet_box(const Table& table);

} // namespace carom::pinball
