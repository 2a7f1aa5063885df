#pragma once

/// @file
/// JSON as a small tree whose nodes know where they stand in the text, so that every later error can name the line.

#include "pinball/table/load_error.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom::pinball {

struct JsonNode
{
    enum class Kind
    {
        Null,
        Boolean,
        Number,
        String,
        Array,
        Object,
    };

    Kind kind = Kind::Null;
    bool boolean = false;
    double number = 0;
    std::string text{};
    std::vector<std::string> keys{}; ///< of an object, beside items
    std::vector<JsonNode> items{};   ///< of an array or an object
    int line = 0;
    int column = 0; ///< of the token's last character

    /// The member of an object, or null.
    [[nodiscard]] const JsonNode* member(std::string_view key) const;
};

[[nodiscard]] std::string_view kind_name(JsonNode::Kind kind);

/// Reads JSON with // and /* */ comments. A syntax error, a key that stands twice, nesting deeper than 16, an
/// object of more than 256 keys or a text above 4 MB are added to the errors; then nothing is returned.
[[nodiscard]] std::optional<JsonNode> parse_json(std::string_view text, LoadErrors& errors);

} // namespace carom::pinball
