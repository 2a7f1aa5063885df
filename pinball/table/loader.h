#pragma once

/// @file
/// Reads table files. docs/table-format.md is the reference of what they may say.

#include "pinball/table/load_error.h"
#include "pinball/table/table.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace carom::pinball {

struct LoadResult
{
    std::optional<Table> table{}; ///< only if there is no error
    LoadErrors errors{};          ///< everything that is wrong, by line; 200 at most
    std::string text{};           ///< of the file, where load_table_file could read it
};

/// Never throws on bad text; any bytes are safe.
[[nodiscard]] LoadResult load_table(std::string_view text);
/// A file that cannot be read is an error of the result.
[[nodiscard]] LoadResult load_table_file(const std::filesystem::path& file);

} // namespace carom::pinball
