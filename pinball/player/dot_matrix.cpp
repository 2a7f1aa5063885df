#include "pinball/player/dot_matrix.h"

#include "pinball/player/dot_font.h"

#include <imgui.h>

#include <algorithm>

namespace carom::pinball {

void DotMatrix::light(int x, int y, float brightness)
{
    if (x < 0 || x >= columns || y < 0 || y >= rows)
        return;
    float& dot = m_dots[static_cast<std::size_t>(y * columns + x)];
    dot = std::max(dot, brightness);
}

int DotMatrix::width(std::string_view line, int scale)
{
    int dots = 0;
    for (const char c : line)
        dots += dot_glyph(c).width + 1;
    return std::max(0, dots - 1) * scale;
}

void DotMatrix::text(int x, int y, std::string_view line, int scale, float brightness)
{
    for (const char c : line)
    {
        const DotGlyph glyph = dot_glyph(c);
        for (int row = 0; row < 7 * scale; ++row)
            for (int column = 0; column < glyph.width * scale; ++column)
                if ((glyph.rows[static_cast<std::size_t>(row / scale)] >> (glyph.width - 1 - column / scale) & 1) != 0)
                    light(x + column, y + row, brightness);
        x += (glyph.width + 1) * scale;
    }
}

void DotMatrix::centered(int y, std::string_view line, int scale, float brightness)
{
    text((columns - width(line, scale)) / 2, y, line, scale, brightness);
}

void DotMatrix::rule(int y, float share, float brightness)
{
    const int lit = static_cast<int>(share * columns + 0.5f);
    for (int x = 0; x < lit; ++x)
        light(x, y, brightness);
}

// Straight into the draw list: thousands of small squares on whole points need no soft edges.
void DotMatrix::draw(view::Canvas& screen, Vec2 corner, float pitch) const
{
    const view::Color off = view::rgb(0x2a1708);
    const view::Color on = view::rgb(0xffa424);
    const float gap = pitch >= 3 ? pitch * 0.22f : 0;
    ImDrawList& list = screen.list();
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
        {
            const ImVec2 at{corner.x + static_cast<float>(x) * pitch, corner.y + static_cast<float>(y) * pitch};
            const view::Color color = view::mix(off, on, this->at(x, y));
            list.AddRectFilled(at, {at.x + pitch - gap, at.y + pitch - gap}, view::pack(color));
        }
}

} // namespace carom::pinball
