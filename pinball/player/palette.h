#pragma once

/// @file
/// The machine's colours, and what it is made of.

#include "pinball/table/table.h"
#include "view/color.h"

#include <string>

namespace carom::pinball {

namespace palette {
using view::rgb;
inline constexpr view::Color room = rgb(0x0b0c12);
inline constexpr view::Color wood_dark = rgb(0x2a1610);
inline constexpr view::Color wood = rgb(0x5b3220);
inline constexpr view::Color wood_light = rgb(0xa5683f);
inline constexpr view::Color field_top = rgb(0x274a94);
inline constexpr view::Color field_bottom = rgb(0x18204f);
inline constexpr view::Color gold = rgb(0xf2b544);
inline constexpr view::Color teal = rgb(0x43c6c4);
inline constexpr view::Color coral = rgb(0xff6b5e);
inline constexpr view::Color ivory = rgb(0xf4ead4);
inline constexpr view::Color steel = rgb(0xaeb7c4);
inline constexpr view::Color steel_light = rgb(0xf4f8ff);
inline constexpr view::Color steel_dark = rgb(0x4b5363);
inline constexpr view::Color rubber = rgb(0xe6dfd2);
inline constexpr view::Color rubber_dark = rgb(0x8d8577);
inline constexpr view::Color red = rgb(0xd8343a);
inline constexpr view::Color shadow = rgb(0x000006);
inline constexpr view::Color text = rgb(0xe9eef8);
inline constexpr view::Color text_faint = rgb(0x93a0ba);
} // namespace palette

enum class Stuff
{
    Wood,
    Metal,
    Rubber,
    Plastic,
};

/// By the name of the element's material.
[[nodiscard]] inline Stuff stuff_of(const Table& table, Index element)
{
    const Index material = table.elements[element].material;
    const std::string name = material == none ? "" : table.materials[material].name;
    const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
    return has("metal") ? Stuff::Metal : has("rubber") ? Stuff::Rubber : has("wood") ? Stuff::Wood : Stuff::Plastic;
}

[[nodiscard]] inline view::Color color_of(const Element& element, view::Color otherwise)
{
    if (!element.color)
        return otherwise;
    constexpr float full = 255;
    return {static_cast<float>(element.color->r) / full, static_cast<float>(element.color->g) / full,
            static_cast<float>(element.color->b) / full, 1};
}

} // namespace carom::pinball
