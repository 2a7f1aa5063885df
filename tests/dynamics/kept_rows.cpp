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

// Pyramids, and a wall of boxes and capsules between two posts with a disc on it; on a box and on a line.
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

// Two worlds alike, of which the second never keeps rows.
class Pair
{
public:
    explicit Pair(bool sleeps) : m_followed(sleeps), m_anew(sleeps)
    {
        build(m_followed);
        build(m_anew);
    }

    template <class Happens>
    void both(const Happens& happens)
    {
        happens(m_followed);
        happens(m_anew);
    }

    // How many of the steps were taken with rows in place.
    int run(int steps_taken, float dt = 1.0f / 60)
    {
        int stayed = 0;
        for (int i = 0; i < steps_taken && !testing::Test::HasFailure(); ++i)
        {
            m_anew.scene.data().state.rows_stamp = 0; // what is in the rows is another state's
            both([dt](World& w) { w.scene.step(dt); });
            stayed += rows_stay() ? 1 : 0;
            const std::string when = "step " + std::to_string(m_followed.scene.step_count());
            EXPECT_FALSE(m_anew.scene.data().scratch.kept_units.rows_stay);
            EXPECT_EQ(m_followed.scene.state_hash(), m_anew.scene.state_hash()) << when;
            EXPECT_EQ(m_followed.scene.report().touching, m_anew.scene.report().touching) << when;
            EXPECT_EQ(m_followed.scene.report().pairs, m_anew.scene.report().pairs) << when;
            if (i % 10 == 0)
                expect_same_contacts(m_followed, m_anew, when);
        }
        return stayed;
    }

    [[nodiscard]] bool rows_stay() { return m_followed.scene.data().scratch.kept_units.rows_stay; }
    [[nodiscard]] const World& followed() const { return m_followed; }
    [[nodiscard]] const World& anew() const { return m_anew; }

private:
    World m_followed;
    World m_anew;
};

struct Event
{
    const char* name;
    std::function<void(World&)> happens;
};

} // namespace

TEST(DynamicsKeptRows, AreThoseFilledAnew)
{
    Pair pair(false);
    EXPECT_GT(pair.run(300), 150) << "or nothing has been tested";
    EXPECT_GT(pair.run(60, 1.0f / 120), 30) << "shorter steps";
    EXPECT_GT(pair.run(30, 1.0f / 25), 0) << "longer ones";
}

TEST(DynamicsKeptRows, FallAsleepAsTheyAre)
{
    Pair pair(true);
    pair.run(900);
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
        Pair pair(false);
        pair.run(100);
        ASSERT_TRUE(pair.rows_stay()) << "or nothing is tested";
        pair.both(event.happens);
        expect_same_contacts(pair.followed(), pair.anew(), "before the step");
        pair.run(30);
    }
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
