// Values out of range: enumerations, times, masses, points, ids that were never given, a scene that was moved from.

#include "contracts/contract.h"

#include <cfenv>
#include <thread>
#include <utility>
#include <vector>

using namespace carom;
using namespace carom::test;

TEST_F(Contract, ValuesThatNoEnumerationHas)
{
    body_refused({.type = static_cast<BodyType>(7)}, "type");
    verb_refused("Body::set_type", "type", [](Body body) { body.set_type(static_cast<BodyType>(3)); });
    geometry_refused(Segment{.a = {0, 0}, .b = {1, 0}, .sides = static_cast<Sides>(9)}, "sides", fixed.body);
    geometry_refused(Arc{.radius = 1, .sides = static_cast<Sides>(9)}, "sides", fixed.body);
    geometry_refused(Chain{.start = {}, .pieces = {{.end = {1, 0}}}, .sides = static_cast<Sides>(9)}, "sides", fixed.body);
    EXPECT_THROW(Scene({.friction_rule = static_cast<MixRule>(50)}), Error);
    EXPECT_THROW(Scene({.restitution_rule = static_cast<MixRule>(50)}), Error);
}

TEST_F(Contract, TimesThatNoStepCanTake)
{
    for (const float h : {1e-38f, 1e-10f, 11.0f, 1e10f})
        refused([&] { scene.step(h); }, {"Scene::step", "h"});
    for (const float h : {1e-30f, 1e-6f, 1e3f})
        EXPECT_THROW(Scene({.fixed_step = h}), Error);
    scene.step(1e-9f);
    scene.step(1);
}

TEST_F(Contract, MassesWhoseInverseIsNoNumber)
{
    for (const float bad : {1e-45f, 1e-37f, 1e37f})
    {
        verb_refused("Body::set_mass", "mass", [&](Body body) { body.set_mass({bad, {}, 1}); });
        verb_refused("Body::set_mass", "inertia", [&](Body body) { body.set_mass({1, {}, bad}); });
    }
}

TEST_F(Contract, PointsThatAreNone)
{
    for (const float bad : {not_a_number, infinite})
    {
        verb_refused("Body::world_point", "local", [&](Body body) { static_cast<void>(body.world_point({bad, 0})); });
        verb_refused("Body::local_point", "world",
                     [&](Body body) { static_cast<void>(body.local_point({0, static_cast<double>(bad)})); });
    }
}

TEST_F(Contract, IdsThatWereNeverGiven)
{
    for (const std::uint32_t slot : {0u, 0x7fffffffu, 0x80000000u, 0x80000001u, 0xffffffffu})
    {
        BodyId id;
        id.slot = slot;
        id.generation = 1;
        EXPECT_FALSE(scene.is_valid(id));
        refused([&] { static_cast<void>(scene.body(id).position()); }, {"Scene::body"});
    }
}

TEST_F(Contract, AMovedFromSceneIsEmpty)
{
    const std::size_t count = scene.bodies().size();
    Scene other = std::move(scene);
    EXPECT_EQ(other.bodies().size(), count);
    EXPECT_EQ(scene.bodies().size(), 0u);
    scene.step(0.1f);
    const BodyId body = scene.create_body({});
    EXPECT_TRUE(scene.is_valid(body));
    scene = std::move(other);
    EXPECT_EQ(scene.bodies().size(), count);
    EXPECT_EQ(other.bodies().size(), 0u);
    other.step(0.1f);
    scene.step(0.1f);
}

// The rounding modes of the calling thread and of the workers.
TEST_F(Contract, TheRoundingModeOfTheProgramChangesNothing)
{
    std::vector<BodyDef> defs;
    for (int i = 0; i < 200; ++i)
        defs.push_back(
            {.type = BodyType::Dynamic, .position = {0.3 * (i % 20), 3 + 0.7 * (i / 20)}, .angle = 0.1f * static_cast<float>(i)});
    const auto run = [&](int mode)
    {
        const int before = std::fegetround();
        std::fesetround(mode);
        SceneDef def;
        def.tasks.worker_count = 2;
        def.tasks.run = [](void*, int count, void (*task)(void*, int), void* context)
        {
            const auto every_other = [&](int first)
            {
                for (int i = first; i < count; i += 2)
                    task(context, i);
            };
            std::thread other(every_other, 0); // which inherits the mode
            every_other(1);
            other.join();
        };
        Scene s{def};
        add_static(s, box(10, 0.5f));
        for (const BodyDef& of : defs)
        {
            const BodyId body = s.create_body(of);
            s.create_shape(body, Polygon{.vertices = {{0.3f, 0}, {0.1f, 0.31f}, {-0.37f, 0.1f}, {-0.1f, -0.3f}}},
                           {.density = 0.7f});
            s.body(body).apply_impulse({0.1f, 0.3f}, of.position);
        }
        s.create_joint(RevoluteDef{.body_a = s.bodies()[1], .body_b = s.bodies()[2], .anchor_a = {0.1f, 0.2f}});
        steps(s, 60);
        EXPECT_EQ(std::fegetround(), mode);
        std::fesetround(before);
        return s.state_hash();
    };
    const std::uint64_t nearest = run(FE_TONEAREST);
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
        EXPECT_EQ(run(mode), nearest);
}
