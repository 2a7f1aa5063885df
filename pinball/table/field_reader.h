#pragma once

/// @file
/// Reads the members of one JSON object, checks type and plausible range, and complains about keys nobody asked for.

#include "pinball/table/json_node.h"
#include "pinball/table/load_error.h"
#include "pinball/table/number_text.h"
#include "pinball/table/table.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom::pinball {

/// Inclusive bounds of a plausible value, in the unit of the file.
struct Range
{
    double least = 0;
    double most = 0;
    std::string_view unit{};
};

inline constexpr double radians_per_degree = 3.14159265358979323846 / 180;

namespace range {
inline constexpr Range coordinate{-0.5, 3.5, "m"};
inline constexpr Range thickness{0, 0.1, "m"}; ///< half thickness of walls
inline constexpr Range radius{0.0005, 0.2, "m"};
inline constexpr Range half_size{0.0005, 1.5, "m"};
inline constexpr Range share{0, 1, ""};
inline constexpr Range speed{0, 10, "m/s"};
inline constexpr Range time{0, 600, "s"};
inline constexpr Range angle{-360, 360, "degrees"};
inline constexpr Range mass{0.005, 5, "kg"};
inline constexpr Range spring{1, 100'000, "N/m"};
inline constexpr Range damper{0, 1'000, "N s/m"};
inline constexpr Range score{0, 10'000'000, ""};
inline constexpr Range count{1, 1'000, ""};
} // namespace range

/// Names that may be referred to.
using NameIndex = std::map<std::string, Index, std::less<>>;

/// Required members give zero after reporting that they miss; optional ones return the fallback.
class FieldReader
{
public:
    FieldReader(const JsonNode& object, std::string path, std::string element, LoadErrors& errors);

    [[nodiscard]] bool has(std::string_view key);
    float number(std::string_view key, Range range);
    float number(std::string_view key, Range range, float fallback);
    /// A number of degrees, as radians.
    float degrees(std::string_view key, Range range);
    float degrees(std::string_view key, Range range, float fallback_radians);
    int integer(std::string_view key, Range range);
    int integer(std::string_view key, Range range, int fallback);
    bool boolean(std::string_view key, bool fallback);
    std::string text(std::string_view key);
    std::string text(std::string_view key, std::string fallback);
    Vec2 vec2(std::string_view key, Range range);
    /// A direction of any length but zero, at length one.
    Vec2 direction(std::string_view key);
    /// So many points, or none after an error.
    std::vector<Vec2> points(std::string_view key, std::size_t count, Range range);
    /// One of the choices, by its place in the list; without a fallback the key is required.
    std::size_t choice(std::string_view key, std::span<const std::string_view> choices, std::optional<std::size_t> fallback);
    std::optional<Color> color(std::string_view key);
    /// The name must be in the index; `what` says what it names.
    Index reference(std::string_view key, const NameIndex& names, std::string_view what);
    Index reference_or_none(std::string_view key, const NameIndex& names, std::string_view what);
    std::vector<Index> references(std::string_view key, const NameIndex& names, std::string_view what);

    /// The member if it is there and of this kind; else null, reported (a missing one only if required).
    const JsonNode* member(std::string_view key, JsonNode::Kind kind, bool required);
    /// Reports every key that nobody asked for. Call it last.
    void refuse_unknown_keys();

    void fail(const JsonNode& where, std::string_view key, std::string sentence);
    void fail(std::string_view key, std::string sentence); ///< at the member, or at the object where it is missing
    [[nodiscard]] FieldReader child(const JsonNode& object, const std::string& subpath) const;
    [[nodiscard]] const std::string& element() const { return m_element; }
    [[nodiscard]] const JsonNode& object() const { return m_object; }

private:
    [[nodiscard]] bool is_misspelt(std::string_view key) const;
    [[nodiscard]] std::string likely_name(std::string_view written) const;
    const JsonNode* look_up(std::string_view key, bool required);
    std::optional<double> checked_number(const JsonNode& node, const std::string& key, Range range);
    std::optional<Vec2> checked_vec2(const JsonNode& node, const std::string& key, Range range);
    Index resolve(const JsonNode& node, const std::string& key, const NameIndex& names, std::string_view what);

    const JsonNode& m_object;
    std::string m_path;
    std::string m_element;
    LoadErrors& m_errors;
    std::vector<std::string> m_known{};
};

} // namespace carom::pinball
