// When something comes into a trigger and goes out again: to the microsecond, on bent and broken paths, however often in a step.

#include "support/test_scene.h"

#include <algorithm>
#include <map>

using namespace carom;
using namespace carom::test;

namespace {

struct Passages
{
    std::vector<double> enters{};
    std::vector<double> exits{};
};

Passages watch(Scene& scene, int count, float h = 1.0f / 60)
{
    Passages seen;
    for (int i = 0; i < count; ++i)
    {
        const double begin = i * static_cast<double>(h);
        scene.step(h);
        for (const TriggerEvent& e : scene.trigger_enters())
            seen.enters.push_back(begin + static_cast<double>(e.time));
        for (const TriggerEvent& e : scene.trigger_exits())
            seen.exits.push_back(begin + static_cast<double>(e.time));
    }
    return seen;
}

void expect_times(const std::vector<double>& seen, const std::vector<double>& exact, double tolerance, const char* what)
{
    ASSERT_EQ(seen.size(), exact.size()) << what << ", the last " << (seen.empty() ? -1 : seen.back());
    for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_NEAR(seen[i], exact[i], tolerance) << what << " " << i;
}

constexpr Filter ghost{.category = 2, .mask = 2}; // meets its like only

} // namespace

// Up through a layer and down again; at the longest steps both within one.
TEST(Row07_TriggerTimes, OnAParabola)
{
    for (const float h : {1.0f / 30, 1.0f / 60, 1.0f / 1000})
    {
        SCOPED_TRACE(h);
        Scene scene({.gravity = {0, -10}});
        add_static(scene, box(1, 0.005f, {0, 0.1f}), {.trigger = true});
        add_dynamic(scene, {0, 0}, Circle{.radius = 0.01f}, {}, {3, 1.5f});
        const Passages seen = watch(scene, static_cast<int>(0.32f / h), h);
        // y = 1.5 t - 5 t²
        const auto at = [](double y, double sign) { return (1.5 + sign * std::sqrt(2.25 - 20 * y)) / 10; };
        ASSERT_LT(1.5 * 1.5 / 20, 0.115) << "it turns inside the layer";
        expect_times(seen.enters, {at(0.085, -1)}, 1e-6, "enter");
        expect_times(seen.exits, {at(0.085, 1)}, 1e-6, "exit");
    }
}

// Up through a thin layer and down through it again in one step, with or without sub-steps.
TEST(Row07_TriggerTimes, TwiceAroundTheApexInOneStep)
{
    for (const int substeps : {1, 4})
    {
        SCOPED_TRACE(substeps);
        Scene scene({.gravity = {0, -10}, .substeps = substeps});
        add_static(scene, box(1, 0.0002f, {0, 0.006f}), {.trigger = true});
        add_dynamic(scene, {0, 0}, Circle{.radius = 0.001f}, {}, {0, 0.5f}); // 12.5 mm high, for 0.1 s
        const Passages seen = watch(scene, 1, 1.0f / 8);
        const auto at = [](double y, double sign) { return (0.5 + sign * std::sqrt(0.25 - 20 * y)) / 10; };
        expect_times(seen.enters, {at(0.0048, -1), at(0.0072, 1)}, 1e-6, "enter");
        expect_times(seen.exits, {at(0.0072, -1), at(0.0048, 1)}, 1e-6, "exit");
    }
}

// Between two walls that give everything back: passages every few milliseconds.
TEST(Row07_TriggerTimes, ManyPassagesBetweenWallsInOneStep)
{
    Scene scene(weightless());
    add_static(scene, box(0.5f, 1, {-0.6f, 0}), {.friction = 0, .restitution = 1});
    add_static(scene, box(0.5f, 1, {0.6f, 0}), {.friction = 0, .restitution = 1});
    add_static(scene, Segment{{0, -1}, {0, 1}, 0.01f}, {.trigger = true});
    add_dynamic(scene, {-0.05, 0}, Circle{.radius = 0.02f}, {.friction = 0, .restitution = 1}, {32, 0});
    const Passages seen = watch(scene, 6);
    // The center goes to and fro over 0.16 m; inside within 0.03 m of the middle.
    std::vector<double> enters;
    std::vector<double> exits;
    for (int k = 0; k * 0.16 + 0.08 < 32 * 0.1; ++k)
    {
        const double middle = (0.05 + 0.16 * k) / 32;
        if (middle - 0.03 / 32 < 0.1)
            enters.push_back(middle - 0.03 / 32);
        if (middle + 0.03 / 32 < 0.1)
            exits.push_back(middle + 0.03 / 32);
    }
    ASSERT_GT(enters.size(), 15u);
    expect_times(seen.enters, enters, 1e-6, "enter");
    expect_times(seen.exits, exits, 1e-6, "exit");
}

// The trigger travels with a ball that bounces off a wall; what it passes twice stands still.
TEST(Row07_TriggerTimes, ATriggerThatBounces)
{
    for (const float v : {2.0f, 20.0f, 100.0f})
    {
        SCOPED_TRACE(v);
        Scene scene(weightless());
        add_static(scene, box(0.5f, 1, {1.5f, 0}), {.friction = 0, .restitution = 1});
        const Thing ball = add_dynamic(scene, {0, 0}, Circle{.radius = 0.1f}, {.friction = 0, .restitution = 1}, {v, 0});
        scene.create_shape(ball.body, Circle{.radius = 0.15f}, {.filter = ghost, .trigger = true});
        add_static(scene, Circle{.center = {0.8f, 0}, .radius = 0.05f}, {.filter = ghost});
        const Passages seen = watch(scene, static_cast<int>(60 * 2 / v) + 2);
        // Inside from 0.6 m on, turns at 0.9 m, out at 0.6 m on the way back.
        const auto speed = static_cast<double>(v);
        expect_times(seen.enters, {0.6 / speed}, 1e-6, "enter");
        expect_times(seen.exits, {1.2 / speed}, 1e-6, "exit");
    }
}

// A bar that turns by up to one radian a step over a small disc: inside while R sin(angle) is within their half widths.
TEST(Row07_TriggerTimes, ATurningBar)
{
    for (const BodyType type : {BodyType::Kinematic, BodyType::Dynamic})
        for (const float w : {3.0f, 30.0f, -30.0f})
        {
            SCOPED_TRACE(std::to_string(static_cast<int>(type)) + " at " + std::to_string(w));
            Scene scene(weightless());
            const Thing bar =
                add(scene, {.type = type, .angular_velocity = w}, box(1, 0.02f), {.filter = ghost, .trigger = true});
            if (type == BodyType::Dynamic)
                scene.create_shape(bar.body, Circle{.radius = 0.1f}, {.filter = {.category = 4, .mask = 4}});
            const double at = w > 0 ? 1.3 : static_cast<double>(pi) - 1.3; // there the bar's other arm comes
            add_static(scene, Circle{.radius = 0.03f}, {.filter = ghost}, {0.7 * std::cos(at), 0.7 * std::sin(at)});
            const auto speed = std::fabs(static_cast<double>(w));
            const Passages seen = watch(scene, static_cast<int>(std::ceil(1.8 * 30 / speed)), 1.0f / 30);
            const double half = std::asin(0.05 / 0.7);
            expect_times(seen.enters, {(1.3 - half) / speed}, 2e-6, "enter");
            expect_times(seen.exits, {(1.3 + half) / speed}, 2e-6, "exit");
        }
}

// A body that the solver moves goes straight in every sub-step, from one recorded pose to the next.
TEST(Row07_TriggerTimes, OfASolvedBodyAsItsSubStepsSay)
{
    SceneDef def = weightless();
    def.record_substeps = true;
    Scene scene(def);
    const Thing slider = add_dynamic(scene, {0, 0}, box(0.1f, 0.1f), {}, {4, 0});
    scene.create_joint(SpringDef{.body_b = slider.body, .anchor_a = {-1, 0}, .stiffness = 57, .length = 1}); // 6 Hz
    add_static(scene, Segment{{0.15f, -1}, {0.15f, 1}}, {.trigger = true});
    const float h = 1.0f / 30; // five steps a swing
    Passages seen;
    Passages want;
    double before = 0;
    for (int i = 0; i < 24; ++i)
    {
        scene.step(h);
        for (const TriggerEvent& e : scene.trigger_enters())
            seen.enters.push_back(i * static_cast<double>(h) + static_cast<double>(e.time));
        for (const TriggerEvent& e : scene.trigger_exits())
            seen.exits.push_back(i * static_cast<double>(h) + static_cast<double>(e.time));
        for (const SubstepPose& p : scene.report().substep_poses)
        {
            if (p.body != slider.body)
                continue;
            const double now = p.pose.position.x;
            const double edge = 0.05; // of the center, where the box reaches the line
            const double end = i * static_cast<double>(h) + static_cast<double>(p.time);
            const double time = end - 0.25 * static_cast<double>(h) * (now - edge) / (now - before);
            if (before < edge && now >= edge)
                want.enters.push_back(time);
            if (before >= edge && now < edge)
                want.exits.push_back(time);
            before = now;
        }
    }
    ASSERT_GT(want.enters.size(), 2u);
    expect_times(seen.enters, want.enters, 2e-6, "enter");
    expect_times(seen.exits, want.exits, 2e-6, "exit");
}

// A fast ball crosses several leaves of a chain in a step: it comes in with the first and goes out with the last.
TEST(Row07_TriggerTimes, AChainIsOneTrigger)
{
    for (const float v : {1.0f, 30.0f, 300.0f})
    {
        SCOPED_TRACE(v);
        Scene scene(weightless());
        add_static(scene,
                   Chain{.start = {1, 0},
                         .pieces = {{.end = {1.3f, 0.02f}}, {.end = {1.6f, 0}}, {.end = {2, 0.02f}}},
                         .half_thickness = 0.01f},
                   {.trigger = true});
        add_dynamic(scene, {0, 0}, Circle{.radius = 0.05f}, {}, {v, 0});
        const Passages seen = watch(scene, static_cast<int>(60 * 2.5 / v) + 2);
        const double half = std::sqrt(0.06 * 0.06 - 0.02 * 0.02); // beside the last end
        const auto speed = static_cast<double>(v);
        expect_times(seen.enters, {(1 - 0.06) / speed}, 2e-6, "enter");
        expect_times(seen.exits, {(2 + half) / speed}, 2e-6, "exit");
    }
}

// Across the seam of two leaves, at their outer and at their inner corner.
TEST(Row07_TriggerTimes, AcrossTheCornerOfAChain)
{
    for (const float v : {1.0f, 30.0f, 900.0f})
        for (const double y : {0.0, 0.03, -0.03, 0.049})
            for (const float side : {1.0f, -1.0f})
            {
                SCOPED_TRACE(std::to_string(v) + " at " + std::to_string(y) + " from " + std::to_string(side));
                Scene scene(weightless());
                add_static(scene, Chain{.start = {0.5f, 1}, .pieces = {{.end = {0, 0}}, {.end = {0.5f, -1}}}}, {.trigger = true});
                add_dynamic(scene, {-0.3 * static_cast<double>(side), y}, Circle{.radius = 0.05f}, {}, {side * v, 0});
                const Passages seen = watch(scene, static_cast<int>(60 / v) + 2);
                // On the left it meets the corner, or, farther from the middle, the flank x = |y| / 2; on the right always the flank.
                const double slant = std::sqrt(1.25);
                const double beside = 0.05 * slant;
                const bool meets_flank = std::fabs(y) > 0.05 * 0.5 / slant;
                const double left = meets_flank ? 0.5 * std::fabs(y) - beside : -std::sqrt(0.05 * 0.05 - y * y);
                const double right = 0.5 * std::fabs(y) + beside;
                const double far = 0.3;
                const auto speed = static_cast<double>(v);
                const double in = side > 0 ? left + far : far - right;
                const double out = side > 0 ? right + far : far - left;
                expect_times(seen.enters, {in / speed}, 2e-6, "enter");
                expect_times(seen.exits, {out / speed}, 2e-6, "exit");
            }
}

// For a line with one solid side, the visitor's middle has to be on that side.
TEST(Row07_TriggerTimes, ALineWithOneSide)
{
    for (const float v : {1.0f, 40.0f, 900.0f})
        for (const float way : {1.0f, -1.0f})
        {
            SCOPED_TRACE(std::to_string(v) + " towards " + std::to_string(way));
            Scene scene(weightless());
            add_static(scene, Segment{{0, -1}, {0, 1}, 0, Sides::Left}, {.trigger = true}); // left of upwards: x < 0
            add_dynamic(scene, {-0.3 * static_cast<double>(way), 0}, Circle{.radius = 0.1f}, {}, {way * v, 0});
            const Passages seen = watch(scene, static_cast<int>(60 / v) + 2);
            const auto speed = static_cast<double>(v);
            expect_times(seen.enters, {(way > 0 ? 0.2 : 0.3) / speed}, 2e-6, "enter");
            expect_times(seen.exits, {(way > 0 ? 0.3 : 0.4) / speed}, 2e-6, "exit");
        }
}

// The way of a box that is stopped by a kinematic wall and thrown back goes through the trigger twice.
TEST(Row07_TriggerTimes, ABoxThrownBack)
{
    Scene scene(weightless());
    add(scene, {.type = BodyType::Kinematic, .position = {2, 0}, .velocity = {-5, 0}}, box(0.5f, 1),
        {.friction = 0, .restitution = 1});
    add_static(scene, Segment{{0.9f, -1}, {0.9f, 1}}, {.trigger = true});
    add_dynamic(scene, {0, 0}, box(0.1f, 0.1f), {.friction = 0, .restitution = 1}, {20, 0});
    const Passages seen = watch(scene, 6);
    // The line lies in the box while its center is between 0.8 m and 1 m. They meet at 25 m/s and 1.12 m; back it goes at 30 m/s.
    const double meet = 1.4 / 25;
    expect_times(seen.enters, {0.8 / 20, meet + 0.12 / 30}, 1e-6, "enter");
    expect_times(seen.exits, {1.0 / 20, meet + 0.32 / 30}, 1e-6, "exit");
}

// A slanted wall throws the ball aside, into a trigger that was not on its way when the step began; or the ball carries the trigger.
TEST(Row07_TriggerTimes, BeyondTheWayTheBodySetOutOn)
{
    for (const bool carried : {false, true})
    {
        SCOPED_TRACE(carried);
        Scene scene(weightless());
        add_static(scene, box(0.5f, 0.5f, {1.5f, 0}, pi / 4),
                   {.friction = 0, .restitution = 1}); // its face: x - y = 1.5 - 0.7071
        const Thing ball = add_dynamic(scene, {0, -0.2}, Circle{.radius = 0.05f}, {.friction = 0, .restitution = 1}, {100, 0});
        if (carried)
            scene.create_shape(ball.body, Circle{.radius = 0.05f}, {.filter = ghost, .trigger = true});
        add_static(scene, box(0.2f, 0.01f, {0.78f, -0.7f}), {.filter = carried ? ghost : Filter{}, .trigger = !carried});
        const Passages seen = watch(scene, 3);
        ASSERT_EQ(seen.enters.size(), 1u);
        ASSERT_EQ(seen.exits.size(), 1u);
        EXPECT_LT(seen.exits[0], 1.0 / 60) << "all of it in the first step";
        const Position p = scene.body(ball.body).position();
        EXPECT_NEAR(scene.body(ball.body).velocity().y, -100, 1e-2) << "thrown downwards";
        // Backwards from where it is now.
        const double end = 3.0 / 60;
        EXPECT_NEAR(seen.enters[0], end - (-0.7 + 0.06 - p.y) / 100, 1e-6);
        EXPECT_NEAR(seen.exits[0], end - (-0.7 - 0.06 - p.y) / 100, 1e-6);
    }
}
