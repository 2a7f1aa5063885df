// Shape casts against marching and closed forms, and filters that leave out bodies or ask.

#include "support/test_scene.h"

#include <algorithm>
#include <cmath>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float tolerance = 2e-3f; // m, of marching

Pose pose_at(const CastWay& way, float fraction)
{
    return {way.start.position + fraction * way.translation, Rotation::from_angle(fraction * way.turn) * way.start.rotation};
}

// How deep the shape is in others at a pose.
float depth_at(const Scene& scene, const Geometry& geometry, const Pose& pose)
{
    const std::optional<CastHit> hit = scene.shapecast_closest(geometry, {.start = pose});
    return hit && hit->overlaps ? hit->depth : 0;
}

Geometry draw_shape(Random& random, int kind)
{
    switch (kind % 6)
    {
    case 0: return Circle{.radius = random.rangef(0.05, 0.6)};
    case 1: return box(random.rangef(0.1, 0.6), random.rangef(0.1, 0.6), {}, 0, random.chance(0.5) ? 0 : 0.1f);
    case 2: return Capsule{{-0.4f, 0}, {0.5f, 0.1f}, 0.3f, 0.1f};
    case 3: return Polygon{{{-0.5f, -0.3f}, {0.6f, -0.2f}, {0, 0.5f}}};
    case 4: return box(0.3f, 0.2f, {0.7f, 0}); // off its origin, about which it turns
    default: return Circle{.center = {0.5f, 0.2f}, .radius = 0.3f};
    }
}

Geometry draw_obstacle(Random& random, int kind)
{
    switch (kind % 8)
    {
    case 6: return Segment{{-0.5f, 0}, {0.5f, 0.3f}, 0.05f};
    case 7: return Arc{.radius = 0.8f, .start_angle = random.rangef(-3, 3), .sweep = 2, .half_thickness = 0.05f};
    default: return draw_shape(random, kind);
    }
}

struct Obstacles
{
    Scene scene{weightless()};

    explicit Obstacles(Random& random)
    {
        for (int i = 0; i < 60; ++i)
            add(scene,
                {.type = i % 8 < 4 ? BodyType::Dynamic : BodyType::Static,
                 .position = {random.range(-8, 8), random.range(-8, 8)},
                 .angle = random.rangef(-3, 3)},
                draw_obstacle(random, i));
    }
};

// The point is on the surface of the cast shape too.
bool is_on(const Geometry& geometry, const Pose& pose, const Position& point)
{
    Scene scene(weightless());
    add_static(scene, geometry);
    const Vec2 local = inverse_transform(pose, point);
    const std::optional<PointHit> near = scene.closest_point({local.x, local.y}, 1);
    return near && std::fabs(near->distance) < tolerance;
}

} // namespace

TEST(ShapeCasts, AgreeWithMarching)
{
    Random random(3);
    int hits = 0;
    int overlaps = 0;
    for (int i = 0; i < 600; ++i)
    {
        SCOPED_TRACE(i);
        static Obstacles field(random);
        const Geometry shape = draw_shape(random, i);
        const CastWay way{.start = {{random.range(-9, 9), random.range(-9, 9)}, Rotation::from_angle(random.rangef(-3, 3))},
                          .translation = random.vec(6),
                          .turn = i % 2 == 0 ? 0 : random.rangef(-3, 3)};
        const std::optional<CastHit> hit = field.scene.shapecast_closest(shape, way);
        const std::vector<CastHit> all = field.scene.shapecast_all(shape, way);
        EXPECT_EQ(field.scene.shapecast_any(shape, way), hit.has_value());
        ASSERT_EQ(hit.has_value(), !all.empty());
        if (hit)
        {
            EXPECT_EQ(hit->shape, all[0].shape);
            EXPECT_NEAR(hit->fraction, all[0].fraction, 1e-5f);
            EXPECT_NEAR(dot(hit->normal, hit->normal), 1, 1e-4);
            EXPECT_TRUE(std::ranges::is_sorted(all, {}, &CastHit::fraction));
            EXPECT_TRUE(field.scene.closest_point(hit->point, tolerance).has_value());
        }
        overlaps += hit && hit->overlaps ? 1 : 0;
        if (hit && hit->overlaps)
            continue;
        hits += hit ? 1 : 0;
        if (hit)
        {
            EXPECT_TRUE(is_on(shape, pose_at(way, hit->fraction), hit->point));
        }
        const float end = hit ? hit->fraction : 1;
        for (int k = 0; k <= 100; ++k)
            ASSERT_LT(depth_at(field.scene, shape, pose_at(way, 0.01f * static_cast<float>(k) * end)), tolerance) << k;
    }
    EXPECT_GT(hits, 150);
    EXPECT_GT(overlaps, 50);
}

TEST(ShapeCasts, ClosedForms)
{
    for (const double far : {0.0, 1e6})
    {
        Scene scene(weightless());
        const BodyId wall = scene.create_body({.position = {far + 2, 0}});
        scene.create_shape(wall, box(1, 5)); // its face is at 1
        const auto cast = [&](const Geometry& g, CastWay way)
        {
            way.start.position.x += far;
            return scene.shapecast_closest(g, way);
        };
        const auto ball = cast(Circle{.radius = 0.25f}, {.translation = {3, 0}});
        ASSERT_TRUE(ball);
        EXPECT_NEAR(ball->fraction, 0.25f, 1e-6f);
        EXPECT_NEAR(ball->point.x, far + 1, 1e-6);
        EXPECT_NEAR(ball->normal.x, -1, 1e-6f);
        EXPECT_FALSE(ball->overlaps);
        // A corner at a distance of sqrt(1/2) reaches 0.6 to the right after 45 degrees - acos(0.6 sqrt(2)).
        const auto turning = cast(box(0.5f, 0.5f), {.start = {.position = {0.4, 0}}, .turn = 0.25f * pi});
        ASSERT_TRUE(turning);
        EXPECT_NEAR(turning->fraction, (0.25 * 3.14159265 - std::acos(0.6 * std::sqrt(2.0))) / (0.25 * 3.14159265), 1e-5);
        EXPECT_FALSE(cast(Circle{.radius = 0.25f}, {.translation = {0.74f, 0}})) << "stops short";
        const auto inside = cast(Circle{.radius = 0.25f}, {.start = {.position = {0.9, 0}}, .translation = {-3, 0}});
        ASSERT_TRUE(inside) << "though it leaves";
        EXPECT_TRUE(inside->overlaps);
        EXPECT_EQ(inside->fraction, 0);
        EXPECT_NEAR(inside->depth, 0.15f, 1e-5f);
        EXPECT_NEAR(inside->normal.x, -1, 1e-5f);
    }
}

TEST(ShapeCasts, WhatTouchesAndLeavesOrSlidesMeetsNothing)
{
    Scene scene(weightless());
    add_static(scene, HalfSpace{});
    const CastWay way{.start = {.position = {0, 0.5}}, .translation = {3, 0}};
    for (const Geometry& g :
         {Geometry{Circle{.radius = 0.5f}}, Geometry{box(0.5f, 0.5f)}, Geometry{Capsule{{-1, 0}, {1, 0}, 0.5f, 0.5f}}})
    {
        EXPECT_FALSE(scene.shapecast_any(g, way));
        EXPECT_FALSE(scene.shapecast_any(g, {way.start, {0, 2}}));
        const auto down = scene.shapecast_closest(g, {way.start, {0, -2}});
        ASSERT_TRUE(down);
        EXPECT_NEAR(down->fraction, 0, 1e-4f);
        EXPECT_NEAR(down->normal.y, 1, 1e-5f);
    }
}

TEST(ShapeCasts, OfShapesThatAreMetAtOnceTheFirstMadeCounts)
{
    for (const float side : {1.0f, -1.0f})
    {
        Scene scene(weightless());
        const Thing first = add_static(scene, Circle{}, {}, {3, 0.75f * side});
        add_static(scene, Circle{}, {}, {3, -0.75f * side});
        EXPECT_EQ(scene.shapecast_closest(Circle{.radius = 0.5f}, {.translation = {5, 0}})->shape, first.shape);
    }
}

TEST(ShapeCasts, SeamsOfAChainStopNothing)
{
    Scene scene(weightless());
    Chain floor{.start = {-10, 0}};
    for (int i = -9; i <= 10; ++i)
        floor.pieces.push_back({{static_cast<float>(i), 0}});
    add_static(scene, floor);
    for (const Geometry& g : {Geometry{Circle{.radius = 0.5f}}, Geometry{box(0.5f, 0.5f)}})
    {
        EXPECT_FALSE(scene.shapecast_any(g, {{.position = {-8, 0.501}}, {16, 0}}));
        EXPECT_EQ(scene.shapecast_all(g, {{.position = {-8, 2}}, {16, -3}}).size(), 1u) << "a chain is one shape";
    }
}

TEST(ShapeCasts, FiltersLeaveOutABodyOrAsk)
{
    Scene scene(weightless());
    const Thing own = add_dynamic(scene, {0, 0}, Circle{.radius = 0.5f});
    const Thing near = add_static(scene, Circle{.radius = 0.5f}, {}, {2, 0});
    const Thing far = add_static(scene, Circle{.radius = 0.5f}, {}, {4, 0});
    const CastWay way{.start = {.position = {0, 0}}, .translation = {5, 0}};
    const Geometry ball = Circle{.radius = 0.5f};
    EXPECT_EQ(scene.shapecast_closest(ball, way)->shape, own.shape);
    EXPECT_EQ(scene.shapecast_closest(ball, way, {.without = own.body})->shape, near.shape);
    const QueryFilter asks{.without = own.body, .accepts = [&](ShapeId shape) { return shape != near.shape; }};
    EXPECT_EQ(scene.shapecast_closest(ball, way, asks)->shape, far.shape);
    EXPECT_EQ(scene.shapecast_all(ball, way, asks).size(), 1u);
    EXPECT_EQ(scene.raycast_all({0, 0}, {5, 0}, asks).size(), 1u);
    EXPECT_EQ(scene.overlap_point({0, 0}, {.without = own.body}).size(), 0u);
    EXPECT_EQ(scene.closest_point({0, 0}, 9, asks)->shape, far.shape);
    scene.destroy(own.body);
    EXPECT_EQ(scene.shapecast_closest(ball, way, {.without = own.body})->shape, near.shape)
        << "one that is gone leaves out nothing";
}
