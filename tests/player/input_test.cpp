#include "pinball/player/buttons.h"
#include "pinball/player/keys.h"
#include "pinball/player/name_entry.h"
#include "pinball/player/step_clock.h"

#include <gtest/gtest.h>

namespace carom::pinball {
namespace {

TEST(PlayerInput, APressFallsIntoTheStepOfItsTime)
{
    ButtonTimeline buttons;
    buttons.push(10.4, Button::Left, true);
    buttons.push(13.2, Button::Left, false);
    EXPECT_FALSE(buttons.advance_to(10).left);
    EXPECT_TRUE(buttons.advance_to(11).left);
    EXPECT_TRUE(buttons.advance_to(12).left);
    EXPECT_TRUE(buttons.advance_to(13).left);
    EXPECT_FALSE(buttons.advance_to(14).left);
}

TEST(PlayerInput, ATapShorterThanAStepIsSeenForOneStep)
{
    ButtonTimeline buttons;
    buttons.push(10.2, Button::Right, true);
    buttons.push(10.7, Button::Right, false);
    EXPECT_TRUE(buttons.advance_to(11).right);
    EXPECT_FALSE(buttons.advance_to(12).right);
}

TEST(PlayerInput, TwoKeysShareAButton)
{
    ButtonTimeline buttons;
    buttons.push(1, Button::Left, true, 0);
    buttons.push(2, Button::Left, true, 1);
    buttons.push(3, Button::Left, false, 0);
    EXPECT_TRUE(buttons.advance_to(3).left);
    EXPECT_TRUE(buttons.advance_to(4).left);
    buttons.push(5, Button::Left, false, 1);
    EXPECT_FALSE(buttons.advance_to(6).left);
}

TEST(PlayerInput, LosingTheFocusDropsFlippersAndPlunger)
{
    ButtonTimeline buttons;
    buttons.push(1, Button::Left, true);
    buttons.push(1, Button::Plunger, true);
    EXPECT_EQ(buttons.advance_to(2), (Input{.left = true, .plunger = true}));
    buttons.push(5, Button::Right, true);
    buttons.release_all();
    EXPECT_EQ(buttons.advance_to(9), Input{});
}

SDL_Event key(SDL_Scancode code, bool down, int repeat = 0)
{
    SDL_Event event{};
    event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
    event.key.keysym.scancode = code;
    event.key.repeat = static_cast<Uint8>(repeat);
    return event;
}

TEST(PlayerInput, KeysAreFoundByTheirPlace)
{
    for (const SDL_Scancode code : {SDL_SCANCODE_LSHIFT, SDL_SCANCODE_Z})
        EXPECT_EQ(button_of(key(code, true))->button, Button::Left);
    for (const SDL_Scancode code : {SDL_SCANCODE_RSHIFT, SDL_SCANCODE_SLASH})
        EXPECT_EQ(button_of(key(code, true))->button, Button::Right);
    EXPECT_EQ(button_of(key(SDL_SCANCODE_SPACE, false))->down, false);
    EXPECT_EQ(button_of(key(SDL_SCANCODE_RETURN, true))->button, Button::Start);
    EXPECT_NE(button_of(key(SDL_SCANCODE_LSHIFT, true))->source, button_of(key(SDL_SCANCODE_Z, true))->source);
    EXPECT_FALSE(button_of(key(SDL_SCANCODE_Q, true)));
}

TEST(PlayerInput, AHeldKeyIsPressedOnce)
{
    EXPECT_FALSE(button_of(key(SDL_SCANCODE_Z, true, 1)));
    EXPECT_FALSE(wish_of(key(SDL_SCANCODE_P, true, 1)));
    EXPECT_EQ(wish_of(key(SDL_SCANCODE_N, true, 1)), Wish::SingleStep);
    EXPECT_FALSE(wish_of(key(SDL_SCANCODE_P, false)));
}

TEST(PlayerClock, StepsKeepUpWithTime)
{
    StepClock clock(1);
    clock.skip_to(100);
    int steps = 0;
    for (double now = 116.5; now < 1100; now += 16.5)
    {
        clock.begin_frame(now, 1);
        while (clock.take_step())
            ++steps;
        EXPECT_GE(clock.alpha(), 0);
        EXPECT_LE(clock.alpha(), 1);
    }
    EXPECT_NEAR(steps, 990, 10);
}

TEST(PlayerClock, AFrameThatComesTooLateIsNotCaughtUpWith)
{
    StepClock clock(1);
    clock.begin_frame(5000, 1);
    int steps = 0;
    while (clock.take_step())
        ++steps;
    EXPECT_EQ(steps, 100);
}

TEST(PlayerClock, SlowMotionTakesFewerStepsAndMovesBetweenThem)
{
    StepClock clock(1);
    clock.begin_frame(90, 0.02);
    int steps = 0;
    while (clock.take_step())
        ++steps;
    EXPECT_EQ(steps, 1); // 50 ms of real time each
    EXPECT_NEAR(clock.alpha(), 0.8f, 1e-4f);
}

TEST(PlayerNames, FlippersTurnTheLetterAndStartTakesIt)
{
    NameEntry entry;
    entry.begin(2);
    EXPECT_TRUE(entry.active());
    const auto tap = [&](const Input& input)
    {
        const bool done = entry.step(input);
        (void)entry.step({});
        return done;
    };
    (void)entry.step({});
    EXPECT_FALSE(tap({.right = true}));
    EXPECT_FALSE(tap({.start = true}));
    EXPECT_FALSE(tap({.left = true}));
    EXPECT_FALSE(tap({.plunger = true}));
    EXPECT_TRUE(tap({.start = true}));
    EXPECT_EQ(entry.name(), "BZA");
    EXPECT_FALSE(entry.active());
}

TEST(PlayerNames, WhatWritesTheNameDoesNotPlay)
{
    NameEntry entry;
    entry.begin(0);
    (void)entry.step({.left = true, .start = true});
    EXPECT_EQ(entry.leaves_over({.left = true, .start = true}), Input{});
    for (int i = 0; i < 3; ++i)
    {
        (void)entry.step({});
        (void)entry.step({.start = true});
    }
    EXPECT_FALSE(entry.active());
    // Held since the last letter: it does not start a game.
    EXPECT_EQ(entry.leaves_over({.start = true}), Input{});
    (void)entry.step({});
    EXPECT_EQ(entry.leaves_over({.start = true}), Input{.start = true});
}

} // namespace
} // namespace carom::pinball
