#pragma once

/// @file
/// A table to begin with, put together from the templates that come with the program. All of them fit together.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace carom::pinball {

struct Template
{
    std::string name{};
    std::string about{}; ///< a sentence or two
    std::filesystem::path file{};
};

/// By name.
[[nodiscard]] std::vector<Template> templates();

/// The text of a table file. Throws std::runtime_error with a sentence where a template is not known or its file cannot be read.
[[nodiscard]] std::string new_table(std::string_view name, const std::vector<std::string>& with);

} // namespace carom::pinball
