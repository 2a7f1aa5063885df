#include "view/window.h"

#include <SDL.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

namespace carom::view {
namespace {

using Pixel = std::tuple<int, int, int>;

Pixel pixel(const Image& image, int x, int y)
{
    const std::uint8_t* p = image.at(x, y);
    return {p[0], p[1], p[2]};
}

int brightness(const Image& image, int x, int y)
{
    const auto [r, g, b] = pixel(image, x, y);
    return r + g + b;
}

std::size_t colors_in(const Image& image, int x0, int y0, int x1, int y1)
{
    std::set<Pixel> colors;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            colors.insert(pixel(image, x, y));
    return colors.size();
}

class WindowTest : public testing::Test
{
protected:
    WindowTest() { setenv("SDL_VIDEODRIVER", "offscreen", 0); }

    // Two frames: sizes of text are baked after the first.
    static Image photograph(Window& window, const std::function<void()>& draw)
    {
        Image image;
        for (int i = 0; i < 2 && window.begin_frame(); ++i)
        {
            draw();
            window.end_frame(&image);
        }
        return image;
    }
};

TEST_F(WindowTest, WithoutADisplayItSaysSo)
{
    for (const char* name : {"SDL_VIDEODRIVER", "DISPLAY", "WAYLAND_DISPLAY"})
        unsetenv(name);
    std::string sentence;
    try
    {
        const Window window;
    }
    catch (const std::runtime_error& error)
    {
        sentence = error.what();
    }
    EXPECT_NE(sentence.find("there is no display"), std::string::npos) << sentence;
}

TEST_F(WindowTest, PictureHasTheSizeAndTheBackground)
{
    Window window({.width = 320, .height = 200, .background = rgb(0x204060)});
    const Image image = photograph(window, [] {});
    ASSERT_EQ(image.width, 320);
    ASSERT_EQ(image.height, 200);
    EXPECT_EQ(pixel(image, 160, 100), (Pixel{0x20, 0x40, 0x60}));
    EXPECT_EQ(colors_in(image, 0, 0, 320, 200), 1u);
}

TEST_F(WindowTest, CircleIsFilledRoundInPlaceAndSoftAtItsEdge)
{
    Window window({.width = 200, .height = 200, .background = rgb(0)});
    const Camera camera{.center = {0, 0}, .points_per_meter = 10, .viewport_min = {0, 0}, .viewport_max = {200, 200}};
    const Image image = photograph(window, [&] { window.canvas(camera).fill_circle({3, 4}, 2, rgb(0xffffff)); });
    EXPECT_EQ(pixel(image, 130, 60), (Pixel{255, 255, 255}));
    EXPECT_EQ(pixel(image, 130, 140), (Pixel{0, 0, 0}));
    double covered = 0;
    bool soft = false;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x)
        {
            const int value = brightness(image, x, y) / 3;
            covered += value / 255.0;
            soft = soft || (value > 60 && value < 200);
        }
    EXPECT_NEAR(covered, 400.0 * static_cast<double>(pi), 15);
    EXPECT_TRUE(soft);
}

// Dear ImGui's own fill is jagged for one winding; ours is soft for both.
TEST_F(WindowTest, PolygonIsSoftInBothWindings)
{
    Window window({.width = 100, .height = 100, .background = rgb(0)});
    std::vector<Position> triangle{{10, 10}, {90, 30}, {40, 90}};
    for (int turn = 0; turn < 2; ++turn)
    {
        const Image image = photograph(window, [&] { window.canvas().fill_polygon(triangle, rgb(0xffffff)); });
        EXPECT_GT(colors_in(image, 0, 0, 100, 100), 20u);
        EXPECT_EQ(pixel(image, 45, 40), (Pixel{255, 255, 255}));
        std::reverse(triangle.begin(), triangle.end());
    }
}

TEST_F(WindowTest, ConcaveOutlineLeavesItsNotchFree)
{
    Window window({.width = 100, .height = 100, .background = rgb(0)});
    const std::vector<Vec2> shape{{10, 10}, {90, 10}, {90, 40}, {40, 40}, {40, 90}, {10, 90}};
    const OutlineMesh mesh(shape);
    const Image image = photograph(window, [&] { window.canvas().fill_outline(mesh, rgb(0xffffff)); });
    EXPECT_EQ(brightness(image, 70, 70), 0);
    EXPECT_EQ(pixel(image, 25, 70), (Pixel{255, 255, 255}));
    EXPECT_EQ(pixel(image, 70, 25), (Pixel{255, 255, 255}));
}

TEST_F(WindowTest, GradientRunsFromOneColourToTheOther)
{
    Window window({.width = 100, .height = 100, .background = rgb(0)});
    const Image image = photograph(
        window,
        [&] { window.canvas().fill_box({{0, 0}, {100, 100}}, Paint::linear({0, 0}, rgb(0x000000), {100, 0}, rgb(0xff0000))); });
    EXPECT_NEAR(std::get<0>(pixel(image, 25, 50)), 64, 4);
    EXPECT_NEAR(std::get<0>(pixel(image, 75, 50)), 192, 4);
}

TEST_F(WindowTest, LineHasItsWidthAndThinLinesArePale)
{
    Window window({.width = 100, .height = 100, .background = rgb(0)});
    const Image image = photograph(window,
                                   [&]
                                   {
                                       Canvas canvas = window.canvas();
                                       canvas.line({10, 30}, {90, 30}, {rgb(0xffffff), 8});
                                       canvas.line({10, 70.5}, {90, 70.5}, {rgb(0xffffff), 0.25f});
                                   });
    double thick = 0;
    double thin = 0;
    for (int y = 0; y < 50; ++y)
        thick += brightness(image, 50, y) / 765.0;
    for (int y = 50; y < 100; ++y)
        thin += brightness(image, 50, y) / 765.0;
    EXPECT_NEAR(thick, 8, 0.3);
    EXPECT_NEAR(thin, 0.25, 0.15);
}

TEST_F(WindowTest, GlowAddsLightAndFadesToNothing)
{
    Window window({.width = 100, .height = 100, .background = rgb(0x202020)});
    const Image image = photograph(window, [&] { window.canvas().glow({50, 50}, 5, 30, rgb(0x808080)); });
    EXPECT_EQ(brightness(image, 50, 50), 3 * (0x20 + 0x80));
    EXPECT_GT(brightness(image, 60, 50), brightness(image, 70, 50));
    EXPECT_EQ(brightness(image, 50, 95), 3 * 0x20);
}

TEST_F(WindowTest, ShadeDarkensAndATrailFadesAlongItsWay)
{
    Window window({.width = 200, .height = 100, .background = rgb(0x606060)});
    Path way;
    for (int x = 180; x >= 20; x -= 4)
        way.emplace_back(x, 70);
    const Image image = photograph(window,
                                   [&]
                                   {
                                       window.canvas().shade({50, 25}, 5, 20, rgb(0, 0.5f));
                                       window.canvas().trail(way, 8, rgb(0xffffff));
                                   });
    EXPECT_NEAR(brightness(image, 50, 25), 3 * 0x30, 6);
    EXPECT_GT(brightness(image, 170, 70), brightness(image, 120, 70) + 60);
    EXPECT_GT(brightness(image, 120, 70), brightness(image, 60, 70) + 60);
    EXPECT_EQ(brightness(image, 100, 50), 3 * 0x60);
}

TEST_F(WindowTest, TextIsDrawnWithSoftEdgesAndNamedGlyphs)
{
    Window window({.width = 300, .height = 100, .background = rgb(0)});
    Vec2 size{};
    const Image image = photograph(window,
                                   [&]
                                   {
                                       Canvas canvas = window.canvas();
                                       const TextStyle style{.size = 24};
                                       canvas.text({10, 10}, "Carom m₁·r²/I", style);
                                       size = canvas.text_size("Carom m₁·r²/I", style);
                                   });
    EXPECT_GT(size.x, 100);
    EXPECT_NEAR(size.y, 24, 2);
    EXPECT_GT(colors_in(image, 10, 10, 10 + static_cast<int>(size.x), 34), 30u);
    EXPECT_EQ(colors_in(image, 0, 50, 300, 100), 1u);
}

TEST_F(WindowTest, TextOfTwiceTheSizeIsTwiceAsWide)
{
    Window window({.width = 300, .height = 100});
    float small = 0;
    float big = 0;
    (void)photograph(window,
                     [&]
                     {
                         Canvas canvas = window.canvas();
                         small = canvas.text_size("width", {.size = 16}).x;
                         big = canvas.text_size("width", {.size = 32}).x;
                     });
    EXPECT_NEAR(big, 2 * small, 2);
}

TEST_F(WindowTest, WidgetsAreShown)
{
    Window window({.width = 300, .height = 200, .background = rgb(0)});
    const Image image = photograph(window,
                                   []
                                   {
                                       ImGui::SetNextWindowPos({20, 20});
                                       ImGui::SetNextWindowSize({200, 100});
                                       ImGui::Begin("panel");
                                       ImGui::TextUnformatted("hello");
                                       ImGui::End();
                                   });
    EXPECT_GT(colors_in(image, 20, 20, 220, 120), 20u);
    EXPECT_EQ(colors_in(image, 230, 0, 300, 200), 1u);
}

TEST_F(WindowTest, QuitEventEndsTheLoopAndOthersReachTheUser)
{
    Window window({.width = 100, .height = 100});
    SDL_Event key{};
    key.type = SDL_KEYDOWN;
    key.key.keysym.scancode = SDL_SCANCODE_Z;
    SDL_PushEvent(&key);
    ASSERT_TRUE(window.begin_frame());
    bool seen = false;
    for (const SDL_Event& event : window.events())
        seen = seen || (event.type == SDL_KEYDOWN && event.key.keysym.scancode == SDL_SCANCODE_Z);
    EXPECT_TRUE(seen);
    window.end_frame();
    SDL_Event quit{};
    quit.type = SDL_QUIT;
    SDL_PushEvent(&quit);
    EXPECT_FALSE(window.begin_frame());
}

TEST_F(WindowTest, PngIsWrittenAndABadPathIsToldOf)
{
    Window window({.width = 64, .height = 64});
    const Image image = photograph(window, [] {});
    const std::string path = testing::TempDir() + "carom_window_test.png";
    EXPECT_TRUE(save_png(image, path));
    std::FILE* file = std::fopen(path.c_str(), "rb");
    ASSERT_NE(file, nullptr);
    unsigned char head[4] = {};
    EXPECT_EQ(std::fread(head, 1, 4, file), 4u);
    std::fclose(file);
    std::remove(path.c_str());
    EXPECT_EQ(head[1], 'P');
    EXPECT_FALSE(save_png(image, "/no/such/folder/picture.png"));
}

} // namespace
} // namespace carom::view
