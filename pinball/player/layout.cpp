#include "pinball/player/layout.h"

#include "pinball/player/dot_matrix.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

constexpr float rail = 0.016f;  // m
constexpr float below = 0.052f; // m, room for a plunger that is pulled

float aspect(const Table& table)
{
    const Box box = cabinet_box(table);
    const Vec2 size = box.upper - box.lower;
    return size.x / size.y;
}

// Whole points a dot, so that the display is crisp.
float pitch_in(float width) { return std::max(1.0f, std::floor(width / DotMatrix::columns)); }

Layout landscape(Vec2 window, float table_aspect, bool xray)
{
    Layout layout{.landscape = true};
    const float width = window.y * table_aspect;
    const float beside = window.x - width;
    // The x-ray has much to say: in a small window the table makes room for it.
    const float side = xray ? std::max(beside / 2, std::min(340.0f, beside - 150)) : beside / 2;
    const float left = std::round(beside - side);
    layout.table = {{left, 0}, {left + width, window.y}};
    layout.score = {{0, 0}, {left, window.y}};
    layout.side = {{left + width, 0}, window};
    layout.unit = std::clamp(std::min(left / 400, window.y / 720), 0.6f, 4.0f);
    layout.dot_pitch = pitch_in(left - 16);
    return layout;
}

Layout portrait(Vec2 window, bool xray)
{
    Layout layout{};
    layout.unit = std::clamp(std::min(window.x / 400, window.y / 800), 0.6f, 5.0f);
    layout.dot_pitch = pitch_in(std::min(window.x - 16, window.y * 0.5f));
    const float line = 24 * layout.unit;
    const float score = std::round(xray ? line : layout.dot_pitch * DotMatrix::rows + 14 + line);
    const float bottom = xray ? std::round(window.y * 0.47f) : window.y;
    layout.score = {{0, 0}, {window.x, score}};
    layout.table = {{0, score}, {window.x, bottom}};
    if (xray)
        layout.side = {{0, bottom}, window};
    return layout;
}

} // namespace

Box cabinet_box(const Table& table)
{
    return {{-rail, -below}, {static_cast<double>(table.size.x) + rail, static_cast<double>(table.size.y) + rail}};
}

Layout lay_out(Vec2 window, const Table& table, bool xray)
{
    // Beside the table there must be room for two columns of 240 points.
    const float shape = aspect(table);
    if (window.x - window.y * shape >= 480)
        return landscape(window, shape, xray);
    return portrait(window, xray);
}

} // namespace carom::pinball
