#pragma once

/// @file
/// Colours and paints. Straight (not premultiplied) alpha, sRGB, components 0 to 1.

#include "carom/math.h"

#include <algorithm>
#include <cstdint>

namespace carom::view {

struct Color
{
    float r = 1;
    float g = 1;
    float b = 1;
    float a = 1;
    friend constexpr bool operator==(Color, Color) = default;
};

/// A colour from 0xRRGGBB.
[[nodiscard]] constexpr Color rgb(std::uint32_t hex, float alpha = 1)
{
    const auto part = [hex](unsigned shift) { return static_cast<float>((hex >> shift) & 255u) / 255.0f; };
    return {part(16), part(8), part(0), alpha};
}

/// The same colour with its alpha multiplied by factor.
[[nodiscard]] constexpr Color fade(Color c, float factor) { return {c.r, c.g, c.b, c.a * factor}; }

/// t = 0 gives a, t = 1 gives b.
[[nodiscard]] constexpr Color mix(Color a, Color b, float t)
{
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t, a.a + (b.a - a.a) * t};
}

/// Packed as Dear ImGui wants it (0xAABBGGRR).
[[nodiscard]] constexpr std::uint32_t pack(Color c)
{
    const auto byte = [](float v) { return static_cast<std::uint32_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f); };
    return byte(c.r) | byte(c.g) << 8 | byte(c.b) << 16 | byte(c.a) << 24;
}

/// One colour, or a linear gradient between two points of the canvas's world.
struct Paint
{
    Color from{};
    Color to{};
    Position start{};
    Position end{};
    bool gradient = false;

    constexpr Paint(Color c) : from(c), to(c) {} // implicit on purpose: a colour is a paint
    [[nodiscard]] static constexpr Paint linear(Position start, Color from, Position end, Color to)
    {
        Paint p(from);
        p.to = to;
        p.start = start;
        p.end = end;
        p.gradient = true;
        return p;
    }
};

/// A line: its paint and its width in points (Canvas::points turns metres into points).
struct Pen
{
    Paint paint = Color{};
    float width = 1.5f;
};

} // namespace carom::view
