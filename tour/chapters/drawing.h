#pragma once

/// @file
/// Drawings that several chapters share: labels, arrows with a name, curves.

#include "tour/chapter.h"
#include "view/canvas.h"
#include "view/shape_art.h"

#include <deque>
#include <span>
#include <string>
#include <string_view>

namespace carom::tour {

inline constexpr view::Color ink = view::rgb(0xe8eef8);
inline constexpr view::Color faint = view::rgb(0x8fa1bd);
inline constexpr view::Color first_color = view::rgb(0xffa94d);
inline constexpr view::Color second_color = view::rgb(0x74c0fc);
inline constexpr view::Color good_color = view::rgb(0x8ce99a);
inline constexpr view::Color bad_color = view::rgb(0xff8787);
inline constexpr view::Color yellow = view::rgb(0xffe066);

/// Text with its middle at a point, kept inside the picture.
void label(view::Canvas& canvas, Position at, std::string_view text, view::Color color = ink, float size = 13);

/// An arrow with its name beside its head; nothing where it is too short to see.
void named_arrow(view::Canvas& canvas, Position from, Vec2 way, std::string_view name, view::Color color);

/// Where much is drawn over a scene it steps back.
[[nodiscard]] view::ScenePalette quiet_palette();

/// A whole number, as a slider of whole numbers gives it.
[[nodiscard]] std::string whole(float value);

/// With so many digits after the point and a real minus sign: numbers of one sum have as many.
[[nodiscard]] std::string fixed(float value, int digits = 3);

/// Values over time, the newest last.
struct Curve
{
    explicit Curve(view::Color c, std::string_view n = {}) : color(c), name(n) {}
    view::Color color;
    std::string name;
    std::deque<float> values{};

    void add(float value, std::size_t most = 240);
};

/// Curves with one scale, zero in sight, over time: `most` values, `seconds` long, fit into the width. The greatest value stands at the upper
/// right corner, the least one, where it is below zero, at the lower right one.
void draw_curves(view::Canvas& canvas, const Box& area, std::string_view title, std::span<const Curve* const> curves, double seconds,
                 std::size_t most = 240);

} // namespace carom::tour
