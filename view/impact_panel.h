#pragma once

/// @file
/// The story of an impact as widgets, and the blow in the picture.

#include "view/canvas.h"
#include "view/impact_story.h"

namespace carom::view {

/// The story as text in the present Dear ImGui window, wrapped to its width. `unit` is the size of its letters, 1 being usual; they become
/// smaller, to two thirds at the least, where the story would not fit into the rest of the window.
void story_widgets(Fonts& fonts, const std::vector<StoryLine>& story, float unit = 1);
void impact_widgets(Fonts& fonts, const std::optional<ImpactRecord>& record, float unit = 1);

/// The blow in the picture: the line of the hit, both speeds, both parties named. `unit` is the size of lines and letters, 1 being usual.
void draw_impact(Canvas& canvas, const ImpactRecord& record, float unit = 1);

inline constexpr Color party_a_color = rgb(0xffa94d);
inline constexpr Color party_b_color = rgb(0x74c0fc);

} // namespace carom::view
