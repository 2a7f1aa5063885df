#pragma once

/// @file
/// Text faces. Every size is baked in real pixels, so text is crisp at any size and display scale. A size asked for the
/// first time is drawn from the nearest baked one for that frame and baked before the next: draw two frames before
/// a picture is taken.

#include <map>
#include <string>
#include <vector>

struct ImFont;

namespace carom::view {

enum class Face
{
    Sans,
    Bold,
    Mono,
};

/// A baked font and the size, in points, to draw it at.
struct SizedFont
{
    ImFont* font = nullptr;
    float size = 0;
};

class Fonts
{
public:
    /// Reads DejaVu from the folder in CAROM_FONT_DIR or the system's; without it everything is Dear ImGui's own font.
    Fonts();

    /// The face at this size in points. Valid for the present frame.
    [[nodiscard]] SizedFont get(Face face, float points);

    /// Called by Window between frames: bakes what was asked for. True if the atlas changed.
    bool prepare(float pixel_scale);

private:
    struct Key
    {
        Face face;
        int pixels;
        friend auto operator<=>(const Key&, const Key&) = default;
    };
    void bake();
    [[nodiscard]] ImFont* nearest(Key key) const;
    [[nodiscard]] int pixels_for(float points) const;

    std::map<Face, std::vector<unsigned char>> m_files;
    std::map<Key, ImFont*> m_baked;
    std::map<Key, bool> m_wanted; ///< true: used since the last bake
    float m_scale = 1;
    bool m_dirty = true;
};

} // namespace carom::view
