#pragma once

/// @file
/// The visible state of an element and of a ball: all that drawing needs.

#include "carom/id.h"
#include "carom/math.h"

#include <cstdint>

namespace carom::pinball {

/// How an element stands now. Fields that mean nothing for its type stay 0.
struct ElementState
{
    BodyId body{};                 ///< for interpolated poses of what moves: flipper, plunger, sprung target
    float angle = 0;               ///< flipper: of the bat from the x axis; spinner: of its flag, 0 hangs; gate: opening; rad
    float speed = 0;               ///< rate of angle or travel
    float travel = 0;              ///< plunger: pulled back; sprung target: pushed in; m
    bool down = false;             ///< a drop target lies; a saucer holds a ball; a flipper's coil or a plunger's key is on
    bool lit = false;              ///< a kicker is armed
    bool occupied = false;         ///< a ball is on the sensor
    std::int64_t last_hit = never; ///< step of the last hit or firing
    int hits = 0;                  ///< since the game object was made

    static constexpr std::int64_t never = -1'000'000'000;
};

struct BallState
{
    BodyId body{};
    int serial = 0; ///< balls are numbered as they come
    bool captive = false;
    bool held = false; ///< by a saucer: it takes no part
    [[nodiscard]] bool is_free() const { return !captive && !held; }
    Position position{};
    Vec2 velocity{}; ///< m/s
    Vec2 rolling{};  ///< velocity at which it would roll without sliding: spin about the table's axes times radius, m/s
    float spin = 0;  ///< about the axis that points up from the playfield, rad/s
};

} // namespace carom::pinball
