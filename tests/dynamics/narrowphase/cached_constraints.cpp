// Rows that are followed where they stand must come out as rows that are filled anew, whatever happens between steps.

#include "dynamics/world_pair.h"

#include <functional>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

// Pyramids, and a wall of boxes and capsules between two posts with a disc on it; on a box and on a line.
void build_piles(World& world)
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

class PilePair : public WorldPair
{
public:
    explicit PilePair(bool sleeps) : WorldPair(sleeps, build_piles) {}
};

struct Event
{
    const char* name;
    std::function<void(World&)> happens;
};

} // namespace

TEST(DynamicsKeptRows, AreThoseFilledAnew)
{
    PilePair pair(false);
    EXPECT_GT(pair.run(300), 150) << "or nothing has been tested";
    pair.run(90, 1.0f / 120); // until the longer steps are forgotten
    EXPECT_GT(pair.run(60, 1.0f / 120), 30) << "shorter steps";
    EXPECT_GT(pair.run(60, 1.0f / 25), 0) << "longer ones";
}

TEST(DynamicsKeptRows, FallAsleepAsTheyAre)
{
    PilePair pair(true);
    pair.run(1500);
    EXPECT_EQ(pair.followed().scene.report().awake_bodies, 0);
    pair.both([](World& w) { w.scene.body(w.bodies[3]).apply_impulse({0, 300}); });
    pair.run(60);
}

TEST(DynamicsKeptRows, SeeWhatHappensBetweenSteps)
{
    const auto body = [](World& w, std::size_t i) { return w.scene.body(w.bodies[i]); };
    const auto shape = [&](World& w, std::size_t i) { return w.scene.shape(body(w, i).shapes()[0]); };
    const std::vector<Event> events = {
        {"impulse", [&](World& w) { body(w, 20).apply_impulse({5, 0}); }},
        {"velocity", [&](World& w) { body(w, 21).set_velocity({0.5f, 0}); }},
        {"teleport", [&](World& w) { body(w, 120).teleport({18, 12}, 0.3f); }},
        {"gravity", [&](World& w) { w.scene.set_gravity({0.5f, -9.81f}); }},
        {"destroyed", [&](World& w) { w.scene.destroy(w.bodies[154]); }}, // the top of a pyramid
        {"friction", [&](World& w) { shape(w, 30).set_def({.friction = 0.1f}); }},
        {"filter", [&](World& w) { shape(w, 30).set_def({.friction = 0.6f, .filter = {.mask = 0}}); }},
        {"conveyor", [&](World& w) { shape(w, 32).set_def({.friction = 0.6f, .surface_speed = 1}); }},
        {"geometry", [&](World& w) { shape(w, 33).set_geometry(box(0.4f, 0.5f)); }},
        {"mass", [&](World& w) { body(w, 31).set_mass({.mass = 900, .inertia = 200}); }},
        {"center", [&](World& w) { body(w, 31).set_mass({.mass = 900, .center = {0, 0.2f}, .inertia = 200}); }},
        {"locks", [&](World& w) { body(w, 31).set_locks({.angular = true}); }},
        {"disabled", [&](World& w) { body(w, 33).set_enabled(false); }},
        {"kinematic", [&](World& w) { body(w, 34).set_type(BodyType::Kinematic); }},
        {"asleep", [&](World& w) { body(w, 3).set_awake(false); }},
        {"new body", [&](World& w) { add_dynamic(w.scene, {-11, 13.5}, box(0.4f, 0.4f)); }},
        {"joint", [&](World& w) { w.scene.create_joint(DistanceDef{.body_a = w.bodies[5], .body_b = w.bodies[6]}); }},
    };
    for (const Event& event : events)
    {
        SCOPED_TRACE(event.name);
        PilePair pair(false);
        pair.run(100);
        ASSERT_TRUE(pair.constraints_are_unchanged()) << "or nothing is tested";
        pair.both(event.happens);
        expect_same_contacts(pair.followed(), pair.anew(), "before the step");
        pair.run(30);
    }
}

TEST(DynamicsKeptRows, OfAnotherPastAreNotTaken)
{
    World world(false);
    build_piles(world);
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
