#pragma once

/// @file
/// High scores and keys: beside the table, or on a card over it where there is no room beside it.

#include "pinball/player/layout.h"
#include "pinball/player/machine.h"
#include "view/canvas.h"

namespace carom::pinball {

/// Both draw from the top of the area and give the y below what they drew.
float draw_high_scores(view::Canvas& screen, const Area& area, const Machine& machine, float unit);
float draw_keys(view::Canvas& screen, const Area& area, float unit);

/// The first screen of a portrait window, over the table.
void draw_card(view::Canvas& screen, const Layout& layout, const Machine& machine);
/// What is wrong with the table file that just changed.
void draw_table_errors(view::Canvas& screen, const Layout& layout, const Machine& machine);
/// A word across the table, and what to do about it.
void draw_banner(view::Canvas& screen, const Layout& layout, const char* word, const char* hint);

} // namespace carom::pinball
