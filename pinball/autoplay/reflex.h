#pragma once

/// @file
/// A player of reflexes: it flips at what is about to arrive and at what rolls past a point of its choice. It sees what
/// a human sees and acts through the same Input.

#include "pinball/elements/random.h"
#include "pinball/game/game.h"

#include <vector>

namespace carom::pinball {

/// The reflexes of one flipper.
class FlipperReflex
{
public:
    FlipperReflex(const Table& table, const Flipper& flipper, Random& random);

    [[nodiscard]] Side side() const { return m_side; }
    /// Whether the button is down in this step.
    [[nodiscard]] bool step(const std::vector<BallState>& balls, Random& random);

private:
    [[nodiscard]] bool wants_to_flip(const BallState& ball) const;

    Side m_side;
    Vec2 m_pivot;
    Vec2 m_along;  ///< from pivot to tip, at rest
    Vec2 m_normal; ///< out of the face that strikes
    float m_length;
    float m_base_reach; ///< from the middle line to the centre of a ball that lies on the face, at the pivot
    float m_tip_reach;
    float m_aim; ///< m along the bat where a rolling ball is struck
    float m_step;
    int m_delay = 0; ///< steps until the press
    int m_hold = 0;  ///< steps the button stays down
    int m_rest = 0;  ///< steps until it may press again
};

class ReflexPlayer
{
public:
    ReflexPlayer(const Table& table, std::uint64_t seed);

    /// The buttons for the next step.
    [[nodiscard]] Input play(const Game& game);

private:
    [[nodiscard]] bool pull(const Game& game);

    Random m_random;
    std::vector<FlipperReflex> m_flippers{};
    Index m_lane = none;
    float m_full_pull = 0; ///< s
    float m_step;
    int m_waited = 0; ///< steps that a ball lies in the lane
    int m_pull = 0;   ///< steps left to hold the plunger
    bool m_start_was_down = false;
};

} // namespace carom::pinball
