#include "view/mesher.h"

#include "carom/math.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom::view {
namespace {

ImVec2 operator+(ImVec2 a, ImVec2 b) { return {a.x + b.x, a.y + b.y}; }
ImVec2 operator-(ImVec2 a, ImVec2 b) { return {a.x - b.x, a.y - b.y}; }
ImVec2 operator*(ImVec2 a, float s) { return {a.x * s, a.y * s}; }

ImVec2 unit(ImVec2 v)
{
    const float size = std::sqrt(v.x * v.x + v.y * v.y);
    return size > 1e-6f ? v * (1 / size) : ImVec2{0, 0};
}

ImVec2 turned(ImVec2 v) { return {-v.y, v.x}; }

// The normal at a corner, long enough that both flanks keep their width; at most three times.
ImVec2 miter(ImVec2 before, ImVec2 at, ImVec2 after)
{
    const ImVec2 a = turned(unit(at - before));
    const ImVec2 b = turned(unit(after - at));
    const ImVec2 sum = a + b;
    const float squared = sum.x * sum.x + sum.y * sum.y;
    return squared > 1e-6f ? sum * (2 / std::max(squared, 4.0f / 9)) : a;
}

float area(std::span<const PathPoint> p)
{
    float sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
    {
        const ImVec2 a = p[i].at - p[0].at;
        const ImVec2 b = p[(i + 1) % p.size()].at - p[0].at;
        sum += a.x * b.y - a.y * b.x;
    }
    return sum / 2;
}

int circle_segments(float radius)
{
    const float step = 2 * std::acos(1 - std::clamp(0.12f / std::max(radius, 0.1f), 1e-5f, 0.5f));
    return std::clamp(static_cast<int>(std::ceil(2 * pi / step)), 10, 400);
}

} // namespace

Mesher::Mark Mesher::reserve(std::size_t vertices, std::size_t indices)
{
    m_list.PrimReserve(static_cast<int>(indices), static_cast<int>(vertices));
    return {m_list._VtxCurrentIdx};
}

void Mesher::triangle(unsigned a, unsigned b, unsigned c)
{
    m_list.PrimWriteIdx(static_cast<ImDrawIdx>(a));
    m_list.PrimWriteIdx(static_cast<ImDrawIdx>(b));
    m_list.PrimWriteIdx(static_cast<ImDrawIdx>(c));
}

void Mesher::quad(unsigned a, unsigned b, unsigned c, unsigned d)
{
    triangle(a, b, c);
    triangle(a, c, d);
}

void Mesher::convex(std::span<const PathPoint> p, float fringe_width)
{
    const auto n = static_cast<unsigned>(p.size());
    if (n < 3)
        return;
    const float outward = (area(p) < 0 ? 0.5f : -0.5f) * fringe_width;
    const auto [base] = reserve(2 * n, 3 * (n - 2) + 6 * n);
    for (unsigned i = 0; i < n; ++i)
    {
        const ImVec2 normal = miter(p[(i + n - 1) % n].at, p[i].at, p[(i + 1) % n].at) * outward;
        vertex(p[i].at - normal, p[i].color);
        vertex(p[i].at + normal, fade(p[i].color, 0));
    }
    for (unsigned i = 2; i < n; ++i)
        triangle(base, base + 2 * (i - 1), base + 2 * i);
    for (unsigned i = 0; i < n; ++i)
    {
        const unsigned a = base + 2 * i;
        const unsigned b = base + 2 * ((i + 1) % n);
        quad(a, a + 1, b + 1, b);
    }
}

void Mesher::triangles(std::span<const PathPoint> corners)
{
    // In portions that fit 16-bit indices.
    constexpr std::size_t most = 30000;
    for (std::size_t first = 0; first < corners.size(); first += most)
    {
        const auto part = corners.subspan(first, std::min(most, corners.size() - first));
        const auto [base] = reserve(part.size(), part.size());
        for (const PathPoint& c : part)
            vertex(c.at, c.color);
        for (unsigned i = 0; i < part.size(); ++i)
            m_list.PrimWriteIdx(static_cast<ImDrawIdx>(base + i));
    }
}

void Mesher::fringe(std::span<const PathPoint> p, float width)
{
    const auto n = static_cast<unsigned>(p.size());
    const float outward = (area(p) < 0 ? 1.0f : -1.0f) * width;
    const auto [base] = reserve(2 * n, 6 * n);
    for (unsigned i = 0; i < n; ++i)
    {
        vertex(p[i].at, p[i].color);
        vertex(p[i].at + miter(p[(i + n - 1) % n].at, p[i].at, p[(i + 1) % n].at) * outward, fade(p[i].color, 0));
    }
    for (unsigned i = 0; i < n; ++i)
    {
        const unsigned a = base + 2 * i;
        const unsigned b = base + 2 * ((i + 1) % n);
        quad(a, a + 1, b + 1, b);
    }
}

void Mesher::sweep(std::span<const PathPoint> p, Profile profile, bool closed)
{
    const auto n = static_cast<unsigned>(p.size());
    const auto half = static_cast<unsigned>(profile.steps.size());
    if (n < 2 || half == 0)
        return;
    const unsigned across = 2 * half;
    const unsigned spans = closed ? n : n - 1;
    const auto [base] = reserve(n * across, spans * (across - 1) * 6);
    for (unsigned i = 0; i < n; ++i)
    {
        const ImVec2 before = closed || i > 0 ? p[(i + n - 1) % n].at : p[i].at - (p[i + 1].at - p[i].at);
        const ImVec2 after = closed || i + 1 < n ? p[(i + 1) % n].at : p[i].at + (p[i].at - p[i - 1].at);
        const ImVec2 normal = miter(before, p[i].at, after);
        for (unsigned k = 0; k < half; ++k)
        {
            const Profile::Step step = profile.steps[half - 1 - k];
            vertex(p[i].at - normal * step.distance, fade(p[i].color, step.alpha));
        }
        for (const Profile::Step step : profile.steps)
            vertex(p[i].at + normal * step.distance, fade(p[i].color, step.alpha));
    }
    for (unsigned i = 0; i < spans; ++i)
        for (unsigned k = 0; k + 1 < across; ++k)
        {
            const unsigned a = base + i * across + k;
            const unsigned b = base + (i + 1) % n * across + k;
            quad(a, a + 1, b + 1, b);
        }
}

void Mesher::taper(std::span<const PathPoint> p, float radius)
{
    const auto n = static_cast<unsigned>(p.size());
    const auto [base] = reserve(3 * n, 12 * (n - 1));
    for (unsigned i = 0; i < n; ++i)
    {
        const ImVec2 before = i > 0 ? p[i - 1].at : p[i].at - (p[i + 1].at - p[i].at);
        const ImVec2 after = i + 1 < n ? p[i + 1].at : p[i].at + (p[i].at - p[i - 1].at);
        const float left = 1 - static_cast<float>(i) / static_cast<float>(n - 1);
        // The direction alone: a miter at a bounce would throw a spike.
        const ImVec2 side = turned(unit(after - before)) * (radius * (0.3f + 0.7f * left));
        vertex(p[i].at - side, fade(p[i].color, 0));
        vertex(p[i].at, fade(p[i].color, left * left));
        vertex(p[i].at + side, fade(p[i].color, 0));
    }
    for (unsigned i = 0; i + 1 < n; ++i)
        for (unsigned k = 0; k < 2; ++k)
        {
            const unsigned a = base + 3 * i + k;
            quad(a, a + 1, a + 4, a + 3);
        }
}

void Mesher::revolve(const PathPoint& center, Profile profile, float start_angle, float sweep_angle)
{
    const auto rings = static_cast<unsigned>(profile.steps.size());
    if (rings == 0)
        return;
    const float share = std::abs(sweep_angle) / (2 * pi);
    const auto n =
        static_cast<unsigned>(std::ceil(static_cast<float>(circle_segments(profile.steps.back().distance)) * share)) + 1;
    const auto [base] = reserve(1 + n * rings, (n - 1) * (3 + (rings - 1) * 6));
    vertex(center.at, fade(center.color, profile.steps[0].alpha));
    for (unsigned i = 0; i < n; ++i)
    {
        const float angle = start_angle + sweep_angle * static_cast<float>(i) / static_cast<float>(n - 1);
        const ImVec2 out{std::cos(angle), std::sin(angle)};
        for (const Profile::Step step : profile.steps)
            vertex(center.at + out * step.distance, fade(center.color, step.alpha));
    }
    for (unsigned i = 0; i + 1 < n; ++i)
    {
        const unsigned a = base + 1 + i * rings;
        const unsigned b = a + rings;
        triangle(base, a, b);
        for (unsigned k = 0; k + 1 < rings; ++k)
            quad(a + k, a + k + 1, b + k + 1, b + k);
    }
}

void Mesher::radial(ImVec2 center, float radius, ImVec2 focus, Color inner, Color outer, float fringe_width)
{
    constexpr unsigned rings = 6;
    const auto n = static_cast<unsigned>(circle_segments(radius));
    const auto [base] = reserve(1 + n * (rings + 1), n * (3 + rings * 6));
    const float solid = std::max(radius - fringe_width / 2, 0.0f);
    vertex(center + focus * radius, inner);
    for (unsigned k = 1; k <= rings; ++k)
    {
        const float t = static_cast<float>(k) / rings;
        for (unsigned i = 0; i < n; ++i)
        {
            const float angle = 2 * pi * static_cast<float>(i) / static_cast<float>(n);
            const ImVec2 out{std::cos(angle), std::sin(angle)};
            vertex(center + focus * (radius * (1 - t)) + out * (solid * t), mix(inner, outer, t));
        }
    }
    for (unsigned i = 0; i < n; ++i)
    {
        const float angle = 2 * pi * static_cast<float>(i) / static_cast<float>(n);
        vertex(center + ImVec2{std::cos(angle), std::sin(angle)} * (radius + fringe_width / 2), fade(outer, 0));
    }
    for (unsigned i = 0; i < n; ++i)
    {
        const unsigned j = (i + 1) % n;
        triangle(base, base + 1 + i, base + 1 + j);
        for (unsigned k = 0; k < rings; ++k)
        {
            const unsigned ring = base + 1 + k * n;
            quad(ring + i, ring + n + i, ring + n + j, ring + j);
        }
    }
}

} // namespace carom::view
