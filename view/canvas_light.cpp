// Glow, shade and trails: the soft-edged part of the canvas.

#include "view/canvas.h"
#include "view/line_maker.h"

#include <SDL_opengl.h>

#include <array>

namespace carom::view {
namespace {

// (1 - d)² from the inner radius out: looks like light and ends without an edge.
std::vector<Profile::Step> falloff(float inner, float outer)
{
    std::vector<Profile::Step> steps;
    constexpr int count = 8;
    for (int i = 0; i <= count; ++i)
    {
        const float d = static_cast<float>(i) / count;
        steps.push_back({inner + (outer - inner) * d, (1 - d) * (1 - d)});
    }
    return steps;
}

} // namespace

void Canvas::glow(Position center, float inner_radius, float radius, Color color)
{
    begin_additive();
    shade(center, inner_radius, radius, color);
    end_additive();
}

void Canvas::glow_line(Position a, Position b, float radius, Color color)
{
    const std::array<Position, 2> path{a, b};
    glow_path(path, radius, color);
}

void Canvas::glow_path(std::span<const Position> path, float radius, Color color, bool closed)
{
    begin_additive();
    shade_path(path, radius, color, closed);
    end_additive();
}

void Canvas::shade(Position center, float inner_radius, float radius, Color color)
{
    const auto steps = falloff(points(inner_radius), points(inner_radius + radius));
    Mesher(*m_list).revolve({to_imgui(m_camera.to_screen(center)), color}, {steps}, 0, 2 * pi);
}

void Canvas::shade_path(std::span<const Position> path, float radius, Color color, bool closed)
{
    auto line = to_line(m_camera, path, color, closed);
    if (line.size() < 2)
        return;
    const auto steps = falloff(0, points(radius));
    Mesher mesher(*m_list);
    // No round joints: what is laid twice shows twice.
    LineMaker lines(mesher, {steps}, 10);
    if (closed && line.size() > 2)
        lines.closed(std::move(line));
    else
        lines.open(line);
}

void Canvas::trail(std::span<const Position> newest_first, float radius, Color color)
{
    const auto line = to_line(m_camera, newest_first, color, false);
    if (line.size() < 2)
        return;
    begin_additive();
    Mesher(*m_list).taper(line, points(radius));
    end_additive();
}

void Canvas::begin_additive()
{
    const auto add = [](const ImDrawList*, const ImDrawCmd*) { glBlendFunc(GL_SRC_ALPHA, GL_ONE); };
    if (m_additive++ == 0)
        m_list->AddCallback(add, nullptr);
}

void Canvas::end_additive()
{
    if (--m_additive == 0)
        m_list->AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

} // namespace carom::view
