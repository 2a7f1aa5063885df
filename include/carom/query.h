#pragma once

/// @file
/// Questions about the scene as it stands between steps. Const: any number of them may run at once.

#include "carom/function.h"
#include "carom/id.h"
#include "carom/math.h"

#include <cstdint>

namespace carom {

/// Which shapes a query sees: those whose category is in mask and whose mask has the query's category.
struct QueryFilter
{
    std::uint64_t category = ~std::uint64_t{0};
    std::uint64_t mask = ~std::uint64_t{0};
    bool include_triggers = false;
    BodyId without{}; ///< a body whose shapes are not seen, such as the one that asks; null, or one that is gone: none
    /// Asked of each shape that passes all else and whose bounds are near, before it is looked at closely; false: it is not seen. The piece of a chain
    /// that is asked for is the chain. Empty: all are seen. It must not change the scene.
    Function<bool(ShapeId)> accepts{};
};

struct RayHit
{
    ShapeId shape{};
    Position point{};
    Vec2 normal{};      ///< of the surface, against the ray; zero where the ray starts inside
    float fraction = 0; ///< of the translation, 0 to 1
};

/// The way of a shape that is cast: from a pose along a straight line, while it turns evenly about the origin of its frame.
struct CastWay
{
    Pose start{};
    Vec2 translation{}; ///< m
    float turn = 0;     ///< rad, counter-clockwise, within ±2 pi
};

struct CastHit
{
    ShapeId shape{};
    Position point{};      ///< where the two touch, or the deepest point where they overlap at the start
    Vec2 normal{};         ///< of the surface that is met, against the cast: the way out
    float fraction = 0;    ///< of the way, 0 to 1
    float depth = 0;       ///< m, how far the two overlap at the start
    bool overlaps = false; ///< they overlap at the start already: fraction is 0
};

struct PointHit
{
    ShapeId shape{};
    Position point{};   ///< on the shape's surface
    Vec2 normal{};      ///< outward at that point
    float distance = 0; ///< m; negative inside
};

/// A touching or nearly touching pair, from Scene::contacts or Body::contacts as the last step has solved it, or from Body::touches_now.
struct ContactInfo
{
    struct Point
    {
        Position position;
        float separation = 0;       ///< m, negative where they overlap
        float normal_impulse = 0;   ///< N s, sum over the last step
        float friction_impulse = 0; ///< along perp(normal) on b, N s, sum over the last step
    };
    ShapeId shape_a{};
    ShapeId shape_b{};
    Vec2 normal{}; ///< unit, from a to b
    Point points[2];
    int point_count = 0;
    bool touching = false;
    int color = -1; ///< of the constraint graph in the last step; -1: not in it
};

} // namespace carom
