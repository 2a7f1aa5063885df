#pragma once

/// @file
/// Reports of the elements: the only thing that the rules, the sound and the lights learn about a step.

#include "carom/math.h"
#include "pinball/table/table.h"

#include <cstdint>

namespace carom::pinball {

enum class EventKind : std::uint8_t
{
    Impact,      ///< a ball against something; `element` is what it hit, none for another ball
    Fired,       ///< a coil: bumper, slingshot, kicker; `speed` is the speed it gave
    Hit,         ///< a target hit hard enough: standup, sprung target (`impulse`)
    Fell,        ///< a drop target went down
    Raised,      ///< a drop target came up again
    Spun,        ///< half a turn of a spinner; `speed` is its rate, rad/s
    Passed,      ///< a ball went through a gate
    Entered,     ///< a ball came onto a sensor, booster or kicker
    Left,        ///< and off it
    Captured,    ///< a saucer holds a ball
    Ejected,     ///< a saucer threw its ball out
    Drained,     ///< a ball left the game over a sensor that kills; `ball` is already gone
    Served,      ///< a ball was put before the plunger
    Launched,    ///< a ball left the plunger's lane for the playfield
    FlipperStop, ///< a flipper reached a stop; `speed` in rad/s, `value` 1 at the upper one
    FlipperCoil, ///< a flipper's coil went on (`value` 1) or off (0)
    PlungerPulled,
    PlungerReleased, ///< `speed` is how far it was pulled, m
    Nudged,          ///< a hand pushes the cabinet, along `normal`
    BobTouched,      ///< the tilt bob swung to its ring
    // From here on: events of the rules.
    GameStarted,
    GroupCompleted, ///< `value` is the index of the group; `element` the member that completed it
    LetterLit,      ///< `value` is how many are lit
    LevelUp,        ///< of the bumpers, `value` the new level from 0
    BallSaved,
    BonusCounted, ///< one step of the count, `value` what was added
    BallEnded,
    Jackpot, ///< `value` what it paid
    Combo,   ///< `value` the length of the chain
    SkillShot,
    MultiballStarted,
    ExtraBall,
    Replay,       ///< the score that wins a game or a ball was reached
    PlayerJoined, ///< `value` how many play now
    TurnBegan,    ///< `value` whose, from 0
    Match,        ///< `value` the number drawn; `speed` 1 where a score ends in it
    Warned,       ///< `value` warnings so far on this ball
    Tilted,       ///< the ball is over, its bonus lost
    BallSearch,   ///< no switch for a while: the coils feel for the ball; `value` is the round from 1
    BallMissing,  ///< it was not found; `value` how many are written off, and replaced unless the machine has tilted
    GameEnded,
    HighScore, ///< `value` is the rank from 0; `ball` the player's number, from 0
};

struct GameEvent
{
    EventKind kind = EventKind::Impact;
    Index element = none; ///< of Table::elements
    Position point{};
    Vec2 normal{};     ///< of an impact: from what was hit towards the ball
    float impulse = 0; ///< N s
    float speed = 0;   ///< approach speed of an impact, m/s; else see EventKind
    int ball = -1;     ///< serial number of the ball, -1 where there is none
    int value = 0;
};

} // namespace carom::pinball
