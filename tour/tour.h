#pragma once

/// @file
/// The tour: how a 2D engine works, in eleven chapters with live scenes, in the order of the text that Carom began with.

#include "tour/lesson.h"
#include "tour/panel.h"
#include "view/window.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace carom::tour {

class Tour
{
public:
    /// Throws std::runtime_error where a text is missing.
    explicit Tour(view::Window& window);
    ~Tour();

    enum class Wish
    {
        None,
        SeeOnTable, ///< with chapter().table_view()
        Leave,
    };
    void handle(const SDL_Event& event);
    /// A frame after so much real time; draws into the window's present frame.
    [[nodiscard]] Wish frame(double seconds);

    [[nodiscard]] int chapter() const { return m_chapter; } ///< from 0
    [[nodiscard]] int chapters() const { return static_cast<int>(m_lessons.size()); }
    [[nodiscard]] Lesson& lesson() { return *m_lessons[static_cast<std::size_t>(m_chapter)]; }
    [[nodiscard]] Panel& panel() { return m_panel; }
    void open(int chapter);

private:
    void key(SDL_Scancode code);
    void take_mouse(const SDL_Event& event);
    void turn_page(int by);
    void picture(const TourLayout& layout);

    view::Window& m_window;
    std::vector<std::unique_ptr<Lesson>> m_lessons;
    std::vector<std::string> m_titles;
    Panel m_panel;
    view::Camera m_camera;
    int m_chapter = 0;
    Wish m_wish = Wish::None;
};

/// Writes a picture of each page of each chapter into the folder: "04-the-blow-1.png". False, with a sentence on stderr, where that fails.
[[nodiscard]] bool write_pictures(view::Window& window, const std::string& folder);

} // namespace carom::tour
