#pragma once

/// @file
/// The sounds of the machine: from events to struck voices, from rolling balls to a drone.

#include "pinball/game/game.h"
#include "view/sound_sink.h"

#include <optional>

namespace carom::pinball {

/// The sound of one event; none where it is silent. The loudness of an impact follows its impulse, its pitch the
/// material, its place the ears.
[[nodiscard]] std::optional<view::Strike> strike_of(const Table& table, const GameEvent& event);

/// The noise of everything that rolls.
[[nodiscard]] view::Drone rolling_noise(const Game& game);

class Sounds
{
public:
    /// After every step.
    void hear(const Game& game);
    /// Once a frame. `running`: time passes.
    void frame(const Game& game, bool running);

    [[nodiscard]] view::SoundSink& sink() { return m_sink; }
    [[nodiscard]] const view::SoundSink& sink() const { return m_sink; }

private:
    view::SoundSink m_sink;
};

} // namespace carom::pinball
