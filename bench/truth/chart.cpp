#include "truth/chart.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace truth {
namespace {

constexpr double width = 820;
constexpr double height = 460;
constexpr double left = 78;
constexpr double right = 24;
constexpr double top = 84;
constexpr double bottom = 58;

std::string text_of(double value)
{
    std::ostringstream out;
    out.precision(6);
    out << (std::abs(value) < 1e-12 ? 0 : value);
    return out.str();
}

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text)
    {
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return result;
}

/// One direction of the chart: an interval of values with a round step, laid on an interval of pixels.
class Axis
{
public:
    Axis(double low, double high, double from, double to) : m_step(round_step(high - low)), m_from(from), m_to(to)
    {
        m_low = std::floor(low / m_step + 1e-9) * m_step;
        m_high = std::max(std::ceil(high / m_step - 1e-9) * m_step, m_low + m_step);
    }
    [[nodiscard]] double at(double value) const { return m_from + (m_to - m_from) * (value - m_low) / (m_high - m_low); }
    [[nodiscard]] std::vector<double> ticks() const
    {
        std::vector<double> result;
        for (int i = 0; m_low + i * m_step <= m_high + m_step / 2; ++i)
        {
            result.push_back(m_low + i * m_step);
        }
        return result;
    }

private:
    /// 1, 2 or 5 times a power of ten that gives five to ten steps.
    static double round_step(double range)
    {
        const double rough = range > 0 ? range / 6 : 1;
        const double power = std::pow(10, std::floor(std::log10(rough)));
        const double digits = rough / power;
        return power * (digits < 1.5 ? 1 : digits < 3.5 ? 2 : digits < 7.5 ? 5 : 10);
    }

    double m_step;
    double m_low = 0;
    double m_high = 0;
    double m_from;
    double m_to;
};

struct Frame
{
    Axis x;
    Axis y;
};

Frame frame_of(const Chart& chart)
{
    constexpr double huge = std::numeric_limits<double>::infinity();
    Vec low{huge, huge};
    Vec high{-huge, -huge};
    for (const Series& series : chart.series)
    {
        for (const std::vector<Vec>& line : series.lines)
        {
            for (const Vec p : line)
            {
                low = {std::min(low.x, p.x), std::min(low.y, p.y)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y)};
            }
        }
    }
    if (!(low.x <= high.x))
    {
        throw std::runtime_error("the chart \"" + chart.title + "\" has no points");
    }
    return {Axis(low.x, high.x, left, width - right), Axis(low.y, high.y, height - bottom, top)};
}

struct Text
{
    Vec at{};
    std::string anchor = "middle";
    int size = 13;
    std::string color = "#3c434c";
    bool upwards = false;
};

void draw_text(std::ostream& out, const Text& how, const std::string& text)
{
    out << "<text x=\"" << how.at.x << "\" y=\"" << how.at.y << "\" text-anchor=\"" << how.anchor << "\" font-size=\"" << how.size
        << "\" fill=\"" << how.color << '"';
    if (how.upwards)
    {
        out << " transform=\"rotate(-90 " << how.at.x << ' ' << how.at.y << ")\"";
    }
    out << '>' << escaped(text) << "</text>\n";
}

void draw_segment(std::ostream& out, Vec a, Vec b, const std::string& style)
{
    out << "<line x1=\"" << a.x << "\" y1=\"" << a.y << "\" x2=\"" << b.x << "\" y2=\"" << b.y << "\" " << style << "/>\n";
}

void draw_axes(std::ostream& out, const Chart& chart, const Frame& frame)
{
    const std::string grid = "stroke=\"#e3e6ea\"";
    for (const double tick : frame.x.ticks())
    {
        const double x = frame.x.at(tick);
        draw_segment(out, {x, top}, {x, height - bottom}, grid);
        draw_text(out, {.at = {x, height - bottom + 20}}, text_of(tick));
    }
    for (const double tick : frame.y.ticks())
    {
        const double y = frame.y.at(tick);
        draw_segment(out, {left, y}, {width - right, y}, grid);
        draw_text(out, {.at = {left - 8, y + 4}, .anchor = "end"}, text_of(tick));
    }
    draw_text(out, {.at = {left, 28}, .anchor = "start", .size = 17, .color = "#14181d"}, chart.title);
    draw_text(out, {.at = {(left + width - right) / 2, height - 14}}, chart.x_label);
    draw_text(out, {.at = {20, (top + height - bottom) / 2}, .upwards = true}, chart.y_label);
}

std::string stroke(const Series& series)
{
    return "fill=\"none\" stroke=\"" + series.color + "\" stroke-width=\"1.8\" stroke-linejoin=\"round\"" +
           (series.mark == Mark::Dashed ? " stroke-dasharray=\"7 5\"" : "");
}

void draw_dot(std::ostream& out, Vec at, const Series& series)
{
    out << "<circle cx=\"" << at.x << "\" cy=\"" << at.y << "\" r=\"4\" fill=\"" << series.color << "\"/>\n";
}

void draw_series(std::ostream& out, const Series& series, const Frame& frame)
{
    for (const std::vector<Vec>& line : series.lines)
    {
        if (series.mark == Mark::Dots)
        {
            for (const Vec p : line)
            {
                draw_dot(out, {frame.x.at(p.x), frame.y.at(p.y)}, series);
            }
            continue;
        }
        out << "<polyline " << stroke(series) << " points=\"";
        for (const Vec p : line)
        {
            out << frame.x.at(p.x) << ',' << frame.y.at(p.y) << ' ';
        }
        out << "\"/>\n";
    }
}

void draw_legend(std::ostream& out, const Chart& chart)
{
    double x = left;
    const double y = 56;
    for (const Series& series : chart.series)
    {
        if (series.mark == Mark::Dots)
        {
            draw_dot(out, {x + 13, y - 4}, series);
        }
        else
        {
            draw_segment(out, {x, y - 4}, {x + 26, y - 4}, stroke(series));
        }
        draw_text(out, {.at = {x + 34, y}, .anchor = "start"}, series.name);
        x += 62 + 7.2 * static_cast<double>(series.name.size());
    }
}

} // namespace

void write_svg(const Chart& chart, const std::filesystem::path& file)
{
    const Frame frame = frame_of(chart);
    std::ofstream out(file);
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' ' << height << "\" width=\"" << width
        << "\" height=\"" << height << "\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n"
        << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    draw_axes(out, chart, frame);
    for (auto series = chart.series.rbegin(); series != chart.series.rend(); ++series)
    {
        draw_series(out, *series, frame);
    }
    draw_legend(out, chart);
    out << "</svg>\n";
    if (!out)
    {
        throw std::runtime_error("cannot write " + file.string());
    }
}

} // namespace truth
