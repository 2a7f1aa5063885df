// Symptom: the impulse of an impact event was absurd where a blow was shared or loaded: it came with the speed of another approach, and neither the speeds
// nor the energy in the event had to do with it.

#include "regressions/numbers.h"
#include "scenes/scenes.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace carom;
using namespace carom::test;

namespace {

double product(Vec2 a, Vec2 b) { return d(a.x) * d(b.x) + d(a.y) * d(b.y); }

double size_of(Vec2 a) { return std::sqrt(product(a, a)); }

// Impulse, energy and velocities of every event agree.
void expect_agreement(const ImpactEvent& e)
{
    const Vec2 impulse = e.impulse * e.normal + e.friction_impulse * perp(e.normal);
    const Vec2 relative = e.velocity_b - e.velocity_a;
    const Vec2 after = e.velocity_after_b - e.velocity_after_a;
    const double scale = size_of(impulse) * (size_of(e.velocity_a) + size_of(e.velocity_b) + size_of(e.velocity_after_a) +
                                             size_of(e.velocity_after_b));
    EXPECT_NEAR(d(e.energy_lost), -0.5 * (product(impulse, relative) + product(impulse, after)), 1e-5 * scale + 1e-9);
    EXPECT_NEAR(d(e.speed_a), product(e.velocity_a, e.normal), 1e-5 * (1 + size_of(e.velocity_a)));
    EXPECT_NEAR(d(e.speed_b), product(e.velocity_b, e.normal), 1e-5 * (1 + size_of(e.velocity_b)));
    EXPECT_NEAR(d(e.approach_speed), d(e.speed_a) - d(e.speed_b), 1e-5 * (1 + size_of(e.velocity_a) + size_of(e.velocity_b)));
    EXPECT_GT(e.approach_speed, 0);
    EXPECT_GE(e.impulse, 0);
}

double by_formula(const ImpactEvent& e)
{
    const double inverse_a = e.effective_mass_a > 0 ? 1 / d(e.effective_mass_a) : 0;
    const double inverse_b = e.effective_mass_b > 0 ? 1 / d(e.effective_mass_b) : 0;
    return ((1 + d(e.restitution)) * d(e.approach_speed) + d(e.kick_speed)) / (inverse_a + inverse_b);
}

} // namespace

TEST(ImpulsesThatMislead, AgreeWithEnergyAndVelocitiesInEveryEvent)
{
    for (const scenes::SceneEntry& entry : scenes::small_scenes())
    {
        SCOPED_TRACE(std::string(entry.name));
        scenes::BuiltScene built = entry.create({});
        for (int i = 0; i < std::min(entry.frames, 300); ++i)
        {
            built.step(entry.h);
            for (const ImpactEvent& e : built.scene.impacts())
                expect_agreement(e);
            ASSERT_FALSE(HasFailure()) << "step " << i;
        }
    }
}

// Whatever lands with one corner, two, or a face; bodies that are alone with each other.
TEST(ImpulsesThatMislead, FollowTheFormulaWhereTwoAreAlone)
{
    for (const float friction : {0.0f, 0.5f})
    {
        for (const float e : {0.0f, 0.3f, 1.0f})
        {
            for (const float angle : {0.0f, 0.2f, 0.785f})
            {
                for (const bool on_body : {false, true})
                {
                    SCOPED_TRACE("friction " + std::to_string(friction) + ", e " + std::to_string(e) + ", turned by " +
                                 std::to_string(angle) + (on_body ? ", on a box" : ", on the floor"));
                    Scene scene(weightless());
                    const ShapeDef def{.friction = friction, .restitution = e};
                    const BodyType type = on_body ? BodyType::Dynamic : BodyType::Static;
                    add(scene, {.type = type, .position = {0, -0.5}}, box(2, 0.5f), def);
                    add(scene, {.type = BodyType::Dynamic, .position = {0.3, 1.2}, .angle = angle, .velocity = {0, -5}},
                        box(0.5f, 0.4f), def);
                    double told = 0;
                    for (int i = 0; i < 30 && told == 0; ++i)
                    {
                        scene.step(dt);
                        for (const ImpactEvent& event : scene.impacts())
                        {
                            expect_agreement(event);
                            if (told++ > 0 || (friction > 0 && (on_body || angle != 0)))
                                continue; // friction on an arm lifts, or presses in
                            EXPECT_NEAR(d(event.impulse) / by_formula(event), 1, 2e-3);
                        }
                    }
                    EXPECT_GT(told, 0);
                }
            }
        }
    }
}

// A row of balls passes a blow on: each has the speeds of its own, and loses nothing.
TEST(ImpulsesThatMislead, ARowOfBallsPassesABlowOn)
{
    for (const float gap : {0.0f, 1e-4f, 0.01f})
    {
        SCOPED_TRACE(gap);
        Scene scene(weightless());
        const ShapeDef elastic{.friction = 0, .restitution = 1};
        for (int i = 0; i < 5; ++i)
            add_dynamic(scene, {i * (1 + d(gap)), 0}, Circle{.radius = 0.5f}, elastic);
        const BodyId first = add_dynamic(scene, {-2, 0}, Circle{.radius = 0.5f}, elastic, {3, 0}).body;
        const double momentum = 3 * d(scene.body(first).mass());
        int told = 0;
        for (int i = 0; i < 60; ++i)
        {
            scene.step(dt);
            for (const ImpactEvent& e : scene.impacts())
            {
                ++told;
                expect_agreement(e);
                EXPECT_NEAR(e.approach_speed, 3, 1e-3);
                EXPECT_NEAR(d(e.impulse) / momentum, 1, 1e-3);
                EXPECT_NEAR(e.energy_lost, 0, 1e-3);
            }
        }
        EXPECT_EQ(told, 5);
    }
}
