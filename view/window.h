#pragma once

/// @file
/// A window with OpenGL 3.3 and Dear ImGui. With SDL_VIDEODRIVER=offscreen it renders for real without any display.
///
///     view::Window window({.title = "Carom"});
///     while (window.begin_frame())
///     {
///         for (const SDL_Event& event : window.events()) ...;
///         view::Canvas canvas = window.canvas(camera);   // world
///         view::Canvas hud = window.canvas();            // points, y down
///         ImGui::Begin(...);                              // widgets
///         window.end_frame();
///     }

#include "view/camera.h"
#include "view/canvas.h"
#include "view/color.h"
#include "view/fonts.h"
#include "view/image.h"

#include <SDL_events.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace carom::view {

struct WindowDef
{
    std::string title = "Carom";
    int width = 1280; ///< points
    int height = 800;
    bool fullscreen = false;
    bool vertical_sync = true;
    Color background = rgb(0x10141c);
};

class Window
{
public:
    /// Throws std::runtime_error with one sentence where there is no display or no OpenGL 3.3.
    explicit Window(const WindowDef& def = {});
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Collects events and starts a frame. False once the user (or a signal) asked to quit.
    [[nodiscard]] bool begin_frame();
    /// Draws what was given since begin_frame and shows it. With a capture, also reads the pixels back.
    void end_frame(Image* capture = nullptr);

    /// The events of this frame, in order. Widgets have seen them too: ask wants_keyboard and wants_mouse first.
    [[nodiscard]] std::span<const SDL_Event> events() const { return m_events; }
    [[nodiscard]] bool wants_keyboard() const; ///< a widget is taking text
    [[nodiscard]] bool wants_mouse() const;    ///< the mouse is over a widget
    void request_quit() { m_quit = true; }
    [[nodiscard]] bool has_focus() const;
    [[nodiscard]] Vec2 mouse() const; ///< points

    [[nodiscard]] Vec2 size() const;         ///< points
    [[nodiscard]] float pixel_scale() const; ///< real pixels per point
    [[nodiscard]] bool is_offscreen() const; ///< nobody sees this window
    void set_fullscreen(bool fullscreen);
    [[nodiscard]] bool is_fullscreen() const;
    void toggle_fullscreen() { set_fullscreen(!is_fullscreen()); }
    void set_title(const std::string& title);
    void set_background(Color color) { m_background = color; }

    [[nodiscard]] Fonts& fonts() { return m_fonts; }
    /// A canvas below all widgets, in the camera's world.
    [[nodiscard]] Canvas canvas(const Camera& camera);
    /// A canvas below all widgets, in points from the top left corner.
    [[nodiscard]] Canvas canvas();
    /// A canvas above all widgets, in points from the top left corner.
    [[nodiscard]] Canvas foreground();

private:
    struct Native;
    void poll();
    void fetch_events();
    void read_pixels(Image& image) const;

    std::unique_ptr<Native> m_native;
    std::vector<SDL_Event> m_events;
    Fonts m_fonts;
    Color m_background;
    bool m_quit = false;
};

} // namespace carom::view
