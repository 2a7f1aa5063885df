#pragma once

/// @file
/// The causes that hold a body where it is, or move it: who pushes it and how hard, from the last step.

#include "view/impact_story.h"

#include <vector>

namespace carom::view {

/// "Why does it not move?", "What does it bear?": of a body or of a trigger. h: of the last step, s.
[[nodiscard]] std::vector<StoryLine> body_story(const Scene& scene, BodyId body, float h, const ShapeNamer& namer = kind_name);

/// One joint: its law with its present numbers.
[[nodiscard]] std::vector<StoryLine> joint_story(const Scene& scene, JointId joint);

} // namespace carom::view
