// In a crowd that churns the rows of the largest unit stand while contacts come and go: they must come out as rows that are laid out and filled anew in
// every step.

#include "dynamics/world_pair.h"

#include <algorithm>
#include <functional>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

void add_some(World& world, int i, Position at)
{
    const ShapeDef def{
        .friction = 0.5f, .restitution = i % 11 == 0 ? 0.5f : 0.0f, .rolling_resistance = i % 31 == 0 ? 0.1f : 0.0f};
    const auto add = [&](const Geometry& geometry) { world.bodies.push_back(add_dynamic(world.scene, at, geometry, def).body); };
    if (i % 5 == 0)
        add(Circle{.radius = 0.2f});
    else if (i % 5 == 1)
        add(Capsule{{-0.15f, 0}, {0.15f, 0}, 0.15f, 0.15f});
    else
        add(box(0.25f, 0.2f));
}

// A drum that a kinematic body turns, or a motor, with a crowd in it.
void build(World& world, bool has_motor)
{
    world.ground = world.scene.create_body({});
    const BodyId drum =
        world.scene.create_body({.type = has_motor ? BodyType::Dynamic : BodyType::Kinematic, .angular_velocity = 0.5f});
    for (const Vec2 side : {Vec2{6.5f, 0}, Vec2{-6.5f, 0}})
        world.scene.create_shape(drum, box(0.5f, 7, side), {.friction = 0.6f});
    for (const Vec2 side : {Vec2{0, 6.5f}, Vec2{0, -6.5f}})
        world.scene.create_shape(drum, box(7, 0.5f, side), {.friction = 0.6f});
    if (has_motor)
        world.scene.create_joint(RevoluteDef{
            .body_a = world.ground, .body_b = drum, .enable_motor = true, .motor_speed = 0.5f, .max_motor_torque = 1e8f});
    for (int i = 0; i < 520; ++i)
        add_some(world, i, {-5.2 + 0.53 * (i % 20), -5.4 + 0.42 * (i / 20)});
}

WorldPair drum(bool has_motor)
{
    return WorldPair(false, [&](World& w) { build(w, has_motor); });
}

} // namespace

TEST(DynamicsStandingRows, AreThoseFilledAnew)
{
    for (const bool has_motor : {false, true})
    {
        WorldPair pair = drum(has_motor);
        pair.run(160);
        EXPECT_GT(pair.steps_stood(), 100) << "or nothing has been tested";
    }
}

TEST(DynamicsStandingRows, NameStatesOfTheirOwnUnit)
{
    World world(false);
    build(world, false);
    add_dynamic(world.scene, {0, 9}, Circle{.radius = 0.3f}, {.restitution = 0.9f}); // bounces on the drum, from outside
    int stood = 0;
    for (int i = 0; i < 150; ++i)
    {
        world.scene.step(1.0f / 60);
        const internal::Scratch& scratch = world.scene.data().scratch;
        for (const internal::Unit& unit : scratch.units)
        {
            for (std::int32_t g = 0; unit.stands && g < unit.wide_count; ++g)
            {
                const internal::WideRow& row = scratch.wide_rows[static_cast<std::size_t>(g)];
                for (int lane = 0; lane < internal::lane_count; ++lane)
                {
                    ASSERT_GE(std::min(row.a.v[lane], row.b.v[lane]), unit.first_state) << "step " << i;
                    ASSERT_LT(std::max(row.a.v[lane], row.b.v[lane]), unit.first_state + unit.state_count) << "step " << i;
                }
            }
            stood += unit.stands ? 1 : 0;
        }
    }
    EXPECT_GT(stood, 60);
}

TEST(DynamicsStandingRows, SeeWhatHappensBetweenSteps)
{
    const auto body = [](World& w, std::size_t i) { return w.scene.body(w.bodies[i]); };
    const auto shape = [&](World& w, std::size_t i) { return w.scene.shape(body(w, i).shapes()[0]); };
    std::size_t at = 0;
    const std::vector<std::function<void(World&)>> events = {
        [&](World& w) { body(w, at).apply_impulse({30, 40}); },
        [&](World& w) { body(w, at).set_velocity({-60, 20}); },
        [&](World& w) { body(w, at).teleport({0, 4.5}, 0.3f); },
        [&](World& w) { w.scene.set_gravity({2, -9.81f}); },
        [&](World& w) { shape(w, at).set_def({.friction = 0.1f}); },
        [&](World& w) { shape(w, at).set_def({.friction = 0.6f, .surface_speed = 1}); },
        [&](World& w) { shape(w, at).set_def({.friction = 0.6f, .filter = {.mask = 2}}); },
        [&](World& w) { shape(w, at).set_geometry(box(0.2f, 0.3f)); },
        [&](World& w) { body(w, at).set_mass({.mass = 90, .inertia = 20}); },
        [&](World& w) { body(w, at).set_mass({.mass = 90, .center = {0.05f, 0}, .inertia = 20}); },
        [&](World& w) { body(w, at).set_enabled(false); },
        [&](World& w) { body(w, at).set_type(BodyType::Static); },
        [&](World& w) { body(w, at).set_type(BodyType::Kinematic); },
        [&](World& w) { body(w, at).set_awake(false); },
        [&](World& w) { w.scene.destroy(w.bodies[at]); },
        [&](World& w) { add_some(w, 3, {0, 5}); },
        [&](World& w) { w.scene.create_joint(DistanceDef{.body_a = w.bodies[at], .body_b = w.bodies[at + 1]}); },
        [&](World& w) { body(w, at).set_locks({.angular = true}); },
        [&](World& w) { body(w, at).set_locks({}); },
    };
    WorldPair pair = drum(false);
    pair.run(70);
    for (std::size_t i = 0; i < 2 * events.size(); ++i)
    {
        SCOPED_TRACE(i % events.size());
        at = 20 + 12 * i;
        pair.both(events[i % events.size()]);
        pair.run(3);
    }
    EXPECT_GT(pair.steps_stood(), 60);
}
