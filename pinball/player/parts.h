#pragma once

/// @file
/// The drawing of each part of the table. Light falls from the upper left.

#include "pinball/player/picture.h"

namespace carom::pinball {

void draw_cabinet(view::Canvas& canvas, const Picture& picture);
/// Draws the print on the playfield.
void draw_art(view::Canvas& canvas, const Picture& picture);
/// Draws the shadows of everything that stands on the playfield.
void draw_shadows(view::Canvas& canvas, const Picture& picture);
/// free: those that roll; else those that a saucer holds.
void draw_balls(view::Canvas& canvas, const Picture& picture, bool free);

void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Light& light);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Booster& booster);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Kicker& kicker);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Sensor& sensor);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Saucer& saucer);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Plunger& plunger);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const DropTarget& target);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Standup& target);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const SprungTarget& target);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Wall& wall);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Solid& solid);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Post& post);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Slingshot& sling);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Gate& gate);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Flipper& flipper);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Bumper& bumper);
void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Spinner& spinner);

} // namespace carom::pinball
