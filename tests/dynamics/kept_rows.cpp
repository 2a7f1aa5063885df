// Rows that are followed where they stand must come out as rows that are filled anew, whatever happens between steps.

#include "dynamics/scene_data.h"
#include "support/test_scene.h"

#include <functional>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

struct World
{
    explicit World(bool sleeps) : scene(SceneDef{.sleeping = sleeps}) {}

    Scene scene;
    BodyId ground{};
    std::vector<BodyId> bodies{};
};

// Boxes, rounded boxes, capsules and discs in layers that hold each other, on ground of a box, a line and a chain.
void build(World& world)
{
    world.ground = add_static(world.scene, box(8, 0.5f, {-9, -0.5f}), {.friction = 0.6f}).body;
    world.scene.create_shape(world.ground, Segment{{-1, 0}, {30, 0}}, {.friction = 0.6f});
    const auto add = [&](double x, double y, const Geometry& geometry)
    { world.bodies.push_back(add_dynamic(world.scene, {x, y}, geometry, {.friction = 0.6f}).body); };
    for (int row = 0; row < 12; ++row)
    {
        for (int i = 0; i < 12 - row; ++i)
        {
            add(-15 + 1.05 * i + 0.525 * row, 0.5 + row, box(0.5f, 0.5f));
            add(0 + 1.05 * i + 0.525 * row, 0.5 + row, box(0.5f, 0.5f));
        }
    }
    for (int row = 0; row < 8; ++row)
    {
        for (int i = 0; i < 10; ++i)
        {
            const double x = 14 + i + 0.1 * (row % 2);
            const double y = 0.3 + 0.6 * row;
            if (row % 4 == 2)
                add(x, y, Capsule{{-0.15f, 0}, {0.15f, 0}, 0.3f, 0.3f});
            else
                add(x, y, box(0.5f, 0.3f));
        }
    }
    add_static(world.scene, box(0.5f, 3, {13, 3}));
    add_static(world.scene, box(0.5f, 3, {24.4f, 3}));
    add(20, 5.2, Circle{.radius = 0.3f});
}

struct Event
{
    int step;
    std::function<void(World&)> happens;
};

void expect_same_contacts(const World& a, const World& b, const std::string& when)
{
    const std::vector<ContactInfo> of_a = a.scene.contacts();
    const std::vector<ContactInfo> of_b = b.scene.contacts();
    ASSERT_EQ(of_a.size(), of_b.size()) << when;
    for (std::size_t i = 0; i < of_a.size(); ++i)
    {
        ASSERT_EQ(of_a[i].normal, of_b[i].normal) << when;
        ASSERT_EQ(of_a[i].point_count, of_b[i].point_count) << when;
        ASSERT_EQ(of_a[i].color, of_b[i].color) << when;
        for (int p = 0; p < of_a[i].point_count; ++p)
        {
            ASSERT_EQ(of_a[i].points[p].position, of_b[i].points[p].position) << when << ", contact " << i;
            ASSERT_EQ(of_a[i].points[p].separation, of_b[i].points[p].separation) << when << ", contact " << i;
            ASSERT_EQ(of_a[i].points[p].normal_impulse, of_b[i].points[p].normal_impulse) << when << ", contact " << i;
        }
    }
}

// How many steps were taken with rows in place.
int expect_same_runs(bool sleeps, const std::vector<Event>& events, int steps_taken)
{
    World followed(sleeps);
    World anew(sleeps);
    build(followed);
    build(anew);
    int stayed = 0;
    for (int i = 0; i < steps_taken; ++i)
    {
        for (const Event& event : events)
        {
            if (event.step != i)
                continue;
            event.happens(followed);
            event.happens(anew);
        }
        anew.scene.data().state.rows_stamp = 0; // what is in the rows is another state's
        const std::string when = "step " + std::to_string(i);
        followed.scene.step(1.0f / 60);
        anew.scene.step(1.0f / 60);
        stayed += followed.scene.data().scratch.kept_units.rows_stay ? 1 : 0;
        EXPECT_FALSE(anew.scene.data().scratch.kept_units.rows_stay);
        EXPECT_EQ(followed.scene.state_hash(), anew.scene.state_hash()) << when;
        EXPECT_EQ(followed.scene.report().touching, anew.scene.report().touching) << when;
        EXPECT_EQ(followed.scene.report().pairs, anew.scene.report().pairs) << when;
        if (i % 10 == 0)
            expect_same_contacts(followed, anew, when);
        if (testing::Test::HasFailure())
            break;
    }
    return stayed;
}

} // namespace

TEST(DynamicsKeptRows, AreThoseFilledAnew) { EXPECT_GT(expect_same_runs(false, {}, 300), 150) << "or nothing has been tested"; }

TEST(DynamicsKeptRows, FallAsleepAsTheyAre)
{
    expect_same_runs(true, {{600, [](World& w) { w.scene.body(w.bodies[3]).apply_impulse({0, 300}); }}}, 700);
}

TEST(DynamicsKeptRows, SeeWhatHappensBetweenSteps)
{
    const auto body = [](World& w, std::size_t i) { return w.scene.body(w.bodies[i]); };
    const std::vector<Event> events = {
        {100, [&](World& w) { body(w, 20).apply_impulse({5, 0}); }},
        {120, [&](World& w) { body(w, 21).set_velocity({0.5f, 0}); }},
        {140, [&](World& w) { body(w, 120).teleport({18, 12}, 0.3f); }},
        {180, [&](World& w) { w.scene.set_gravity({0.5f, -9.81f}); }},
        {205, [&](World& w) { w.scene.destroy(w.bodies[154]); }}, // from the top of a pyramid
        {210, [&](World& w) { w.scene.destroy(w.bodies[155]); }},
        {220, [&](World& w) { w.scene.shape(body(w, 30).shapes()[0]).set_def({.friction = 0.1f}); }},
        {240, [&](World& w) { body(w, 31).set_mass({.mass = 900, .inertia = 200}); }},
        {260, [&](World& w) { w.scene.shape(body(w, 32).shapes()[0]).set_def({.friction = 0.6f, .surface_speed = 1}); }},
        {280, [&](World& w) { body(w, 33).set_enabled(false); }},
        {300, [&](World& w) { body(w, 33).set_enabled(true); }},
        {320, [&](World& w) { add_dynamic(w.scene, {-11, 12}, box(0.4f, 0.4f)); }},
        {400, [&](World& w) { body(w, 34).set_type(BodyType::Kinematic); }},
        {420, [&](World& w) { body(w, 34).set_type(BodyType::Dynamic); }},
        {440, [&](World& w) { w.scene.create_joint(DistanceDef{.body_a = w.bodies[5], .body_b = w.bodies[6]}); }},
    };
    EXPECT_GT(expect_same_runs(false, events, 500), 100) << "or nothing has been tested";
}

TEST(DynamicsKeptRows, OfAnotherPastAreNotTaken)
{
    World world(false);
    build(world);
    steps(world.scene, 120);
    const auto run_on = [&](int count)
    {
        for (int i = 0; i < count; ++i)
            world.scene.step(1.0f / 60);
    };
    run_on(30);
    const internal::SceneState first = world.scene.data().state;
    const std::uint64_t hash_before = world.scene.state_hash();
    run_on(10);
    const std::uint64_t hash_after = world.scene.state_hash();
    world.scene.data().state = first;
    ASSERT_EQ(world.scene.state_hash(), hash_before);
    world.scene.body(world.bodies[20]).apply_impulse({3, 0}); // another way to the same step
    run_on(10);
    EXPECT_NE(world.scene.state_hash(), hash_after);
    world.scene.data().state = first;
    run_on(10);
    EXPECT_EQ(world.scene.state_hash(), hash_after);
}
