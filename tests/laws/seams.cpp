// A ball rolled along an arc, and over every seam of a chain, reports no impact and loses less than 1e-5 of its energy.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

constexpr float r = 0.1f;
constexpr float half_pi = 0.5f * pi;

// A stadium, closed: straight, half circle, straight, half circle. Rolled inside.
Chain stadium(Sides sides, float thickness)
{
    return {.start = {-2, -1},
            .pieces = {{.end = {2, -1}}, {.end = {2, 1}, .sweep = pi}, {.end = {-2, 1}}, {.end = {-2, -1}, .sweep = pi}},
            .closed = true,
            .half_thickness = thickness,
            .sides = sides};
}

// Straight pieces in line, then a dip made of arcs that bend both ways, all tangential: a skate park. Rolled on top.
Chain park(float thickness)
{
    // Four quarter-ish arcs of 0.4 rad: down, up, up, down, so that the end is level again.
    const float a = 0.4f;
    const auto s = static_cast<float>(std::sin(0.4));
    const auto c = static_cast<float>(1 - std::cos(0.4));
    const float big = 2;
    Chain chain{.start = {-3, 0}, .half_thickness = thickness};
    chain.pieces = {{.end = {-2, 0}},
                    {.end = {-1, 0}},
                    {.end = {-1 + big * s, -big * c}, .sweep = -a},
                    {.end = {-1 + 2 * big * s, -2 * big * c}, .sweep = a},
                    {.end = {-1 + 3 * big * s, -2 * big * c + big * c}, .sweep = a},
                    {.end = {-1 + 4 * big * s, 0}, .sweep = -a},
                    {.end = {4, 0}},
                    {.end = {6, 0}}};
    return chain;
}

struct Ride
{
    int impacts = 0;
    double loss = 0; // share of the kinetic energy at the start
    double off = 0;  // how far the ball came off its start height at most
};

Ride ride(const Chain& chain, Position start, Vec2 velocity, float spin, SceneDef def, float h, double seconds, float friction)
{
    def.sleeping = false;
    Scene scene(def);
    add_static(scene, chain, {.friction = friction, .restitution = 0.5f});
    const BodyId ball =
        add_dynamic(scene, start, Circle{.radius = r}, {.friction = friction, .restitution = 0.5f}, velocity, spin).body;
    const double before = energy(scene, ball);
    const double moving = kinetic(scene, ball);
    Ride result;
    for (int i = 0; i * static_cast<double>(h) < seconds; ++i)
    {
        scene.step(h);
        result.impacts += static_cast<int>(scene.impacts().size());
    }
    result.loss = (before - energy(scene, ball)) / moving;
    const Position p = scene.body(ball).position();
    result.off = p.y;
    return result;
}

// At most 1e-5 of the energy is lost at each seam, and twice that may come out of rounding.
void expect_clean(const Ride& ride, int seams)
{
    EXPECT_EQ(ride.impacts, 0);
    EXPECT_LT(ride.loss, 1e-5 * seams);
    EXPECT_GT(ride.loss, -2e-5 * seams);
}

SceneDef with_gravity(bool on)
{
    SceneDef def;
    if (!on)
        def.gravity = {};
    return def;
}

} // namespace

TEST(LawSeams, InsideAStadiumWithoutGravity)
{
    for (const float h : {1.0f / 60, 1.0f / 1000})
        for (const float friction : {0.0f})
            for (const Sides sides : {Sides::Both, Sides::Left})
            {
                SCOPED_TRACE("h " + std::to_string(h) + " friction " + std::to_string(friction) + " sides " +
                             std::to_string(static_cast<int>(sides)));
                // 14.3 m around: seven seams in 27 m.
                expect_clean(ride(stadium(sides, 0), {-1, -1 + static_cast<double>(r)}, {3, 0}, friction > 0 ? -30.0f : 0.0f,
                                  with_gravity(false), h, 9, friction),
                             7);
            }
}

TEST(LawSeams, InsideAFullCircle)
{
    for (const float h : {1.0f / 60, 1.0f / 1000})
        for (const bool falls : {false, true})
        {
            SCOPED_TRACE("h " + std::to_string(h) + " gravity " + std::to_string(falls));
            SceneDef def = with_gravity(falls);
            def.sleeping = false;
            Scene scene(def);
            add_static(scene, Arc{.radius = 1, .start_angle = -half_pi, .sweep = 2 * pi},
                       {.friction = 0.6f, .restitution = 0.5f});
            const float v = falls ? 9.0f : 3.0f; // enough to pass the top
            const BodyId ball =
                add_dynamic(scene, {0, -1 + static_cast<double>(r)}, Circle{.radius = r}, {.restitution = 0.5f}, {v, 0}, -v / r)
                    .body;
            const double before = energy(scene, ball);
            const double moving = kinetic(scene, ball);
            int impacts = 0;
            for (int i = 0; i * static_cast<double>(h) < 5; ++i)
            {
                scene.step(h);
                impacts += static_cast<int>(scene.impacts().size());
            }
            EXPECT_EQ(impacts, 0);
            if (!falls)
            {
                EXPECT_LT(std::fabs(before - energy(scene, ball)) / moving, 1e-5 * 2.7) << "2.7 times around";
            }
            EXPECT_NEAR(std::hypot(scene.body(ball).position().x, scene.body(ball).position().y), 0.9, 1e-3);
        }
}

TEST(LawSeams, OverAParkWithGravity)
{
    for (const float h : {1.0f / 60, 1.0f / 1000})
        for (const float thickness : {0.0f, 0.05f})
            for (const float friction : {0.0f, 0.6f})
            {
                SCOPED_TRACE("h " + std::to_string(h) + " thickness " + std::to_string(thickness) + " friction " +
                             std::to_string(friction));
                // Slow enough not to fly off the crests: v² < g (2 + r).
                const float v = 2.5f;
                expect_clean(ride(park(thickness), {-2.8, static_cast<double>(thickness + r)}, {v, 0}, friction > 0 ? -v / r : 0,
                                  with_gravity(true), h, 2.4, friction),
                             6);
            }
}

TEST(LawSeams, OverStraightSeamsWithAndWithoutGravity)
{
    for (const float h : {1.0f / 60, 1.0f / 1000})
        for (const bool falls : {false, true})
        {
            SCOPED_TRACE("h " + std::to_string(h) + " gravity " + std::to_string(falls));
            Chain chain{.start = {-5, 0}};
            for (int i = -4; i <= 5; ++i)
                chain.pieces.push_back({.end = {static_cast<float>(i), 0}});
            const Ride straight = ride(chain, {-4.5, static_cast<double>(r)}, {4, 0}, -40, with_gravity(falls), h, 2.2, 0.6f);
            expect_clean(straight, 8);
            EXPECT_NEAR(straight.off, static_cast<double>(r), 2e-3);
        }
}

TEST(LawSeams, BoxesAndCapsulesSlideOverSeams)
{
    Chain chain{.start = {-5, 0}};
    for (int i = -4; i <= 5; ++i)
        chain.pieces.push_back({.end = {static_cast<float>(i), 0}});
    for (const Geometry& geometry : {Geometry{box(0.2f, 0.2f)}, Geometry{Capsule{{-0.2f, 0}, {0.2f, 0}, 0.2f, 0.2f}}})
        for (const float h : {1.0f / 60, 1.0f / 1000})
        {
            SCOPED_TRACE("h " + std::to_string(h) + " shape " + std::to_string(geometry.index()));
            Scene scene(sleepless());
            add_static(scene, chain, {.friction = 0});
            const BodyId body = add_dynamic(scene, {-4.5, 0.2}, geometry, {.friction = 0}, {4, 0}).body;
            int impacts = 0;
            for (int i = 0; i * static_cast<double>(h) < 2; ++i)
            {
                scene.step(h);
                impacts += static_cast<int>(scene.impacts().size());
            }
            EXPECT_EQ(impacts, 0);
            EXPECT_NEAR(scene.body(body).velocity().x, 4, 4e-3);
            EXPECT_NEAR(scene.body(body).angle(), 0, 0.01);
        }
}

// A seam that does turn a corner is an impact like any other.
TEST(LawSeams, AConvexCornerIsLeftAndAConcaveOneIsHit)
{
    Scene scene(weightless());
    add_static(scene, Chain{.start = {-3, 0}, .pieces = {{.end = {0, 0}}, {.end = {1, 1}}}}, {.friction = 0, .restitution = 1});
    const BodyId ball =
        add_dynamic(scene, {-2, static_cast<double>(r)}, Circle{.radius = r}, {.friction = 0, .restitution = 1}, {3, 0}).body;
    int impacts = 0;
    for (int i = 0; i < 60; ++i)
    {
        scene.step(1.0f / 60);
        impacts += static_cast<int>(scene.impacts().size());
    }
    EXPECT_EQ(impacts, 1);
    EXPECT_NEAR(scene.body(ball).velocity().y, 3, 0.01) << "a slope of 45 degrees turns it upwards";
    EXPECT_NEAR(scene.body(ball).velocity().x, 0, 0.01);
}

TEST(LawSeams, RollingInsideAStadiumWithoutGravity)
{
    for (const float h : {1.0f / 60, 1.0f / 1000})
        for (const Sides sides : {Sides::Both, Sides::Left})
        {
            SCOPED_TRACE("h " + std::to_string(h) + " sides " + std::to_string(static_cast<int>(sides)));
            expect_clean(
                ride(stadium(sides, 0), {-1, -1 + static_cast<double>(r)}, {3, 0}, -30.0f, with_gravity(false), h, 9, 0.6f), 7);
        }
}

TEST(LawSeams, RollingInsideAThickStadium)
{
    for (const float h : {1.0f / 60, 1.0f / 1000})
        expect_clean(ride(stadium(Sides::Both, 0.05f), {-1, -1 + 0.05 + static_cast<double>(r)}, {3, 0}, -30, with_gravity(false),
                          h, 9, 0.6f),
                     7);
}
