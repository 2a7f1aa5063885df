#include "view/fonts.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace carom::view {
namespace {

constexpr float widget_points = 15;
// 40 sizes of the ranges below fill about a quarter of a 4096² atlas.
constexpr std::size_t most_sizes = 40;

std::vector<unsigned char> read_file(const std::string& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<unsigned char> read_font(const std::string& name)
{
    std::vector<std::string> folders{"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF",
                                     "/usr/share/fonts/dejavu-sans-fonts"};
    if (const char* own = std::getenv("CAROM_FONT_DIR"))
        folders.insert(folders.begin(), own);
    for (const std::string& folder : folders)
        if (auto bytes = read_file(folder + "/" + name); !bytes.empty())
            return bytes;
    return {};
}

// Latin, Greek, and what formulas need: super- and subscripts, arrows, operators, marks.
const ImWchar* glyph_ranges()
{
    static const ImWchar ranges[] = {0x0020, 0x017F, 0x0370, 0x03FF, 0x2010, 0x2027, 0x2070, 0x209F, 0x2190,
                                     0x21A0, 0x2200, 0x2265, 0x25A0, 0x25CF, 0x2605, 0x2606, 0};
    return ranges;
}

} // namespace

Fonts::Fonts()
{
    m_files[Face::Sans] = read_font("DejaVuSans.ttf");
    m_files[Face::Bold] = read_font("DejaVuSans-Bold.ttf");
    m_files[Face::Mono] = read_font("DejaVuSansMono.ttf");
}

int Fonts::pixels_for(float points) const
{
    const float pixels = std::clamp(points * m_scale, 6.0f, 200.0f);
    // Big letters in steps of about 4 %, so that a zoom does not bake every pixel size on its way.
    const float step = pixels < 32 ? 1.0f : pixels < 64 ? 2.0f : 4.0f;
    return static_cast<int>(std::round(pixels / step) * step);
}

ImFont* Fonts::nearest(Key key) const
{
    ImFont* best = nullptr;
    int distance = 1 << 20;
    for (const auto& [other, font] : m_baked)
    {
        const int d = std::abs(other.pixels - key.pixels) + (other.face == key.face ? 0 : 1000);
        if (d < distance)
        {
            distance = d;
            best = font;
        }
    }
    return best != nullptr ? best : ImGui::GetFont();
}

SizedFont Fonts::get(Face face, float points)
{
    const Key key{face, pixels_for(points)};
    const float size = static_cast<float>(key.pixels) / m_scale;
    m_wanted[key] = true;
    if (const auto found = m_baked.find(key); found != m_baked.end())
        return {found->second, size};
    m_dirty = true;
    return {nearest(key), size};
}

bool Fonts::prepare(float pixel_scale)
{
    if (pixel_scale != m_scale)
    {
        m_scale = pixel_scale;
        m_wanted.clear();
        m_dirty = true;
    }
    if (!m_dirty)
        return false;
    bake();
    return true;
}

void Fonts::bake()
{
    if (m_wanted.size() > most_sizes)
        std::erase_if(m_wanted, [](const auto& entry) { return !entry.second; });
    if (m_wanted.size() > most_sizes)
        m_wanted.clear();
    const Key widgets{Face::Sans, pixels_for(widget_points)};
    m_wanted.try_emplace(widgets, false);

    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    m_baked.clear();
    for (auto& [key, used] : m_wanted)
    {
        ImFontConfig config;
        config.FontDataOwnedByAtlas = false;
        config.OversampleH = key.pixels < 32 ? 2 : 1;
        config.OversampleV = 1;
        config.SizePixels = static_cast<float>(key.pixels);
        std::vector<unsigned char>& file = m_files[key.face];
        m_baked[key] = file.empty() ? io.Fonts->AddFontDefault(&config)
                                    : io.Fonts->AddFontFromMemoryTTF(file.data(), static_cast<int>(file.size()),
                                                                     config.SizePixels, &config, glyph_ranges());
        used = false;
    }
    io.FontDefault = m_baked[widgets];
    io.FontGlobalScale = 1 / m_scale;
    m_dirty = false;
}

} // namespace carom::view
