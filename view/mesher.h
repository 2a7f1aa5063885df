#pragma once

/// @file
/// Triangles with soft edges into a Dear ImGui draw list. Everything here is in window points, y down.

#include "view/color.h"

#include <imgui.h>

#include <span>

namespace carom::view {

/// A point of a line and the colour of the line there.
struct PathPoint
{
    ImVec2 at;
    Color color;
};

/// A line's cross-section: alpha over the distance from its middle, from the middle outwards, symmetric.
struct Profile
{
    struct Step
    {
        float distance = 0;
        float alpha = 0;
    };
    std::span<const Step> steps;
};

class Mesher
{
public:
    explicit Mesher(ImDrawList& list) : m_list(list), m_white(ImGui::GetFontTexUvWhitePixel()) {}

    /// Convex, in either winding; edges fade over `fringe` points.
    void convex(std::span<const PathPoint> outline, float fringe);
    /// Loose triangles, three points each, hard edges.
    void triangles(std::span<const PathPoint> corners);
    /// A soft edge around a closed outline in either winding.
    void fringe(std::span<const PathPoint> outline, float width);
    /// The profile swept along the path without breaks.
    void sweep(std::span<const PathPoint> path, Profile profile, bool closed);
    /// A soft band that narrows from its first point, where it is `radius` wide to each side, and fades to nothing at its last.
    void taper(std::span<const PathPoint> path, float radius);
    /// The profile turned about a point, by pi (a cap that looks in `direction`) or all the way round.
    void revolve(const PathPoint& center, Profile profile, float start_angle, float sweep);
    /// Rings of colour between a point and a circle.
    void radial(ImVec2 center, float radius, ImVec2 focus, Color inner, Color outer, float fringe);

private:
    struct Mark
    {
        unsigned base;
    };
    Mark reserve(std::size_t vertices, std::size_t indices);
    void vertex(ImVec2 p, Color c) { m_list.PrimWriteVtx(p, m_white, pack(c)); }
    void triangle(unsigned a, unsigned b, unsigned c);
    void quad(unsigned a, unsigned b, unsigned c, unsigned d);

    ImDrawList& m_list;
    ImVec2 m_white;
};

} // namespace carom::view
