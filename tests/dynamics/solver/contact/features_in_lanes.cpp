// Rolling resistance and conveyors in large islands, whose contacts are solved eight side by side.

#include "support/test_scene.h"

#include "dynamics/state/scene_data.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr double gravity_of_lanes = 9.81;
constexpr int riders_on_plank = 24;

// Discs side by side on a plank that rests on the floor: one island of more than 16 bodies.
struct Plank
{
    Scene scene{sleepless()};
    BodyId plank;
    std::vector<BodyId> riders;

    Plank(const Geometry& rider, const ShapeDef& of_plank, const std::function<ShapeDef(int)>& of_rider, Vec2 velocity,
          float spin)
    {
        add_static(scene, HalfSpace{}, {.friction = 5});
        plank = add(scene, {.type = BodyType::Dynamic, .position = {0, 0.25}}, box(100, 0.25f), of_plank).body;
        for (int i = 0; i < riders_on_plank; ++i)
        {
            const double x = 3.0 * (i - riders_on_plank / 2);
            riders.push_back(add(scene,
                                 {.type = BodyType::Dynamic, .position = {x, 1}, .velocity = velocity, .angular_velocity = spin},
                                 rider, of_rider(i))
                                 .body);
        }
    }

    // Whether all contacts are in lanes, and some of them have features.
    [[nodiscard]] bool are_in_lanes()
    {
        auto& solver = scene.data().scratch.solver;
        int featured = 0;
        for (const internal::Island& island : solver.islands)
        {
            if (island.constraint_count > 0)
                return false;
            for (int g = 0; g < island.wide_count; ++g)
                featured += solver.wide_notes[static_cast<std::size_t>(island.wide_store + g)].featured;
        }
        return featured > 0;
    }
    [[nodiscard]] double speed_of(int i)
    {
        return static_cast<double>(scene.body(riders[static_cast<std::size_t>(i)]).velocity().x);
    }
};

} // namespace

TEST(DynamicsFeatures, RollingResistanceBrakesInLanes)
{
    // Torque c r N about the contact, I + m r² = 3/2 m r²: a = c g / 1.5. A load of the last pass instead of the present one brakes a third too much.
    const auto resistance = [](int i) { return 0.02f * static_cast<float>(1 + i % 3); };
    Plank plank(
        Circle{}, {.density = 1000, .friction = 5}, [&](int i) { return ShapeDef{.rolling_resistance = resistance(i)}; },
        {0.5f, 0}, -1);
    steps(plank.scene, 60);
    EXPECT_TRUE(plank.are_in_lanes());
    for (int i = 0; i < riders_on_plank; ++i)
        EXPECT_NEAR(plank.speed_of(i), 0.5 - static_cast<double>(resistance(i)) * gravity_of_lanes / 1.5, 0.003) << i;
    steps(plank.scene, 60 * 5);
    for (int i = 0; i < riders_on_plank; ++i)
        EXPECT_NEAR(plank.speed_of(i), 0, 0.001) << i << " comes to rest and does not turn back";
}

TEST(DynamicsFeatures, AConveyorCarriesInLanes)
{
    // Positive: what lies on it goes to the left of the outward normal, which is -x on a plank.
    Plank plank(
        box(0.5f, 0.5f), {.density = 1000, .friction = 5},
        [](int i) { return ShapeDef{.friction = 0.6f, .surface_speed = i % 2 == 0 ? 0.5f : 0.0f}; }, {}, 0);
    steps(plank.scene, 200);
    EXPECT_TRUE(plank.are_in_lanes());
    for (int i = 0; i < riders_on_plank; ++i)
        EXPECT_NEAR(std::fabs(plank.speed_of(i)), i % 2 == 0 ? 0.5 : 0, 0.005) << i;
}

// The impulse of rolling resistance goes through the contact when an island shrinks and grows, and lanes come and go.
TEST(DynamicsFeatures, RestOnASlopeLastsWhileOthersComeAndGo)
{
    Scene scene(sleepless());
    scene.set_gravity({0.15f, -9.81f}); // less than rolling resistance holds
    add_static(scene, HalfSpace{}, {.friction = 5});
    const BodyId plank =
        add(scene, {.type = BodyType::Dynamic, .position = {0, 0.25}}, box(100, 0.25f), {.density = 1000, .friction = 5}).body;
    std::vector<BodyId> discs;
    for (int i = 0; i < riders_on_plank; ++i)
        discs.push_back(add_dynamic(scene, {3.0 * (i - riders_on_plank / 2), 1}, Circle{}, {.rolling_resistance = 0.02f}).body);
    for (int round = 0; round < 10; ++round)
    {
        steps(scene, 60);
        if (round % 2 == 0)
            scene.destroy(discs[static_cast<std::size_t>(riders_on_plank - 1 - round)]);
        else
            add_dynamic(scene, {40.0 + 2 * round, 1}, Circle{}, {.rolling_resistance = 0.02f});
        for (int i = 0; i < riders_on_plank / 2; ++i)
            EXPECT_NEAR(scene.body(discs[static_cast<std::size_t>(i)]).velocity().x, 0, 1e-3)
                << "disc " << i << " in round " << round;
    }
    EXPECT_NEAR(scene.body(discs[0]).position().x, 3.0 * (0 - riders_on_plank / 2), 0.02);
    EXPECT_NEAR(scene.body(plank).velocity().x, 0, 1e-3);
}
