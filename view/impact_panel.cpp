#include "view/impact_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace carom::view {
namespace {

struct Look
{
    Face face;
    float size;
    Color color;
    float indent;
};

const Look& look_of(const StoryLine& line)
{
    static constexpr Look looks[] = {{Face::Bold, 16, rgb(0xffffff), 0},
                                     {Face::Bold, 13, rgb(0x9fc3ff), 0},
                                     {Face::Sans, 13, rgb(0xc6d0e0), 10},
                                     {Face::Mono, 13, rgb(0xffe3a3), 10},
                                     {Face::Bold, 13, rgb(0x8ce99a), 10}};
    return looks[static_cast<std::size_t>(line.kind)];
}

constexpr float gap = 3;      // points between lines
constexpr float step_gap = 4; // more above a step
constexpr float smallest = 0.66f;

void line_widget(Fonts& fonts, const StoryLine& line, float unit)
{
    const Look& look = look_of(line);
    if (line.kind == StoryLine::Kind::Step)
        ImGui::Dummy({0, (step_gap - gap) * unit});
    ImGui::PushFont(fonts.get(look.face, look.size * unit).font);
    if (look.indent > 0)
        ImGui::Indent(look.indent * unit);
    ImGui::PushStyleColor(ImGuiCol_Text, pack(look.color));
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(line.text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    if (look.indent > 0)
        ImGui::Unindent(look.indent * unit);
    ImGui::PopFont();
}

float height_of(Fonts& fonts, const std::vector<StoryLine>& story, float width, float unit)
{
    float height = 0;
    for (const StoryLine& line : story)
    {
        const Look& look = look_of(line);
        ImGui::PushFont(fonts.get(look.face, look.size * unit).font);
        height += ImGui::CalcTextSize(line.text.c_str(), nullptr, false, width - look.indent * unit).y + gap * unit;
        ImGui::PopFont();
        if (line.kind == StoryLine::Kind::Step)
            height += step_gap * unit;
    }
    return height;
}

float fitting_unit(Fonts& fonts, const std::vector<StoryLine>& story, float unit)
{
    const ImVec2 room = ImGui::GetContentRegionAvail();
    while (unit > smallest && height_of(fonts, story, room.x, unit) > room.y)
        unit -= 0.05f;
    return unit;
}

// The nearest place to `at` where a centered text of this size, in points, is not cut off by the edge of the picture.
Position kept_in_view(const Canvas& canvas, Position at, Vec2 size)
{
    const Box view = canvas.camera().visible();
    const Vec2 half = (0.5f * canvas.camera().meters(1)) * (size + Vec2{8, 8});
    const Box room{view.lower + half, view.upper - half};
    if (room.lower.x > room.upper.x || room.lower.y > room.upper.y)
        return at;
    return {std::clamp(at.x, room.lower.x, room.upper.x), std::clamp(at.y, room.lower.y, room.upper.y)};
}

} // namespace

void story_widgets(Fonts& fonts, const std::vector<StoryLine>& story, float unit)
{
    unit = fitting_unit(fonts, story, unit);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * unit, gap * unit});
    for (const StoryLine& line : story)
        line_widget(fonts, line, unit);
    ImGui::PopStyleVar();
}

void impact_widgets(Fonts& fonts, const std::optional<ImpactRecord>& record, float unit)
{
    if (record)
        return story_widgets(fonts, impact_story(*record), unit);
    ImGui::TextWrapped("Nothing has been hit yet. The next impact is written out here, step by step.");
}

void draw_impact(Canvas& canvas, const ImpactRecord& record, float unit)
{
    const ImpactEvent& e = record.event;
    const float pixel = canvas.camera().meters(unit);
    const std::array<Position, 2> axis{e.point - e.normal * (90 * pixel), e.point + e.normal * (90 * pixel)};
    canvas.dashed(axis, {rgb(0xffffff, 0.5f), unit});
    canvas.stroke_circle(e.point, 7 * pixel, {rgb(0xffffff), 1.5f * unit});
    // The faster one gets 55 points.
    const float scale = 55 * pixel / std::max({std::abs(e.speed_a), std::abs(e.speed_b), 1e-9f});
    // Before on one side of the line, after on the other.
    const Vec2 side = perp(e.normal) * pixel;
    const auto speed = [&](float v, float shift, Color color)
    {
        if (std::abs(v) * scale > 3 * pixel)
            canvas.arrow(e.point + side * shift, e.point + side * shift + e.normal * (v * scale), {color, 2.5f * unit},
                         10 * unit);
    };
    speed(e.speed_a, 12, party_a_color);
    speed(e.speed_b, 18, party_b_color);
    speed(dot(e.velocity_after_a, e.normal), -12, party_a_color);
    speed(dot(e.velocity_after_b, e.normal), -18, party_b_color);
    const TextStyle small{
        .size = 11 * unit, .color = rgb(0xc6d0e0), .align_x = 0.5f, .align_y = 0.5f, .shadow = rgb(0x000000, 0.8f)};
    for (const auto& [text, shift] : {std::pair("before", 32.0f), std::pair("after", -32.0f)})
        canvas.text(kept_in_view(canvas, e.point + side * shift, canvas.text_size(text, small)), text, small);
    const TextStyle style{.size = 13 * unit, .align_x = 0.5f, .align_y = 0.5f, .shadow = rgb(0x000000, 0.8f)};
    const auto label = [&](const ImpactParty& p, const char* index, float direction, Color color)
    {
        TextStyle own = style;
        own.color = color;
        const std::string text = p.name + index;
        canvas.text(kept_in_view(canvas, e.point + e.normal * (direction * 122 * pixel), canvas.text_size(text, own)), text, own);
    };
    label(record.a, " (1)", -1, party_a_color);
    label(record.b, " (2)", 1, party_b_color);
}

} // namespace carom::view
