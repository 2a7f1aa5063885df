#pragma once

/// @file
/// High scores, keys and rules: beside the table, or on a card over it where there is no room beside it.

#include "pinball/player/layout.h"
#include "pinball/player/machine.h"
#include "pinball/player/score_panel.h"
#include "view/canvas.h"

#include <string>
#include <vector>

namespace carom::pinball {

/// All draw from the top of the area and give the y below what they drew.
float draw_high_scores(view::Canvas& screen, const Area& area, const Machine& machine, float unit);
float draw_keys(view::Canvas& screen, const Area& area, const Machine& machine, float unit);
float draw_rules(view::Canvas& screen, const Area& area, const Machine& machine, float unit);
/// Whether it is the rules' turn: while somebody plays, and by turns with the keys while not.
[[nodiscard]] bool shows_rules(const Machine& machine, const Status& status);

/// The first screen of a portrait window, over the table; also while it is paused.
void draw_card(view::Canvas& screen, const Layout& layout, const Machine& machine, const Status& status);
/// Sentences at the lower edge of the table; of more than four the first ones.
void draw_strip(view::Canvas& screen, const Layout& layout, const std::vector<std::string>& sentences);
/// Sentences under a heading, as many as there is room for.
void draw_notes(view::Canvas& screen, const Area& area, const char* title, const std::vector<std::string>& sentences, float unit);
/// The error in the table file that just changed.
void draw_table_errors(view::Canvas& screen, const Layout& layout, const Machine& machine);
/// A word across the table, and what to do about it.
void draw_banner(view::Canvas& screen, const Layout& layout, const char* word, const char* hint);

} // namespace carom::pinball
