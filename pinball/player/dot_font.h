#pragma once

/// @file
/// Letters for a dot matrix: seven rows high, up to five dots wide.

#include <array>
#include <cstdint>

namespace carom::pinball {

struct DotGlyph
{
    int width = 0;
    std::array<std::uint8_t, 7> rows{}; ///< from the top; the lowest bit is the rightmost dot
};

/// Capitals, digits and , . - / : ! + ; small letters are drawn as capitals, everything else is a gap.
[[nodiscard]] DotGlyph dot_glyph(char c);

} // namespace carom::pinball
