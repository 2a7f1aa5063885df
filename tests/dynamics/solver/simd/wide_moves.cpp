// Eight bodies that move side by side go where each goes by itself, in every instruction set.

#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/solver/simd/kernels.h"
#include "support/test_scene.h"

#include <vector>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

constexpr float sub_step = 1.0f / 240;

struct Bodies
{
    std::vector<BodyState> states;
    std::vector<StateConstants> constants;

    Bodies(Random& random, int count, double greatest_turn)
    {
        for (int i = 0; i < count; ++i)
        {
            BodyState& s = states.emplace_back();
            s.velocity = random.vec(20);
            s.angular_velocity = random.chance(0.2) ? 0 : random.rangef(-greatest_turn, greatest_turn) / sub_step;
            s.flags =
                body_flag::dynamic | (random.chance(0.2) ? body_flag::flier : 0) | (random.chance(0.3) ? body_flag::unbound : 0);
            s.delta_position = random.vec(0.1);
            s.delta_rotation = Rotation::from_angle(random.rangef(-1, 1));
            constants.emplace_back().acceleration = random.vec(10);
        }
    }
};

// As IslandSolver::integrate_position.
void move_one_by_one(Bodies& bodies)
{
    const SolverView view{bodies.states.data(), bodies.constants.data(), sub_step, 1 / sub_step, 0};
    for (std::size_t i = 0; i < bodies.states.size(); ++i)
    {
        BodyState& s = bodies.states[i];
        if ((s.flags & body_flag::flier) != 0)
            continue;
        s.delta_position += drift(view, static_cast<std::int32_t>(i));
        if (s.angular_velocity != 0)
            s.delta_rotation = Rotation::from_angle(sub_step * s.angular_velocity) * s.delta_rotation;
    }
}

} // namespace

TEST(WideMoves, AreThoseOfEachBody)
{
    Random random(31);
    for (int round = 0; round < 50; ++round)
    {
        const Bodies before(random, 8 * (1 + random.below(5)) + random.below(8), 0.24);
        for (const WideKernels* kernels : all_wide_kernels())
        {
            SCOPED_TRACE(kernels->name);
            Bodies bodies = before;
            const auto count = static_cast<std::int32_t>(bodies.states.size());
            ASSERT_EQ(kernels->move(bodies.states.data(), bodies.constants.data(), count, sub_step), count / 8 * 8);
            Bodies want = before;
            want.states.resize(static_cast<std::size_t>(count / 8 * 8));
            move_one_by_one(want);
            for (std::size_t i = 0; i < bodies.states.size(); ++i)
            {
                const BodyState& s = i < want.states.size() ? want.states[i] : before.states[i];
                EXPECT_EQ(bodies.states[i].delta_position, s.delta_position) << i;
                EXPECT_EQ(bodies.states[i].delta_rotation, s.delta_rotation) << i;
            }
        }
    }
}

TEST(WideMoves, StopBeforeWhatTurnsFast)
{
    Random random(32);
    Bodies bodies(random, 24, 0.2);
    bodies.states[13].flags = body_flag::dynamic;
    bodies.states[13].angular_velocity = 0.3f / sub_step;
    for (const WideKernels* kernels : all_wide_kernels())
    {
        Bodies copy = bodies;
        EXPECT_EQ(kernels->move(copy.states.data(), copy.constants.data(), 24, sub_step), 8) << kernels->name;
        copy = bodies;
        copy.states[13].flags |= body_flag::flier;
        EXPECT_EQ(kernels->move(copy.states.data(), copy.constants.data(), 24, sub_step), 24) << "flight moves it itself";
    }
}
