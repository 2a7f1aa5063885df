#pragma once

// Letters that are cut off in the last frame: by the edge of the window, of a widget, or of a region.

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

namespace carom::test {

namespace detail {

using TexturePart = std::tuple<float, float, float, float>;

// Where letters stand in the texture; a quad with another part of it is a letter that was cut.
inline std::set<TexturePart> letters()
{
    std::set<TexturePart> all;
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
        for (const ImFontGlyph& glyph : font->Glyphs)
            all.emplace(glyph.U0, glyph.V0, glyph.U1, glyph.V1);
    return all;
}

// Lines have a place in the texture, too; other areas are of its one white point.
inline bool is_of_lines(float v)
{
    const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    float low = 1;
    float high = 0;
    for (const ImVec4& line : atlas.TexUvLines)
    {
        low = std::min({low, line.y, line.w});
        high = std::max({high, line.y, line.w});
    }
    return v >= low && v <= high;
}

} // namespace detail

/// Where in the window, in points, up to `most` of them; empty if all letters are whole. After Window::end_frame.
inline std::string clipped_text(std::size_t most = 5)
{
    const ImDrawData* data = ImGui::GetDrawData();
    const auto letters = detail::letters();
    std::string found;
    std::size_t count = 0;
    for (int l = 0; l < data->CmdListsCount; ++l)
    {
        const ImDrawList& list = *data->CmdLists[l];
        for (const ImDrawCmd& cmd : list.CmdBuffer)
        {
            for (unsigned i = 0; i + 5 < cmd.ElemCount; i += 3)
            {
                const auto vertex = [&](unsigned k) -> const ImDrawVert&
                {
                    return list
                        .VtxBuffer[static_cast<int>(cmd.VtxOffset + list.IdxBuffer[static_cast<int>(cmd.IdxOffset + i + k)])];
                };
                const ImDrawVert& a = vertex(0);
                const ImDrawVert& c = vertex(2);
                const bool is_quad = &vertex(3) == &a && &vertex(4) == &c;
                if (!is_quad || a.uv.x == c.uv.x || a.uv.y == c.uv.y || detail::is_of_lines(a.uv.y))
                    continue;
                const bool whole = letters.contains({a.uv.x, a.uv.y, c.uv.x, c.uv.y});
                const float slack = 1.01f;
                const bool inside = a.pos.x >= cmd.ClipRect.x - slack && a.pos.y >= cmd.ClipRect.y - slack &&
                                    c.pos.x <= cmd.ClipRect.z + slack && c.pos.y <= cmd.ClipRect.w + slack;
                if (whole && inside)
                    continue;
                if (count++ < most)
                    found += (found.empty() ? "" : ", ") + std::to_string(std::lround(a.pos.x)) + "|" +
                             std::to_string(std::lround(a.pos.y));
            }
        }
    }
    return count > most ? found + ", ... " + std::to_string(count) + " in all" : found;
}

} // namespace carom::test
