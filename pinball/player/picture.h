#pragma once

/// @file
/// The input for drawing the table, and its parts in the order in which they lie on top of each other.

#include "pinball/game/game.h"
#include "pinball/player/effects.h"
#include "pinball/player/table_art.h"
#include "view/canvas.h"

namespace carom::pinball {

struct Picture
{
    const Game& game;
    const Effects& effects;
    const TableArt& art;
    float alpha = 1;    ///< how far the frame is past the last step
    double time = 0;    ///< s, for what moves without physics
    bool plain = false; ///< under the x-ray: no glow, no shine, darker

    [[nodiscard]] const Table& table() const { return game.table(); }
    [[nodiscard]] float glow(Index element, float fade_s = 0.18f) const { return glow_of(game, element, alpha, fade_s); }
    /// Angle or travel of an element at the time of the frame.
    [[nodiscard]] float now(float value, float rate) const { return value + (alpha - 1) * rate * table().physics.step; }
};

/// Everything.
void draw_table(view::Canvas& canvas, const Picture& picture);

} // namespace carom::pinball
