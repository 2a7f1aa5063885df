#pragma once

// The shapes that games move about, each about a metre tall and lowest 0.6 m below its center.

#include "carom/shape.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {

using NamedShape = std::pair<std::string, Geometry>;

inline Polygon many_cornered(int count, float inner_radius)
{
    Polygon p;
    const float step = pi / static_cast<float>(count);
    for (int k = 0; k < count; ++k)
    {
        const float angle = static_cast<float>(2 * k + 1) * step;
        p.vertices.push_back({inner_radius * std::cos(angle) / std::cos(step), inner_radius * std::sin(angle) / std::cos(step)});
    }
    return p;
}

inline std::vector<NamedShape> moving_shapes()
{
    return {
        {"box", box(0.5f, 0.6f)},
        {"upright capsule", Capsule{.a = {0, -0.3f}, .b = {0, 0.3f}, .radius_a = 0.3f, .radius_b = 0.3f}},
        {"lying capsule", Capsule{.a = {-0.3f, 0}, .b = {0.3f, 0}, .radius_a = 0.6f, .radius_b = 0.6f}},
        {"tapered capsule", Capsule{.a = {0, -0.3f}, .b = {0, 0.2f}, .radius_a = 0.3f, .radius_b = 0.4f}},
        {"twelve corners", many_cornered(12, 0.6f)},
        {"rounded box", box(0.4f, 0.5f, {}, 0, 0.1f)},
        {"triangle", Polygon{.vertices = {{0, 0.8f}, {-0.6f, -0.6f}, {0.6f, -0.6f}}}},
        {"circle", Circle{.radius = 0.6f}},
    };
}

} // namespace carom::test
