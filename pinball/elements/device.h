#pragma once

/// @file
/// How an element of the table works. A device drives its bodies before the step, hears what touched it and
/// reports events; it knows nothing of scores and rules.

#include "carom/event.h"
#include "pinball/elements/event.h"
#include "pinball/elements/hash.h"
#include "pinball/elements/state.h"

namespace carom::pinball {

class Playfield;
struct Ball;

/// Orders of the rules to an element. Each one is understood by the types named; the others ignore it.
enum class Command : std::uint8_t
{
    Drop,    ///< drop target: go down, though nothing struck it
    Raise,   ///< drop target: come up as soon as no ball is in the way
    Light,   ///< kicker: fire at the next ball
    Unlight, ///< kicker
    Hold,    ///< saucer: keep the ball until Eject
    Eject,   ///< saucer: throw the ball out now
    Enable,  ///< flipper, bumper, slingshot, kicker: the coil works
    Disable, ///< the coil is dead
    Pulse,   ///< bumper, slingshot, kicker, saucer: fire once, whatever is there
};

/// A ball struck an element.
struct Strike
{
    Position point{};
    Vec2 normal{};        ///< from the element to the ball
    float speed = 0;      ///< of approach, m/s
    float impulse = 0;    ///< N s
    float kick_speed = 0; ///< added by a kick, m/s
};

class Device
{
public:
    explicit Device(Index index) : m_index(index) {}
    virtual ~Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    virtual void before_step(Playfield&) {}
    virtual void on_strike(Playfield&, Ball&, const Strike&) {}
    virtual void on_enter(Playfield&, Ball&) {}
    /// A ball that left the game counts as gone out: it is then null.
    virtual void on_exit(Playfield&, BodyId, Ball*) {}
    virtual void after_step(Playfield&) {}
    virtual void command(Playfield&, Command) {}
    /// Adds the state that `state` does not hold.
    virtual void add_to(Hash&) const {}

    [[nodiscard]] Index index() const { return m_index; }

    ElementState state{};

protected:
    /// Notes a hit for counting and drawing, and reports it.
    void report_hit(Playfield& field, GameEvent event);
    /// As above, for a ball that struck; the speed is what the event tells.
    void report_strike(Playfield& field, EventKind kind, const Ball& ball, const Strike& strike, float speed);

private:
    Index m_index;
};

} // namespace carom::pinball
