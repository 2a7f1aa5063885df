#include "view/camera.h"

#include <gtest/gtest.h>

namespace carom::view {
namespace {

TEST(Camera, CenterIsInTheMiddleAndYPointsUp)
{
    const Camera camera{.center = {3, -2}, .points_per_meter = 50, .viewport_min = {100, 0}, .viewport_max = {500, 300}};
    EXPECT_EQ(camera.to_screen({3, -2}), (Vec2{300, 150}));
    EXPECT_EQ(camera.to_screen({4, -1}), (Vec2{350, 100}));
}

TEST(Camera, ToWorldUndoesToScreenFarFromTheOrigin)
{
    const Camera camera{.center = {1e6, -2e6}, .points_per_meter = 400, .viewport_min = {0, 0}, .viewport_max = {640, 480}};
    const Position p{1e6 + 0.3, -2e6 + 0.2};
    const Position back = camera.to_world(camera.to_screen(p));
    EXPECT_NEAR(back.x, p.x, 1e-6);
    EXPECT_NEAR(back.y, p.y, 1e-6);
}

TEST(Camera, FitShowsTheWholeBoxAndTouchesTwoMargins)
{
    const Box box{{-2, 1}, {6, 5}};
    const Camera camera = Camera::fit(box, {10, 20}, {410, 420}, 25);
    const Vec2 low = camera.to_screen(box.lower);
    const Vec2 high = camera.to_screen(box.upper);
    EXPECT_NEAR(low.x, 35, 1e-3);
    EXPECT_NEAR(high.x, 385, 1e-3);
    EXPECT_GT(high.y, 20 + 25);
    EXPECT_LT(low.y, 420 - 25);
    EXPECT_NEAR((low.y + high.y) / 2, 220, 1e-3);
}

TEST(Camera, ZoomKeepsThePointUnderTheMouse)
{
    Camera camera{.center = {1, 1}, .points_per_meter = 30};
    const Position before = camera.to_world({900, 120});
    camera.zoom_at({900, 120}, 2.5);
    EXPECT_DOUBLE_EQ(camera.points_per_meter, 75);
    EXPECT_NEAR(camera.to_world({900, 120}).x, before.x, 1e-9);
    EXPECT_NEAR(camera.to_world({900, 120}).y, before.y, 1e-9);
}

TEST(Camera, PanMovesThePictureWithTheMouse)
{
    Camera camera{.points_per_meter = 20};
    const Vec2 before = camera.to_screen({5, 5});
    camera.pan({13, -7});
    const Vec2 after = camera.to_screen({5, 5});
    EXPECT_NEAR(after.x - before.x, 13, 1e-3);
    EXPECT_NEAR(after.y - before.y, -7, 1e-3);
}

TEST(Camera, ScreenCameraIsPointsWithYDown)
{
    const Camera camera = Camera::screen({800, 600});
    EXPECT_EQ(camera.to_screen({0, 0}), (Vec2{0, 0}));
    EXPECT_EQ(camera.to_screen({20, 30}), (Vec2{20, 30}));
}

TEST(Camera, VisibleIsTheViewportInTheWorld)
{
    const Camera camera{.center = {2, 3}, .points_per_meter = 10, .viewport_min = {0, 0}, .viewport_max = {100, 40}};
    const Box box = camera.visible();
    EXPECT_NEAR(box.lower.x, -3, 1e-9);
    EXPECT_NEAR(box.upper.x, 7, 1e-9);
    EXPECT_NEAR(box.lower.y, 1, 1e-9);
    EXPECT_NEAR(box.upper.y, 5, 1e-9);
}

} // namespace
} // namespace carom::view
