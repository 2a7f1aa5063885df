#pragma once

// Reads an impact story as a reader would who checks it with a calculator: every chain of equal signs must be one number, as far as the digits
// that are shown can tell.

#include "view/impact_story.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom::test {

/// The range of values that a number with so many digits may have been rounded from.
struct Range
{
    double low = 0;
    double high = 0;
};

namespace detail {

inline Range hull(std::initializer_list<double> values) { return {std::min(values), std::max(values)}; }
inline Range plus(Range a, Range b) { return {a.low + b.low, a.high + b.high}; }
inline Range minus(Range a, Range b) { return {a.low - b.high, a.high - b.low}; }
inline Range times(Range a, Range b) { return hull({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high}); }
inline std::optional<Range> over(Range a, Range b)
{
    if (b.low <= 0 && b.high >= 0)
        return std::nullopt;
    return times(a, {1 / b.high, 1 / b.low});
}

// Numbers, + − · / ( ) ² and powers of ten. Nothing where there is anything else: a name, a unit.
class Calculator
{
public:
    explicit Calculator(std::string_view text) : m_text(text) {}

    std::optional<Range> result()
    {
        const std::optional<Range> value = sum();
        skip();
        return m_text.empty() ? value : std::nullopt;
    }

private:
    void skip()
    {
        while (m_text.starts_with(' '))
            m_text.remove_prefix(1);
    }
    bool take(std::string_view sign)
    {
        skip();
        if (!m_text.starts_with(sign))
            return false;
        m_text.remove_prefix(sign.size());
        return true;
    }

    std::optional<Range> sum()
    {
        std::optional<Range> value = product();
        while (value)
        {
            const bool adds = take("+");
            if (!adds && !take("−"))
                break;
            const std::optional<Range> next = product();
            if (!next)
                return std::nullopt;
            value = adds ? plus(*value, *next) : minus(*value, *next);
        }
        return value;
    }

    std::optional<Range> product()
    {
        std::optional<Range> value = power();
        while (value)
        {
            const bool multiplies = take("·");
            if (!multiplies && !take("/"))
                break;
            const std::optional<Range> next = power();
            if (!next)
                return std::nullopt;
            value = multiplies ? times(*value, *next) : over(*value, *next);
        }
        return value;
    }

    std::optional<Range> power()
    {
        std::optional<Range> value = take("(") ? bracket() : number();
        if (value && take("²"))
            value = times(*value, *value);
        return value;
    }

    std::optional<Range> bracket()
    {
        const std::optional<Range> value = sum();
        return take(")") ? value : std::nullopt;
    }

    std::optional<Range> number()
    {
        const bool negative = take("−");
        skip();
        const std::size_t length = std::min(m_text.find_first_not_of("0123456789."), m_text.size());
        if (length == 0)
            return std::nullopt;
        const std::string digits(m_text.substr(0, length));
        m_text.remove_prefix(length);
        const std::size_t point = digits.find('.');
        const double value = std::stod(digits);
        // Whole numbers of one or two digits stand in the formula itself.
        const bool exact = point == std::string::npos && digits.size() < 3;
        const double half =
            exact ? 0 : 0.5 * std::pow(10, point == std::string::npos ? 0 : -static_cast<double>(digits.size() - point - 1));
        const double scale = (negative ? -1 : 1) * std::pow(10, exponent());
        return times({value - half, value + half}, {scale, scale});
    }

    // ·10⁻⁶
    int exponent()
    {
        static constexpr std::string_view digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
        if (!m_text.starts_with("·10⁻") &&
            !std::ranges::any_of(digits, [&](std::string_view d) { return m_text.starts_with("·10" + std::string(d)); }))
            return 0;
        take("·10");
        const bool negative = take("⁻");
        int value = 0;
        for (bool more = true; more;)
        {
            more = false;
            for (int d = 0; d < 10; ++d)
            {
                if (!m_text.starts_with(digits[d]))
                    continue;
                m_text.remove_prefix(digits[d].size());
                value = 10 * value + d;
                more = true;
            }
        }
        return negative ? -value : value;
    }

    std::string_view m_text;
};

inline std::string without_unit(std::string text)
{
    for (const std::string unit : {" m/s", " N·s", " kg", " J"})
        if (text.ends_with(unit))
            return text.substr(0, text.size() - unit.size());
    return text;
}

} // namespace detail

/// The first formula whose sides differ; empty where all are right.
inline std::string false_formula(const std::vector<view::StoryLine>& story)
{
    for (const view::StoryLine& line : story)
    {
        if (line.kind != view::StoryLine::Kind::Formula)
            continue;
        std::optional<Range> last;
        for (std::size_t start = 0; start < line.text.size();)
        {
            const std::size_t end = std::min(line.text.find(" = ", start), line.text.size());
            const std::optional<Range> side =
                detail::Calculator(detail::without_unit(line.text.substr(start, end - start))).result();
            if (side && last && (side->low > last->high + 1e-12 || side->high < last->low - 1e-12))
                return line.text;
            if (side)
                last = side;
            start = end + 3;
        }
    }
    return "";
}

/// The number after these words in the first line that has them.
inline std::optional<Range> number_after(const std::vector<view::StoryLine>& story, std::string_view words)
{
    for (const view::StoryLine& line : story)
    {
        const std::size_t at = line.text.find(words);
        if (at == std::string::npos)
            continue;
        const std::string rest = line.text.substr(at + words.size());
        return detail::Calculator(rest.substr(0, rest.find(' '))).result();
    }
    return std::nullopt;
}

/// The first false statement in the story of this impact; empty: there is none.
inline std::string what_is_false(const view::ImpactRecord& record)
{
    const std::vector<view::StoryLine> story = view::impact_story(record);
    for (const view::StoryLine& line : story)
        if (line.text.find('{') != std::string::npos)
            return "a word that is missing: " + line.text;
    if (const std::string formula = false_formula(story); !formula.empty())
        return formula;
    const ImpactEvent& e = record.event;
    const auto says = [&](std::string_view words, double value)
    {
        const std::optional<Range> said = number_after(story, words);
        const double rounding = 2e-3 * std::abs(value) + 1e-9;
        return !said || (said->low <= value + rounding && said->high >= value - rounding);
    };
    const auto along = [&](Vec2 v) { return static_cast<double>(dot(v, e.normal)); };
    if (!says("The engine gave ", static_cast<double>(e.impulse)))
        return "impulse";
    if (!says("they slide on at ", std::abs(static_cast<double>(cross(e.normal, e.velocity_after_b - e.velocity_after_a)))))
        return "sliding";
    if (!says("They part at ", along(e.velocity_after_b - e.velocity_after_a)))
        return "parting speed";
    if (!says("still approach at ", -along(e.velocity_after_b - e.velocity_after_a)))
        return "approach afterwards";
    if (!says("Energy turned into heat and sound: ", static_cast<double>(e.energy_lost)))
        return "energy";
    // Afterwards, of each that can be pushed.
    for (const view::StoryLine& line : story)
    {
        for (const bool first : {true, false})
        {
            const std::string& name = first ? record.a.name : record.b.name;
            const std::string v = first ? "v₁" : "v₂";
            const bool is_of_it =
                line.text.starts_with(name + ": " + v) || line.text.starts_with(name + ", where it is hit: " + v);
            if (!is_of_it || (first ? e.effective_mass_a : e.effective_mass_b) <= 0)
                continue;
            const std::size_t equals = line.text.rfind(" = ");
            const std::size_t from = equals != std::string::npos ? equals + 3 : line.text.rfind(" to ") + 4;
            const std::optional<Range> said = detail::Calculator(detail::without_unit(line.text.substr(from))).result();
            const double value = along(first ? e.velocity_after_a : e.velocity_after_b);
            if (!said || said->low > value + 2e-3 * std::abs(value) + 1e-9 || said->high < value - 2e-3 * std::abs(value) - 1e-9)
                return line.text;
        }
    }
    return "";
}

} // namespace carom::test
