#pragma once

/// @file
/// Results as tables, JSON and CSV.

#include "speed/run.h"

#include <iosfwd>

namespace speed {

void print_times_header(std::ostream& out);
void print_times(std::ostream& out, const Result& result);
/// All of them, under a header of its own.
void print_quality(std::ostream& out, const std::vector<Result>& results);
void print_memory(std::ostream& out, const std::vector<Result>& results);
void print_json(std::ostream& out, const std::vector<Result>& results);
void print_csv(std::ostream& out, const std::vector<Result>& results);

} // namespace speed
