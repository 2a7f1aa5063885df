#pragma once

/// @file
/// Pixels read back from a window, and PNG files of them.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::view {

/// 8-bit RGB, top row first.
struct Image
{
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels{};

    [[nodiscard]] const std::uint8_t* at(int x, int y) const
    {
        return pixels.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
};

/// Writes a PNG file; false if the file cannot be written.
bool save_png(const Image& image, const std::string& path);

} // namespace carom::view
