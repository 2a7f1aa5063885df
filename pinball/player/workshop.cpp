#include "pinball/player/workshop.h"

#include "pinball/player/palette.h"
#include "pinball/player/side_panel.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace carom::pinball {

namespace {

using view::Canvas;
using view::Face;

constexpr double fine_line = 0.01; // m
constexpr double thick_line = 0.1; // m, labelled
constexpr float least_spacing = 5; // points between fine lines

constexpr view::Color grid_color = view::rgb(0xbfe3ff);
constexpr view::Color finding_color = view::rgb(0xff5a4f);

std::string metres(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

void draw_lines(Canvas& table, Vec2 size, double spacing, float strength)
{
    const view::Pen pen{view::fade(grid_color, strength), 1};
    for (int i = 0; i * spacing <= static_cast<double>(size.x) + 1e-6; ++i)
        table.line({i * spacing, 0}, {i * spacing, static_cast<double>(size.y)}, pen);
    for (int i = 0; i * spacing <= static_cast<double>(size.y) + 1e-6; ++i)
        table.line({0, i * spacing}, {static_cast<double>(size.x), i * spacing}, pen);
}

void draw_grid(Canvas& table, Vec2 size)
{
    if (table.points(static_cast<float>(fine_line)) >= least_spacing)
        draw_lines(table, size, fine_line, 0.10f);
    draw_lines(table, size, thick_line, 0.45f);
    const view::TextStyle style{.size = 11, .color = grid_color, .face = Face::Bold};
    for (int i = 1; i * thick_line <= static_cast<double>(size.x); ++i)
        table.text({i * thick_line, static_cast<double>(table.camera().meters(14))}, metres(i * thick_line), style);
    for (int i = 1; i * thick_line <= static_cast<double>(size.y); ++i)
        table.text({static_cast<double>(table.camera().meters(2)), i * thick_line}, metres(i * thick_line), style);
}

void draw_finding(Canvas& table, const Finding& finding, std::size_t number)
{
    const float radius = table.camera().meters(11);
    table.stroke_circle(Position(finding.where), radius, {finding_color, 2.5f});
    table.text(Position(finding.where + Vec2{radius, radius}), std::to_string(number),
               {.size = 14, .color = finding_color, .face = Face::Bold});
}

// Where the mouse is, on a dark ground that stays within what is seen.
void draw_cursor(Canvas& table, Vec2 mouse)
{
    const Position at = table.camera().to_world(mouse);
    const Box seen = table.camera().visible();
    if (at.x < seen.lower.x || at.x > seen.upper.x || at.y < seen.lower.y || at.y > seen.upper.y)
        return;
    char text[48];
    std::snprintf(text, sizeof text, "%.3f, %.3f m", at.x, at.y);
    const view::TextStyle style{.size = 13, .color = palette::text, .face = Face::Mono};
    const Vec2 size = table.text_size(text, style) + Vec2{10, 6};
    const double width = static_cast<double>(table.camera().meters(size.x));
    const double height = static_cast<double>(table.camera().meters(size.y));
    const double gap = static_cast<double>(table.camera().meters(12));
    const double x = std::min(at.x + gap, seen.upper.x - width);
    const double y = std::max(at.y - gap, seen.lower.y + height);
    table.fill_box({{x, y - height}, {x + width, y}}, view::rgb(0x0a0d18, 0.92f), table.camera().meters(4));
    table.text({x + static_cast<double>(table.camera().meters(5)), y - static_cast<double>(table.camera().meters(3))}, text,
               style);
}

} // namespace

void Workshop::check(const Machine& machine)
{
    if (m_running.valid() && m_running.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    {
        m_findings = m_running.get();
        m_done = true;
    }
    if (m_running.valid() || m_version == machine.table_version())
        return;
    m_version = machine.table_version();
    m_done = false;
    m_findings.clear();
    m_running = std::async(std::launch::async, [table = machine.game().table()] { return pinball::check(table); });
}

void Workshop::draw_on(Canvas& table, const Machine& machine, Vec2 mouse)
{
    check(machine);
    draw_grid(table, machine.game().table().size);
    for (std::size_t i = 0; i < m_findings.size(); ++i)
        draw_finding(table, m_findings[i], i + 1);
    draw_cursor(table, mouse);
}

std::vector<std::string> Workshop::lines() const
{
    if (!m_done)
        return {"looking ..."};
    if (m_findings.empty())
        return {"nothing found"};
    std::vector<std::string> all;
    for (std::size_t i = 0; i < m_findings.size(); ++i)
        all.push_back(std::to_string(i + 1) + "  " + to_string(m_findings[i]));
    return all;
}

void Workshop::draw_list(Canvas& screen, const Layout& layout) const
{
    if (layout.landscape)
        draw_notes(screen, {layout.side.min + Vec2{0, 78 * layout.unit}, layout.side.max}, "the checker", lines(), layout.unit);
    else
        draw_strip(screen, layout, lines());
}

} // namespace carom::pinball
