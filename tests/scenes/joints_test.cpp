// Chain, cradle, springs, joints: what the scenes show is what mechanics says.

#include "scene_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::scenes {
namespace {

float worst_gap(const Scene& scene)
{
    float worst = 0;
    for (const JointId id : scene.joints())
        worst = std::max(worst, length(scene.joint(id).anchor_a() - scene.joint(id).anchor_b()));
    return worst;
}

TEST(Chain, DoesNotComeApartWhileAHeavyWeightSwings)
{
    SceneRun run("chain");
    float worst = 0;
    for (int i = 0; i < 600; ++i)
    {
        run.steps(1);
        worst = std::max(worst, worst_gap(run.scene()));
    }
    // Soft joints under three times the weight of fifty links: 56 mm were measured, links are 500 mm long.
    EXPECT_LT(worst, 0.08f);
}

TEST(Chain, LosesNoEnergyToSpeakOfAndGainsNone)
{
    SceneRun run("chain", {.sleeping = false});
    const auto energy = [&]
    {
        double sum = 0;
        for (const BodyId id : run.dynamic())
        {
            const auto body = run.scene().body(id);
            sum += static_cast<double>(body.kinetic_energy()) +
                   static_cast<double>(body.mass()) * 9.81 * (body.center_of_mass().y + 11);
        }
        return sum;
    };
    const double start = energy();
    for (int i = 0; i < 10; ++i)
    {
        run.seconds(1);
        EXPECT_LT(energy(), 1.01 * start);
    }
}

// The five balls of one cradle, left to right: the scene builds the touching one first.
std::vector<BodyId> cradle_balls(SceneRun& run, int which)
{
    const auto all = run.dynamic();
    return {all.begin() + 5 * which, all.begin() + 5 * which + 5};
}

double kinetic_energy(SceneRun& run, const std::vector<BodyId>& balls)
{
    double sum = 0;
    for (const BodyId id : balls)
        sum += static_cast<double>(run.scene().body(id).kinetic_energy());
    return sum;
}

// With gaps every meeting is one impact of two balls, and the last one takes the whole speed of the first.
TEST(Cradle, WithGapsOnlyTheLastBallFliesOut)
{
    SceneRun run("cradle");
    const auto balls = cradle_balls(run, 1);
    float arriving = 0;
    bool passed_on = false;
    for (int i = 0; i < 2000 && !passed_on; ++i)
    {
        run.steps(1);
        arriving = std::max(arriving, run.scene().body(balls[0]).velocity().x);
        passed_on = run.scene().body(balls[4]).velocity().x > 0.5f * arriving && arriving > 1;
    }
    ASSERT_TRUE(passed_on);
    // Drawn back by 40° on 4 m: v = sqrt(2 g l (1 - cos 40°)) = 4.28 m/s.
    EXPECT_NEAR(arriving, 4.285f, 0.05f);
    EXPECT_NEAR(run.scene().body(balls[4]).velocity().x, arriving, 0.01f * arriving);
    for (int i = 0; i < 4; ++i)
        EXPECT_LT(std::abs(run.scene().body(balls[static_cast<std::size_t>(i)]).velocity().x), 0.01f * arriving);
}

TEST(Cradle, MomentumAndEnergyPassThroughBothRows)
{
    for (const int which : {0, 1})
    {
        SceneRun run("cradle");
        const auto balls = cradle_balls(run, which);
        double energy_before = 0;
        float momentum_before = 0;
        bool hit = false;
        for (int i = 0; i < 2000 && !hit; ++i)
        {
            energy_before = kinetic_energy(run, balls);
            momentum_before = run.scene().body(balls[0]).velocity().x;
            run.steps(1);
            hit = run.scene().body(balls[0]).velocity().x < 0.5f * momentum_before && momentum_before > 1;
        }
        ASSERT_TRUE(hit) << which;
        float momentum = 0;
        for (const BodyId id : balls)
            momentum += run.scene().body(id).velocity().x;
        EXPECT_NEAR(momentum, momentum_before, 0.01f * momentum_before) << which;
        EXPECT_LT(kinetic_energy(run, balls), 1.01 * energy_before) << which;
        // Five touching balls take the blow in one solve: momentum is kept, but not all of the energy.
        EXPECT_GT(kinetic_energy(run, balls), (which == 0 ? 0.6 : 0.97) * energy_before) << which;
    }
}

TEST(Cradle, RodsKeepTheirLength)
{
    SceneRun run("cradle");
    std::vector<float> start;
    for (const JointId id : run.scene().joints())
        start.push_back(run.scene().joint(id).coordinate());
    run.seconds(5);
    std::size_t i = 0;
    for (const JointId id : run.scene().joints())
        EXPECT_NEAR(run.scene().joint(id).coordinate(), start[i++], 0.005f);
}

// Times at which the mass passes its mean height upwards.
std::vector<double> upward_crossings(SceneRun& run, BodyId mass, double mean, double seconds)
{
    std::vector<double> times;
    double before = run.scene().body(mass).position().y;
    for (int i = 0; i < static_cast<int>(seconds / static_cast<double>(run.h())); ++i)
    {
        run.steps(1);
        const double now = run.scene().body(mass).position().y;
        if (before < mean && now >= mean)
            times.push_back(run.scene().time() - static_cast<double>(run.h()) * (now - mean) / (now - before));
        before = now;
    }
    return times;
}

double rest_height(double stiffness) { return -3 - 9.81 / stiffness; }

TEST(Springs, FollowTheirFrequency)
{
    const double stiffness[] = {9.8696, 39.478, 157.91};
    const double hertz[] = {0.5, 1, 2};
    for (std::size_t i = 0; i < 3; ++i)
    {
        SceneRun run("springs");
        const auto times = upward_crossings(run, run.dynamic()[i], rest_height(stiffness[i]), 9);
        ASSERT_GE(times.size(), 4u) << hertz[i];
        const double measured = static_cast<double>(times.size() - 1) / (times.back() - times.front());
        EXPECT_NEAR(measured, hertz[i], 0.005 * hertz[i]);
    }
}

TEST(Springs, UndampedOnesKeepTheirAmplitude)
{
    SceneRun run("springs");
    double highest = -1e9;
    run.seconds(8);
    for (int i = 0; i < 480; ++i)
    {
        run.steps(1);
        highest = std::max(highest, run.scene().body(run.dynamic()[1]).position().y);
    }
    EXPECT_NEAR(highest - rest_height(39.478), 0.5, 0.02);
}

TEST(Springs, DampedOneDecaysAsItsEquationSays)
{
    SceneRun run("springs");
    const BodyId mass = run.dynamic()[3];
    double worst = 0;
    // x'' = -k x - c x' with k = 39.478, c = 1, x(0) = -0.5.
    const double k = 39.478;
    const double half = 0.5;
    const double rate = std::sqrt(k - half * half);
    for (int i = 0; i < 4 * 240; ++i)
    {
        run.steps(1);
        const double t = run.scene().time();
        const double expected = -0.5 * std::exp(-half * t) * (std::cos(rate * t) + half / rate * std::sin(rate * t));
        worst = std::max(worst, std::abs(run.scene().body(mass).position().y - rest_height(k) - expected));
    }
    EXPECT_LT(worst, 0.01);
}

TEST(Springs, OverdampedOneNeverSwingsOverAndTheStiffOneIsStill)
{
    SceneRun run("springs");
    const BodyId slow = run.dynamic()[4];
    const BodyId stiff = run.dynamic()[5];
    for (int i = 0; i < 1200; ++i)
    {
        run.steps(1);
        ASSERT_LT(run.scene().body(slow).position().y, rest_height(39.478) + 1e-3);
        ASSERT_NEAR(run.scene().body(stiff).position().y, -3, 1e-3);
    }
    EXPECT_NEAR(run.scene().body(slow).position().y, rest_height(39.478), 0.01);
}

TEST(Joints, HoldTogetherAndKeepTheirLimits)
{
    SceneRun run("joints");
    for (int i = 0; i < 600; ++i)
    {
        run.steps(1);
        for (const JointId id : run.scene().joints())
        {
            const ConstJoint joint = std::as_const(run.scene()).joint(id);
            const JointDef def = joint.def();
            if (const auto* rope = std::get_if<DistanceDef>(&def))
            {
                ASSERT_LT(joint.coordinate(), rope->max_length + 0.03f);
            }
            if (std::holds_alternative<RevoluteDef>(def))
            {
                ASSERT_LT(length(joint.anchor_a() - joint.anchor_b()), 0.05f);
            }
            if (const auto* slider = std::get_if<PrismaticDef>(&def))
            {
                ASSERT_LT(joint.coordinate(), slider->upper_translation + 0.02f);
                ASSERT_GT(joint.coordinate(), slider->lower_translation - 0.02f);
            }
        }
    }
}

} // namespace
} // namespace carom::scenes
