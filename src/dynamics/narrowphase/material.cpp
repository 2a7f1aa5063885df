// Rules that mix materials, restitution curves, kicks and one-way shapes.

#include "dynamics/narrowphase/material.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

struct Side
{
    float value;
    bool yields;
    int shape;
};

std::uint64_t user_data_of(const SceneData& scene, int shape)
{
    return scene.shape_user_data[static_cast<std::size_t>(scene.state.shapes[shape].owner)];
}

float mix(const SceneData& scene, MixedValue what, const Side& a, const Side& b)
{
    const SceneDef& def = scene.def;
    switch (what == MixedValue::Friction ? def.friction_rule : def.restitution_rule)
    {
    case MixRule::Average: return 0.5f * (a.value + b.value);
    case MixRule::GeometricMean: return std::sqrt(a.value * b.value);
    case MixRule::Minimum: return std::min(a.value, b.value);
    case MixRule::Maximum: return std::max(a.value, b.value);
    case MixRule::Product: return a.value * b.value;
    case MixRule::OtherDecides: return a.yields == b.yields ? 0.5f * (a.value + b.value) : (a.yields ? b.value : a.value);
    case MixRule::Function:
        return def.mix_function(what, a.value, user_data_of(scene, a.shape), b.value, user_data_of(scene, b.shape));
    }
    return 0;
}

float restitution_at(const SceneState& state, const ShapeRecord& shape, float speed)
{
    const RestitutionCurve& curve = rare_traits_of(state, shape).restitution_curve;
    if (curve.count == 0)
        return shape.restitution;
    const std::uint32_t n = curve.count;
    const auto& p = curve.points;
    if (speed <= p[0].speed)
        return p[0].restitution;
    for (std::uint32_t i = 1; i < n; ++i)
    {
        if (speed < p[i].speed)
        {
            const float t = (speed - p[i - 1].speed) / (p[i].speed - p[i - 1].speed);
            return p[i - 1].restitution + t * (p[i].restitution - p[i - 1].restitution);
        }
    }
    return p[n - 1].restitution;
}

bool fires(const SceneState& state, const RareTraits& shape, float speed)
{
    return shape.kick.speed > 0 && speed > shape.kick.threshold && state.time >= shape.kick_ready;
}

bool stops_short(const SceneState& state, const ShapeRecord& shape, Vec2 outward)
{
    const Vec2 one_way = rare_traits_of(state, shape).one_way;
    if (one_way == Vec2{})
        return false;
    const Vec2 direction = rotate(state.sims[static_cast<std::size_t>(shape.body)].rotation, one_way);
    return dot(outward, direction) <= 0;
}

} // namespace

float mixed_friction(const SceneData& scene, int shape_a, int shape_b)
{
    const ShapeRecord& a = scene.state.shapes[shape_a];
    const ShapeRecord& b = scene.state.shapes[shape_b];
    const float value =
        mix(scene, MixedValue::Friction, {a.friction, a.yields_material, shape_a}, {b.friction, b.yields_material, shape_b});
    return value > 0 ? std::min(value, 1e6f) : 0;
}

float mixed_restitution(const SceneData& scene, int shape_a, int shape_b, float speed)
{
    const ShapeRecord& a = scene.state.shapes[shape_a];
    const ShapeRecord& b = scene.state.shapes[shape_b];
    const float value = mix(scene, MixedValue::Restitution, {restitution_at(scene.state, a, speed), a.yields_material, shape_a},
                            {restitution_at(scene.state, b, speed), b.yields_material, shape_b});
    return value > 0 ? std::min(value, 1.0f) : 0;
}

bool may_bounce(const SceneData& scene, int shape_a, int shape_b)
{
    const auto kicks = [&](int shape) { return rare_traits_of(scene.state, scene.state.shapes[shape]).kick.speed > 0; };
    bool bounces = kicks(shape_a) || kicks(shape_b) || mixed_restitution(scene, shape_a, shape_b, 0) >= bouncing_restitution;
    for (const int shape : {shape_a, shape_b})
    {
        const RestitutionCurve& curve = rare_traits_of(scene.state, scene.state.shapes[shape]).restitution_curve;
        for (std::uint32_t i = 0; i < curve.count; ++i)
            bounces = bounces || mixed_restitution(scene, shape_a, shape_b, curve.points[i].speed) >= bouncing_restitution;
    }
    return bounces;
}

KickResult kick_speed(const SceneData& scene, int shape_a, int shape_b, float speed)
{
    const SceneState& state = scene.state;
    const RareTraits& a = rare_traits_of(state, state.shapes[shape_a]);
    const RareTraits& b = rare_traits_of(state, state.shapes[shape_b]);
    KickResult result{0, fires(state, a, speed), fires(state, b, speed)};
    result.speed = (result.a_fired ? a.kick.speed : 0) + (result.b_fired ? b.kick.speed : 0);
    return result;
}

bool lets_pass(const SceneData& scene, int shape_a, int shape_b, Vec2 normal)
{
    const SceneState& state = scene.state;
    return stops_short(state, state.shapes[shape_a], normal) || stops_short(state, state.shapes[shape_b], -normal);
}

} // namespace carom::internal
