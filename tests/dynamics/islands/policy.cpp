// Where island sizes decide how islands are solved today, and that every choice can be made the other way without a scene coming to something else.

#include "support/test_scene.h"

#include "dynamics/islands/policy.h"
#include "dynamics/state/scene_data.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;
using internal::choose_policy;
using internal::ForcedPolicy;
using internal::IslandPolicy;
using internal::IslandTally;

namespace {

constexpr float dt = 1.0f / 60;

IslandPolicy policy_of(const IslandTally& island, const ForcedPolicy& forced = {})
{
    return choose_policy(island, false, dt, SceneDef{}.most_passes, forced);
}
IslandPolicy of_bodies(int bodies) { return policy_of({.bodies = bodies, .contacts = bodies}); }
IslandPolicy of_joints(int bodies, int joints) { return policy_of({.bodies = bodies, .joints = joints, .hangs = true}); }

// --- the cliffs -----------------------------------------------------------------------------------------------------------------------

TEST(DynamicsPolicy, FromTheSeventeenthBodyOnContactsAreSolvedAsInAPile)
{
    const IslandPolicy few = of_bodies(16);
    EXPECT_TRUE(few.recomputes_contacts && few.converges && few.exact_impacts && few.conserves_energy);
    EXPECT_FALSE(few.wide_contacts || few.caches_manifolds || few.caches_graph);
    const IslandPolicy many = of_bodies(17);
    EXPECT_FALSE(many.recomputes_contacts || many.converges || many.exact_impacts || many.conserves_energy);
    EXPECT_TRUE(many.wide_contacts && many.caches_manifolds && many.caches_graph);
    EXPECT_FALSE(internal::limits_flight_to_fast_movers(16));
    EXPECT_TRUE(internal::limits_flight_to_fast_movers(17));
    EXPECT_EQ(internal::most_impacts_of_a_step(68, 17), 16);
    EXPECT_EQ(internal::most_impacts_of_a_step(69, 17), 4);
    EXPECT_TRUE(internal::follows_turning_contacts(16));
    EXPECT_FALSE(internal::follows_turning_contacts(17));
}

TEST(DynamicsPolicy, TheEnergyOfJointedBodiesIsKept)
{
    EXPECT_TRUE(of_joints(17, 17).conserves_energy);
    EXPECT_FALSE(of_joints(17, 17).wide_contacts);
    EXPECT_TRUE(of_joints(64, 63).conserves_energy);
    EXPECT_TRUE(of_joints(1000, 999).conserves_energy);
    const IslandPolicy pile = policy_of({.bodies = 65, .joints = 64, .contacts = 16});
    EXPECT_FALSE(pile.conserves_energy);
    EXPECT_TRUE(pile.wide_contacts);
    const IslandPolicy loaded_bridge = policy_of({.bodies = 500, .joints = 21, .contacts = 900, .hangs = true});
    EXPECT_TRUE(loaded_bridge.wide_contacts && loaded_bridge.direct_joints);
    EXPECT_FALSE(loaded_bridge.wide_joints);
    EXPECT_TRUE(internal::follows_swinging_joints({.bodies = 65, .joints = 65}));
    EXPECT_FALSE(internal::follows_swinging_joints({.bodies = 65, .joints = 65, .contacts = 17}));
}

TEST(DynamicsPolicy, HingesOfAPileGoSideBySide)
{
    const IslandPolicy pile = policy_of({.bodies = 80, .joints = 65, .contacts = 17});
    EXPECT_TRUE(pile.wide_joints && pile.caches_graph);
    EXPECT_FALSE(policy_of({.bodies = 80, .joints = 64, .contacts = 17}).wide_joints);
    const IslandPolicy swinging = policy_of({.bodies = 80, .joints = 65, .contacts = 16});
    EXPECT_FALSE(swinging.wide_joints || swinging.caches_graph);
    EXPECT_FALSE(policy_of({.bodies = 80, .joints = 65, .contacts = 17, .hangs = true}).wide_joints);
}

TEST(DynamicsPolicy, JointsAreSolvedAtOnceUnlessManyCloseLoops)
{
    const auto net = [](int loops)
    { return policy_of({.bodies = 500, .joints = 600, .inner_joints = 400 + loops, .jointed = 400}); };
    EXPECT_TRUE(net(256).direct_joints);
    EXPECT_FALSE(net(256).wide_joints);
    EXPECT_FALSE(net(257).direct_joints);
    EXPECT_TRUE(net(257).wide_joints);
    EXPECT_TRUE(internal::solves_all_joints_directly({}, false));
    EXPECT_FALSE(internal::solves_all_joints_directly({}, true));
    EXPECT_FALSE(internal::solves_all_joints_directly({.direct_joints = false}, false));
}

TEST(DynamicsPolicy, EightJointsThatLieOrAreDampedAreSoft)
{
    const IslandTally lying{.bodies = 9, .joints = 8, .contacts = 4, .bearing = 2};
    EXPECT_TRUE(policy_of(lying).soft_joints);
    EXPECT_FALSE(policy_of({.bodies = 9, .joints = 7, .contacts = 4, .bearing = 2}).soft_joints);
    EXPECT_FALSE(policy_of({.bodies = 9, .joints = 8, .contacts = 4, .bearing = 1}).soft_joints);
    EXPECT_TRUE(policy_of({.bodies = 9, .joints = 8, .damped = 8}).soft_joints);
    EXPECT_FALSE(policy_of({.bodies = 9, .joints = 8, .damped = 7}).soft_joints);
    EXPECT_FALSE(policy_of({.bodies = 65, .joints = 64, .contacts = 64, .bearing = 64}).soft_joints);
    EXPECT_FALSE(policy_of({.bodies = 9, .joints = 8, .contacts = 4, .bearing = 2, .hangs = true}).soft_joints);
}

TEST(DynamicsPolicy, PassesGrowFewerAsIslandsGrow)
{
    for (const auto& [bodies, passes] :
         {std::pair{2, 4}, {16, 4}, {17, 4}, {128, 4}, {129, 3}, {170, 3}, {171, 2}, {256, 2}, {257, 1}, {100'000, 1}})
        EXPECT_EQ(of_bodies(bodies).passes, passes) << bodies << " bodies";
    EXPECT_EQ(policy_of({.bodies = 40, .joints = 20, .contacts = 100, .bearing = 40}).passes, 1)
        << "joints are solved row by row";
    EXPECT_EQ(policy_of({.bodies = 40, .joints = 20, .contacts = 10, .hangs = true}).passes, 4);
}

TEST(DynamicsPolicy, IslandsAreCutIntoPowersOfTwo)
{
    const IslandPolicy wide = of_bodies(5000);
    EXPECT_EQ(internal::partitions_of(wide, 5000, 4095), 0);
    EXPECT_EQ(internal::partitions_of(wide, 5000, 4096), 2);
    EXPECT_EQ(internal::partitions_of(wide, 5000, 1'000'000), 16);
    EXPECT_EQ(internal::partitions_of(wide, 1'000'000, 1'000'000), 64);
    EXPECT_EQ(internal::partitions_of(of_bodies(16), 16, 4096), 0);
}

// --- choices ------------------------------------------------------------------------------------------------------------------------

TEST(DynamicsPolicy, WhatAChoiceRulesOutIsNotTaken)
{
    const IslandTally few{.bodies = 5, .contacts = 8};
    EXPECT_FALSE(policy_of(few, {.wide_contacts = true}).wide_contacts) << "lanes have no room for manifolds that change";
    EXPECT_TRUE(policy_of(few, {.recomputes_contacts = false, .wide_contacts = true}).wide_contacts);
    const IslandTally many{.bodies = 100, .contacts = 200};
    EXPECT_FALSE(policy_of(many, {.subdivisions = 2}).wide_contacts);
}

struct Choice
{
    const char* name;
    ForcedPolicy forced;
};

const std::vector<Choice>& choices()
{
    static const std::vector<Choice> all = {
        {"recomputes_contacts = false", {.recomputes_contacts = false}},
        {"recomputes_contacts = true", {.recomputes_contacts = true}},
        {"converges = false", {.converges = false}},
        {"converges = true", {.converges = true}},
        {"exact_impacts = false", {.exact_impacts = false}},
        {"exact_impacts = true", {.exact_impacts = true}},
        {"conserves_energy = false", {.conserves_energy = false}},
        {"conserves_energy = true", {.conserves_energy = true}},
        {"caches_manifolds = false", {.caches_manifolds = false}},
        {"caches_manifolds = true", {.caches_manifolds = true}},
        {"caches_graph = false", {.caches_graph = false}},
        {"wide_contacts = false", {.wide_contacts = false}},
        {"as in a pile",
         {.recomputes_contacts = false,
          .converges = false,
          .exact_impacts = false,
          .conserves_energy = false,
          .caches_manifolds = true}},
        {"wide_joints = false", {.wide_joints = false}},
        {"direct_joints = false", {.direct_joints = false}},
        {"soft_joints = false", {.soft_joints = false}},
        {"free_fall = false", {.free_fall = false}},
        {"subdivisions = 2", {.subdivisions = 2}},
        {"passes = 3", {.passes = 3}},
    };
    return all;
}

// Positions after so many seconds.
std::vector<Position> run(const std::function<std::vector<BodyId>(Scene&)>& build, const ForcedPolicy& forced, double seconds)
{
    Scene scene(sleepless());
    scene.data().forced_policy = forced;
    const std::vector<BodyId> bodies = build(scene);
    for (int i = 0; i < static_cast<int>(seconds / static_cast<double>(dt)); ++i)
        scene.step(dt);
    std::vector<Position> at;
    for (const BodyId body : bodies)
        at.push_back(scene.body(body).position());
    return at;
}

void expect_the_same(
    const std::function<std::vector<BodyId>(Scene&)>& build, double seconds, double within,
    const std::function<bool(const Choice&)>& counts = [](const Choice&) { return true; })
{
    const std::vector<Position> chosen = run(build, {}, seconds);
    for (const Choice& choice : choices())
    {
        if (!counts(choice))
            continue;
        const std::vector<Position> forced = run(build, choice.forced, seconds);
        for (std::size_t i = 0; i < chosen.size(); ++i)
        {
            const Position d = forced[i] - chosen[i];
            EXPECT_LT(std::hypot(d.x, d.y), within) << choice.name << ", body " << i;
        }
    }
}

std::vector<BodyId> stack(Scene& scene, int boxes)
{
    add_static(scene, HalfSpace{}, {.friction = 0.6f});
    std::vector<BodyId> bodies;
    for (int i = 0; i < boxes; ++i)
        bodies.push_back(add_dynamic(scene, {0, 0.5 + i}, box(0.5f, 0.5f), {.friction = 0.6f}).body);
    return bodies;
}

TEST(DynamicsPolicy, AStackStandsWhicheverWayItIsSolved)
{
    expect_the_same([](Scene& scene) { return stack(scene, 5); }, 4, 0.01);
    expect_the_same([](Scene& scene) { return stack(scene, 20); }, 4, 0.03);
}

TEST(DynamicsPolicy, ABallThatFallsLandsWhicheverWayItIsSolved)
{
    const auto build = [](Scene& scene)
    {
        add_static(scene, HalfSpace{}, {.friction = 0.6f});
        return std::vector{add_dynamic(scene, {0, 4}, Circle{.radius = 0.3f}).body};
    };
    expect_the_same(build, 3, 0.01);
}

std::vector<BodyId> hanging_chain(Scene& scene, int edges)
{
    std::vector<BodyId> bodies;
    BodyId before = add_static(scene, Circle{.radius = 0.1f}).body;
    for (int i = 0; i < edges; ++i)
    {
        const double y = -0.25 - 0.5 * i;
        bodies.push_back(add_dynamic(scene, {0.0, y}, box(0.05f, 0.2f)).body);
        scene.create_joint(
            RevoluteDef{.body_a = before, .body_b = bodies.back(), .anchor_a = {0, i == 0 ? 0 : -0.25f}, .anchor_b = {0, 0.25f}});
        before = bodies.back();
    }
    return bodies;
}

TEST(DynamicsPolicy, AChainHangsWhicheverWayItIsSolved)
{
    expect_the_same([](Scene& scene) { return hanging_chain(scene, 6); }, 3, 0.01);
    const auto solved_at_once = [](const Choice& choice) { return choice.forced.direct_joints.value_or(true); };
    expect_the_same([](Scene& scene) { return hanging_chain(scene, 70); }, 3, 0.01, solved_at_once); // one by one, joints stretch
}

TEST(DynamicsPolicy, ALongChainDoesNotStretch)
{
    const auto chain = [](Scene& scene) { return hanging_chain(scene, 300); };
    EXPECT_NEAR(run(chain, {}, 1).back().y, -0.25 - 0.5 * 299, 1e-3);
}

} // namespace
