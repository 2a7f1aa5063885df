#include "pinball/table/load_path.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace carom::pinball {
namespace {

constexpr std::size_t max_pieces = 1'000;

double distance(Vec2 a, Vec2 b)
{
    return std::sqrt((double{a.x} - b.x) * (double{a.x} - b.x) + (double{a.y} - b.y) * (double{a.y} - b.y));
}

/// Follows the commands of one path and remembers whether any of them was refused.
class PathReader
{
public:
    explicit PathReader(FieldReader& reader) : m_reader(reader) {}

    Chain read();
    [[nodiscard]] bool ends_in_z() const { return m_closed; }
    [[nodiscard]] bool clean() const { return m_clean; }

private:
    void command(const JsonNode& node);
    void move(const JsonNode& node);
    void line(const JsonNode& node);
    void arc(const JsonNode& node);
    void close(const JsonNode& node);
    void add_arc(const JsonNode& node, Vec2 center, double radius, double from, double to);
    bool arguments_fit(const JsonNode& node, std::size_t count);
    bool in_range(const JsonNode& node, std::size_t argument, Range range);
    void fail(const JsonNode& node, std::string sentence);

    FieldReader& m_reader;
    Chain m_chain{};
    Vec2 m_at{};
    std::string m_place{};
    bool m_started = false;
    bool m_closed = false;
    bool m_clean = true;
};

void PathReader::fail(const JsonNode& node, std::string sentence)
{
    m_clean = false;
    m_reader.fail(node, m_place, std::move(sentence));
}

bool PathReader::in_range(const JsonNode& node, std::size_t argument, Range range)
{
    const JsonNode& value = node.items[argument];
    if (value.kind != JsonNode::Kind::Number)
        fail(value, "number " + std::to_string(argument) + " after the letter is not a number");
    else if (value.number < range.least || value.number > range.most)
        fail(value, "must lie between " + short_number(range.least) + " and " + short_number(range.most) + " " +
                        std::string(range.unit) + ", is " + short_number(value.number));
    else
        return true;
    return false;
}

bool PathReader::arguments_fit(const JsonNode& node, std::size_t count)
{
    if (node.items.size() == count + 1)
        return true;
    fail(node, "needs " + std::to_string(count) + " numbers after \"" + node.items[0].text + "\", has " +
                   std::to_string(node.items.size() - 1));
    return false;
}

void PathReader::move(const JsonNode& node)
{
    if (m_started)
        return fail(node, "a path has one \"M\", at its start");
    m_started = true;
    if (arguments_fit(node, 2) && in_range(node, 1, range::coordinate) && in_range(node, 2, range::coordinate))
        m_chain.start = m_at = {static_cast<float>(node.items[1].number), static_cast<float>(node.items[2].number)};
}

void PathReader::line(const JsonNode& node)
{
    if (!arguments_fit(node, 2) || !in_range(node, 1, range::coordinate) || !in_range(node, 2, range::coordinate))
        return;
    const Vec2 end{static_cast<float>(node.items[1].number), static_cast<float>(node.items[2].number)};
    if (distance(m_at, end) < snap_distance)
        return fail(node, "a line of no length");
    m_chain.pieces.push_back({.end = end});
    m_at = end;
}

void PathReader::arc(const JsonNode& node)
{
    constexpr Range center{-20, 20, "m"};
    constexpr Range radius{0.001, 20, "m"};
    if (arguments_fit(node, 5) && in_range(node, 1, center) && in_range(node, 2, center) && in_range(node, 3, radius) &&
        in_range(node, 4, range::angle) && in_range(node, 5, range::angle))
        add_arc(node, {static_cast<float>(node.items[1].number), static_cast<float>(node.items[2].number)}, node.items[3].number,
                node.items[4].number * radians_per_degree, node.items[5].number * radians_per_degree);
}

void PathReader::add_arc(const JsonNode& node, Vec2 center, double radius, double from, double to)
{
    const auto point_at = [&](double angle)
    { return center + rotate(Rotation::from_angle(static_cast<float>(angle)), {static_cast<float>(radius), 0}); };
    const double sweep = to - from;
    if (std::abs(sweep) < 0.5 * radians_per_degree || std::abs(sweep) > 359.5 * radians_per_degree)
        return fail(node, "an arc sweeps between 0.5 and 359.5 degrees");
    const double miss = distance(point_at(from), m_at);
    if (miss > snap_distance)
        return fail(node, "this arc starts " + short_number(std::round(miss * 1e6) / 1e3) +
                              " mm from where the path stands; 0.1 mm is allowed");
    const Vec2 end = point_at(to);
    if (distance(m_at, end) < snap_distance)
        return fail(node, "the ends of an arc lie at least 0.1 mm apart");
    m_chain.pieces.push_back({.end = end, .sweep = static_cast<float>(sweep)});
    m_at = end;
}

void PathReader::close(const JsonNode& node)
{
    m_closed = true;
    arguments_fit(node, 0);
    if (m_chain.pieces.empty())
        return;
    // A last piece that comes back to the start within the snap ends there exactly: no closing line of a hair's length.
    if (distance(m_at, m_chain.start) < snap_distance)
        m_chain.pieces.back().end = m_chain.start;
    else
        m_chain.pieces.push_back({.end = m_chain.start});
}

void PathReader::command(const JsonNode& node)
{
    if (node.kind != JsonNode::Kind::Array || node.items.empty() || node.items[0].kind != JsonNode::Kind::String)
        return fail(node, "must be an array like [\"L\", x, y]");
    const std::string& letter = node.items[0].text;
    if (m_closed)
        return fail(node, "nothing follows \"Z\"");
    if (!m_started && letter != "M")
        return fail(node, "a path starts with \"M\"");
    if (letter == "M")
        move(node);
    else if (letter == "L")
        line(node);
    else if (letter == "A")
        arc(node);
    else if (letter == "Z")
        close(node);
    else
        fail(node, "a path command is \"M\", \"L\", \"A\" or \"Z\"");
}

Chain PathReader::read()
{
    const JsonNode* path = m_reader.member("path", JsonNode::Kind::Array, true);
    if (path == nullptr)
    {
        m_clean = false;
        return {};
    }
    m_place = "path";
    if (path->items.size() > max_pieces)
        fail(*path, "has more than " + std::to_string(max_pieces) + " commands");
    for (std::size_t i = 0; m_clean && i < path->items.size(); ++i)
    {
        m_place = "path[" + std::to_string(i) + "]";
        command(path->items[i]);
    }
    m_place = "path";
    if (m_clean && m_chain.pieces.empty())
        fail(*path, "needs at least one line or arc");
    return m_chain;
}

void reverse(Chain& chain)
{
    const std::vector<ChainPiece> forward = chain.pieces;
    chain.pieces.clear();
    for (std::size_t i = forward.size(); i-- > 0;)
        chain.pieces.push_back({.end = i == 0 ? chain.start : forward[i - 1].end, .sweep = -forward[i].sweep});
}

/// Area between an arc and its chord: r²/2 (sweep - sin sweep), with r from chord = 2 r sin(sweep / 2).
double arc_cap_area(double chord, double sweep)
{
    const Rotation half = Rotation::from_angle(static_cast<float>(sweep / 2));
    const double radius = chord / 2 / std::abs(double{half.s});
    const double sine = 2 * double{half.s} * half.c;
    return radius * radius / 2 * (sweep - sine);
}

} // namespace

double signed_area(const Chain& chain)
{
    double area = 0;
    Vec2 from = chain.start;
    for (const ChainPiece& piece : chain.pieces)
    {
        area += (double{from.x} * piece.end.y - double{from.y} * piece.end.x) / 2;
        if (piece.sweep != 0)
            area += arc_cap_area(distance(from, piece.end), piece.sweep);
        from = piece.end;
    }
    return area;
}

Chain read_open_path(FieldReader& reader)
{
    PathReader path(reader);
    Chain chain = path.read();
    if (path.clean() && path.ends_in_z())
        reader.fail("path", "a wall is open: the path must not end in \"Z\"");
    return chain;
}

Chain read_closed_path(FieldReader& reader)
{
    PathReader path(reader);
    Chain chain = path.read();
    if (path.clean() && !path.ends_in_z())
        reader.fail("path", "the path of a solid must end in \"Z\"");
    else if (path.clean() && std::abs(signed_area(chain)) < 1e-6)
        reader.fail("path", "the outline encloses no area");
    else if (path.clean() && signed_area(chain) < 0)
        reverse(chain);
    chain.closed = true;
    return chain;
}

} // namespace carom::pinball
