#pragma once

/// @file
/// Scenes in a line, random numbers from a fixed seed, and the few numbers that many tests ask for.

#include "carom/scene.h"
#include "scenes/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace carom::test {

/// The same numbers everywhere.
class Random : public SplitMix64
{
public:
    using SplitMix64::SplitMix64;
    double range(double low, double high) { return low + (high - low) * unit(); }
    float rangef(double low, double high) { return static_cast<float>(range(low, high)); }
    bool chance(double p) { return unit() < p; }
    Vec2 vec(double size) { return {rangef(-size, size), rangef(-size, size)}; }
};

struct Thing
{
    BodyId body{};
    ShapeId shape{};
};

inline Thing add(Scene& scene, const BodyDef& body, const Geometry& geometry, const ShapeDef& shape = {})
{
    Thing thing;
    thing.body = scene.create_body(body);
    thing.shape = scene.create_shape(thing.body, geometry, shape);
    return thing;
}

inline Thing add_dynamic(Scene& scene, Position position, const Geometry& geometry, const ShapeDef& shape = {},
                         Vec2 velocity = {}, float spin = 0)
{
    return add(scene, {.type = BodyType::Dynamic, .position = position, .velocity = velocity, .angular_velocity = spin}, geometry,
               shape);
}

inline Thing add_static(Scene& scene, const Geometry& geometry, const ShapeDef& shape = {}, Position position = {},
                        float angle = 0)
{
    return add(scene, {.position = position, .angle = angle}, geometry, shape);
}

/// No gravity, and bodies stay awake.
inline SceneDef weightless()
{
    SceneDef def;
    def.gravity = {0, 0};
    def.sleeping = false;
    return def;
}

inline SceneDef sleepless()
{
    SceneDef def;
    def.sleeping = false;
    return def;
}

inline void steps(Scene& scene, int count, float h = 1.0f / 60)
{
    for (int i = 0; i < count; ++i)
        scene.step(h);
}

/// Kinetic energy in doubles.
inline double kinetic(Scene& scene, BodyId id)
{
    const Body body = scene.body(id);
    const double v2 =
        static_cast<double>(body.velocity().x) * body.velocity().x + static_cast<double>(body.velocity().y) * body.velocity().y;
    const double w = body.angular_velocity();
    return 0.5 * static_cast<double>(body.mass()) * v2 + 0.5 * static_cast<double>(body.inertia()) * w * w;
}

/// Kinetic plus potential energy in the scene's gravity.
inline double energy(Scene& scene, BodyId id)
{
    const Position c = scene.body(id).center_of_mass();
    const Vec2 g = scene.gravity();
    return kinetic(scene, id) -
           static_cast<double>(scene.body(id).mass()) * (static_cast<double>(g.x) * c.x + static_cast<double>(g.y) * c.y);
}

inline double speed(Scene& scene, BodyId id)
{
    const Vec2 v = scene.body(id).velocity();
    return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y));
}

} // namespace carom::test
