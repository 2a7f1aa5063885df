#include "tour/panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace carom::tour {
namespace {

struct Look
{
    view::Face face;
    float size;
    view::Color color;
    float indent;
    float above; ///< space
};

Look look_of(Block::Kind kind)
{
    switch (kind)
    {
    case Block::Kind::Heading: return {view::Face::Bold, 15, view::rgb(0x9fc3ff), 0, 10};
    case Block::Kind::Formula: return {view::Face::Mono, 13, view::rgb(0xffe3a3), 10, 3};
    case Block::Kind::Task: return {view::Face::Sans, 15, view::rgb(0xb8e6c4), 15, 5};
    case Block::Kind::Paragraph: break;
    }
    return {view::Face::Sans, 15, view::rgb(0xd5ddea), 0, 8};
}

Block as_block(const view::StoryLine& line)
{
    using Kind = view::StoryLine::Kind;
    switch (line.kind)
    {
    case Kind::Title:
    case Kind::Step: return {Block::Kind::Heading, line.text};
    case Kind::Formula: return {Block::Kind::Formula, line.text};
    case Kind::Text:
    case Kind::Result: break;
    }
    return {Block::Kind::Paragraph, line.text};
}

// The text that is read now: numbers filled in, the story in its place.
std::vector<Block> blocks_of(const Lesson& lesson, const Panel& panel)
{
    const Values values = lesson.chapter().values();
    std::vector<Block> blocks;
    for (const Block& block : lesson.text().blocks)
    {
        if (block.text == "{story}")
            for (const view::StoryLine& line : lesson.chapter().story())
                blocks.push_back(as_block(line));
        else if (block.kind == Block::Kind::Heading)
            blocks.push_back({block.kind, panel.word(block.text), block.sets});
        else
            blocks.push_back({block.kind, filled(block.text, values), block.sets});
    }
    return blocks;
}

// At blanks alone: Dear ImGui would part 0.250 at its point.
std::string wrapped(const std::string& text, float width)
{
    std::string lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();)
    {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        const std::string longer = line.empty() ? word : line + ' ' + word;
        if (!line.empty() && ImGui::CalcTextSize(longer.c_str()).x > width)
        {
            lines += line + '\n';
            line = word;
        }
        else
            line = longer;
        at = end + 1;
    }
    return lines + line;
}

float height_of(view::Fonts& fonts, const Block& block, float width, float unit)
{
    const Look look = look_of(block.kind);
    const view::SizedFont sized = fonts.get(look.face, look.size * unit);
    ImGui::PushFont(sized.font);
    const float height = ImGui::CalcTextSize(wrapped(block.text, width - look.indent * unit).c_str()).y;
    ImGui::PopFont();
    return height + look.above * unit;
}

// The first block of each page: a heading is not left alone at the foot.
std::vector<std::size_t> page_starts(view::Fonts& fonts, const std::vector<Block>& blocks, float width, float room, float unit)
{
    std::vector<std::size_t> starts{0};
    float used = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
        float needed = height_of(fonts, blocks[i], width, unit);
        const float own = needed;
        if (blocks[i].kind == Block::Kind::Heading && i + 1 < blocks.size())
            needed += height_of(fonts, blocks[i + 1], width, unit);
        if (used > 0 && (used + needed > room || !blocks[i].sets.empty()))
        {
            starts.push_back(i);
            used = 0;
        }
        used += own;
    }
    return starts;
}

// On the present line where there is room, else on the next.
bool flowing_button(const std::string& label, bool active = false)
{
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(label.c_str()).x + 2 * style.FramePadding.x;
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetCursorPosX() > ImGui::GetWindowContentRegionMin().x + 1 ||
        ImGui::GetItemRectMax().x + style.ItemSpacing.x + width <= end)
        ImGui::SameLine();
    if (active)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool pressed = ImGui::Button(label.c_str());
    if (active)
        ImGui::PopStyleColor();
    return pressed;
}

std::string shown(const Control& control, float value)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), control.format, static_cast<double>(value));
    return text.data();
}

} // namespace

TourLayout lay_out(Vec2 window)
{
    TourLayout layout;
    const bool beside = window.x >= 700 && window.x > 1.1f * window.y;
    layout.unit = beside ? std::clamp(std::min(window.x / 1280, window.y / 800), 0.9f, 2.2f)
                         : std::clamp(std::min(window.x / 420, window.y / 800), 0.9f, 2.2f);
    layout.panel_max = window;
    if (beside)
    {
        const float width = std::clamp(0.40f * window.x, 330 * layout.unit, 520 * layout.unit);
        layout.picture_max = {window.x - width, window.y};
        layout.panel_min = {window.x - width, 0};
    }
    else
    {
        layout.picture_max = {window.x, std::floor(0.42f * window.y)};
        layout.panel_min = {0, layout.picture_max.y};
    }
    return layout;
}

const std::string& Panel::word(std::string_view name) const
{
    static const std::string missing = "?";
    const auto found = m_words.find(name);
    return found != m_words.end() ? found->second : missing;
}

PanelWish Panel::draw(view::Window& window, const TourLayout& layout, Lesson& lesson, int chapter,
                      const std::vector<std::string>& titles)
{
    m_fonts = &window.fonts();
    PanelWish wish;
    const Vec2 size = layout.panel_max - layout.panel_min;
    const float unit = layout.unit;
    ImGui::SetNextWindowPos({layout.panel_min.x, layout.panel_min.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {14 * unit, 10 * unit});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {7 * unit, 3 * unit});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {6 * unit, 5 * unit});
    ImGui::Begin("reading", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    title(chapter, lesson.text().title, unit);
    const float top = ImGui::GetCursorPosY();
    const float bottom = ImGui::GetWindowContentRegionMax().y;
    read(lesson, blocks_of(lesson, *this), bottom - m_foot - top, unit);

    ImGui::SetCursorPosY(bottom - m_foot);
    ImGui::PushFont(m_fonts->get(view::Face::Sans, 13 * unit).font);
    ImGui::Separator();
    controls(lesson, unit);
    if (!lesson.chapter().is_still())
        time(lesson);
    ImGui::Separator();
    turn(wish, chapter, titles);
    ImGui::PopFont();
    const float foot = ImGui::GetCursorPosY() - (bottom - m_foot);
    m_foot = std::min(foot, 0.7f * size.y);
    ImGui::End();
    ImGui::PopStyleVar(4);
    return wish;
}

void Panel::title(int chapter, const std::string& text, float unit)
{
    ImGui::PushFont(m_fonts->get(view::Face::Bold, 18 * unit).font);
    ImGui::TextUnformatted((std::to_string(chapter + 1) + "  " + text).c_str());
    ImGui::PopFont();
}

void Panel::read(Lesson& lesson, const std::vector<Block>& blocks, float room, float unit)
{
    const float width = ImGui::GetContentRegionAvail().x;
    const std::vector<std::size_t> starts = page_starts(*m_fonts, blocks, width, room, unit);
    m_pages = static_cast<int>(starts.size());
    m_page = std::clamp(m_page, 0, m_pages - 1);
    const auto page = static_cast<std::size_t>(m_page);
    const std::size_t end = page + 1 < starts.size() ? starts[page + 1] : blocks.size();
    if (std::exchange(m_set_for, m_page) != m_page)
    {
        for (const auto& [name, value] : blocks[starts[page]].sets)
            lesson.set_control(name, value);
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    for (std::size_t i = starts[page]; i < end; ++i)
        block(blocks[i], unit);
    ImGui::PopStyleVar();
}

void Panel::block(const Block& block, float unit)
{
    const Look look = look_of(block.kind);
    ImGui::Dummy({0, look.above * unit});
    const float indent = std::max(look.indent * unit, 0.001f);
    ImGui::PushFont(m_fonts->get(look.face, look.size * unit).font);
    ImGui::PushStyleColor(ImGuiCol_Text, pack(look.color));
    if (block.kind == Block::Kind::Task)
    {
        ImGui::TextUnformatted("•");
        ImGui::SameLine();
        ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMin().x + indent);
    }
    else
        ImGui::Indent(indent);
    ImGui::TextUnformatted(wrapped(block.text, ImGui::GetContentRegionAvail().x).c_str());
    if (block.kind != Block::Kind::Task)
        ImGui::Unindent(indent);
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

// A slider beside its label; where the label is long, below it.
void Panel::controls(Lesson& lesson, float unit)
{
    const float width = ImGui::GetContentRegionAvail().x;
    for (std::size_t i = 0; i < lesson.chapter().controls().size(); ++i)
    {
        const Control control = lesson.chapter().controls()[i];
        const auto label = lesson.text().controls.find(control.name);
        const std::string text = label != lesson.text().controls.end() ? label->second : control.name;
        ImGui::PushID(static_cast<int>(i));
        if (control.is_switch)
        {
            bool on = control.value != 0;
            if (ImGui::Checkbox(text.c_str(), &on))
                lesson.set_control(i, on ? 1.0f : 0.0f);
            ImGui::PopID();
            continue;
        }
        float value = control.value;
        const std::string named = text + ": " + shown(control, control.value) + "###slider";
        // Room for the longest value, so that the slider does not shrink while it is dragged.
        const auto width_at = [&](float v) { return ImGui::CalcTextSize((text + ": " + shown(control, v)).c_str()).x; };
        const float label_width = std::max({width_at(control.low), width_at(control.high), width_at(control.value)});
        ImGui::SetNextItemWidth(std::max(width - label_width - 8 * unit, 50 * unit));
        const ImGuiSliderFlags flags =
            ImGuiSliderFlags_AlwaysClamp | (control.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
        if (ImGui::SliderFloat(named.c_str(), &value, control.low, control.high, "", flags))
            lesson.set_control(i, control.is_whole ? std::round(value) : value);
        ImGui::PopID();
    }
}

void Panel::time(Lesson& lesson)
{
    constexpr std::array<double, 3> speeds{1, 0.2, 0.04};
    if (ImGui::Button(word(lesson.paused ? "play" : "pause").c_str()))
        lesson.paused = !lesson.paused;
    const auto slower = std::ranges::find(speeds, lesson.speed);
    const std::string speed = lesson.speed == 1 ? word("real time") : filled(word("slow motion"), {{"x", std::to_string(static_cast<int>(std::lround(1 / lesson.speed)))}});
    if (flowing_button(speed + "###speed", lesson.speed != 1))
        lesson.speed = slower == speeds.end() || slower + 1 == speeds.end() ? speeds.front() : *(slower + 1);
    if (flowing_button(word("back")))
        lesson.back();
    if (flowing_button(word("step")))
    {
        lesson.paused = true;
        lesson.step();
    }
    if (flowing_button(word("next impact"), lesson.runs_to_next()))
        lesson.run_to_next();
    if (flowing_button(word("restart")))
        lesson.restart();
}

void Panel::turn(PanelWish& wish, int chapter, const std::vector<std::string>& titles)
{
    const bool is_last_page = m_page + 1 >= m_pages;
    if (ImGui::Button("←"))
        (m_page > 0 ? wish.turn_page : wish.turn_chapter) = -1;
    const std::string page =
        filled(word("page"), {{"page", std::to_string(m_page + 1)}, {"pages", std::to_string(m_pages)}});
    if (flowing_button("→ " + word(is_last_page ? "next chapter" : "next page") + "###next", true))
        (is_last_page ? wish.turn_chapter : wish.turn_page) = 1;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(page.c_str());
    if (flowing_button(word("chapters")))
        ImGui::OpenPopup("chapters");
    if (flowing_button(word("see it on the table")))
        wish.see_on_table = true;
    if (ImGui::BeginPopup("chapters"))
    {
        for (std::size_t i = 0; i < titles.size(); ++i)
        {
            if (ImGui::Selectable((std::to_string(i + 1) + "  " + titles[i]).c_str(), static_cast<int>(i) == chapter))
                wish.chapter = static_cast<int>(i);
        }
        ImGui::EndPopup();
    }
}

} // namespace carom::tour
