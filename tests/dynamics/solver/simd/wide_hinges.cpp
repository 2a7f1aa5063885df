// Hinges filled eight at a time: every instruction set against the joint by itself.

#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/solver/simd/kernels.h"
#include "support/test_scene.h"

#include <vector>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

constexpr float h = 1.0f / 240;

// Eight hinges between sixteen bodies, the last lane empty.
struct Hinges
{
    SceneState state;
    std::vector<StateConstants> constants{2 * lane_count, {.inverse_mass = {2, 2}, .inverse_inertia = 3}};
    WideJoint wide{};

    explicit Hinges(Random& random)
    {
        state.sims.resize(2 * lane_count);
        state.turns.assign(2 * lane_count, 0);
        for (int i = 0; i < lane_count; ++i)
        {
            JointRecord joint;
            joint.kind = JointType::Revolute;
            joint.body_a = 2 * i;
            joint.body_b = 2 * i + 1;
            joint.enable_limit = i % 2 == 0;
            joint.enable_motor = i % 3 == 0;
            joint.hertz = i % 4 == 1 ? random.rangef(0.5f, 5) : 0;
            joint.damping_ratio = random.rangef(0, 2);
            joint.reference_angle = i % 4 == 2 ? random.rangef(-3, 3) : 0;
            for (float* value : {&joint.lower, &joint.upper, &joint.motor_speed, &joint.max_motor, &joint.spring_target})
                *value = random.rangef(0.1f, 2);
            for (float& impulse : joint.impulses)
                impulse = random.rangef(-1, 1);
            for (const int body : {joint.body_a, joint.body_b})
                state.sims[static_cast<std::size_t>(body)].rotation = Rotation::from_angle(random.rangef(-3.2f, 3.2f));
            wide.a.v[i] = joint.body_a;
            wide.b.v[i] = joint.body_b;
            wide.joint.v[i] = i + 1 < lane_count ? state.joints.create(joint) : none;
        }
        wide.turns = 1;
    }

    [[nodiscard]] WideJoint filled(const WideKernels& kernels) const
    {
        WideJoint filled = wide;
        kernels.fill_joints(filled, &state.joints[0], state.sims.data(), state.turns.data(), constants.data(), h);
        return filled;
    }
};

} // namespace

TEST(WideHinges, TurnAsFarAsEachByItself)
{
    Random random(5);
    for (int round = 0; round < 500; ++round)
    {
        const Hinges hinges(random);
        for (const WideKernels* kernels : all_wide_kernels())
        {
            const WideJoint filled = hinges.filled(*kernels);
            for (int i = 0; i + 1 < lane_count; ++i)
                ASSERT_EQ(filled.angle.start.v[i], hinge_angle(hinges.state, hinges.state.joints[i]))
                    << kernels->name << ' ' << i;
            EXPECT_EQ(filled.angle.start.v[lane_count - 1], 0);
        }
    }
}

TEST(WideHinges, AreDrivenAsEachByItself)
{
    Random random(6);
    for (int round = 0; round < 50; ++round)
    {
        const Hinges hinges(random);
        for (const WideKernels* kernels : all_wide_kernels())
        {
            const WideAngle t = hinges.filled(*kernels).angle;
            for (int i = 0; i + 1 < lane_count; ++i)
            {
                const JointRecord& joint = hinges.state.joints[i];
                const bool sprung = joint.hertz > 0;
                AxisSpring spring = make_spring(joint.hertz, joint.damping_ratio, 1 / (2 * 3.0f), h, soft_spring_turn);
                spring.theta = 1;
                const SpringLine line = sprung ? spring.line(1, h) : SpringLine{};
                EXPECT_NEAR(static_cast<double>(t.spring_rate.v[i]), line.rest, 1e-5 * std::fabs(line.rest));
                EXPECT_NEAR(static_cast<double>(t.spring_conductance.v[i]), sprung ? 1 / line.compliance : 0,
                            sprung ? 1e-5 / line.compliance : 0);
                EXPECT_EQ(t.spring_impulse.v[i], sprung ? joint.impulses[slot_spring] : 0);
                EXPECT_EQ(t.motor_max.v[i], joint.enable_motor ? h * joint.max_motor : 0);
                EXPECT_EQ(t.motor_impulse.v[i], joint.enable_motor ? joint.impulses[slot_motor] : 0);
                EXPECT_EQ(t.lower_impulse.v[i], joint.enable_limit ? joint.impulses[slot_lower] : 0);
                EXPECT_EQ(t.upper_impulse.v[i], joint.enable_limit ? joint.impulses[slot_upper] : 0);
                EXPECT_EQ(joint.enable_limit, t.upper.v[i] == joint.upper && t.lower.v[i] == joint.lower);
            }
        }
    }
}
