#pragma once

/// @file
/// Elements that kick the ball that strikes them: bumper and slingshot differ in shape only. The kick itself is data of the shape.

#include "pinball/elements/device.h"

namespace carom::pinball {

class KickingDevice : public Device
{
public:
    void on_strike(Playfield& field, Ball& ball, const Strike& strike) override;
    void command(Playfield& field, Command command) override;
    void add_to(Hash& hash) const override;

protected:
    KickingDevice(Index index, const Kick& kick) : Device(index), m_kick(kick) {}
    /// The shape that kicks.
    void add_kicker(Playfield& field, BodyId body, const Geometry& geometry);

private:
    /// Sets what the next blow gets.
    void arm(Playfield& field);
    void pulse(Playfield& field);

    Kick m_kick;
    float m_scatter_factor = 1;
    bool m_enabled = true;
    ShapeId m_kicker{};
};

} // namespace carom::pinball
