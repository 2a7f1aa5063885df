// Debug drawing calls what the options ask for, and nothing else.

#include "support/test_scene.h"

#include <map>

using namespace carom;
using namespace carom::test;

namespace {

class Counter : public DebugDraw
{
public:
    std::map<DrawRole, int> circles, capsules, polygons, arcs, lines, points;

    void circle(DrawRole role, Position, float, Rotation) override { ++circles[role]; }
    void capsule(DrawRole role, Position, Position, float, float) override { ++capsules[role]; }
    void polygon(DrawRole role, std::span<const Position>, float) override { ++polygons[role]; }
    void arc(DrawRole role, Position, float, float, float, float) override { ++arcs[role]; }
    void line(DrawRole role, Position, Position) override { ++lines[role]; }
    void point(DrawRole role, Position) override { ++points[role]; }

    [[nodiscard]] int all(DrawRole role)
    {
        return circles[role] + capsules[role] + polygons[role] + arcs[role] + lines[role] + points[role];
    }
};

DebugDrawOptions nothing() { return {.shapes = false, .joints = false, .triggers = false}; }

} // namespace

TEST(SceneDebugDraw, ShapesByTheirRole)
{
    Scene scene;
    add_static(scene, box(20, 0.5f, {0, -0.5f}));
    add_static(scene, Arc{.center = {0, 20}});
    add(scene, {.type = BodyType::Kinematic, .position = {5, 9}}, Capsule{});
    add_dynamic(scene, {0, 0.5}, Circle{});
    const Thing off = add_dynamic(scene, {8, 5}, Circle{});
    scene.body(off.body).set_enabled(false);
    add_static(scene, Circle{.center = {-8, 5}}, {.trigger = true});
    Counter draw;
    scene.debug_draw(draw);
    EXPECT_EQ(draw.polygons[DrawRole::StaticShape], 1);
    EXPECT_EQ(draw.arcs[DrawRole::StaticShape], 1);
    EXPECT_EQ(draw.capsules[DrawRole::KinematicShape], 1);
    EXPECT_EQ(draw.circles[DrawRole::AwakeShape], 1);
    EXPECT_EQ(draw.circles[DrawRole::DisabledShape], 1);
    EXPECT_EQ(draw.circles[DrawRole::Trigger], 1);
    EXPECT_EQ(draw.all(DrawRole::Contact), 0);
    EXPECT_EQ(draw.all(DrawRole::Box), 0);
    steps(scene, 200);
    Counter later;
    scene.debug_draw(later);
    EXPECT_EQ(later.circles[DrawRole::SleepingShape], 1);
    Counter none;
    scene.debug_draw(none, nothing());
    for (int role = 0; role <= static_cast<int>(DrawRole::Island); ++role)
        EXPECT_EQ(none.all(static_cast<DrawRole>(role)), 0) << role;
}

TEST(SceneDebugDraw, EachOptionDrawsItsOwn)
{
    Scene scene(sleepless());
    add_static(scene, HalfSpace{});
    const Thing box_body = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f), {}, {1, 0});
    const Thing ball = add_dynamic(scene, {5, 3}, Circle{});
    scene.create_joint(SpringDef{.body_a = box_body.body, .body_b = ball.body, .stiffness = 1});
    steps(scene, 5);
    const auto drawn = [&](auto&& set, DrawRole role)
    {
        DebugDrawOptions options = nothing();
        set(options);
        Counter draw;
        scene.debug_draw(draw, options);
        return draw.all(role);
    };
    EXPECT_GT(drawn([](DebugDrawOptions& o) { o.joints = true; }, DrawRole::Joint), 0);
    EXPECT_GT(drawn([](DebugDrawOptions& o) { o.boxes = true; }, DrawRole::Box), 0);
    EXPECT_EQ(drawn([](DebugDrawOptions& o) { o.contacts = true; }, DrawRole::Contact), 2);
    EXPECT_GT(drawn([](DebugDrawOptions& o) { o.normals = true; }, DrawRole::ContactNormal), 0);
    EXPECT_GT(drawn([](DebugDrawOptions& o) { o.impulses = true; }, DrawRole::Impulse), 0);
    EXPECT_GT(drawn([](DebugDrawOptions& o) { o.friction = true; }, DrawRole::Friction), 0);
    EXPECT_EQ(drawn([](DebugDrawOptions& o) { o.velocities = true; }, DrawRole::Velocity), 2);
    EXPECT_EQ(drawn([](DebugDrawOptions& o) { o.centers = true; }, DrawRole::CenterOfMass), 2);
    EXPECT_GT(drawn([](DebugDrawOptions& o) { o.islands = true; }, DrawRole::Island), 0);
}

TEST(SceneDebugDraw, OnlyWhatTheViewShows)
{
    Scene scene(weightless());
    add_dynamic(scene, {0, 0}, Circle{});
    add_dynamic(scene, {100, 0}, Circle{});
    Counter draw;
    scene.debug_draw(draw, {.view = {{-5, -5}, {5, 5}}});
    EXPECT_EQ(draw.circles[DrawRole::AwakeShape], 1);
}
