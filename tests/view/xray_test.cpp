// The x-ray over a real scene: what is switched on is seen where it is, and the scrubber knows the sub-steps.

#include "view/impact_story.h"
#include "view/shape_art.h"
#include "view/substep_scrubber.h"
#include "view/window.h"
#include "view/xray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

namespace carom::view {
namespace {

// Pixels of a colour, or of a darker tone of it: thin lines on black are soft.
int count_color(const Image& image, Color color)
{
    const auto same_tone = [color](const std::uint8_t* p)
    {
        const float strongest = std::max({color.r, color.g, color.b, 1e-3f});
        const float share = static_cast<float>(std::max({p[0], p[1], p[2]})) / (255 * strongest);
        const auto near = [share](std::uint8_t value, float wanted)
        { return std::abs(static_cast<float>(value) - share * wanted * 255) < 12; };
        return share > 0.35f && share < 1.05f && near(p[0], color.r) && near(p[1], color.g) && near(p[2], color.b);
    };
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            count += same_tone(image.at(x, y));
    return count;
}

bool is_black(const Image& image)
{
    return std::ranges::all_of(image.pixels, [](std::uint8_t value) { return value == 0; });
}

XrayToggles nothing()
{
    XrayToggles t;
    t.outlines = t.triggers = t.joints = t.contacts = t.normals = t.impulses = t.velocities = false;
    return t;
}

class XrayTest : public testing::Test
{
protected:
    XrayTest()
    {
        setenv("SDL_VIDEODRIVER", "offscreen", 0);
        const BodyId floor = scene.create_body({});
        scene.create_shape(floor, HalfSpace{});
        ball = scene.create_body({.type = BodyType::Dynamic, .position = {-2, 0.99}});
        scene.create_shape(ball, Circle{.radius = 1});
        flyer = scene.create_body({.type = BodyType::Dynamic, .position = {3, 5}, .velocity = {2, 0}});
        scene.create_shape(flyer, box(0.5f, 0.5f));
        const BodyId zone = scene.create_body({.position = {5, 3}});
        scene.create_shape(zone, box(0.5f, 0.5f), {.trigger = true});
        (void)scene.create_joint(SpringDef{.body_b = flyer, .anchor_a = {3, 8}, .stiffness = 1});
        scene.set_record_substeps(true);
        for (int i = 0; i < 5; ++i)
            scene.step(1.0f / 60);
    }

    Image photograph(const std::function<void(Canvas&)>& draw)
    {
        Window window({.width = 480, .height = 400, .background = rgb(0)});
        const Camera camera = Camera::fit({{-6, -1}, {6, 9}}, {0, 0}, window.size());
        Image image;
        for (int i = 0; i < 2 && window.begin_frame(); ++i)
        {
            Canvas canvas = window.canvas(camera);
            draw(canvas);
            window.end_frame(&image);
        }
        return image;
    }

    Image overlay(const XrayToggles& toggles)
    {
        XrayOverlay xray;
        xray.toggles = toggles;
        return photograph([&](Canvas& canvas) { xray.draw(canvas, scene); });
    }

    Scene scene{SceneDef{.sleeping = false}};
    BodyId ball{};
    BodyId flyer{};
};

TEST_F(XrayTest, NothingSwitchedOnDrawsNothing)
{
    const Image image = overlay(nothing());
    EXPECT_TRUE(is_black(image));
}

// Each toggle alone brings its own colour.
TEST_F(XrayTest, EveryToggleShowsItsOwnColour)
{
    const std::pair<bool XrayToggles::*, DrawRole> toggles[] = {
        {&XrayToggles::outlines, DrawRole::AwakeShape},   {&XrayToggles::triggers, DrawRole::Trigger},
        {&XrayToggles::joints, DrawRole::Joint},          {&XrayToggles::contacts, DrawRole::Contact},
        {&XrayToggles::normals, DrawRole::ContactNormal}, {&XrayToggles::impulses, DrawRole::Impulse},
        {&XrayToggles::velocities, DrawRole::Velocity},   {&XrayToggles::boxes, DrawRole::Box},
        {&XrayToggles::centers, DrawRole::CenterOfMass},  {&XrayToggles::islands, DrawRole::Island},
    };
    for (const auto& [toggle, role] : toggles)
    {
        XrayToggles t = nothing();
        t.*toggle = true;
        EXPECT_GT(count_color(overlay(t), role_color(role)), 3) << "role " << static_cast<int>(role);
    }
}

TEST_F(XrayTest, SceneIsDrawnWithMovingThingsOverStillOnes)
{
    const ScenePalette palette;
    const Image image = photograph([&](Canvas& canvas) { draw_scene(canvas, scene, 1, palette); });
    EXPECT_GT(count_color(image, palette.still), 480 * 30);
    EXPECT_GT(count_color(image, palette.dynamic[ball.slot % 5]), 2000);
    EXPECT_GT(count_color(image, palette.dynamic[flyer.slot % 5]), 700);
    EXPECT_GT(count_color(image, palette.trigger), 20);
}

TEST_F(XrayTest, ScrubberHasEverySubstepFromStartToEnd)
{
    SubstepScrubber scrubber;
    EXPECT_TRUE(scrubber.empty());
    scrubber.capture(scene);
    ASSERT_EQ(scrubber.substeps(), scene.report().substeps);
    EXPECT_NEAR(scrubber.time(), 1.0f / 60, 1e-6f);
    const Position end = scene.body(flyer).position();
    ASSERT_TRUE(scrubber.pose(flyer));
    EXPECT_NEAR(scrubber.pose(flyer)->position.x, end.x, 1e-6);
    scrubber.select(0);
    EXPECT_EQ(scrubber.time(), 0);
    EXPECT_EQ(scrubber.pose(flyer)->position, scene.body(flyer).interpolated_pose(0).position);
    scrubber.select(2);
    EXPECT_NEAR(scrubber.pose(flyer)->position.x, end.x - 2.0 / 60 * 0.5, 1e-3);
    EXPECT_FALSE(scrubber.pose(BodyId{}));
    scrubber.select(99);
    EXPECT_EQ(scrubber.selected(), scrubber.substeps());
    scrubber.clear();
    EXPECT_TRUE(scrubber.empty());
}

TEST_F(XrayTest, ScrubberDrawsGhostsAndTakesPartInAnyFrame)
{
    SubstepScrubber scrubber;
    const auto ghosts = [&] { return count_color(photograph([&](Canvas& c) { scrubber.draw(c, scene); }), rgb(0xffe066)); };
    EXPECT_EQ(ghosts(), 0);
    scrubber.capture(scene);
    EXPECT_EQ(ghosts(), 0);
    scrubber.select(1);
    EXPECT_GT(ghosts(), 50);
    scene.destroy(flyer);
    EXPECT_GT(ghosts(), 0);
}

TEST_F(XrayTest, KindNamesTellWhatAndWhich)
{
    const auto name = [&](BodyId body) { return kind_name(scene, scene.body(body).shapes()[0]); };
    EXPECT_EQ(name(ball), "ball " + std::to_string(ball.slot));
    EXPECT_EQ(name(flyer), "box " + std::to_string(flyer.slot));
    EXPECT_EQ(name(scene.bodies()[0]), "floor");
}

// A real impact, told: the formula gives what the engine gave.
TEST(ImpactOfAScene, IsRecordedAndItsFormulaHolds)
{
    Scene scene(SceneDef{.gravity = {0, 0}});
    const ShapeDef material{.friction = 0, .restitution = 0.5f};
    const BodyId ball = scene.create_body({.type = BodyType::Dynamic, .position = {-2, 0.3}, .velocity = {6, 0}});
    scene.create_shape(ball, Circle{.radius = 0.2f}, material);
    const BodyId rod = scene.create_body({.type = BodyType::Dynamic});
    scene.create_shape(rod, box(0.1f, 1), material);
    ImpactWatch watch([&](const Scene& s, ShapeId shape) { return std::string(s.shape(shape).body() == ball ? "ball" : "rod"); });
    for (int i = 0; i < 60 && !watch.last(); ++i)
    {
        scene.step(1.0f / 60);
        watch.observe(scene);
    }
    ASSERT_TRUE(watch.last());
    const ImpactRecord& record = *watch.last();
    EXPECT_NE(record.a.name, record.b.name);
    EXPECT_NEAR(record.event.approach_speed, 6, 0.01f);
    EXPECT_NEAR(impulse_by_formula(record), record.event.impulse, 1e-4f * record.event.impulse);
    const bool rod_is_a = record.a.name == "rod";
    const float rod_mass = rod_is_a ? record.event.effective_mass_a : record.event.effective_mass_b;
    EXPECT_NEAR(lever_arm(rod_is_a ? record.a : record.b, rod_mass), 0.3f, 0.01f);
}

TEST(ImpactWatch, KeepsTheStrongerOneForAWhile)
{
    Scene scene(SceneDef{.gravity = {0, 0}});
    const ShapeDef bouncy{.friction = 0, .restitution = 1};
    const BodyId wall = scene.create_body({});
    scene.create_shape(wall, HalfSpace{.normal = {-1, 0}, .offset = 0}, bouncy);
    // The wall is at x = 0 and its free side is to the left. A fast ball first, a slow one 0.1 s later.
    const BodyId fast = scene.create_body({.type = BodyType::Dynamic, .position = {-1, 0}, .velocity = {10, 0}});
    scene.create_shape(fast, Circle{.radius = 0.1f}, bouncy);
    const BodyId slow = scene.create_body({.type = BodyType::Dynamic, .position = {-0.3, 3}, .velocity = {1, 0}});
    scene.create_shape(slow, Circle{.radius = 0.1f}, bouncy);
    ImpactWatch patient({}, 1);
    ImpactWatch hasty({}, 0.01);
    for (int i = 0; i < 30; ++i)
    {
        scene.step(1.0f / 60);
        patient.observe(scene);
        hasty.observe(scene);
    }
    ASSERT_TRUE(patient.last() && hasty.last());
    EXPECT_NEAR(patient.last()->event.approach_speed, 10, 0.1f);
    EXPECT_NEAR(hasty.last()->event.approach_speed, 1, 0.1f);
}

} // namespace
} // namespace carom::view
