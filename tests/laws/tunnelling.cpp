// Row 16: no ball crosses a wall, a flipper or a kinematic body at any speed up to 1,000 m/s, at steps of 1/60 too.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

constexpr float speeds[] = {5, 20, 100, 300, 1000};
constexpr float radii[] = {0.0135f, 0.1f, 0.5f};

// Shoots balls from many places and at many angles at the wall along y = 0; none may get to its other side. A domed wall is the top of a
// circle of that radius.
template <class Build>
void expect_stopped(Build&& build, bool from_below = false, double reach = 2, double dome = 1e12)
{
    Random random(77);
    for (const float v : speeds)
        for (const float radius : radii)
            for (const float e : {0.0f, 0.8f})
                for (int i = 0; i < 6; ++i)
                {
                    Scene scene(weightless());
                    build(scene, e);
                    const double side = from_below ? -1 : 1;
                    const double height = side * random.range(0.8, 3);
                    const double aim = random.range(-reach, reach);
                    const double from = aim + random.range(-0.7, 0.7) * std::fabs(height);
                    const double far = std::hypot(aim - from, height);
                    const Vec2 velocity{static_cast<float>((aim - from) / far) * v, static_cast<float>(-height / far) * v};
                    const BodyId ball = add_dynamic(scene, {from, height}, Circle{.radius = radius}, {.restitution = e}, velocity,
                                                    random.rangef(-50, 50))
                                            .body;
                    const double path = far - static_cast<double>(radius);
                    double t = 0;
                    bool hit = false;
                    while (t * static_cast<double>(v) < 2 * path + 1)
                    {
                        scene.step(1.0f / 60);
                        t += 1.0 / 60;
                        hit = hit || !scene.impacts().empty();
                        const Position p = scene.body(ball).position();
                        if (std::fabs(p.x) > 4)
                            break;
                        const double above = dome < 1e9 ? std::hypot(p.x, p.y + dome) - dome : p.y;
                        ASSERT_GT(side * above, 0)
                            << "speed " << v << " radius " << radius << " e " << e << " case " << i << " at t " << t;
                    }
                    ASSERT_TRUE(hit) << "speed " << v << " radius " << radius << " e " << e << " case " << i;
                }
}

} // namespace

TEST(Row16_NoTunnelling, Segment)
{
    for (const bool below : {false, true})
        expect_stopped([](Scene& s, float e) { add_static(s, Segment{{-5, 0}, {5, 0}}, {.restitution = e}); }, below);
}

TEST(Row16_NoTunnelling, ThinBox)
{
    expect_stopped([](Scene& s, float e) { add_static(s, box(5, 0.001f), {.restitution = e}); });
}

TEST(Row16_NoTunnelling, ThinCapsule)
{
    expect_stopped([](Scene& s, float e) { add_static(s, Capsule{{-5, 0}, {5, 0}, 0.002f, 0.001f}, {.restitution = e}); });
}

TEST(Row16_NoTunnelling, HalfSpace)
{
    expect_stopped([](Scene& s, float e) { add_static(s, HalfSpace{}, {.restitution = e}); });
}

TEST(Row16_NoTunnelling, ArcFromEitherSide)
{
    for (const bool below : {false, true})
        expect_stopped(
            [](Scene& s, float e)
            {
                add_static(s, Arc{.center = {0, -100}, .radius = 100, .start_angle = 0.25f * pi, .sweep = 0.5f * pi},
                           {.restitution = e});
            },
            below, 1, 100);
}

TEST(Row16_NoTunnelling, ChainAtItsSeams)
{
    Chain chain{.start = {-5, 0}};
    for (int i = -19; i <= 20; ++i)
        chain.pieces.push_back({.end = {0.25f * static_cast<float>(i), 0}});
    for (const bool below : {false, true})
        expect_stopped([&](Scene& s, float e) { add_static(s, chain, {.restitution = e}); }, below);
    // Straight at a seam.
    for (const float v : speeds)
        for (const float radius : radii)
        {
            Scene scene(weightless());
            add_static(scene, chain);
            const BodyId ball = add_dynamic(scene, {0.25, 1}, Circle{.radius = radius}, {}, {0, -v}).body;
            for (int i = 0; i < 40; ++i)
                scene.step(1.0f / 60);
            EXPECT_GT(scene.body(ball).position().y, 0) << v << " " << radius;
        }
}

TEST(Row16_NoTunnelling, OneSidedChainHoldsItsSide)
{
    Chain chain{.start = {-5, 0}, .sides = Sides::Left};
    for (int i = -19; i <= 20; ++i)
        chain.pieces.push_back({.end = {0.25f * static_cast<float>(i), 0}});
    expect_stopped([&](Scene& s, float e) { add_static(s, chain, {.restitution = e}); });
}

TEST(Row16_NoTunnelling, InsideAClosedArcForALongTime)
{
    for (const float v : {5.0f, 100.0f, 1000.0f})
        for (const float radius : {0.0135f, 0.2f})
        {
            Scene scene(weightless());
            add_static(scene, Arc{.radius = 1, .sweep = 2 * pi}, {.friction = 0, .restitution = 1});
            const BodyId ball =
                add_dynamic(scene, {0.1, 0.2}, Circle{.radius = radius}, {.friction = 0, .restitution = 1}, {0.6f * v, 0.8f * v})
                    .body;
            for (int i = 0; i < 300; ++i)
            {
                scene.step(1.0f / 240);
                const Position p = scene.body(ball).position();
                ASSERT_LT(std::hypot(p.x, p.y), 1.001 - static_cast<double>(radius))
                    << "speed " << v << " radius " << radius << " step " << i;
            }
            EXPECT_NEAR(speed(scene, ball), v, 1e-3 * static_cast<double>(v)) << "elastic: nothing is lost";
        }
}

TEST(Row16_NoTunnelling, RotatingKinematicBar)
{
    // A bar that turns fast about its middle sweeps a resting ball: the ball must never be on the other side of it.
    for (const float w : {5.0f, 50.0f, 200.0f})
        for (const float distance : {0.3f, 0.9f})
            for (const float radius : {0.02f, 0.1f})
            {
                Scene scene(weightless());
                const BodyId bar = add(scene, {.type = BodyType::Kinematic, .angular_velocity = w}, box(1, 0.005f),
                                       {.friction = 0, .restitution = 0.5f})
                                       .body;
                const BodyId ball = add_dynamic(scene, {static_cast<double>(distance), 0.2}, Circle{.radius = radius},
                                                {.friction = 0, .restitution = 0.5f})
                                        .body;
                bool hit = false;
                for (int i = 0; i < 60 && !hit; ++i)
                {
                    scene.step(1.0f / 60);
                    hit = !scene.impacts().empty();
                }
                ASSERT_TRUE(hit) << "w " << w << " distance " << distance << " radius " << radius;
                // Struck from below: it flies up and away, at least as fast as the bar's surface.
                const Vec2 v = scene.body(ball).velocity();
                EXPECT_GT(speed(scene, ball), 0.9 * static_cast<double>(w * distance))
                    << "w " << w << " distance " << distance << " radius " << radius;
                EXPECT_GT(v.y, 0);
                static_cast<void>(bar);
            }
}

TEST(Row16_NoTunnelling, BallAgainstAMovingKinematicBar)
{
    for (const float v : speeds)
    {
        Scene scene(weightless());
        const BodyId bar = add(scene, {.type = BodyType::Kinematic, .position = {0, -3}, .velocity = {0, 30}}, box(2, 0.01f),
                               {.restitution = 0.5f})
                               .body;
        const BodyId ball = add_dynamic(scene, {0.3, 3}, Circle{.radius = 0.05f}, {.restitution = 0.5f}, {0, -v}).body;
        for (int i = 0; i < 30; ++i)
        {
            scene.step(1.0f / 60);
            ASSERT_GT(scene.body(ball).position().y, scene.body(bar).position().y) << "speed " << v << " step " << i;
        }
    }
}

// A dynamic, pivoted flipper that swings at up to 150 rad/s against a ball that comes fast.
TEST(Row16_NoTunnelling, SwingingFlipper)
{
    Random random(8);
    int hits = 0;
    for (int i = 0; i < 200; ++i)
    {
        SceneDef def = weightless();
        def.length_scale = 0.02f;
        Scene scene(def);
        const BodyId flipper = scene.create_body({.type = BodyType::Dynamic,
                                                  .angle = -0.5f,
                                                  .angular_velocity = random.rangef(0, 150),
                                                  .locks = {.linear_x = true, .linear_y = true}});
        scene.create_shape(flipper, Capsule{{0, 0}, {0.08f, 0}, 0.012f, 0.006f}, {.restitution = 0.5f});
        scene.body(flipper).set_mass({.mass = 0.1f, .inertia = 2e-4f});
        const double x = random.range(0.02, 0.07);
        const float v = random.rangef(1, 60);
        const double height = random.range(0.03, 0.2); // drawn one by one: compilers differ in the order of arguments
        const float sideways = random.rangef(-0.2, 0.2) * v;
        const BodyId ball =
            add_dynamic(scene, {x, height}, Circle{.radius = 0.0135f}, {.density = 140, .restitution = 0.5f}, {sideways, -v})
                .body;
        bool below = false;
        bool hit = false;
        bool around = false; // went past the tip or the pivot: what swings over it later does not count
        const float h = i % 2 == 0 ? 1e-3f : 1.0f / 240;
        // As long as the flipper has not swung past the upright: after that it may catch the ball from behind.
        for (int k = 0; k < 60 && scene.body(flipper).angle() < 1.2f; ++k)
        {
            scene.step(h);
            const Position p = scene.body(ball).position();
            hit = hit || !scene.impacts().empty();
            const Vec2 local = scene.body(flipper).local_point(p);
            // Inside the flipper's length the ball must stay on its upper side until it has been hit off it.
            around = around || (!hit && (local.x <= 0 || local.x >= 0.08f));
            if (!hit && !around && local.y < 0.0f)
                below = true;
        }
        hits += hit;
        ASSERT_FALSE(below) << "case " << i;
    }
    EXPECT_GT(hits, 100);
}

TEST(Row16_NoTunnelling, BallsHeadOn)
{
    for (const float v : speeds)
        for (const float radius : radii)
            for (const double offset : {0.0, 0.5, 1.5})
            {
                Scene scene(weightless());
                const double off = offset * static_cast<double>(radius);
                const BodyId a =
                    add_dynamic(scene, {-3, 0}, Circle{.radius = radius}, {.friction = 0, .restitution = 1}, {v, 0}).body;
                const BodyId b =
                    add_dynamic(scene, {3, off}, Circle{.radius = radius}, {.friction = 0, .restitution = 1}, {-v, 0}).body;
                int impacts = 0;
                for (int i = 0; i < 100 && impacts == 0; ++i)
                {
                    scene.step(1.0f / 60);
                    impacts += static_cast<int>(scene.impacts().size());
                }
                ASSERT_EQ(impacts, 1) << "speed " << v << " radius " << radius << " offset " << offset;
                // n from the geometry: sin = off / 2r; equal elastic balls exchange the normal parts.
                const double sine = off / (2 * static_cast<double>(radius));
                const double cosine = std::sqrt(1 - sine * sine);
                EXPECT_NEAR(scene.body(a).velocity().x, static_cast<double>(v) * (1 - 2 * cosine * cosine),
                            1e-3 * static_cast<double>(v));
                EXPECT_NEAR(scene.body(b).velocity().x, -static_cast<double>(v) * (1 - 2 * cosine * cosine),
                            1e-3 * static_cast<double>(v));
            }
}

TEST(Row16_NoTunnelling, ABallBetweenTwoWallsBouncesManyTimesInAStep)
{
    Scene scene(weightless());
    add_static(scene, Segment{{-1, -5}, {-1, 5}}, {.friction = 0, .restitution = 1});
    add_static(scene, Segment{{1, -5}, {1, 5}}, {.friction = 0, .restitution = 1});
    const BodyId ball = add_dynamic(scene, {0, 0}, Circle{.radius = 0.1f}, {.friction = 0, .restitution = 1}, {1000, 0}).body;
    int impacts = 0;
    for (int i = 0; i < 60; ++i)
    {
        scene.step(1.0f / 60);
        impacts += static_cast<int>(scene.impacts().size());
        ASSERT_LT(std::fabs(scene.body(ball).position().x), 0.901);
        for (std::size_t k = 1; k < scene.impacts().size(); ++k)
            EXPECT_GE(scene.impacts()[k].time, scene.impacts()[k - 1].time);
    }
    EXPECT_NEAR(impacts, 1000 / 1.8, 2);
    EXPECT_NEAR(std::fabs(scene.body(ball).velocity().x), 1000, 0.5);
}
