#include "pinball/player/buttons.h"
#include "pinball/player/controls.h"
#include "pinball/player/name_entry.h"
#include "pinball/player/step_clock.h"
#include "pinball/table/loader.h"

#include <SDL_keyboard.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

namespace carom::pinball {
namespace {

TEST(PlayerInput, APressFallsIntoTheStepOfItsTime)
{
    ButtonTimeline buttons;
    buttons.push(10.4, Button::Left, true);
    buttons.push(43.2, Button::Left, false);
    EXPECT_FALSE(buttons.advance_to(10).left);
    for (int t = 11; t <= 43; ++t)
        EXPECT_TRUE(buttons.advance_to(t).left) << t;
    EXPECT_FALSE(buttons.advance_to(44).left);
}

// Press and release that come with one frame have one time.
TEST(PlayerInput, ATapShorterThanAFrameLastsAsLongAsAFingerDoes)
{
    ButtonTimeline buttons;
    buttons.push(10, Button::Right, true);
    buttons.push(10, Button::Right, false);
    for (int t = 10; t < 30; ++t)
        EXPECT_TRUE(buttons.advance_to(t).right) << t;
    EXPECT_FALSE(buttons.advance_to(30).right);
}

TEST(PlayerInput, AKeyThatIsHitTwiceIsUpInBetween)
{
    ButtonTimeline buttons;
    buttons.push(10, Button::Left, true);
    buttons.push(11, Button::Left, false);
    buttons.push(18, Button::Left, true);
    EXPECT_TRUE(buttons.advance_to(17).left);
    EXPECT_TRUE(buttons.advance_to(35).left);
    buttons.push(60, Button::Left, false);
    EXPECT_TRUE(buttons.advance_to(59).left);
    EXPECT_FALSE(buttons.advance_to(60).left);
}

// The bat of the table, from a tap within one frame.
TEST(PlayerInput, ATapShorterThanAFrameLiftsTheBat)
{
    LoadResult loaded = load_table_file(CAROM_TABLES_DIR "/momentum.table.json");
    ASSERT_TRUE(loaded.table);
    Game game(std::move(*loaded.table), {.seed = 1});
    ButtonTimeline buttons;
    buttons.push(1, Button::Start, true);
    buttons.push(30, Button::Start, false);
    const double tap = 100;
    buttons.push(tap, Button::Left, true);
    buttons.push(tap, Button::Left, false);
    const auto angles = [&]
    {
        std::vector<float> all;
        for (const BodyId body : game.scene().bodies())
        {
            const MotionLocks locks = game.scene().body(body).locks();
            if (locks.linear_x && locks.linear_y && game.scene().body(body).type() == BodyType::Dynamic)
                all.push_back(game.scene().body(body).angle());
        }
        return all;
    };
    std::vector<float> before;
    float most = 0;
    for (int t = 1; t < 200; ++t)
    {
        game.step(buttons.advance_to(t));
        if (t < tap)
            before = angles();
        const std::vector<float> now = angles();
        for (std::size_t i = 0; i < now.size(); ++i)
            most = std::max(most, std::abs(now[i] - before[i]));
    }
    EXPECT_GT(most, 0.3f);
}

TEST(PlayerInput, TwoKeysShareAButton)
{
    ButtonTimeline buttons;
    buttons.push(1, Button::Left, true, 0);
    buttons.push(2, Button::Left, true, 1);
    buttons.push(33, Button::Left, false, 0);
    EXPECT_TRUE(buttons.advance_to(33).left);
    EXPECT_TRUE(buttons.advance_to(34).left);
    buttons.push(35, Button::Left, false, 1);
    EXPECT_FALSE(buttons.advance_to(36).left);
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

std::optional<ButtonPress> press_of(Controls& controls, const SDL_Event& event)
{
    const std::vector<ButtonPress> presses = controls.buttons_of(event);
    return presses.empty() ? std::nullopt : std::optional(presses.front());
}

TEST(PlayerControls, KeysAreFoundByTheirPlace)
{
    Controls controls;
    for (const SDL_Scancode code : {SDL_SCANCODE_LSHIFT, SDL_SCANCODE_Z})
        EXPECT_EQ(press_of(controls, key(code, true))->button, Button::Left);
    for (const SDL_Scancode code : {SDL_SCANCODE_RSHIFT, SDL_SCANCODE_SLASH})
        EXPECT_EQ(press_of(controls, key(code, true))->button, Button::Right);
    EXPECT_EQ(press_of(controls, key(SDL_SCANCODE_SPACE, false))->down, false);
    EXPECT_EQ(press_of(controls, key(SDL_SCANCODE_RETURN, true))->button, Button::Start);
    EXPECT_NE(press_of(controls, key(SDL_SCANCODE_LSHIFT, true))->source, press_of(controls, key(SDL_SCANCODE_Z, true))->source);
    EXPECT_FALSE(press_of(controls, key(SDL_SCANCODE_Q, true)));
}

TEST(PlayerControls, AHeldKeyIsPressedOnce)
{
    Controls controls;
    EXPECT_FALSE(press_of(controls, key(SDL_SCANCODE_Z, true, 1)));
    EXPECT_FALSE(controls.wish_of(key(SDL_SCANCODE_P, true, 1)));
    EXPECT_EQ(controls.wish_of(key(SDL_SCANCODE_N, true, 1)), Wish::SingleStep);
    EXPECT_FALSE(controls.wish_of(key(SDL_SCANCODE_P, false)));
}

SDL_Event axis(SDL_GameControllerAxis which, float value)
{
    SDL_Event event{};
    event.type = SDL_CONTROLLERAXISMOTION;
    event.caxis.axis = static_cast<Uint8>(which);
    event.caxis.value = static_cast<Sint16>(32767 * value);
    return event;
}

TEST(PlayerControls, TriggersAreFlippersAndDoNotTremble)
{
    Controls controls;
    std::vector<bool> downs;
    for (const float value : {0.1f, 0.5f, 0.7f, 0.55f, 0.65f, 0.3f, 0.5f})
        for (const ButtonPress& press : controls.buttons_of(axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, value)))
        {
            EXPECT_EQ(press.button, Button::Right);
            downs.push_back(press.down);
        }
    EXPECT_EQ(downs, (std::vector<bool>{true, false}));
}

TEST(PlayerControls, AStickNudgesAndHoldsTheRod)
{
    Controls controls;
    EXPECT_EQ(press_of(controls, axis(SDL_CONTROLLER_AXIS_LEFTX, 0.9f))->button, Button::NudgeLeft);
    const auto turned = controls.buttons_of(axis(SDL_CONTROLLER_AXIS_LEFTX, -0.9f));
    ASSERT_EQ(turned.size(), 2u) << "one is let go, the other pushed";
    EXPECT_EQ(press_of(controls, axis(SDL_CONTROLLER_AXIS_LEFTY, -0.9f))->button, Button::NudgeUp);
    EXPECT_EQ(Controls::rod_of(axis(SDL_CONTROLLER_AXIS_LEFTY, 1)), 255);
    EXPECT_EQ(Controls::rod_of(axis(SDL_CONTROLLER_AXIS_LEFTY, 0.1f)), 0);
    EXPECT_FALSE(Controls::rod_of(axis(SDL_CONTROLLER_AXIS_LEFTX, 1)));
    ButtonTimeline buttons;
    buttons.hold_rod(5, 200);
    EXPECT_EQ(buttons.advance_to(4).rod, 0);
    EXPECT_EQ(buttons.advance_to(6).rod, 200);
    buttons.release_all();
    EXPECT_EQ(buttons.advance_to(7).rod, 0);
}

std::size_t action_named(std::string_view id)
{
    for (std::size_t i = 0; i < Controls::actions().size(); ++i)
        if (Controls::actions()[i].id == id)
            return i;
    ADD_FAILURE() << id;
    return 0;
}

TEST(PlayerControls, AKeyDoesWhatItIsBoundToAndNothingElse)
{
    Controls controls;
    controls.bind(action_named("left"), {Control::Kind::Key, SDL_SCANCODE_P});
    EXPECT_EQ(press_of(controls, key(SDL_SCANCODE_P, true))->button, Button::Left);
    EXPECT_FALSE(controls.wish_of(key(SDL_SCANCODE_P, true)));
    EXPECT_LE(controls.controls_of(action_named("left")).size(), 4u);
    EXPECT_EQ(controls.label(Wish::Pause).substr(0, 3), "pad") << "its gamepad button is left";
}

TEST(PlayerControls, AreKeptInAFile)
{
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "carom_controls_test.json";
    Controls controls;
    controls.bind(action_named("plunger"), {Control::Kind::Key, SDL_SCANCODE_B});
    controls.bind(action_named("pause"), {Control::Kind::Pad, SDL_CONTROLLER_BUTTON_Y});
    EXPECT_EQ(controls.save(file), "");
    Controls read;
    EXPECT_EQ(read.load(file), "");
    EXPECT_EQ(press_of(read, key(SDL_SCANCODE_B, true))->button, Button::Plunger);
    EXPECT_EQ(read.key_lines().size(), controls.key_lines().size());
    std::string many = "{\"left\": [";
    for (int code = SDL_SCANCODE_A; code < SDL_SCANCODE_A + 40; ++code)
        many += (code == SDL_SCANCODE_A ? "\"key " : ", \"key ") +
                std::string(SDL_GetScancodeName(static_cast<SDL_Scancode>(code))) + '"';
    std::ofstream(file) << many + "], \"pause\": [\"key Space\"]}";
    Controls crowded;
    EXPECT_EQ(crowded.load(file), "");
    EXPECT_LE(crowded.controls_of(action_named("left")).size(), 4u);
    EXPECT_EQ(crowded.wish_of(key(SDL_SCANCODE_SPACE, true)), Wish::Pause);
    EXPECT_FALSE(press_of(crowded, key(SDL_SCANCODE_SPACE, true))) << "a key does one thing";
    for (const char* bad : {"{\"left\": [\"key Nonsense\"]}", "{\"jump\": []}", "[1", "{\"left\": 5}"})
    {
        std::ofstream(file) << bad;
        EXPECT_NE(read.load(file).find("was not read"), std::string::npos) << bad;
        EXPECT_EQ(press_of(read, key(SDL_SCANCODE_B, true))->button, Button::Plunger) << "nothing was lost";
    }
    EXPECT_FALSE(std::filesystem::exists(file)) << "a bad file is put aside";
    std::filesystem::remove(file.string() + ".broken");
    EXPECT_EQ(read.load(file), "") << "no file, no change";
    EXPECT_NE(controls.save("/no/such/folder/file").find("cannot be written"), std::string::npos);
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

TEST(PlayerNames, AreTyped)
{
    NameEntry entry;
    entry.begin(0);
    (void)entry.step({});
    for (const char c : std::string("z!x"))
        entry.type(c);
    entry.erase();
    for (const char c : std::string("o7q"))
        entry.type(c);
    EXPECT_EQ(entry.name(), "ZO7");
    EXPECT_TRUE(entry.active());
    EXPECT_TRUE(entry.step({.start = true}));
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
