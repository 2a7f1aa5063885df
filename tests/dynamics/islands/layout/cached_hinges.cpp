// Wide hinges that are followed where they stand must come out as hinges that are filled anew, whatever happens between steps.

#include "dynamics/world_pair.h"

#include <functional>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr int sheet_columns = 24;
constexpr int sheet_rows = 16;

// A sheet of discs that do not touch. It hangs from a rail, a static body; hinges of its last column are driven, sprung or limited.
void build_hinged(World& world)
{
    world.ground = add_static(world.scene, box(20, 0.1f, {0, 40}), {.filter = {2, 4}}).body;
    for (int i = 0; i < sheet_columns * sheet_rows; ++i)
    {
        const Position at{static_cast<double>(i % sheet_columns), 30.0 - i / sheet_columns};
        world.bodies.push_back(add_dynamic(world.scene, at, Circle{.radius = 0.2f}, {.filter = {2, 4}}).body);
        const auto hinge = [&](BodyId a, Position anchor)
        {
            const bool last = i % sheet_columns + 1 == sheet_columns;
            world.scene.create_joint(RevoluteDef{.body_a = a,
                                                 .body_b = world.bodies.back(),
                                                 .anchor_a = anchor - world.scene.body(a).position(),
                                                 .anchor_b = anchor - at,
                                                 .enable_limit = last && i % 3 == 0,
                                                 .lower_angle = -0.2f,
                                                 .upper_angle = 0.2f,
                                                 .enable_motor = last && i % 3 == 1,
                                                 .motor_speed = 1,
                                                 .max_motor_torque = 0.1f,
                                                 .spring_hertz = last && i % 3 == 2 ? 2.0f : 0.0f,
                                                 .spring_damping_ratio = 0.3f});
        };
        if (i % sheet_columns > 0)
            hinge(world.bodies[static_cast<std::size_t>(i - 1)], {at.x - 0.5, at.y});
        if (i >= sheet_columns)
            hinge(world.bodies[static_cast<std::size_t>(i - sheet_columns)], {at.x, at.y + 0.5});
        else
            hinge(world.ground, {at.x, at.y + 0.5});
    }
}

class HingedPair : public WorldPair
{
public:
    HingedPair() : WorldPair(false, build_hinged) {}

    // How many of the steps were taken with hinges in place.
    int run(int steps_taken, float dt = 1.0f / 60)
    {
        int stayed = 0;
        for (int i = 0; i < steps_taken; ++i)
        {
            WorldPair::run(1, dt);
            stayed += hinges_are_unchanged() ? 1 : 0;
        }
        return stayed;
    }
};

} // namespace

TEST(DynamicsKeptHinges, AreThoseFilledAnew)
{
    HingedPair pair;
    EXPECT_GT(pair.run(100), 90) << "or nothing has been tested";
    EXPECT_GT(pair.run(20, 1.0f / 40), 15) << "longer steps";
    pair.run(60, 1.0f / 80); // until the longer ones are forgotten
    EXPECT_GT(pair.run(20, 1.0f / 80), 15) << "shorter ones";
}

TEST(DynamicsKeptHinges, SeeWhatHappensBetweenSteps)
{
    struct Event
    {
        const char* name;
        std::function<void(World&)> happens;
    };
    const auto body = [](World& w, std::size_t i) { return w.scene.body(w.bodies[i]); };
    const auto joint = [&](World& w, std::size_t i) { return w.scene.joint(body(w, i).joints()[0]); };
    const auto change = [&](World& w, std::size_t i, const std::function<void(RevoluteDef&)>& how)
    {
        auto def = std::get<RevoluteDef>(joint(w, i).def());
        how(def);
        joint(w, i).set_def(def);
    };
    const std::vector<Event> events = {
        {"impulse", [&](World& w) { body(w, 100).apply_impulse({5, 3}); }},
        {"teleport", [&](World& w) { body(w, 120).teleport(body(w, 120).position() + Vec2{0.1f, 0}, 0.3f); }},
        {"anchor", [&](World& w) { change(w, 60, [](RevoluteDef& d) { d.anchor_a.x += 0.05f; }); }},
        {"motor", [&](World& w) { change(w, 61, [](RevoluteDef& d) { d.enable_motor = true, d.max_motor_torque = 2; }); }},
        {"no motor", [&](World& w) { change(w, sheet_columns - 2, [](RevoluteDef& d) { d.enable_motor = false; }); }},
        {"motor speed", [&](World& w) { change(w, 2 * sheet_columns - 1, [](RevoluteDef& d) { d.motor_speed = 3; }); }},
        {"restitution", [&](World& w) { change(w, 60, [](RevoluteDef& d) { d.limit_restitution = 0.5f; }); }},
        {"mass", [&](World& w) { body(w, 200).set_mass({.mass = 3, .inertia = 0.2f}); }},
        {"center", [&](World& w) { body(w, 200).set_mass({.mass = 3, .center = {0.05f, 0}, .inertia = 0.2f}); }},
        {"shape", [&](World& w) { w.scene.create_shape(w.bodies[201], Circle{{0.1f, 0}, 0.15f}, {.filter = {2, 4}}); }},
        {"locks", [&](World& w) { body(w, 202).set_locks({.angular = true}); }},
        {"uneven locks", [&](World& w) { body(w, 202).set_locks({.linear_x = true}); }},
        {"gravity", [&](World& w) { w.scene.set_gravity({1, -5}); }},
        {"joint destroyed", [&](World& w) { w.scene.destroy(body(w, 210).joints()[0]); }},
        {"new joint", [&](World& w)
         { w.scene.create_joint(RevoluteDef{.body_b = w.bodies[211], .anchor_a = {20, 20}, .anchor_b = {0, 0.5f}}); }},
        {"body destroyed", [&](World& w) { w.scene.destroy(w.bodies[250]); }},
        {"kinematic", [&](World& w) { body(w, 34).set_type(BodyType::Kinematic); }},
        {"asleep", [&](World& w) { body(w, 3).set_awake(false); }},
        {"disabled", [&](World& w) { body(w, 33).set_enabled(false); }},
        {"rail elsewhere", [&](World& w) { w.scene.body(w.ground).teleport({0.05, 40}, 0); }},
        {"no rail", [&](World& w) { w.scene.body(w.ground).set_enabled(false); }},
        {"moving rail",
         [&](World& w)
         {
             w.scene.body(w.ground).set_type(BodyType::Kinematic);
             w.scene.body(w.ground).set_velocity({0.2f, 0});
         }},
        {"something to land on", [&](World& w) { add_static(w.scene, box(20, 0.5f, {0, 14.2f})); }},
    };
    for (const Event& event : events)
    {
        SCOPED_TRACE(event.name);
        HingedPair pair;
        ASSERT_GT(pair.run(20), 15) << "or nothing is tested";
        pair.both(event.happens);
        pair.run(10);
        if (std::string(event.name) == "no rail")
            pair.both([](World& w) { w.scene.body(w.ground).set_enabled(true); });
        pair.run(10);
    }
}

TEST(DynamicsKeptHinges, OfAnotherPastAreNotTaken)
{
    World world(false);
    build_hinged(world);
    steps(world.scene, 30);
    const internal::SceneState first = world.scene.data().state;
    steps(world.scene, 10);
    const std::uint64_t hash_after = world.scene.state_hash();
    world.scene.data().state = first;
    world.scene.body(world.bodies[20]).apply_impulse({3, 0}); // another way to the same step
    steps(world.scene, 10);
    EXPECT_NE(world.scene.state_hash(), hash_after);
    world.scene.data().state = first;
    steps(world.scene, 10);
    EXPECT_EQ(world.scene.state_hash(), hash_after);
}
