#pragma once

/// @file
/// Line charts as SVG: axes with round numbers, a legend, nothing else.

#include "truth/vec.h"

#include <filesystem>
#include <string>
#include <vector>

namespace truth {

enum class Mark
{
    Line,
    Dashed,
    Dots,
};

/// Lines or dots of one colour and one name.
struct Series
{
    std::string name{};
    std::string color{}; ///< as in CSS
    Mark mark = Mark::Line;
    std::vector<std::vector<Vec>> lines{};
};

struct Chart
{
    std::string title{};
    std::string x_label{};
    std::string y_label{};
    std::vector<Series> series{}; ///< earlier ones are drawn over later ones
};

/// Throws std::runtime_error where the file cannot be written.
void write_svg(const Chart& chart, const std::filesystem::path& file);

} // namespace truth
