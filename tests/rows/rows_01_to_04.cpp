// Rows 1 to 4: fixed steps, the table over shape pairs, the one-sided plane, contacts with points, normal and depth.

#include "support/test_scene.h"

#include "collision/manifold.h"

using namespace carom;
using namespace carom::test;

// --- 1: update ---------------------------------------------------------------------------------------------------------------------------

TEST(Row01_FixedTimestep, UpdateTakesAsManyStepsAsFit)
{
    SceneDef def;
    def.fixed_step = 0.01f;
    Scene scene(def);
    UpdateResult r = scene.update(0.025f);
    EXPECT_EQ(r.steps, 2);
    EXPECT_NEAR(r.alpha, 0.5, 1e-4);
    r = scene.update(0.005f);
    EXPECT_EQ(r.steps, 1);
    EXPECT_NEAR(r.alpha, 0, 1e-3);
    r = scene.update(0.001f);
    EXPECT_EQ(r.steps, 0);
    EXPECT_NEAR(r.alpha, 0.1, 1e-3);
    EXPECT_EQ(scene.step_count(), 3u);
    EXPECT_NEAR(scene.time(), 0.03, 1e-7);
}

TEST(Row01_FixedTimestep, TheAccumulatorIsCappedAndSaysSo)
{
    SceneDef def;
    def.fixed_step = 0.01f;
    def.max_frame_time = 0.1f;
    Scene scene(def);
    const UpdateResult r = scene.update(5);
    EXPECT_EQ(r.steps, 10);
    EXPECT_TRUE(scene.report().has(StepFlag::TimeDropped));
    EXPECT_EQ(scene.update(0.01f).steps, 1) << "what was dropped does not come back";
    EXPECT_FALSE(scene.report().has(StepFlag::TimeDropped));
}

TEST(Row01_FixedTimestep, ScenesHaveTheirOwnAccumulators)
{
    SceneDef def;
    def.fixed_step = 0.01f;
    Scene a(def);
    Scene b(def);
    EXPECT_EQ(a.update(0.009f).steps, 0);
    EXPECT_EQ(b.update(0.009f).steps, 0);
    EXPECT_EQ(a.update(0.002f).steps, 1);
    EXPECT_EQ(b.update(0.0005f).steps, 0);
}

TEST(Row01_FixedTimestep, AnHourOfFramesLosesNoStep)
{
    SceneDef def;
    def.fixed_step = 1.0f / 60;
    Scene scene(def);
    Random random(9);
    double given = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const float frame = random.rangef(0.001, 0.04);
        given += static_cast<double>(frame);
        const UpdateResult r = scene.update(frame);
        ASSERT_GE(r.alpha, 0);
        ASSERT_LE(r.alpha, 1);
        ASSERT_NEAR(scene.time() + static_cast<double>(r.alpha) / 60, given, 1e-3);
    }
}

TEST(Row01_FixedTimestep, InterpolatedPoseLiesBetweenTheLastTwoSteps)
{
    SceneDef def = weightless();
    def.fixed_step = 0.01f;
    Scene scene(def);
    const Thing body = add_dynamic(scene, {1, 2}, box(1, 1), {}, {10, -20}, 5);
    scene.update(0.01f);
    const Pose half = scene.body(body.body).interpolated_pose(0.5f);
    EXPECT_NEAR(half.position.x, 1.05, 1e-6);
    EXPECT_NEAR(half.position.y, 1.9, 1e-6);
    EXPECT_NEAR(half.rotation.angle(), 0.025, 1e-5);
    EXPECT_NEAR(half.rotation.c * half.rotation.c + half.rotation.s * half.rotation.s, 1, 1e-6);
    EXPECT_NEAR(scene.body(body.body).interpolated_pose(0).position.x, 1, 1e-7);
    EXPECT_NEAR(scene.body(body.body).interpolated_pose(1).position.x, 1.1, 1e-6);
    scene.body(body.body).teleport({50, 50}, 1);
    EXPECT_NEAR(scene.body(body.body).interpolated_pose(0.3f).position.x, 50, 1e-6) << "a teleport jumps";
}

TEST(Row01_FixedTimestep, ForcesBeforeUpdateActInAllItsSteps)
{
    SceneDef def = weightless();
    def.fixed_step = 0.01f;
    Scene scene(def);
    const Thing body = add_dynamic(scene, {}, Circle{});
    scene.body(body.body).apply_force({10, 0});
    EXPECT_EQ(scene.update(0.05f).steps, 5);
    EXPECT_NEAR(scene.body(body.body).velocity().x, 10 * 0.05 / static_cast<double>(scene.body(body.body).mass()), 1e-5);
    scene.update(0.05f);
    EXPECT_NEAR(scene.body(body.body).velocity().x, 10 * 0.05 / static_cast<double>(scene.body(body.body).mass()), 1e-5);
}

// A frame shorter than a step must not lose the force: it acts for the frame's time once there is a step.
TEST(Row01_FixedTimestep, ForcesWaitForAStep)
{
    SceneDef def = weightless();
    def.fixed_step = 0.01f;
    Scene scene(def);
    const Thing body = add_dynamic(scene, {}, Circle{});
    scene.body(body.body).apply_force({10, 0});
    EXPECT_EQ(scene.update(0.004f).steps, 0);
    EXPECT_EQ(scene.update(0.008f).steps, 1);
    EXPECT_NEAR(scene.body(body.body).velocity().x, 10 * 0.004 / static_cast<double>(scene.body(body.body).mass()), 1e-6);
}

// --- 2: the table ------------------------------------------------------------------------------------------------------------------------

TEST(Row02_CollisionTable, EveryPermutationThatCanMeetIsThere)
{
    using internal::LeafType;
    const auto moves = [](LeafType t)
    { return t == LeafType::Circle || t == LeafType::Polygon || t == LeafType::Capsule || t == LeafType::Segment; };
    for (int a = 0; a < internal::leaf_type_count; ++a)
        for (int b = 0; b < internal::leaf_type_count; ++b)
        {
            const bool can_meet = moves(static_cast<LeafType>(a)) || moves(static_cast<LeafType>(b));
            EXPECT_EQ(internal::collide_function(static_cast<LeafType>(a), static_cast<LeafType>(b)) != nullptr, can_meet)
                << a << ", " << b;
        }
    EXPECT_EQ(internal::collide_function(LeafType::HalfSpace, LeafType::HalfSpace), nullptr) << "plane and plane never collide";
}

TEST(Row02_CollisionTable, EveryPairOfShapesMeetsInBothOrders)
{
    struct Kind
    {
        const char* name;
        Geometry geometry;
        bool moves;
    };
    // Each has the point (0, 0) on its top side and is solid below it.
    const Kind kinds[] = {
        {"circle", Circle{.center = {0, -0.5f}}, true},
        {"polygon", box(0.5f, 0.5f, {0, -0.5f}), true},
        {"capsule", Capsule{{-0.5f, -0.25f}, {0.5f, -0.25f}}, true},
        {"segment", Segment{{0.5f, -0.1f}, {-0.5f, -0.1f}, 0.1f}, true},
        {"arc", Arc{.center = {0, -1.1f}, .radius = 1, .start_angle = 0.25f * pi, .sweep = 0.5f * pi, .half_thickness = 0.1f},
         false},
        {"chain", Chain{.start = {1, -0.1f}, .pieces = {{.end = {0.2f, -0.1f}}, {.end = {-1, -0.1f}}}, .half_thickness = 0.1f},
         false},
        {"half-space", HalfSpace{}, false},
    };
    for (const Kind& below : kinds)
        for (const Kind& above : kinds)
        {
            if (!above.moves && !below.moves)
                continue;
            for (const bool above_first : {false, true})
            {
                SCOPED_TRACE(std::string(above.name) + " on " + below.name + (above_first ? ", made first" : ""));
                // The upper one is turned upside down. Where it cannot move, the lower one rises against it.
                Scene scene(weightless());
                const BodyDef lower{.type = below.moves ? BodyType::Dynamic : BodyType::Static,
                                    .velocity = {0, above.moves ? 0.0f : 1.0f}};
                const BodyDef upper{.type = above.moves ? BodyType::Dynamic : BodyType::Static,
                                    .position = {0, 0.004},
                                    .angle = pi,
                                    .velocity = {0, -1}};
                const BodyId first = scene.create_body(above_first ? upper : lower);
                const BodyId second = scene.create_body(above_first ? lower : upper);
                const BodyId top = above_first ? first : second;
                const BodyId bottom = above_first ? second : first;
                scene.create_shape(first, above_first ? above.geometry : below.geometry, {.friction = 0, .restitution = 1});
                scene.create_shape(second, above_first ? below.geometry : above.geometry, {.friction = 0, .restitution = 1});
                int impacts = 0;
                Vec2 up{};
                for (int i = 0; i < 3; ++i)
                {
                    scene.step(1.0f / 60);
                    for (const ImpactEvent& hit : scene.impacts())
                    {
                        ++impacts;
                        up = hit.body_a == bottom ? hit.normal : -hit.normal;
                    }
                }
                EXPECT_GE(impacts, 1);
                EXPECT_NEAR(up.y, 1, 1e-3);
                const float apart = scene.body(top).velocity().y - scene.body(bottom).velocity().y;
                EXPECT_GT(apart, 0.5f) << "they part again";
            }
        }
}

// --- 3: the plane ------------------------------------------------------------------------------------------------------------------------

TEST(Row03_Plane, BlocksOnlyWhatMovesAgainstItsNormal)
{
    for (const Geometry& geometry :
         {Geometry{Circle{}}, Geometry{box(0.5f, 0.5f)}, Geometry{Capsule{{-0.5f, 0}, {0.5f, 0}, 0.5f, 0.5f}}})
    {
        SCOPED_TRACE(geometry.index());
        Scene scene(weightless());
        add_static(scene, HalfSpace{.normal = {0, 2}, .offset = 1});
        const Thing falls = add_dynamic(scene, {0, 5}, geometry, {}, {0, -8});
        const Thing rises = add_dynamic(scene, {5, 1.5}, geometry, {}, {0, 8});
        steps(scene, 60);
        EXPECT_NEAR(scene.body(falls.body).position().y, 1.5, 0.02);
        EXPECT_NEAR(scene.body(rises.body).velocity().y, 8, 1e-4);
        EXPECT_NEAR(scene.body(rises.body).position().y, 9.5, 1e-3);
    }
}

TEST(Row03_Plane, IsInfiniteAndTurns)
{
    Scene scene(sleepless());
    add(scene, {.angle = 0.5f}, HalfSpace{});
    const Thing far = add_dynamic(scene, {1e5 * std::cos(0.5), 1e5 * std::sin(0.5) + 1.0}, Circle{}, {.friction = 0});
    steps(scene, 30);
    const Position p = scene.body(far.body).position();
    EXPECT_GT(-std::sin(0.5) * p.x + std::cos(0.5) * p.y, 0.49) << "1e5 m away it still lies on the plane";
}

TEST(Row03_Plane, IsStaticOnly)
{
    Scene scene;
    for (const BodyType type : {BodyType::Dynamic, BodyType::Kinematic})
    {
        const BodyId body = scene.create_body({.type = type});
        EXPECT_THROW(scene.create_shape(body, HalfSpace{}), Error);
    }
}

// --- 4: contacts -------------------------------------------------------------------------------------------------------------------------

namespace {

const ContactInfo the_contact(const Scene& scene)
{
    const std::vector<ContactInfo> contacts = scene.contacts();
    return contacts.empty() ? ContactInfo{} : contacts[0];
}

} // namespace

TEST(Row04_Contacts, PlaneSphere)
{
    Scene scene(weightless());
    add_static(scene, HalfSpace{});
    const Thing ball = add_dynamic(scene, {2, 0.497}, Circle{});
    scene.step(1e-5f);
    const ContactInfo c = the_contact(scene);
    ASSERT_EQ(c.point_count, 1);
    EXPECT_NEAR(c.points[0].separation, -0.003, 1e-4);
    EXPECT_NEAR(c.points[0].position.x, 2, 1e-4);
    EXPECT_NEAR(c.points[0].position.y, 0, 4e-3);
    EXPECT_NEAR(c.shape_b == ball.shape ? c.normal.y : -c.normal.y, 1, 1e-5);
    EXPECT_TRUE(c.touching);
}

TEST(Row04_Contacts, PlaneBoxAndBoxBoxHaveTwoPoints)
{
    for (const bool plane : {true, false})
    {
        Scene scene(weightless());
        if (plane)
            add_static(scene, HalfSpace{});
        else
            add_static(scene, box(5, 0.5f, {0, -0.5f}));
        add_dynamic(scene, {1, 0.498}, box(0.75f, 0.5f));
        scene.step(1e-5f);
        const ContactInfo c = the_contact(scene);
        ASSERT_EQ(c.point_count, 2);
        EXPECT_NEAR(std::min(c.points[0].position.x, c.points[1].position.x), 0.25, 1e-3);
        EXPECT_NEAR(std::max(c.points[0].position.x, c.points[1].position.x), 1.75, 1e-3);
        EXPECT_NEAR(c.points[0].separation, -0.002, 1e-4);
        EXPECT_NEAR(c.points[1].separation, -0.002, 1e-4);
    }
}

TEST(Row04_Contacts, SphereSphereAndSphereBox)
{
    Scene scene(weightless());
    const Thing a = add_dynamic(scene, {0, 0}, Circle{});
    add_dynamic(scene, {0.3, 0.3 / 0.75}, Circle{.radius = 0.001f});
    const Thing b = add_dynamic(scene, {0.6 * 0.999, 0.8 * 0.999}, Circle{});
    scene.destroy(scene.bodies()[1]);
    scene.step(1e-6f);
    const ContactInfo c = the_contact(scene);
    ASSERT_EQ(c.point_count, 1);
    const float sign = c.shape_a == a.shape ? 1.0f : -1.0f;
    EXPECT_NEAR(sign * c.normal.x, 0.6, 1e-5);
    EXPECT_NEAR(sign * c.normal.y, 0.8, 1e-5);
    EXPECT_NEAR(c.points[0].separation, -0.001, 1e-5);
    EXPECT_NEAR(c.points[0].position.x, 0.3, 1e-3);
    static_cast<void>(b);
}

TEST(Row04_Contacts, ABoxOnItsCornerHasOnePoint)
{
    Scene scene(weightless());
    add_static(scene, box(5, 0.5f, {0, -0.5f}));
    add(scene, {.type = BodyType::Dynamic, .position = {0, std::sqrt(0.5) - 0.001}, .angle = 0.25f * pi}, box(0.5f, 0.5f));
    scene.step(1e-5f);
    const ContactInfo c = the_contact(scene);
    int deep = 0;
    for (int i = 0; i < c.point_count; ++i)
        deep += c.points[i].separation < 0.01f;
    EXPECT_EQ(deep, 1);
    EXPECT_NEAR(c.points[0].position.x, 0, 1e-3);
}

TEST(Row04_Contacts, PressureIsShared)
{
    // A box at rest: the two points carry its weight between them, and contacts of a body say so.
    Scene scene({.gravity = {0, -10}, .sleeping = false});
    add_static(scene, HalfSpace{});
    const Thing body = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f), {.density = 3});
    steps(scene, 240);
    const std::vector<ContactInfo> contacts = scene.body(body.body).contacts();
    ASSERT_EQ(contacts.size(), 1u);
    const double weight = 30.0 / 60;
    EXPECT_NEAR(contacts[0].points[0].normal_impulse + contacts[0].points[1].normal_impulse, weight, 0.01 * weight);
    EXPECT_NEAR(contacts[0].points[0].normal_impulse, weight / 2, 0.02 * weight);
}
