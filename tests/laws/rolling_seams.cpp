// With friction: a ball rolled over every seam of a chain, reports no impact and loses less than 1e-5 of its energy.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

constexpr float r = 0.1f;

// A stadium, closed: straight, half circle, straight, half circle. Rolled inside.
Chain stadium(Sides sides, float thickness)
{
    return {.start = {-2, -1},
            .pieces = {{.end = {2, -1}}, {.end = {2, 1}, .sweep = pi}, {.end = {-2, 1}}, {.end = {-2, -1}, .sweep = pi}},
            .closed = true,
            .half_thickness = thickness,
            .sides = sides};
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

// At most 1e-5 of the energy is lost at each seam.
void expect_clean(const Ride& ride, int seams)
{
    EXPECT_EQ(ride.impacts, 0);
    EXPECT_LT(ride.loss, 1e-5 * seams);
}

SceneDef with_gravity(bool on)
{
    SceneDef def;
    if (!on)
        def.gravity = {};
    return def;
}

} // namespace

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
