// The screens of the machine at several sizes of its window: every word is whole.

#include "pinball/player/controls_panel.h"
#include "pinball/player/machine.h"
#include "pinball/player/stage.h"
#include "support/clipped_text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <string>

namespace carom::pinball {
namespace {

struct Size
{
    int width;
    int height;
};

void PrintTo(const Size& size, std::ostream* out) { *out << size.width << "x" << size.height; }

class Screens : public testing::TestWithParam<Size>
{
protected:
    void play(int steps)
    {
        for (int i = 0; i < steps; ++i)
            m_machine.step({.start = i == 5});
    }

    void expect_whole_words(const char* what, const Frame& frame)
    {
        for (int i = 0; i < 3; ++i)
        {
            ASSERT_TRUE(m_window.begin_frame());
            draw_frame(m_window, m_machine, m_stage, frame);
            m_controls.draw(m_window, m_machine.controls);
            m_window.end_frame();
        }
        EXPECT_EQ(test::clipped_text(), "") << what;
    }

    int m_offscreen = setenv("SDL_VIDEODRIVER", "offscreen", 0); // before the window
    view::Window m_window{{.width = GetParam().width, .height = GetParam().height}};
    Machine m_machine{CAROM_TABLES_DIR "/momentum.table.json", 3, false, false};
    Stage m_stage{};
    ControlsPanel m_controls{};
};

TEST_P(Screens, OfAMachineThatWaits)
{
    for (const double time : {1.0, 9.0, 12.0})
        expect_whole_words("attract", {.status = {.time = time}});
    m_stage.workshop.open = true;
    expect_whole_words("grid", {.status = {.time = 1}});
}

TEST_P(Screens, OfAGame)
{
    m_machine.play_by_itself(true);
    play(30'000);
    expect_whole_words("game", {.status = {.time = 1}});
    for (const double time : {1.0, 9.0})
        expect_whole_words("paused", {.status = {.time = time, .paused = true}});
    expect_whole_words("question", {.question = "LEAVE THE GAME?", .status = {.time = 1, .paused = true}});
}

TEST_P(Screens, OfTheXray)
{
    m_machine.record_substeps(true);
    m_machine.play_by_itself(true);
    play(13'000); // the ball is where the edge of the picture cuts no lamp's letter
    m_machine.look_into_step();
    ASSERT_TRUE(m_machine.impacts.last());
    for (const bool paused : {false, true})
        expect_whole_words("x-ray", {.xray = true, .status = {.time = 1, .paused = paused}});
}

TEST_P(Screens, OfTheKeys)
{
    m_controls.toggle();
    expect_whole_words("keys", {.status = {.time = 1}});
}

TEST_P(Screens, OfAGameThatIsWatched)
{
    m_machine.play_by_itself(true);
    play(20'000);
    m_machine.restart();
    ASSERT_EQ(m_machine.watch_last(), "");
    expect_whole_words("watching", {.status = {.time = 1, .speed = 0.25}});
    play(20'001);
    EXPECT_TRUE(m_machine.has_watched());
    EXPECT_TRUE(m_machine.came_out_the_same());
    expect_whole_words("watched", {.status = {.time = 1}});
    m_machine.stop_watching();
    EXPECT_TRUE(m_machine.is_idle());
}

INSTANTIATE_TEST_SUITE_P(Sizes, Screens, testing::Values(Size{1280, 800}, Size{800, 600}, Size{400, 800}, Size{2560, 1440}),
                         [](const auto& size)
                         { return std::to_string(size.param.width) + "x" + std::to_string(size.param.height); });

} // namespace
} // namespace carom::pinball
