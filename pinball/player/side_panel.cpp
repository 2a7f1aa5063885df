#include "pinball/player/side_panel.h"

#include "pinball/player/palette.h"
#include "pinball/player/score_panel.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

using view::Canvas;
using view::Face;
using view::TextStyle;

float heading(Canvas& screen, const Area& area, const char* text, float unit)
{
    const float x = area.min.x + 34 * unit;
    screen.text({x, area.min.y}, text, {.size = 15 * unit, .color = palette::gold, .face = Face::Bold});
    const float y = area.min.y + 23 * unit;
    screen.line({x, y}, {area.max.x - 34 * unit, y}, {view::fade(palette::gold, 0.4f), 1});
    return y + 8 * unit;
}

// Words of a text, filled into lines of this width.
std::vector<std::string> wrap(const Canvas& screen, const std::string& text, const TextStyle& style, float width)
{
    std::vector<std::string> lines{""};
    std::size_t at = 0;
    while (at < text.size())
    {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
        if (!lines.back().empty() && screen.text_size(longer, style).x > width)
            lines.push_back(word);
        else
            lines.back() = longer;
        at = end + 1;
    }
    return lines;
}

// Rules and keys show for so long by turns while nobody plays, s.
constexpr double page_time = 8;

void draw_sheet(Canvas& screen, Vec2 min, Vec2 max)
{
    const Box box{Position(min), Position(max)};
    screen.fill_box(box, view::rgb(0x0a0d18, 0.90f), 8);
    screen.stroke_box(box, {view::fade(palette::gold, 0.5f), 1}, 8);
}

} // namespace

float draw_high_scores(Canvas& screen, const Area& area, const Machine& machine, float unit)
{
    float y = heading(screen, area, "high scores", unit);
    const auto& entries = machine.game().high_scores().entries();
    const float left = area.min.x + 34 * unit;
    const float right = area.max.x - 34 * unit;
    for (const std::string& line : wrap(screen, machine.score_trouble(), {.size = 12 * unit}, right - left))
    {
        if (line.empty())
            break;
        screen.text({left, y}, line, {.size = 12 * unit, .color = palette::coral});
        y += 16 * unit;
    }
    if (entries.empty())
        screen.text({left, y}, "none yet: the first one is yours", {.size = 14 * unit, .color = palette::text_faint});
    for (std::size_t i = 0; i < entries.size() && y + 20 * unit < area.max.y; ++i, y += 21 * unit)
    {
        const bool fresh =
            std::ranges::find(machine.game().last_ranks(), static_cast<int>(i)) != machine.game().last_ranks().end();
        const view::Color color = fresh ? palette::gold : palette::text;
        screen.text({left, y}, std::to_string(i + 1), {.size = 14 * unit, .color = palette::text_faint});
        screen.text({left + 30 * unit, y}, entries[i].name, {.size = 14 * unit, .color = color, .face = Face::Mono});
        screen.text({right, y}, with_commas(entries[i].score),
                    {.size = 14 * unit, .color = color, .face = Face::Bold, .align_x = 1});
    }
    return entries.empty() ? y + 21 * unit : y;
}

float draw_keys(Canvas& screen, const Area& area, const Machine& machine, float unit)
{
    float y = heading(screen, area, "keys", unit);
    const float left = area.min.x + 34 * unit;
    const float right = area.max.x - 34 * unit;
    for (const KeyLine& line : machine.controls.key_lines())
    {
        screen.text({left, y}, line.keys, {.size = 14 * unit, .color = palette::text, .face = Face::Bold});
        screen.text({right, y}, line.meaning, {.size = 14 * unit, .color = palette::text_faint, .align_x = 1});
        y += 23 * unit;
    }
    return y;
}

float draw_rules(Canvas& screen, const Area& area, const Machine& machine, float unit)
{
    float y = heading(screen, area, "rules", unit);
    const float left = area.min.x + 34 * unit;
    const float width = area.size().x - 68 * unit;
    for (const CardEntry& entry : machine.game().table().card)
    {
        screen.text({left, y}, entry.name, {.size = 13 * unit, .color = palette::text, .face = Face::Bold});
        y += 17 * unit;
        const TextStyle style{.size = 13 * unit, .color = palette::text_faint};
        for (const std::string& line : wrap(screen, entry.text, style, width))
        {
            screen.text({left, y}, line, style);
            y += 16 * unit;
        }
        y += 6 * unit;
    }
    return y;
}

bool shows_rules(const Machine& machine, const Status& status)
{
    if (machine.game().table().card.empty())
        return false;
    const bool waits = machine.is_idle() || status.paused;
    return !waits || std::fmod(status.time, 2 * page_time) >= page_time;
}

void draw_card(Canvas& screen, const Layout& layout, const Machine& machine, const Status& status)
{
    const float u = layout.unit;
    const Vec2 middle = (layout.table.min + layout.table.max) * 0.5f;
    const float half = std::min(165 * u, layout.table.size().x / 2 - 4);
    const bool rules = shows_rules(machine, status);
    const auto draw_page = [&](Vec2 corner)
    {
        const Area area{corner + Vec2{-14 * u, 60 * u}, corner + Vec2{2 * half + 14 * u, 10'000}};
        if (rules)
            return draw_rules(screen, area, machine, u);
        const float keys_end = draw_keys(screen, area, machine, u);
        return draw_high_scores(screen, {{area.min.x, keys_end + 12 * u}, {area.max.x, keys_end + 190 * u}}, machine, u);
    };
    screen.push_clip({{0, 0}, {0, 0}});
    const float height = draw_page({}) + 12 * u;
    screen.pop_clip();
    const float top = std::max(layout.table.min.y + 8 * u, middle.y - height / 2);
    draw_sheet(screen, {middle.x - half, top}, {middle.x + half, top + height});
    screen.text({middle.x, top + 14 * u}, status.paused ? "paused" : machine.game().table().name,
                {.size = 28 * u, .color = palette::gold, .face = Face::Bold, .align_x = 0.5f});
    draw_page({middle.x - half, top});
}

void draw_strip(Canvas& screen, const Layout& layout, const std::vector<std::string>& sentences)
{
    constexpr std::size_t most = 4;
    const float u = layout.unit;
    const TextStyle style{.size = 13 * u, .color = palette::text};
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < std::min(sentences.size(), most); ++i)
        for (const std::string& line : wrap(screen, sentences[i], style, layout.table.size().x - 44 * u))
            lines.push_back(line);
    if (sentences.size() > most)
        lines.push_back("and " + std::to_string(sentences.size() - most) + " more");
    const float height = (12 + 18 * static_cast<float>(lines.size())) * u;
    const float top = layout.table.max.y - height - 8 * u;
    draw_sheet(screen, {layout.table.min.x + 12 * u, top}, {layout.table.max.x - 12 * u, top + height});
    for (std::size_t i = 0; i < lines.size(); ++i)
        screen.text({layout.table.min.x + 22 * u, top + (6 + 18 * static_cast<float>(i)) * u}, lines[i], style);
}

void draw_notes(Canvas& screen, const Area& area, const char* title, const std::vector<std::string>& sentences, float unit)
{
    float y = heading(screen, area, title, unit);
    const TextStyle style{.size = 13 * unit, .color = palette::text};
    for (std::size_t i = 0; i < sentences.size(); ++i)
    {
        const auto lines = wrap(screen, sentences[i], style, area.size().x - 68 * unit);
        if (y + (17 * static_cast<float>(lines.size()) + 20) * unit > area.max.y)
        {
            screen.text({area.min.x + 34 * unit, y}, "and " + std::to_string(sentences.size() - i) + " more", style);
            return;
        }
        for (const std::string& line : lines)
        {
            screen.text({area.min.x + 34 * unit, y}, line, style);
            y += 17 * unit;
        }
        y += 6 * unit;
    }
}

void draw_table_errors(Canvas& screen, const Layout& layout, const Machine& machine)
{
    const auto& errors = machine.table_errors();
    if (errors.empty())
        return;
    const float u = layout.unit;
    const TextStyle style{.size = 13 * u, .color = palette::text};
    const float width = layout.table.size().x - 44 * u;
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < errors.size() && i < 4; ++i)
        for (const std::string& line : wrap(screen, errors[i], style, width))
            lines.push_back(line);
    if (errors.size() > 4)
        lines.push_back("and " + std::to_string(errors.size() - 4) + " more");
    const float top = layout.table.min.y + 10 * u;
    const float left = layout.table.min.x + 12 * u;
    draw_sheet(screen, {left, top}, {layout.table.max.x - 12 * u, top + (42 + 18 * static_cast<float>(lines.size())) * u});
    screen.text({left + 10 * u, top + 10 * u}, "The table file has errors; the old table plays on.",
                {.size = 13 * u, .color = palette::coral, .face = Face::Bold});
    float y = top + 32 * u;
    for (const std::string& line : lines)
    {
        screen.text({left + 10 * u, y}, line, style);
        y += 18 * u;
    }
}

void draw_banner(Canvas& screen, const Layout& layout, const char* word, const char* hint)
{
    const Vec2 middle = (layout.table.min + layout.table.max) * 0.5f;
    const float u = layout.unit;
    const Vec2 half = Vec2{145, 40} * u;
    draw_sheet(screen, middle - half, middle + half);
    TextStyle style{.size = 26 * u, .color = palette::ivory, .face = Face::Bold, .align_x = 0.5f, .align_y = 0.5f};
    screen.text(middle - Vec2{0, 12 * u}, word, style);
    style.size = 12 * u;
    style.color = palette::text_faint;
    style.face = Face::Sans;
    screen.text(middle + Vec2{0, 18 * u}, hint, style);
}

} // namespace carom::pinball
