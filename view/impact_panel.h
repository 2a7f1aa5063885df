#pragma once

/// @file
/// The story of an impact as widgets, and the blow in the picture.

#include "view/canvas.h"
#include "view/impact_story.h"

namespace carom::view {

/// The story as text in the present Dear ImGui window, wrapped to its width.
void story_widgets(Fonts& fonts, const std::vector<StoryLine>& story);
void impact_widgets(Fonts& fonts, const std::optional<ImpactRecord>& record);

/// The blow in the picture: the line of the hit, both speeds, both parties named.
void draw_impact(Canvas& canvas, const ImpactRecord& record);

inline constexpr Color party_a_color = rgb(0xffa94d);
inline constexpr Color party_b_color = rgb(0x74c0fc);

} // namespace carom::view
