#pragma once

/// @file
/// The cost of the last steps as stacked columns, a colour a stage.

#include "carom/step_report.h"

#include <deque>

namespace carom::lab {

/// Into the present Dear ImGui window, with a legend of mean times.
void stage_plot(const std::deque<StageTimes>& history);

} // namespace carom::lab
