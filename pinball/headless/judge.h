#pragma once

/// @file
/// Judges by geometry alone whether a ball has left the table or is stuck. It changes nothing.

#include "pinball/elements/playfield.h"

#include <map>
#include <vector>

namespace carom::pinball {

/// The area that the outline wall encloses, closed by a straight line; its arcs in straight pieces of 3 degrees, which
/// are off by a tenth of a millimetre where a ball's centre keeps half a ball away.
class Outline
{
public:
    explicit Outline(const Table& table);
    [[nodiscard]] bool contains(Position p) const; ///< everything, where the table has no outline

private:
    std::vector<Position> m_corners{};
};

enum class Verdict : std::uint8_t
{
    Fine,
    Escaped, ///< its centre is outside the outline
    Stuck,   ///< moved less than a diameter in ten seconds, not held by a device and not in the plunger's lane
    Endless, ///< in play for ten minutes
};

class Judge
{
public:
    explicit Judge(const Table& table);

    /// To be called once a step for every ball on the table.
    [[nodiscard]] Verdict look(const BallState& ball, std::int64_t step);
    void forget(int serial) { m_watched.erase(serial); }
    [[nodiscard]] bool in_lane(Position p) const { return m_lane.contains(p); }

private:
    struct Watch
    {
        Position from{};
        std::int64_t since = 0;
        std::int64_t first = 0;
    };

    Outline m_outline;
    PlungerLane m_lane;
    float m_diameter;
    std::int64_t m_stuck_steps;
    std::int64_t m_endless_steps;
    std::map<int, Watch> m_watched{}; ///< by serial number
};

} // namespace carom::pinball
