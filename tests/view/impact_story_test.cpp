#include "view/impact_story.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::view {
namespace {

TEST(Number, ThreeDigitsAndARealMinus)
{
    EXPECT_EQ(number(0), "0");
    EXPECT_EQ(number(0.03372f), "0.0337");
    EXPECT_EQ(number(-1.5f), "−1.50");
    EXPECT_EQ(number(12.345f), "12.3");
    EXPECT_EQ(number(9.999f), "10.0");
    EXPECT_EQ(number(1234.5f), "1234");
    EXPECT_EQ(number(3.2e-6f), "3.20·10⁻⁶");
    EXPECT_EQ(number(INFINITY), "∞");
}

// A ball of 2 kg hits the end of a free rod of 1 kg, 1 m long (I = 1/12), half a metre beside its centre.
ImpactRecord ball_on_rod()
{
    const float rod = 1 / (1.0f + 0.25f * 12);
    ImpactRecord record;
    record.event = {
        .approach_speed = 3, .speed_a = 2, .speed_b = -1, .effective_mass_a = 2, .effective_mass_b = rod, .restitution = 0.5f};
    record.event.impulse = 1.5f * (2 * rod / (2 + rod)) * 3;
    record.event.normal = {1, 0};
    record.event.velocity_after_a = {2 - record.event.impulse / 2, 0};
    record.event.velocity_after_b = {-1 + record.event.impulse / rod, 0};
    record.a = {.name = "ball", .type = BodyType::Dynamic, .mass = 2, .inertia = 0.4f};
    record.b = {.name = "rod", .type = BodyType::Dynamic, .mass = 1, .inertia = 1.0f / 12};
    return record;
}

bool says(const ImpactRecord& record, const std::string& text)
{
    for (const StoryLine& line : impact_story(record))
        if (line.text.find(text) != std::string::npos)
            return true;
    return false;
}

TEST(ImpactStory, LeverArmComesBackFromTheEffectiveMass)
{
    const ImpactRecord record = ball_on_rod();
    EXPECT_EQ(lever_arm(record.a, record.event.effective_mass_a), 0);
    EXPECT_NEAR(lever_arm(record.b, record.event.effective_mass_b), 0.5f, 1e-5f);
}

TEST(ImpactStory, ShowsTheFormulaWithItsValuesAndAgreesWithTheEngine)
{
    const ImpactRecord record = ball_on_rod();
    EXPECT_FLOAT_EQ(impulse_by_formula(record), record.event.impulse);
    EXPECT_TRUE(says(record, "ball (1) hits rod (2)"));
    EXPECT_TRUE(says(record, "j = (1+e)·m₁·m₂/(m₁+m₂)·(v₁−v₂)"));
    EXPECT_TRUE(says(record, "m₂ = 1 / (1/1.00 + 0.500²/0.0833) = 0.250 kg"));
    EXPECT_TRUE(says(record, "v₁ − v₂ = 2.00 − (−1.00) = 3.00 m/s"));
    EXPECT_TRUE(says(record, "j = (1+0.500)·2.00·0.250/(2.00+0.250)·3.00 = 1.00 N·s"));
    EXPECT_TRUE(says(record, "The engine gave 1.00 N·s: the same"));
}

TEST(ImpactStory, SpeedsAfterwardsFollowFromTheBlow)
{
    EXPECT_TRUE(says(ball_on_rod(), "ball: v₁ − j/m₁ = 2.00 − 1.00/2.00 = 1.50 m/s"));
    EXPECT_TRUE(says(ball_on_rod(), "rod, where it is hit: v₂ + j/m₂ = −1.00 + 1.00/0.250 = 3.00 m/s"));
}

TEST(ImpactStory, WhatOthersDidAtThatMomentIsNotTakenForTheBlow)
{
    ImpactRecord record = ball_on_rod();
    record.event.velocity_after_b = {0.5f, 0};
    EXPECT_TRUE(says(record, "rod, where it is hit: v₂ from −1.00 to 0.500 m/s"));
}

TEST(ImpactStory, AWallIsAnInfiniteMass)
{
    ImpactRecord record = ball_on_rod();
    record.event.effective_mass_b = 0;
    record.event.impulse = 1.5f * 2 * 3;
    record.b = {.name = "wall", .type = BodyType::Static};
    EXPECT_FLOAT_EQ(impulse_by_formula(record), 9);
    EXPECT_TRUE(says(record, "wall is fixed and cannot be pushed: m₂ = ∞"));
    EXPECT_TRUE(says(record, "j = (1+0.500)·2.00·3.00 = 9.00 N·s"));
    EXPECT_FALSE(says(record, "wall: v₂"));
}

TEST(ImpactStory, AFlipperTurnsAboutItsPivot)
{
    ImpactRecord record = ball_on_rod();
    record.b = {.name = "flipper", .type = BodyType::Dynamic, .mass = 0.1f, .inertia = 0.0625f, .held = true};
    EXPECT_NEAR(lever_arm(record.b, 0.25f), 0.5f, 1e-6f);
    EXPECT_TRUE(says(record, "flipper turns about a fixed pivot"));
    EXPECT_TRUE(says(record, "m₂ = 0.0625 / 0.500² = 0.250 kg"));
}

TEST(ImpactStory, TellsOfTheKickAndOfDifferences)
{
    ImpactRecord record = ball_on_rod();
    record.event.kick_speed = 2;
    EXPECT_TRUE(says(record, "plus the kick of 2.00 m/s: 0.444 N·s"));
    EXPECT_TRUE(says(record, "They differ"));
    record.event.impulse = impulse_by_formula(record);
    EXPECT_FALSE(says(record, "They differ"));
}

} // namespace
} // namespace carom::view
