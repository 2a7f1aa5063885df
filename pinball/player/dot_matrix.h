#pragma once

/// @file
/// The score display: a matrix of lamps, drawn as rectangles.

#include "view/canvas.h"

#include <array>
#include <string_view>

namespace carom::pinball {

class DotMatrix
{
public:
    static constexpr int columns = 96;
    static constexpr int rows = 27;

    /// Lights a line of text; x and y are its top left dot. What lies outside is cut off.
    void text(int x, int y, std::string_view line, int scale = 1, float brightness = 1);
    void centered(int y, std::string_view line, int scale = 1, float brightness = 1);
    /// From left to right.
    void rule(int y, float share, float brightness);
    [[nodiscard]] static int width(std::string_view line, int scale = 1);
    [[nodiscard]] float at(int x, int y) const { return m_dots[static_cast<std::size_t>(y * columns + x)]; }

    /// Top left corner and size of a dot, points.
    void draw(view::Canvas& screen, Vec2 corner, float pitch) const;

private:
    void light(int x, int y, float brightness);
    std::array<float, static_cast<std::size_t>(columns* rows)> m_dots{};
};

} // namespace carom::pinball
