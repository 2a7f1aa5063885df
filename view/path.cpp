#include "view/path.h"

#include <algorithm>
#include <cmath>

namespace carom::view {
namespace {

double turn(Position a, Position b, Position c) { return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x); }

float signed_area(std::span<const Position> v)
{
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
        sum += turn(v[0], v[i], v[(i + 1) % v.size()]);
    return static_cast<float>(sum);
}

float direction(Position from, Position to)
{
    return std::atan2(static_cast<float>(to.y - from.y), static_cast<float>(to.x - from.x));
}

// The piece from `from` to its end, without `from` itself.
void append_piece(Path& path, Position from, const ChainPiece& piece, float tolerance)
{
    const Position end = piece.end;
    if (piece.sweep == 0)
    {
        path.push_back(end);
        return;
    }
    const float chord = length(end - from);
    const float half = piece.sweep / 2;
    const float radius = chord / 2 / std::abs(std::sin(half));
    const Vec2 along = normalize(end - from);
    // The centre lies left of the chord for a positive sweep below pi, and crosses over beyond it.
    const float offset = chord / 2 / std::tan(half);
    const Position center = from + along * (chord / 2) + perp(along) * offset;
    Path arc;
    append_arc(arc, center, radius, direction(center, from), piece.sweep, tolerance);
    path.insert(path.end(), arc.begin() + 1, arc.end() - 1);
    path.push_back(end);
}

} // namespace

void append_arc(Path& path, Position center, float radius, float start_angle, float sweep, float tolerance)
{
    const float ratio = std::clamp(tolerance / std::max(radius, 1e-9f), 1e-6f, 0.5f);
    const float step = std::min(2 * std::acos(1 - ratio), 0.6f);
    const int count = std::clamp(static_cast<int>(std::ceil(std::abs(sweep) / step)), 1, 512);
    for (int i = 0; i <= count; ++i)
    {
        const float angle = start_angle + sweep * static_cast<float>(i) / static_cast<float>(count);
        path.push_back(center + Vec2{radius * std::cos(angle), radius * std::sin(angle)});
    }
}

Path capsule_outline(Position a, Position b, float radius_a, float radius_b, float tolerance)
{
    const float distance = length(b - a);
    Path path;
    if (distance <= std::abs(radius_a - radius_b))
    {
        const bool a_wins = radius_a > radius_b;
        append_arc(path, a_wins ? a : b, std::max(radius_a, radius_b), 0, 2 * pi, tolerance);
        path.pop_back();
        return path;
    }
    // The flanks touch both circles where the normal leans by this angle towards the thinner end.
    const float lean = std::acos((radius_a - radius_b) / distance);
    const float along = direction(a, b);
    append_arc(path, a, radius_a, along + lean, 2 * (pi - lean), tolerance);
    append_arc(path, b, radius_b, along - lean, 2 * lean, tolerance);
    return path;
}

Path rounded_outline(std::span<const Position> vertices, float radius, float tolerance)
{
    Path corners(vertices.begin(), vertices.end());
    if (signed_area(corners) < 0)
        std::ranges::reverse(corners);
    if (radius <= 0)
        return corners;
    Path path;
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i)
    {
        const float in = direction(corners[(i + n - 1) % n], corners[i]);
        float bend = direction(corners[i], corners[(i + 1) % n]) - in;
        if (bend < 0)
            bend += 2 * pi;
        append_arc(path, corners[i], radius, in - pi / 2, bend, tolerance);
    }
    return path;
}

Path chain_path(const Chain& chain, float tolerance)
{
    Path path{chain.start};
    for (const ChainPiece& piece : chain.pieces)
        append_piece(path, path.back(), piece, tolerance);
    if (chain.closed && path.size() > 2 && length(path.back() - path.front()) < 1e-6f)
        path.pop_back();
    return path;
}

void transform_path(Path& path, const Pose& pose)
{
    for (Position& p : path)
        p = transform(pose, to_vec2(p));
}

} // namespace carom::view
