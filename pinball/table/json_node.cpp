#include "pinball/table/json_node.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

namespace carom::pinball {
namespace {

constexpr std::size_t max_text_size = 4u << 20;
constexpr std::size_t max_depth = 16;
constexpr std::size_t max_keys = 256; ///< of one object

struct TextPlace
{
    int line = 1;
    int column = 0;
};

/// Counts lines while the lexer reads: its callbacks do not say where they are.
struct Cursor
{
    TextPlace now{};
    TextPlace before{}; ///< one character earlier: a number is known only once the character after it was read

    void pass(char c)
    {
        before = now;
        if (c == '\n')
            now = {now.line + 1, 0};
        else
            ++now.column;
    }
};

class CountingIterator
{
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingIterator(const char* at, Cursor* cursor) : m_at(at), m_cursor(cursor) {}
    reference operator*() const { return *m_at; }
    CountingIterator& operator++()
    {
        m_cursor->pass(*m_at);
        ++m_at;
        return *this;
    }
    CountingIterator operator++(int)
    {
        CountingIterator old = *this;
        ++*this;
        return old;
    }
    friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.m_at == b.m_at; }

private:
    const char* m_at;
    Cursor* m_cursor;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// The last sign before a place that is no blank; a comment counts for what it ends with.
char sign_before(std::string_view text, std::size_t end)
{
    while (end > 0 && is_blank(text[end - 1]))
        --end;
    return end > 0 ? text[end - 1] : ' ';
}

bool ends_value(char c) { return c == '"' || c == '}' || c == ']' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z'); }

// Says in plain words what is wrong at the sign that was read last.
std::string syntax_sentence(std::string_view text, std::size_t read, std::size_t open_line, const std::string& message)
{
    if (message.find("UTF-8") != std::string::npos)
        return "not UTF-8: save the file in that encoding";
    if (message.find("number overflow") != std::string::npos)
        return "a number that is too big";
    const std::size_t last = text.find_last_not_of(" \t\r\n");
    if (last == std::string_view::npos)
        return "the file is empty";
    if (read == 0 || read > last + 1)
        return open_line > 0 ? "the file ends here, and a bracket of line " + std::to_string(open_line) + " is still open"
                             : "the file ends here";
    const char sign = text[read - 1];
    std::size_t start = read - 1;
    if (sign == '"' && start > 0) // of a string, read whole
        start = std::min(text.rfind('"', start - 1), start);
    const char before = sign_before(text, start);
    const bool closes = sign == ']' || sign == '}';
    if (before == ',' && (closes || sign == ','))
        return std::string("a comma too many") + (closes ? " before " + std::string(1, sign) : "");
    if (message.find("expected ':'") != std::string::npos)
        return "a colon is missing after the key";
    if (ends_value(before) && !closes && sign != ':' && sign != ',')
        return "a comma is missing before this";
    const std::size_t expected = message.rfind("expected ");
    const bool known = expected != std::string::npos && (expected < 2 || message.compare(expected - 2, 2, "un") != 0);
    return std::string("unexpected ") + sign + (known ? "; " + message.substr(expected) : "");
}

/// nlohmann's parser calls this for every token.
class TreeBuilder
{
public:
    TreeBuilder(std::string_view text, const Cursor& cursor, LoadErrors& errors)
        : m_text(text), m_cursor(cursor), m_errors(errors)
    {}

    JsonNode take() { return std::move(m_root); }
    [[nodiscard]] bool clean() const { return m_clean; }

    bool null() { return leaf({.kind = JsonNode::Kind::Null}, m_cursor.now); }
    bool boolean(bool value) { return leaf({.kind = JsonNode::Kind::Boolean, .boolean = value}, m_cursor.now); }
    bool number_integer(nlohmann::json::number_integer_t value) { return number(static_cast<double>(value)); }
    bool number_unsigned(nlohmann::json::number_unsigned_t value) { return number(static_cast<double>(value)); }
    bool number_float(nlohmann::json::number_float_t value, const std::string&) { return number(value); }
    bool string(std::string& value) { return leaf({.kind = JsonNode::Kind::String, .text = std::move(value)}, m_cursor.now); }
    bool binary(nlohmann::json::binary_t&) { return false; }
    bool start_object(std::size_t) { return open(JsonNode::Kind::Object); }
    bool start_array(std::size_t) { return open(JsonNode::Kind::Array); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name);
    bool parse_error(std::size_t, const std::string& token, const nlohmann::json::exception& error);

private:
    bool number(double value) { return leaf({.kind = JsonNode::Kind::Number, .number = value}, m_cursor.before); }
    bool leaf(JsonNode node, TextPlace place);
    bool open(JsonNode::Kind kind);
    bool close();
    JsonNode& attach(JsonNode node);
    void fail(TextPlace place, std::string sentence);

    std::string_view m_text;
    const Cursor& m_cursor;
    LoadErrors& m_errors;
    JsonNode m_root{};
    std::vector<JsonNode> m_open{}; ///< the containers around the current token, outermost first
    bool m_clean = true;
};

void TreeBuilder::fail(TextPlace place, std::string sentence)
{
    m_clean = false;
    m_errors.push_back({.line = place.line, .column = place.column, .sentence = std::move(sentence)});
}

JsonNode& TreeBuilder::attach(JsonNode node)
{
    if (m_open.empty())
        return m_root = std::move(node);
    return m_open.back().items.emplace_back(std::move(node));
}

bool TreeBuilder::leaf(JsonNode node, TextPlace place)
{
    node.line = place.line;
    node.column = place.column;
    attach(std::move(node));
    return true;
}

bool TreeBuilder::open(JsonNode::Kind kind)
{
    if (m_open.size() >= max_depth)
    {
        fail(m_cursor.now, "nested deeper than " + std::to_string(max_depth) + " levels");
        return false;
    }
    m_open.push_back({.kind = kind, .line = m_cursor.now.line, .column = m_cursor.now.column});
    return true;
}

bool TreeBuilder::close()
{
    JsonNode done = std::move(m_open.back());
    m_open.pop_back();
    attach(std::move(done));
    return true;
}

bool TreeBuilder::key(std::string& name)
{
    JsonNode& object = m_open.back();
    if (object.keys.size() >= max_keys)
    {
        fail(m_cursor.now, "an object has more than " + std::to_string(max_keys) + " keys");
        return false;
    }
    if (std::find(object.keys.begin(), object.keys.end(), name) != object.keys.end())
        fail(m_cursor.now, "the key \"" + name + "\" stands twice in one object");
    object.keys.push_back(std::move(name));
    return true;
}

bool TreeBuilder::parse_error(std::size_t read, const std::string&, const nlohmann::json::exception& error)
{
    const std::size_t open_line = m_open.empty() ? 0 : static_cast<std::size_t>(m_open.back().line);
    fail(m_cursor.now, "not valid JSON: " + syntax_sentence(m_text, read, open_line, error.what()));
    return false;
}

} // namespace

const JsonNode* JsonNode::member(std::string_view key) const
{
    const auto found = std::find(keys.begin(), keys.end(), key);
    return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

std::string_view kind_name(JsonNode::Kind kind)
{
    constexpr std::array<std::string_view, 6> names = {"null", "true or false", "a number", "a string", "an array", "an object"};
    return names[static_cast<std::size_t>(kind)];
}

std::optional<JsonNode> parse_json(std::string_view text, LoadErrors& errors)
{
    if (text.size() > max_text_size)
    {
        errors.push_back({.sentence = "larger than 4 MB: this is no table"});
        return std::nullopt;
    }
    Cursor cursor;
    TreeBuilder builder(text, cursor, errors);
    const CountingIterator first(text.data(), &cursor);
    const CountingIterator last(text.data() + text.size(), &cursor);
    const bool read = nlohmann::json::sax_parse(first, last, &builder, nlohmann::json::input_format_t::json, true, true);
    if (!read && errors.empty())
        errors.push_back({.line = cursor.now.line, .column = cursor.now.column, .sentence = "not valid JSON"});
    if (!read || !builder.clean())
        return std::nullopt;
    return builder.take();
}

} // namespace carom::pinball
