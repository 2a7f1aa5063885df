// Figures whose hinges all brake are held softly, several at a time: in flight that costs neither momentum nor the hold of a hinge, and what lands stays
// above the ground and comes to rest.

#include "scenes/ragdoll.h"
#include "support/test_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

struct Sums
{
    double along = 0; ///< momentum
    double up = 0;
    double around = 0;
    double energy = 0;
};

Sums sums_of(const Scene& scene)
{
    Sums sums;
    for (const BodyId id : scene.bodies())
    {
        const ConstBody body = scene.body(id);
        const double m = body.mass();
        const double vx = body.velocity().x;
        const double vy = body.velocity().y;
        const double w = body.angular_velocity();
        const double inertia = body.inertia();
        sums.along += m * vx;
        sums.up += m * vy;
        sums.around += m * (body.center_of_mass().x * vy - body.center_of_mass().y * vx) + inertia * w;
        sums.energy += 0.5 * (m * (vx * vx + vy * vy) + inertia * w * w);
    }
    return sums;
}

double widest_gap(const Scene& scene, const std::vector<JointId>& hinges)
{
    double widest = 0;
    for (const JointId hinge : hinges)
        widest = std::max(widest, static_cast<double>(length(scene.joint(hinge).anchor_b() - scene.joint(hinge).anchor_a())));
    return widest;
}

} // namespace

TEST(LawFigures, ABrakedChainInFlightKeepsItsMomentum)
{
    Scene scene(weightless());
    std::vector<BodyId> links;
    std::vector<JointId> hinges;
    Random random(7);
    for (int i = 0; i < 12; ++i)
    {
        links.push_back(add_dynamic(scene, {0.5 * i, 0}, Capsule{{-0.2f, 0}, {0.2f, 0}, 0.04f, 0.04f}, {.filter = {.group = -1}},
                                    random.vec(2), random.rangef(-4, 4))
                            .body);
        if (i > 0)
            hinges.push_back(scene.create_joint(RevoluteDef{.body_a = links[static_cast<std::size_t>(i - 1)],
                                                            .body_b = links.back(),
                                                            .anchor_a = {0.25f, 0},
                                                            .anchor_b = {-0.25f, 0},
                                                            .enable_motor = true,
                                                            .max_motor_torque = 0.05f}));
    }
    scene.step(1.0f / 60); // joins what set out apart
    const Sums before = sums_of(scene);
    double energy = before.energy;
    for (int i = 0; i < 240; ++i)
    {
        scene.step(1.0f / 60);
        const Sums now = sums_of(scene);
        ASSERT_NEAR(now.along, before.along, 1e-4 * std::fabs(before.energy));
        ASSERT_NEAR(now.up, before.up, 1e-4 * std::fabs(before.energy));
        ASSERT_NEAR(now.around, before.around, 0.01 * std::fabs(before.around));
        ASSERT_LT(now.energy, energy * 1.001) << i;
        energy = now.energy;
        ASSERT_LT(widest_gap(scene, hinges), i < 30 ? 0.02 : 0.002) << i;
    }
    EXPECT_LT(energy, 0.9 * before.energy) << "the hinges brake";
}

TEST(LawFigures, TheyFallOnParabolasLandAndRest)
{
    Scene scene;
    add_static(scene, box(50, 0.5f), {}, {0, -0.5});
    std::vector<BodyId> bones;
    for (int i = 0; i < 4; ++i)
    {
        const scenes::Ragdoll figure = scenes::add_ragdoll(scene, {static_cast<float>(0.5 * i), 20}, i + 1);
        bones.insert(bones.end(), figure.begin(), figure.end());
    }
    const double start = scene.body(bones[1]).position().y;
    steps(scene, 60);
    EXPECT_NEAR(scene.body(bones[1]).position().y, start - 0.5 * static_cast<double>(9.81f), 0.05);
    for (int i = 0; i < 600; ++i)
    {
        scene.step(1.0f / 60);
        for (const BodyId bone : bones)
            ASSERT_GT(scene.body(bone).position().y, 0) << "in step " << i;
    }
    EXPECT_EQ(scene.report().awake_bodies, 0);
}
