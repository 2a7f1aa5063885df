#pragma once

/// @file
/// Short words for building scenes.

#include "scenes/scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom::scenes {

/// PCG32: small, the same everywhere.
class Random
{
public:
    explicit Random(std::uint64_t seed) : m_state(seed * 2 + 1) { (void)bits(); }
    std::uint32_t bits()
    {
        const std::uint64_t old = m_state;
        m_state = old * 6364136223846793005u + 1442695040888963407u;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto turn = static_cast<std::uint32_t>(old >> 59u);
        return (shifted >> turn) | (shifted << ((32 - turn) & 31));
    }
    /// From low (included) to high (excluded).
    float in(float low, float high) { return low + (high - low) * (static_cast<float>(bits() >> 8) * (1.0f / 16777216)); }
    int below(int count) { return static_cast<int>(bits() % static_cast<std::uint32_t>(count)); }

private:
    std::uint64_t m_state;
};

/// How many steps of length h a schedule counts for so many seconds: at least 1.
inline std::uint64_t steps_in(float seconds, float h)
{
    return static_cast<std::uint64_t>(std::max(1.0f, std::round(seconds / h)));
}

inline BodyId add_static(Scene& scene, const Geometry& geometry, const ShapeDef& shape = {}, Position at = {}, float angle = 0)
{
    const BodyId body = scene.create_body({.type = BodyType::Static, .position = at, .angle = angle});
    scene.create_shape(body, geometry, shape);
    return body;
}

inline BodyId add_dynamic(Scene& scene, Position at, const Geometry& geometry, const ShapeDef& shape = {}, Vec2 velocity = {},
                          float angle = 0)
{
    const BodyId body = scene.create_body({.type = BodyType::Dynamic, .position = at, .angle = angle, .velocity = velocity});
    scene.create_shape(body, geometry, shape);
    return body;
}

inline BodyId add_floor(Scene& scene, float height = 0, const ShapeDef& shape = {})
{
    return add_static(scene, HalfSpace{.normal = {0, 1}, .offset = height}, shape);
}

/// A trough: a floor and two walls of boxes half a metre thick; their inner faces lie at ±half_width and at height 0.
inline BodyId add_trough(Scene& scene, float half_width, float wall_height, const ShapeDef& shape = {})
{
    constexpr float half = 0.25f;
    const BodyId body = scene.create_body({.type = BodyType::Static});
    scene.create_shape(body, box(half_width + 2 * half, half, {0, -half}), shape);
    scene.create_shape(body, box(half, wall_height / 2, {-half_width - half, wall_height / 2}), shape);
    scene.create_shape(body, box(half, wall_height / 2, {half_width + half, wall_height / 2}), shape);
    return body;
}

} // namespace carom::scenes
