#pragma once

/// @file
/// The part of the table that is seen: all of it, or, where the x-ray leaves little room, the part where the ball is.

#include "pinball/game/game.h"
#include "pinball/player/layout.h"
#include "view/camera.h"

namespace carom::pinball {

class TableCamera
{
public:
    /// Once a frame.
    [[nodiscard]] view::Camera look(const Game& game, const Layout& layout, double time);

private:
    [[nodiscard]] double follow(const Game& game, double reach, double time);
    double m_y = -1; ///< m, where it looks; negative before the first frame
    double m_last = 0;
};

} // namespace carom::pinball
