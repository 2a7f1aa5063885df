#include "pinball/table/field_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace carom::pinball {
namespace {

constexpr std::size_t max_text_length = 200;
constexpr std::size_t max_references = 256;
constexpr std::size_t max_errors = 1'000; ///< a file made to be refused must not fill the memory

std::string describe(Range range)
{
    std::string text = "between " + short_number(range.least) + " and " + short_number(range.most);
    if (!range.unit.empty())
        text.append(1, ' ').append(range.unit);
    return text;
}

std::optional<std::uint8_t> hex_byte(std::string_view digits)
{
    int value = 0;
    for (const char c : digits)
    {
        const std::size_t digit = std::string_view("0123456789abcdef").find(c);
        if (digit == std::string_view::npos)
            return std::nullopt;
        value = value * 16 + static_cast<int>(digit);
    }
    return static_cast<std::uint8_t>(value);
}

std::optional<Color> parse_color(std::string_view text)
{
    if (text.size() != 7 || text[0] != '#')
        return std::nullopt;
    const auto r = hex_byte(text.substr(1, 2));
    const auto g = hex_byte(text.substr(3, 2));
    const auto b = hex_byte(text.substr(5, 2));
    return r && g && b ? std::optional(Color{*r, *g, *b}) : std::nullopt;
}

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ", ") + word;
    return text;
}

} // namespace

FieldReader::FieldReader(const JsonNode& object, std::string path, std::string element, LoadErrors& errors)
    : m_object(object), m_path(std::move(path)), m_element(std::move(element)), m_errors(errors)
{}

FieldReader FieldReader::child(const JsonNode& object, const std::string& subpath) const
{
    return {object, m_path.empty() ? subpath : m_path + "." + subpath, m_element, m_errors};
}

void FieldReader::fail(const JsonNode& where, std::string_view key, std::string sentence)
{
    if (m_errors.size() >= max_errors)
        return;
    std::string path = m_path;
    if (!key.empty() && !path.empty())
        path.append(1, '.');
    path.append(key);
    m_errors.push_back({m_element, std::move(path), where.line, where.column, std::move(sentence)});
}

void FieldReader::fail(std::string_view key, std::string sentence)
{
    const JsonNode* node = m_object.member(key);
    fail(node != nullptr ? *node : m_object, key, std::move(sentence));
}

namespace {

// One letter more, less, other, or two that changed places; in long names two of them.
bool are_alike(std::string_view a, std::string_view b)
{
    const std::size_t most = std::min(a.size(), b.size()) >= 8 ? 2 : 1;
    if (a == b || std::min(a.size(), b.size()) < 3 || (a.size() > b.size() ? a.size() - b.size() : b.size() - a.size()) > most)
        return false;
    std::vector<std::size_t> before_last;
    std::vector<std::size_t> last(b.size() + 1);
    for (std::size_t j = 0; j < last.size(); ++j)
        last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        std::vector<std::size_t> row(b.size() + 1);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last = std::exchange(last, std::move(row));
    }
    return last.back() <= most;
}

} // namespace

bool FieldReader::has(std::string_view key) { return look_up(key, false) != nullptr; }

const JsonNode* FieldReader::look_up(std::string_view key, bool required)
{
    if (std::find(m_known.begin(), m_known.end(), key) == m_known.end())
        m_known.emplace_back(key);
    const JsonNode* node = m_object.member(key);
    if (node == nullptr && required && !is_misspelt(key))
        fail(m_object, key, "is missing");
    return node;
}

const JsonNode* FieldReader::member(std::string_view key, JsonNode::Kind kind, bool required)
{
    const JsonNode* node = look_up(key, required);
    if (node == nullptr || node->kind == kind)
        return node;
    fail(*node, key, "must be " + std::string(kind_name(kind)) + ", is " + std::string(kind_name(node->kind)));
    return nullptr;
}

void FieldReader::refuse_unknown_keys()
{
    for (std::size_t i = 0; i < m_object.keys.size(); ++i)
        if (std::find(m_known.begin(), m_known.end(), m_object.keys[i]) == m_known.end())
            fail(m_object.items[i], m_object.keys[i].substr(0, max_text_length),
                 "is not a key of this object; " + likely_name(m_object.keys[i]));
}

// A key that stands there and is like it: that one will be told.
bool FieldReader::is_misspelt(std::string_view key) const
{
    return std::ranges::any_of(m_object.keys, [&](const std::string& written) { return are_alike(written, key); });
}

std::string FieldReader::likely_name(std::string_view written) const
{
    const auto likely = std::ranges::find_if(m_known, [&](const std::string& known)
                                             { return are_alike(written, known) && m_object.member(known) == nullptr; });
    return likely != m_known.end() ? "is \"" + *likely + "\" meant?" : "it has " + joined(m_known);
}

std::optional<double> FieldReader::checked_number(const JsonNode& node, const std::string& key, Range range)
{
    if (node.kind != JsonNode::Kind::Number)
    {
        fail(node, key, "must be a number, is " + std::string(kind_name(node.kind)));
        return std::nullopt;
    }
    if (node.number >= range.least && node.number <= range.most)
        return node.number;
    fail(node, key, "must be " + describe(range) + ", is " + short_number(node.number));
    return std::nullopt;
}

float FieldReader::number(std::string_view key, Range range)
{
    const JsonNode* node = look_up(key, true);
    return node == nullptr ? 0 : static_cast<float>(checked_number(*node, std::string(key), range).value_or(0));
}

float FieldReader::number(std::string_view key, Range range, float fallback)
{
    return look_up(key, false) == nullptr ? fallback : number(key, range);
}

float FieldReader::degrees(std::string_view key, Range range)
{
    const JsonNode* node = look_up(key, true);
    if (node == nullptr)
        return 0;
    return static_cast<float>(checked_number(*node, std::string(key), range).value_or(0) * radians_per_degree);
}

float FieldReader::degrees(std::string_view key, Range range, float fallback_radians)
{
    return look_up(key, false) == nullptr ? fallback_radians : degrees(key, range);
}

int FieldReader::integer(std::string_view key, Range range)
{
    const JsonNode* node = look_up(key, true);
    if (node == nullptr)
        return 0;
    const double value = checked_number(*node, std::string(key), range).value_or(0);
    if (value != std::floor(value))
        fail(*node, key, "must be a whole number, is " + short_number(value));
    return static_cast<int>(value);
}

int FieldReader::integer(std::string_view key, Range range, int fallback)
{
    return look_up(key, false) == nullptr ? fallback : integer(key, range);
}

bool FieldReader::boolean(std::string_view key, bool fallback)
{
    const JsonNode* node = member(key, JsonNode::Kind::Boolean, false);
    return node == nullptr ? fallback : node->boolean;
}

std::string FieldReader::text(std::string_view key)
{
    const JsonNode* node = member(key, JsonNode::Kind::String, true);
    if (node == nullptr)
        return {};
    if (node->text.size() > max_text_length)
        fail(*node, key, "must not be longer than " + std::to_string(max_text_length) + " bytes");
    return node->text.substr(0, max_text_length);
}

std::string FieldReader::text(std::string_view key, std::string fallback)
{
    return look_up(key, false) == nullptr ? std::move(fallback) : text(key);
}

std::optional<Vec2> FieldReader::checked_vec2(const JsonNode& node, const std::string& key, Range range)
{
    if (node.kind != JsonNode::Kind::Array || node.items.size() != 2)
    {
        fail(node, key, "must be an array of two numbers");
        return std::nullopt;
    }
    const auto x = checked_number(node.items[0], key + "[0]", range);
    const auto y = checked_number(node.items[1], key + "[1]", range);
    if (!x || !y)
        return std::nullopt;
    return Vec2{static_cast<float>(*x), static_cast<float>(*y)};
}

Vec2 FieldReader::vec2(std::string_view key, Range range)
{
    const JsonNode* node = look_up(key, true);
    return node == nullptr ? Vec2{} : checked_vec2(*node, std::string(key), range).value_or(Vec2{});
}

Vec2 FieldReader::direction(std::string_view key)
{
    const JsonNode* node = look_up(key, true);
    const auto value = node == nullptr ? std::nullopt : checked_vec2(*node, std::string(key), {-1'000, 1'000, ""});
    if (!value)
        return {0, 1};
    const double size = std::sqrt(double{value->x} * value->x + double{value->y} * value->y);
    if (size < 1e-3)
    {
        fail(*node, key, "must be a direction, not zero");
        return {0, 1};
    }
    return {static_cast<float>(value->x / size), static_cast<float>(value->y / size)};
}

std::vector<Vec2> FieldReader::points(std::string_view key, std::size_t count, Range range)
{
    const JsonNode* node = member(key, JsonNode::Kind::Array, true);
    if (node == nullptr)
        return {};
    if (node->items.size() != count)
    {
        fail(*node, key, "must have " + std::to_string(count) + " points, has " + std::to_string(node->items.size()));
        return {};
    }
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < count; ++i)
        if (const auto point = checked_vec2(node->items[i], std::string(key) + "[" + std::to_string(i) + "]", range))
            points.push_back(*point);
    return points.size() == count ? points : std::vector<Vec2>{};
}

std::size_t FieldReader::choice(std::string_view key, std::span<const std::string_view> choices,
                                std::optional<std::size_t> fallback)
{
    const JsonNode* node = member(key, JsonNode::Kind::String, !fallback.has_value());
    if (node == nullptr)
        return fallback.value_or(0);
    const auto found = std::find(choices.begin(), choices.end(), node->text);
    if (found != choices.end())
        return static_cast<std::size_t>(found - choices.begin());
    fail(*node, key, "must be one of " + joined({choices.begin(), choices.end()}));
    return fallback.value_or(0);
}

std::optional<Color> FieldReader::color(std::string_view key)
{
    const JsonNode* node = member(key, JsonNode::Kind::String, false);
    if (node == nullptr)
        return std::nullopt;
    const std::optional<Color> value = parse_color(node->text);
    if (!value)
        fail(*node, key, "must be a color like \"#ffd400\", in lower case");
    return value;
}

Index FieldReader::resolve(const JsonNode& node, const std::string& key, const NameIndex& names, std::string_view what)
{
    if (node.kind != JsonNode::Kind::String)
    {
        fail(node, key, "must be the name of a " + std::string(what));
        return none;
    }
    const auto found = names.find(node.text);
    if (found != names.end())
        return found->second;
    fail(node, key, "there is no " + std::string(what) + " \"" + node.text.substr(0, max_text_length) + "\"");
    return none;
}

Index FieldReader::reference(std::string_view key, const NameIndex& names, std::string_view what)
{
    const JsonNode* node = look_up(key, true);
    return node == nullptr ? none : resolve(*node, std::string(key), names, what);
}

Index FieldReader::reference_or_none(std::string_view key, const NameIndex& names, std::string_view what)
{
    const JsonNode* node = look_up(key, false);
    return node == nullptr ? none : resolve(*node, std::string(key), names, what);
}

std::vector<Index> FieldReader::references(std::string_view key, const NameIndex& names, std::string_view what)
{
    std::vector<Index> indices;
    const JsonNode* node = member(key, JsonNode::Kind::Array, true);
    if (node == nullptr)
        return indices;
    if (node->items.empty())
        fail(*node, key, "must name at least one " + std::string(what));
    if (node->items.size() > max_references)
    {
        fail(*node, key, "names more than " + std::to_string(max_references));
        return indices;
    }
    for (std::size_t i = 0; i < node->items.size(); ++i)
    {
        const std::string place = std::string(key) + "[" + std::to_string(i) + "]";
        const Index index = resolve(node->items[i], place, names, what);
        if (index == none)
            continue;
        if (std::find(indices.begin(), indices.end(), index) == indices.end())
            indices.push_back(index);
        else
            fail(node->items[i], place, "names \"" + node->items[i].text + "\" twice");
    }
    return indices;
}

} // namespace carom::pinball
