// The machine through its window: events come in as SDL gives them, time is the test's own.

#include "pinball/player/app.h"

#include <SDL_events.h>
#include <SDL_keyboard.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace carom::pinball {
namespace {

class Window : public testing::Test
{
protected:
    Window()
    {
        SDL_FlushEvents(SDL_FIRSTEVENT, SDL_LASTEVENT);
        m_app.emplace(PlayerOptions{.seed = 3, .width = 400, .height = 500, .mute = true}, [this] { return m_now; });
        frames(3);
    }

    void key(SDL_Scancode code, bool down)
    {
        SDL_Event event{};
        event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
        event.key.timestamp = static_cast<Uint32>(m_now);
        event.key.keysym.scancode = code;
        event.key.keysym.sym = SDL_GetKeyFromScancode(code);
        push(event);
    }
    // SDL_PushEvent would put a time of its own into it.
    static void push(SDL_Event event) { SDL_PeepEvents(&event, 1, SDL_ADDEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT); }
    void tap(SDL_Scancode code)
    {
        key(code, true);
        key(code, false);
        frames(4);
    }
    void frames(int count)
    {
        for (int i = 0; i < count && m_runs; ++i)
        {
            m_now += 16;
            m_runs = m_app->frame();
        }
    }
    // Longer than a game must be to be kept, in frames as long as they may be.
    void play_a_while()
    {
        for (int i = 0; i < 60; ++i)
        {
            m_now += 80;
            frames(1);
        }
    }
    void start_game()
    {
        tap(SDL_SCANCODE_RETURN);
        ASSERT_EQ(game().phase(), Phase::Ready);
    }
    [[nodiscard]] const Game& game() const { return m_app->machine().game(); }

    // Its own data, and no display: before SDL begins.
    int m_no_display = setenv("SDL_VIDEODRIVER", "offscreen", 0) + setenv("SDL_AUDIODRIVER", "dummy", 0) +
                       setenv("XDG_DATA_HOME", testing::TempDir().c_str(), 1);
    double m_now = 1000;
    bool m_runs = true;
    std::optional<App> m_app{};
};

TEST_F(Window, ATapWithinOneFrameLiftsTheBat)
{
    start_game();
    frames(20);
    const Index flipper = game().table().find("flipper_left");
    const float rest = game().element(flipper).angle;
    key(SDL_SCANCODE_Z, true);
    key(SDL_SCANCODE_Z, false);
    float most = 0;
    for (int i = 0; i < 4; ++i)
    {
        frames(1);
        most = std::max(most, std::abs(game().element(flipper).angle - rest));
    }
    EXPECT_GT(most, 0.2f);
}

TEST_F(Window, EscAndRAskBeforeTheyEndAGame)
{
    start_game();
    tap(SDL_SCANCODE_ESCAPE);
    EXPECT_TRUE(m_runs);
    EXPECT_EQ(m_app->asks(), Wish::Quit);
    tap(SDL_SCANCODE_Q);
    EXPECT_FALSE(m_app->asks()) << "any other key: no";
    EXPECT_EQ(game().phase(), Phase::Ready);
    const std::int64_t steps = game().step_count();
    tap(SDL_SCANCODE_R);
    EXPECT_EQ(m_app->asks(), Wish::Restart);
    tap(SDL_SCANCODE_R);
    EXPECT_FALSE(m_app->asks());
    frames(2);
    EXPECT_LT(game().step_count(), steps + 60) << "a new game";
    EXPECT_EQ(game().phase(), Phase::Ready);
    tap(SDL_SCANCODE_ESCAPE);
    tap(SDL_SCANCODE_ESCAPE);
    frames(2);
    EXPECT_FALSE(m_runs);
}

TEST_F(Window, LosesItsFocusAndPauses)
{
    start_game();
    SDL_Event event{};
    event.type = SDL_WINDOWEVENT;
    event.window.event = SDL_WINDOWEVENT_FOCUS_LOST;
    push(event);
    frames(2);
    EXPECT_TRUE(m_app->is_paused());
    const std::int64_t steps = game().step_count();
    frames(10);
    EXPECT_EQ(game().step_count(), steps);
    tap(SDL_SCANCODE_P);
    EXPECT_FALSE(m_app->is_paused());
}

TEST_F(Window, ANudgeMovesTheCabinet)
{
    start_game();
    key(SDL_SCANCODE_A, true);
    frames(3);
    EXPECT_GT(game().cabinet().offset().x, 0.001f);
    key(SDL_SCANCODE_A, false);
}

TEST_F(Window, AnotherStartLetsAnotherPlayerIn)
{
    start_game();
    tap(SDL_SCANCODE_RETURN);
    EXPECT_EQ(game().players(), 2);
}

TEST_F(Window, AGameThatWasLeftIsShownAgainAtAnySpeed)
{
    tap(SDL_SCANCODE_W);
    const bool had_one = m_app->machine().is_watching(); // of an earlier test
    if (had_one)
        tap(SDL_SCANCODE_W);
    start_game();
    play_a_while();
    tap(SDL_SCANCODE_R);
    tap(SDL_SCANCODE_R);
    tap(SDL_SCANCODE_W);
    EXPECT_FALSE(m_app->machine().is_watching()) << "not while a game is on";
    m_app.emplace(PlayerOptions{.seed = 3, .width = 400, .height = 500, .mute = true}, [this] { return m_now; });
    frames(3);
    tap(SDL_SCANCODE_W);
    ASSERT_TRUE(m_app->machine().is_watching());
    const std::int64_t before = game().step_count();
    frames(10);
    const std::int64_t at_one = game().step_count() - before;
    tap(SDL_SCANCODE_RIGHTBRACKET);
    tap(SDL_SCANCODE_RIGHTBRACKET);
    const std::int64_t later = game().step_count();
    frames(10);
    EXPECT_NEAR(static_cast<double>(game().step_count() - later), 4.0 * static_cast<double>(at_one), 40);
    play_a_while();
    EXPECT_TRUE(m_app->machine().came_out_the_same());
    tap(SDL_SCANCODE_ESCAPE);
    EXPECT_FALSE(m_app->machine().is_watching());
    EXPECT_TRUE(m_runs);
}

TEST_F(Window, AClickUnderTheXrayChoosesAThing)
{
    tap(SDL_SCANCODE_X);
    SDL_Event event{};
    event.type = SDL_MOUSEBUTTONDOWN;
    event.button.button = SDL_BUTTON_LEFT;
    bool chosen = false;
    for (int x = 40; x < 360 && !chosen; x += 10) // across the flippers
    {
        event.button.x = x;
        event.button.y = 190;
        push(event);
        frames(1);
        event.type = SDL_MOUSEBUTTONUP;
        push(event);
        frames(1);
        event.type = SDL_MOUSEBUTTONDOWN;
        chosen = game().scene().is_valid(m_app->machine().selected);
    }
    EXPECT_TRUE(chosen);
}

TEST_F(Window, TheSpeedOfWatchingEndsWithIt)
{
    start_game();
    play_a_while();
    tap(SDL_SCANCODE_ESCAPE);
    tap(SDL_SCANCODE_ESCAPE);
    m_runs = true;
    m_app.emplace(PlayerOptions{.seed = 3, .width = 400, .height = 500, .mute = true}, [this] { return m_now; });
    frames(3);
    tap(SDL_SCANCODE_W);
    ASSERT_TRUE(m_app->machine().is_watching());
    for (int i = 0; i < 4; ++i)
        tap(SDL_SCANCODE_RIGHTBRACKET);
    start_game();
    EXPECT_FALSE(m_app->machine().is_watching());
    const std::int64_t before = game().step_count();
    frames(10);
    EXPECT_NEAR(static_cast<double>(game().step_count() - before), 160, 5);
}

TEST_F(Window, TheAnswerToAQuestionIsNotPlayed)
{
    start_game();
    tap(SDL_SCANCODE_ESCAPE);
    ASSERT_TRUE(m_app->asks());
    tap(SDL_SCANCODE_RETURN);
    EXPECT_FALSE(m_app->asks());
    frames(4);
    EXPECT_EQ(game().players(), 1);
}

} // namespace
} // namespace carom::pinball
