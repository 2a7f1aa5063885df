// Whole turns of a body, against the difference of its angles.

#include "dynamics/state/turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace carom;
using namespace carom::internal;

namespace {

double angle_of(Rotation q) { return std::atan2(static_cast<double>(q.s), static_cast<double>(q.c)); }

TEST(Turns, AreCountedWhereTheAngleJumps)
{
    constexpr float half_turn = std::numbers::pi_v<float>;
    for (const float start : {-half_turn, -0.5f * half_turn, 0.0f, 0.5f * half_turn, half_turn})
    {
        for (const float beside : {-1.5f, -0.1f, -1e-3f, -1e-7f, 0.0f, 1e-7f, 1e-3f, 0.1f, 1.5f})
        {
            for (const float way : {-3.1f, -1.6f, -1.5f, -0.1f, -1e-3f, -1e-7f, 1e-7f, 1e-3f, 0.1f, 1.5f, 1.6f, 3.1f})
            {
                const Rotation before = Rotation::from_angle(start + beside);
                BodyState moved;
                moved.delta_rotation = Rotation::from_angle(way);
                const Rotation after = moved.delta_rotation * before;
                const double gone = angle_of(moved.delta_rotation) - (angle_of(after) - angle_of(before));
                std::int32_t turns = 7;
                count_turns(turns, before, after, moved);
                EXPECT_EQ(turns, 7 + static_cast<int>(std::lround(gone / (2 * std::numbers::pi))))
                    << start << " + " << beside << " by " << way;
            }
        }
    }
}

} // namespace
