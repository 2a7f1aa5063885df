#include "view/image.h"

#include <stb_image_write.h>

namespace carom::view {

bool save_png(const Image& image, const std::string& path)
{
    return stbi_write_png(path.c_str(), image.width, image.height, 3, image.pixels.data(), image.width * 3) != 0;
}

} // namespace carom::view
