// Company changes nothing: a body that bounces obeys the same laws among hundreds of others as alone.

#include "support/test_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float pool_ball = 0.0286f;
constexpr ShapeDef ivory{.friction = 0, .restitution = 1};

struct PoolShot
{
    Vec2 object;
    Vec2 cue;
};

// Spectators stand in two rows along the cue ball's way, a millimeter from it and from each other.
PoolShot shoot(int spectators)
{
    Scene scene({.gravity = {}, .sleeping = false});
    const float off = 2 * pool_ball * std::sin(0.5f);
    const float along = 2 * pool_ball * std::cos(0.5f);
    const BodyId object = add_dynamic(scene, {0, 0}, Circle{.radius = pool_ball}, ivory).body;
    const BodyId cue = add_dynamic(scene, {-along - 0.3, off}, Circle{.radius = pool_ball}, ivory, {2, 0}).body;
    for (int i = 0; i < spectators; ++i)
    {
        const double x = -along - 0.15 - (i / 2) * (2 * pool_ball + 0.001); // NOLINT(bugprone-integer-division)
        const double y = off + (i % 2 == 0 ? 1 : -1) * (2 * pool_ball + 0.001);
        add_dynamic(scene, {x, y}, Circle{.radius = pool_ball}, ivory);
    }
    steps(scene, 12);
    return {scene.body(object).velocity(), scene.body(cue).velocity()};
}

} // namespace

TEST(LawCompany, SpectatorsDoNotDeflectAShot)
{
    const PoolShot alone = shoot(0);
    EXPECT_NEAR(length(alone.object), 2 * std::cos(0.5f), 1e-4f);
    for (const int spectators : {1, 13, 14, 15, 16, 60, 300})
    {
        const PoolShot shot = shoot(spectators);
        EXPECT_NEAR(length(shot.object - alone.object), 0, 1e-5f) << spectators;
        EXPECT_NEAR(length(shot.cue - alone.cue), 0, 1e-5f) << spectators;
    }
}

namespace {

struct Vessel
{
    Scene scene{{.gravity = {}, .sleeping = false}};
    std::vector<BodyId> pieces{};
    std::vector<ShapeId> shapes{};

    Vessel(int count, float side, bool boxes, float restitution)
    {
        const ShapeDef wall{.friction = 0, .restitution = restitution};
        for (const float sign : {-1.0f, 1.0f})
        {
            shapes.push_back(add_static(scene, box(side / 2 + 1, 0.5f, {0, sign * (side / 2 + 0.5f)}), wall).shape);
            shapes.push_back(add_static(scene, box(0.5f, side / 2 + 1, {sign * (side / 2 + 0.5f), 0}), wall).shape);
        }
        const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
        for (int i = 0; i < count; ++i)
        {
            const double cell = static_cast<double>(side) / columns;
            const Position at{(i % columns + 0.5) * cell - static_cast<double>(side) / 2,
                              (i / columns + 0.5) * cell - static_cast<double>(side) / 2}; // NOLINT
            const float angle = static_cast<float>(i) * 2.4f;                              // the golden angle: all directions
            const Vec2 velocity{2 * std::cos(angle), 2 * std::sin(angle)};
            const Geometry geometry = boxes ? Geometry(box(0.09f, 0.09f)) : Geometry(Circle{.radius = 0.1f});
            const auto added = add_dynamic(scene, at, geometry, {.friction = 0, .restitution = restitution}, velocity);
            pieces.push_back(added.body);
            shapes.push_back(added.shape);
        }
    }

    [[nodiscard]] double kinetic_energy()
    {
        double sum = 0;
        for (const BodyId id : pieces)
        {
            const ConstBody b = std::as_const(scene).body(id);
            sum += 0.5 * static_cast<double>(b.mass() * dot(b.velocity(), b.velocity()) +
                                             b.inertia() * b.angular_velocity() * b.angular_velocity());
        }
        return sum;
    }
};

} // namespace

TEST(LawCompany, ElasticCrowdsKeepTheirEnergy)
{
    for (const int count : {15, 16, 17, 18, 60, 250})
    {
        for (const bool boxes : {false, true})
        {
            for (const float filled : {0.1f, 0.4f})
            {
                Vessel vessel(count, std::sqrt(static_cast<float>(count) * std::numbers::pi_v<float> * 0.01f / filled), boxes, 1);
                const double start = vessel.kinetic_energy();
                steps(vessel.scene, 240);
                EXPECT_NEAR(vessel.kinetic_energy() / start, 1, 0.002) << count << (boxes ? " boxes " : " discs ") << filled;
            }
        }
    }
}

// A rack breaks as its mirror image does.
TEST(LawCompany, ASymmetricBreakIsSymmetric)
{
    constexpr int rows = 7; // 28 balls
    Scene scene({.gravity = {}, .sleeping = false});
    std::vector<std::vector<BodyId>> rack(rows);
    for (int row = 0; row < rows; ++row)
    {
        for (int i = 0; i <= row; ++i)
        {
            const double y = (2 * i - row) * static_cast<double>(pool_ball);
            rack[static_cast<std::size_t>(row)].push_back(
                add_dynamic(scene, {std::sqrt(3.0) * row * static_cast<double>(pool_ball) * 1.0001, y * 1.0001},
                            Circle{.radius = pool_ball}, ivory)
                    .body);
        }
    }
    add_dynamic(scene, {-0.2, 0}, Circle{.radius = pool_ball}, ivory, {4, 0});
    steps(scene, 5);
    for (const std::vector<BodyId>& row : rack)
    {
        for (std::size_t i = 0; i < row.size(); ++i)
        {
            const Vec2 a = scene.body(row[i]).velocity();
            const Vec2 b = scene.body(row[row.size() - 1 - i]).velocity();
            EXPECT_NEAR(a.x, b.x, 0.05f);
            EXPECT_NEAR(a.y, -b.y, 0.05f);
        }
    }
    EXPECT_GT(length(scene.body(rack.back().front()).velocity()), 0.1f);
}

// Materials may change on the way.
TEST(LawCompany, BodiesThatLearnToBounceKeepTheirEnergyFromThenOn)
{
    Vessel vessel(60, 4, false, 0);
    steps(vessel.scene, 5);
    for (const ShapeId shape : vessel.shapes)
        vessel.scene.shape(shape).set_def({.friction = 0, .restitution = 1});
    const double start = vessel.kinetic_energy();
    steps(vessel.scene, 240);
    EXPECT_NEAR(vessel.kinetic_energy() / start, 1, 0.002);
}

namespace {

// A chain of bars on the world, flat at first. Returns the greatest error of its energy, as a share of what its swing has.
double energy_error_of_chain(int bars, double seconds)
{
    constexpr float size = 0.5f;
    Scene scene({.gravity = {0, -10}, .sleeping = false});
    std::vector<BodyId> chain;
    for (int i = 0; i < bars; ++i)
    {
        chain.push_back(add_dynamic(scene, {(i + 0.5) * 0.5, 0}, box(0.25f, 0.05f), {.filter = {.mask = 0}}).body);
        scene.create_joint(RevoluteDef{.body_a = i > 0 ? chain[chain.size() - 2] : BodyId{},
                                       .body_b = chain.back(),
                                       .anchor_a = {i > 0 ? size / 2 : 0, 0},
                                       .anchor_b = {-size / 2, 0}});
    }
    const auto energy = [&]
    {
        double sum = 0;
        for (const BodyId id : chain)
            sum += static_cast<double>(scene.body(id).kinetic_energy()) +
                   static_cast<double>(scene.body(id).mass()) * 10 * scene.body(id).position().y;
        return sum;
    };
    const double swing = bars * static_cast<double>(scene.body(chain[0]).mass()) * 10 * bars * 0.25;
    const double start = energy();
    double worst = 0;
    for (int i = 0; i < static_cast<int>(60 * seconds); ++i)
    {
        scene.step(1.0f / 60);
        worst = std::max(worst, std::fabs(energy() - start) / swing);
    }
    return worst;
}

} // namespace

TEST(LawCompany, AChainKeepsItsEnergyHoweverLongItIs)
{
    for (const int bars : {2, 16, 17, 42, 43, 64, 65, 129, 300})
        EXPECT_LT(energy_error_of_chain(bars, 3), 0.01) << bars << " bars";
}
