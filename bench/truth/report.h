#pragma once

/// @file
/// Results as a table for people and as JSON for programs.

#include "truth/experiment.h"

#include <iosfwd>

namespace truth {

/// One metric over all engines that ran.
struct Row
{
    Metric ours{};
    std::vector<double> peers{};
    double finer_error = none; ///< ours at four times the rate, where convergence was asked for
    bool converges = true;
};

struct Results
{
    std::vector<std::string> peer_names{};
    bool convergence = false;
    std::vector<Row> rows{};
};

void print_header(std::ostream& out, const Results& results, double hz);
void print_experiment(std::ostream& out, const Results& results, const Experiment& experiment);
/// How many lines keep their bound, and which do not.
void print_summary(std::ostream& out, const Results& results);
void print_json(std::ostream& out, const Results& results);
[[nodiscard]] bool all_ok(const Results& results);

} // namespace truth
