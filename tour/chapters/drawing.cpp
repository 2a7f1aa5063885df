#include "tour/chapters/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace carom::tour {

void label(view::Canvas& canvas, Position at, std::string_view text, view::Color color, float size)
{
    view::TextStyle style{.size = size, .color = color, .align_x = 0.5f, .align_y = 0.5f, .shadow = view::rgb(0x000000, 0.8f)};
    const Box seen = canvas.camera().visible();
    const Vec2 half = (0.5f * canvas.camera().meters(1)) * (canvas.text_size(text, style) + Vec2{8, 8});
    if (seen.upper.x - seen.lower.x > 2 * static_cast<double>(half.x))
        at.x = std::clamp(at.x, seen.lower.x + static_cast<double>(half.x), seen.upper.x - static_cast<double>(half.x));
    if (seen.upper.y - seen.lower.y > 2 * static_cast<double>(half.y))
        at.y = std::clamp(at.y, seen.lower.y + static_cast<double>(half.y), seen.upper.y - static_cast<double>(half.y));
    canvas.text(at, text, style);
}

void named_arrow(view::Canvas& canvas, Position from, Vec2 way, std::string_view name, view::Color color)
{
    const float pixel = canvas.camera().meters(1);
    const float size = length(way);
    if (size < 4 * pixel)
        return;
    canvas.arrow(from, from + way, {color, 2.5f}, 10);
    if (!name.empty())
        label(canvas, from + way + way * (16 * pixel / size), name, color);
}

view::ScenePalette quiet_palette()
{
    view::ScenePalette palette;
    for (view::Color& c : palette.dynamic)
        c = view::mix(view::rgb(0x10141c), c, 0.42f);
    return palette;
}

std::string whole(float value) { return std::to_string(std::lround(value)); }

std::string fixed(float value, int digits)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, static_cast<double>(std::abs(value)));
    const bool is_zero = std::string_view(text).find_first_not_of("0.") == std::string_view::npos;
    return (value < 0 && !is_zero ? "−" : "") + std::string(text);
}

void Curve::add(float value, std::size_t most)
{
    values.push_back(value);
    while (values.size() > most)
        values.pop_front();
}

void draw_curves(view::Canvas& canvas, const Box& area, std::string_view title, std::span<const Curve* const> curves, double seconds,
                 std::size_t most)
{
    const float pixel = canvas.camera().meters(1);
    float low = 0;
    float high = 1e-6f;
    for (const Curve* curve : curves)
    {
        for (const float v : curve->values)
        {
            low = std::min(low, v);
            high = std::max(high, v);
        }
    }
    canvas.fill_box(area, view::rgb(0x0b0e14, 0.8f), 4 * pixel);
    const double width = area.upper.x - area.lower.x;
    const double room = (area.upper.y - area.lower.y) - 22 * static_cast<double>(pixel);
    const auto place = [&](std::size_t i, float v)
    {
        const double share = static_cast<double>((v - low) / (high - low));
        return Position{area.lower.x + width * static_cast<double>(i) / static_cast<double>(most - 1), area.lower.y + room * share};
    };
    canvas.line({area.lower.x, place(0, 0).y}, {area.upper.x, place(0, 0).y}, {view::rgb(0x4b5a73), 1});
    float name_at = 8;
    const auto name = [&](std::string_view text, view::Color color)
    {
        const view::TextStyle style{.size = 12, .color = color};
        canvas.text({area.lower.x + static_cast<double>(name_at * pixel), area.upper.y - static_cast<double>(3 * pixel)}, text, style);
        name_at += canvas.text_size(text, style).x + 10;
    };
    name(title, faint);
    for (const Curve* curve : curves)
    {
        std::vector<Position> path;
        for (std::size_t i = 0; i < curve->values.size(); ++i)
            path.push_back(place(i, curve->values[i]));
        if (path.size() > 1)
            canvas.polyline(path, {curve->color, 2});
        name(curve->name, curve->color);
    }
    const view::TextStyle style{.size = 12, .color = faint, .align_x = 1};
    const std::string most_value = view::number(high);
    if (name_at + canvas.text_size(most_value, style).x + 12 < canvas.points(static_cast<float>(width)))
        canvas.text({area.upper.x - static_cast<double>(6 * pixel), area.upper.y - static_cast<double>(3 * pixel)}, most_value, style);
    view::TextStyle foot = style;
    foot.align_y = 1;
    if (low < -0.02f * high)
        canvas.text({area.upper.x - static_cast<double>(6 * pixel), area.lower.y + static_cast<double>(2 * pixel)}, view::number(low), foot);
    foot.align_x = 0.5f;
    canvas.text({(area.lower.x + area.upper.x) / 2, area.lower.y + static_cast<double>(2 * pixel)}, "← " + view::number(static_cast<float>(seconds)) + " s →", foot);
}

} // namespace carom::tour
