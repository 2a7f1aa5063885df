#pragma once

/// @file
/// The reading side of the tour: the text of a chapter in pages that fit the window, its sliders, and the buttons for time and pages.

#include "tour/lesson.h"
#include "view/window.h"

#include <optional>
#include <vector>

namespace carom::tour {

/// Where things stand in a window of this size, in points.
struct TourLayout
{
    Vec2 picture_min{};
    Vec2 picture_max{};
    Vec2 panel_min{};
    Vec2 panel_max{};
    float unit = 1; ///< sizes of text are multiples of it
};
[[nodiscard]] TourLayout lay_out(Vec2 window);

/// The wishes of the reader.
struct PanelWish
{
    int turn_page = 0;    ///< -1 and 1
    int turn_chapter = 0; ///< -1 and 1
    std::optional<int> chapter{};
    bool see_on_table = false;
    bool leave = false;
};

class Panel
{
public:
    explicit Panel(ChapterText interface_words) : m_words(std::move(interface_words.words)) {}

    /// Into the present frame.
    [[nodiscard]] PanelWish draw(view::Window& window, const TourLayout& layout, Lesson& lesson, int chapter,
                                 const std::vector<std::string>& titles);

    [[nodiscard]] int page() const { return m_page; }
    [[nodiscard]] int pages() const { return m_pages; } ///< as of the last frame
    void set_page(int page)
    {
        m_page = page;
        m_set_for = -1;
    }
    [[nodiscard]] const std::string& word(std::string_view name) const;

private:
    void title(int chapter, const std::string& text, float unit);
    void read(Lesson& lesson, const std::vector<Block>& blocks, float room, float unit);
    void block(const Block& block, float unit);
    void controls(Lesson& lesson, float unit);
    void time(Lesson& lesson);
    void turn(PanelWish& wish, int chapter, const std::vector<std::string>& titles);

    view::Fonts* m_fonts = nullptr;
    Values m_words;
    int m_page = 0;
    int m_pages = 1;
    int m_set_for = -1; ///< the page whose settings hold
    float m_foot = 200; ///< height of what stands below the text, as it was in the last frame
};

} // namespace carom::tour
