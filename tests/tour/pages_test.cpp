// Every page at four sizes: whole words, and nothing left unsaid.

#include "support/clipped_text.h"
#include "tour/tour.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace carom::tour {
namespace {

struct Size
{
    int width;
    int height;
};

class Pages : public testing::TestWithParam<Size>
{
protected:
    Pages() { setenv("SDL_VIDEODRIVER", "offscreen", 0); }
};

TEST_P(Pages, HaveNoClippedWord)
{
    view::Window window({.width = GetParam().width, .height = GetParam().height});
    Tour tour(window);
    for (int chapter = 0; chapter < tour.chapters(); ++chapter)
    {
        tour.open(chapter);
        tour.lesson().paused = true;
        for (int i = 0; i < tour.lesson().chapter().picture_steps(); ++i)
            tour.lesson().step();
        int page = 0;
        do
        {
            tour.panel().set_page(page);
            for (int i = 0; i < 3; ++i)
            {
                ASSERT_TRUE(window.begin_frame());
                (void)tour.frame(0);
                window.end_frame();
            }
            EXPECT_EQ(test::clipped_text(), "") << tour.lesson().chapter().name() << ", page " << page + 1;
        } while (++page < tour.panel().pages());
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Pages, testing::Values(Size{1280, 800}, Size{800, 600}, Size{400, 800}, Size{2560, 1440}),
                         [](const auto& size)
                         { return std::to_string(size.param.width) + "x" + std::to_string(size.param.height); });

// A letter that hangs over an edge is found: else the test above could not fail.
TEST(ClippedText, IsFound)
{
    setenv("SDL_VIDEODRIVER", "offscreen", 0);
    view::Window window({.width = 300, .height = 200});
    for (const float x : {20.0f, 284.0f})
    {
        for (int i = 0; i < 2; ++i)
        {
            ASSERT_TRUE(window.begin_frame());
            view::Canvas canvas = window.canvas();
            canvas.text({x, 20}, "word", {});
            window.end_frame();
        }
        EXPECT_EQ(test::clipped_text().empty(), x < 100);
    }
}

TEST(Pictures, AreWrittenOfEveryChapter)
{
    setenv("SDL_VIDEODRIVER", "offscreen", 0);
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "carom-tour-pictures";
    std::filesystem::remove_all(folder);
    view::Window window({.width = 800, .height = 600});
    ASSERT_TRUE(write_pictures(window, folder.string()));
    for (const auto& chapter : all_chapters())
        EXPECT_TRUE(std::filesystem::exists(folder / (chapter->name() + "-1.png"))) << chapter->name();
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace carom::tour
