#pragma once

/// @file
/// Memory of drawing from step to step: trails, how the balls have rolled, targets half way down.

#include "pinball/game/game.h"

#include <array>
#include <map>
#include <vector>

namespace carom::pinball {

/// Turns in space, as three columns: where the ball's own axes point. z is up from the playfield.
struct Orientation
{
    using Axis = std::array<float, 3>;
    std::array<Axis, 3> axes{Axis{1, 0, 0}, Axis{0, 1, 0}, Axis{0, 0, 1}};

    /// Turns by the vector `turn`, rad.
    void turn_by(Axis turn);
    [[nodiscard]] Axis apply(Axis own) const;
};

struct BallMemory
{
    std::vector<Position> trail{}; ///< newest first
    Orientation orientation{};
};

class Effects
{
public:
    explicit Effects(const Table& table) : m_sunk(table.elements.size(), 0.0f) {}

    /// After every step.
    void observe(const Game& game);

    [[nodiscard]] const BallMemory* ball(int serial) const;
    /// How far a drop target is down, 0 to 1.
    [[nodiscard]] float sunk(Index element) const { return m_sunk[element]; }

private:
    void follow(const BallState& ball, const Game& game);

    std::map<int, BallMemory> m_balls{};
    std::vector<float> m_sunk;
};

/// 1 at the element's last hit, then fading; `alpha` is how far the frame is past the last step.
[[nodiscard]] float glow_of(const Game& game, Index element, float alpha, float fade_s = 0.18f);

} // namespace carom::pinball
