// Queries against brute force over single shapes, and filters.

#include "support/test_scene.h"

#include <algorithm>

using namespace carom;
using namespace carom::test;

namespace {

struct Zoo
{
    Scene scene{weightless()};
    std::vector<Thing> things;

    explicit Zoo(std::uint64_t seed, int count = 80)
    {
        Random random(seed);
        for (int i = 0; i < count; ++i)
        {
            const Position p{random.range(-8, 8), random.range(-8, 8)};
            Geometry g;
            switch (i % 6)
            {
            case 0: g = Circle{.radius = random.rangef(0.05, 1)}; break;
            case 1: g = box(random.rangef(0.1, 1), random.rangef(0.1, 1), {}, 0, random.chance(0.5) ? 0 : 0.1f); break;
            case 2: g = Capsule{{-0.4f, 0}, {0.5f, 0.1f}, 0.3f, 0.1f}; break;
            case 3: g = Segment{{-0.5f, 0}, {0.5f, 0.3f}, random.chance(0.5) ? 0 : 0.05f}; break;
            case 4: g = Arc{.radius = 0.8f, .start_angle = random.rangef(-3, 3), .sweep = 2, .half_thickness = 0.05f}; break;
            default:
                g = Chain{.start = {-1, 0}, .pieces = {{.end = {0, 0.2f}}, {.end = {1, 0}, .sweep = 1}}, .half_thickness = 0.02f};
                break;
            }
            const ShapeDef def{.filter = {.category = 1u << (i % 4)}, .trigger = i % 11 == 0};
            things.push_back(add(scene,
                                 {.type = i % 6 < 4 && i % 2 == 0 ? BodyType::Dynamic : BodyType::Static,
                                  .position = p,
                                  .angle = random.rangef(-3, 3)},
                                 g, def));
        }
    }
};

} // namespace

TEST(SceneQueries, RaysAgreeWithMarching)
{
    Zoo zoo(1);
    Random random(2);
    int hits = 0;
    for (int i = 0; i < 400; ++i)
    {
        SCOPED_TRACE(i);
        const Position from{random.range(-9, 9), random.range(-9, 9)};
        const Vec2 way = random.vec(8);
        const std::optional<RayHit> hit = zoo.scene.raycast_closest(from, way);
        const std::vector<RayHit> all = zoo.scene.raycast_all(from, way);
        EXPECT_EQ(zoo.scene.raycast_any(from, way), hit.has_value());
        ASSERT_EQ(hit.has_value(), !all.empty());
        if (!hit)
            continue;
        ++hits;
        EXPECT_EQ(hit->fraction, all[0].fraction);
        for (std::size_t k = 1; k < all.size(); ++k)
            EXPECT_LE(all[k - 1].fraction, all[k].fraction);
        for (const RayHit& h : all)
        {
            ASSERT_GE(h.fraction, 0);
            ASSERT_LE(h.fraction, 1);
            const Position p = from + h.fraction * way;
            EXPECT_NEAR(p.x, h.point.x, 1e-4);
            EXPECT_NEAR(p.y, h.point.y, 1e-4);
            if (h.fraction > 0)
            {
                EXPECT_NEAR(dot(h.normal, h.normal), 1, 1e-4);
                EXPECT_LE(dot(h.normal, way), 1e-4f) << "against the ray";
                // The point is on the shape's surface by the closest-point query too.
                const auto near = zoo.scene.closest_point(h.point, 1e-3f);
                ASSERT_TRUE(near.has_value());
            }
            else
            {
                EXPECT_EQ(h.normal, (Vec2{}));
                EXPECT_TRUE(zoo.scene.shape(h.shape).contains(from));
            }
        }
        // March: nothing solid before the first hit, along the ray.
        for (int k = 1; k < 200; ++k)
        {
            const float f = static_cast<float>(k) / 200 * hit->fraction * 0.999f;
            for (const ShapeId id : zoo.scene.overlap_point(from + f * way))
                EXPECT_LT(zoo.scene.closest_point(from + f * way, 1)->distance, 1e-3f) << id.slot;
        }
    }
    EXPECT_GT(hits, 100);
}

TEST(SceneQueries, ARayThatStopsShortHitsNothing)
{
    Scene scene(weightless());
    add_static(scene, Circle{.center = {5, 0}, .radius = 1});
    EXPECT_FALSE(scene.raycast_closest({0, 0}, {3.99f, 0}).has_value());
    const auto hit = scene.raycast_closest({0, 0}, {4.01f, 0});
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->point.x, 4, 1e-5);
    EXPECT_NEAR(hit->normal.x, -1, 1e-6);
    EXPECT_FALSE(scene.raycast_closest({0, 0}, {0, 0}).has_value()) << "a point outside meets nothing";
}

TEST(SceneQueries, OverlapPointAgreesWithContains)
{
    Zoo zoo(3);
    Random random(4);
    int found = 0;
    for (int i = 0; i < 2000; ++i)
    {
        const Position p{random.range(-9, 9), random.range(-9, 9)};
        std::vector<ShapeId> got = zoo.scene.overlap_point(p, {.include_triggers = true});
        std::vector<ShapeId> want;
        for (const Thing& t : zoo.things)
            if (zoo.scene.shape(t.shape).contains(p))
                want.push_back(t.shape);
        std::sort(got.begin(), got.end());
        std::sort(want.begin(), want.end());
        ASSERT_EQ(got, want);
        found += !got.empty();
    }
    EXPECT_GT(found, 200);
}

TEST(SceneQueries, ClosestPointIsTheNearestOfAll)
{
    Zoo zoo(5);
    Random random(6);
    for (int i = 0; i < 400; ++i)
    {
        SCOPED_TRACE(i);
        const Position p{random.range(-9, 9), random.range(-9, 9)};
        const auto near = zoo.scene.closest_point(p, 2);
        if (!near)
            continue;
        if (near->distance > 0)
        {
            EXPECT_NEAR(std::hypot(near->point.x - p.x, near->point.y - p.y), near->distance, 1e-4);
            // No circle a little smaller than the distance meets anything.
            if (near->distance > 0.02f)
            {
                EXPECT_TRUE(zoo.scene.overlap_shape(Circle{.radius = near->distance - 0.01f}, {p, {}}).empty());
            }
            const auto with = zoo.scene.overlap_shape(Circle{.radius = near->distance + 0.01f}, {p, {}});
            EXPECT_NE(std::find(with.begin(), with.end(), near->shape), with.end());
        }
        else
        {
            EXPECT_TRUE(zoo.scene.shape(near->shape).contains(p));
        }
    }
    EXPECT_FALSE(zoo.scene.closest_point({500, 500}, 2).has_value());
}

TEST(SceneQueries, OverlapBoxMeansTheShapesNotTheirBounds)
{
    Scene scene(weightless());
    const Thing ball = add_dynamic(scene, {0, 0}, Circle{.radius = 1});
    EXPECT_TRUE(scene.overlap_box({{0.8, 0.8}, {1.2, 1.2}}).empty()) << "the corner of its bounds is empty";
    EXPECT_EQ(scene.overlap_box({{0.6, 0.6}, {1.2, 1.2}}), (std::vector{ball.shape}));
    EXPECT_EQ(scene.overlap_box({{-0.1, -0.1}, {0.1, 0.1}}), (std::vector{ball.shape})) << "wholly inside";
    const Thing plane = add_static(scene, HalfSpace{.offset = -5});
    EXPECT_EQ(scene.overlap_box({{-100, -7}, {-99, -4}}), (std::vector{plane.shape}));
}

TEST(SceneQueries, FiltersAndTriggers)
{
    Scene scene(weightless());
    const Thing a = add_static(scene, Circle{}, {.filter = {.category = 1}});
    const Thing b = add_static(scene, Circle{}, {.filter = {.category = 2, .mask = 4}});
    const Thing t = add_static(scene, Circle{}, {.filter = {.category = 1}, .trigger = true});
    EXPECT_EQ(scene.overlap_point({}).size(), 2u);
    EXPECT_EQ(scene.overlap_point({}, {.include_triggers = true}).size(), 3u);
    EXPECT_EQ(scene.overlap_point({}, {.mask = 1}), (std::vector{a.shape}));
    EXPECT_EQ(scene.overlap_point({}, {.mask = 2}), (std::vector{b.shape}));
    EXPECT_EQ(scene.overlap_point({}, {.category = 1}), (std::vector{a.shape})) << "b's mask has only 4";
    EXPECT_EQ(scene.overlap_point({}, {.category = 4, .mask = 2}), (std::vector{b.shape}));
    EXPECT_TRUE(scene.raycast_all({-5, 0}, {10, 0}, {.mask = 8}).empty());
    EXPECT_EQ(scene.raycast_all({-5, 0}, {10, 0}, {.mask = 1, .include_triggers = true}).size(), 2u);
    static_cast<void>(t);
}

TEST(SceneQueries, DisabledBodiesAreNotSeen)
{
    Scene scene(weightless());
    const Thing ball = add_dynamic(scene, {0, 0}, Circle{});
    scene.body(ball.body).set_enabled(false);
    EXPECT_TRUE(scene.overlap_point({}).empty());
    scene.body(ball.body).set_enabled(true);
    EXPECT_EQ(scene.overlap_point({}).size(), 1u);
    scene.body(ball.body).teleport({50, 0}, 0);
    EXPECT_TRUE(scene.overlap_point({}).empty()) << "at once, without a step";
    EXPECT_EQ(scene.overlap_point({50, 0}).size(), 1u);
}
