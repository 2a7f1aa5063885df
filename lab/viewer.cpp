#include "lab/viewer.h"

#include "lab/hand.h"
#include "lab/panels.h"
#include "lab/run.h"
#include "view/impact_panel.h"
#include "view/shape_art.h"
#include "view/window.h"

#include <SDL_timer.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

namespace carom::lab {
namespace {

class Viewer
{
public:
    explicit Viewer(const ViewerOptions& options)
        : m_options(options), m_window({.title = "Carom lab", .width = options.width, .height = options.height})
    {
        m_state.xray = options.xray;
        load(*options.entry);
    }

    int watch()
    {
        Uint64 before = SDL_GetPerformanceCounter();
        while (m_window.begin_frame())
        {
            const Uint64 now = SDL_GetPerformanceCounter();
            const double passed = static_cast<double>(now - before) / static_cast<double>(SDL_GetPerformanceFrequency());
            before = now;
            for (const SDL_Event& event : m_window.events())
                handle(event);
            m_hand.follow(m_run->scene(), m_camera);
            m_run->advance(std::min(passed, 0.1));
            frame();
            m_window.end_frame();
            if (m_state.wanted != nullptr)
                load(*m_state.wanted);
        }
        return 0;
    }

    int photograph()
    {
        for (int i = 0; i < m_options.steps; ++i)
            m_run->step();
        m_run->paused = true;
        const std::vector<BodyId> bodies = m_run->scene().bodies();
        if (m_options.select >= 0 && static_cast<std::size_t>(m_options.select) < bodies.size())
            m_state.selected = bodies[static_cast<std::size_t>(m_options.select)];
        if (m_options.substep >= 0)
            m_run->scrubber.select(m_options.substep);
        view::Image image;
        // Sizes of text asked for in one frame are baked before the next; widgets settle in the second.
        for (int i = 0; i < 3 && m_window.begin_frame(); ++i)
        {
            frame();
            m_window.end_frame(&image);
        }
        if (view::save_png(image, m_options.screenshot))
            return 0;
        std::fprintf(stderr, "carom-lab: cannot write %s\n", m_options.screenshot.c_str());
        return 1;
    }

private:
    void load(const scenes::SceneEntry& entry)
    {
        const bool paused = m_run && m_run->paused;
        const double speed = m_run ? m_run->speed : 1;
        const bool same = m_run && &m_run->entry() == &entry;
        m_run = std::make_unique<Run>(entry, m_state.base);
        m_run->paused = paused;
        m_run->speed = speed;
        m_hand.forget();
        m_state.wanted = nullptr;
        m_state.selected = {};
        if (!same)
            m_own_camera = false;
    }

    void handle(const SDL_Event& event)
    {
        if (event.type == SDL_KEYDOWN && !m_window.wants_keyboard())
            key(event.key.keysym.scancode);
        const bool mouse = event.type == SDL_MOUSEBUTTONDOWN || event.type == SDL_MOUSEWHEEL;
        if (mouse && m_window.wants_mouse())
            return;
        select(event);
        if (m_hand.handle(event, m_run->scene(), m_camera))
            m_own_camera = true;
    }

    // A click, not a drag.
    void select(const SDL_Event& event)
    {
        if (event.type == SDL_MOUSEBUTTONDOWN && event.button.button == SDL_BUTTON_LEFT)
            m_pressed_at = {event.button.x, event.button.y};
        if (event.type != SDL_MOUSEBUTTONUP || event.button.button != SDL_BUTTON_LEFT || m_window.wants_mouse())
            return;
        const SDL_Point at{event.button.x, event.button.y};
        if (std::abs(at.x - m_pressed_at.x) + std::abs(at.y - m_pressed_at.y) > 4)
            return;
        const Scene& scene = m_run->scene();
        const std::vector<ShapeId> under =
            scene.overlap_point(m_camera.to_world({static_cast<float>(at.x), static_cast<float>(at.y)}));
        m_state.selected = under.empty() ? BodyId{} : scene.shape(under.front()).body();
        m_state.xray = m_state.xray || !under.empty();
    }

    void key(SDL_Scancode code)
    {
        switch (code)
        {
        case SDL_SCANCODE_SPACE: m_run->paused = !m_run->paused; break;
        case SDL_SCANCODE_RIGHT:
            m_run->paused = true;
            m_run->step();
            break;
        case SDL_SCANCODE_COMMA: scrub(-1); break;
        case SDL_SCANCODE_PERIOD: scrub(1); break;
        case SDL_SCANCODE_R: m_state.wanted = &m_run->entry(); break;
        case SDL_SCANCODE_X: m_state.xray = !m_state.xray; break;
        case SDL_SCANCODE_HOME: m_own_camera = false; break;
        case SDL_SCANCODE_PAGEUP: neighbor(-1); break;
        case SDL_SCANCODE_PAGEDOWN: neighbor(1); break;
        case SDL_SCANCODE_F11: m_window.toggle_fullscreen(); break;
        case SDL_SCANCODE_ESCAPE: m_window.request_quit(); break;
        default: break;
        }
    }

    void scrub(int by)
    {
        m_run->paused = true;
        m_state.xray = true;
        m_run->scrubber.select(m_run->scrubber.selected() + by);
    }

    void neighbor(int by)
    {
        const auto all = scenes::all_scenes();
        const auto index = &m_run->entry() - all.data() + by;
        if (index >= 0 && index < static_cast<std::ptrdiff_t>(all.size()))
            m_state.wanted = &all[static_cast<std::size_t>(index)];
    }

    void frame()
    {
        const Viewport area = picture_area(m_window.size(), m_state.xray);
        if (!m_own_camera)
            m_camera = view::Camera::fit(m_run->entry().view, area.min, area.max, 16);
        m_camera.viewport_min = area.min;
        m_camera.viewport_max = area.max;
        picture(area);
        draw_panels(m_window, *m_run, m_state);
    }

    void picture(const Viewport& area)
    {
        view::Canvas canvas = m_window.canvas(m_camera);
        canvas.push_clip(m_camera.visible());
        view::draw_scene(canvas, m_run->scene(), m_run->alpha(), m_state.xray ? faded() : view::ScenePalette{});
        if (m_state.xray)
            m_state.overlay.draw(canvas, m_run->scene());
        if (m_state.xray && m_run->paused)
            m_run->scrubber.draw(canvas, m_run->scene());
        if (m_state.xray && m_run->impacts.last())
            view::draw_impact(canvas, *m_run->impacts.last());
        if (m_run->scene().is_valid(m_state.selected))
            view::draw_ghost(canvas, m_run->scene(), m_state.selected, m_run->scene().body(m_state.selected).pose(),
                             {view::rgb(0xffe066), 3});
        m_hand.draw(canvas, m_run->scene());
        caption(area);
        canvas.pop_clip();
    }

    void caption(const Viewport& area)
    {
        view::Canvas hud = m_window.canvas();
        const scenes::SceneEntry& entry = m_run->entry();
        const view::Color shadow = view::rgb(0x000000, 0.7f);
        hud.text(area.min + Vec2{14, 12}, entry.name,
                 {.size = 20, .color = view::rgb(0xe8eef8), .face = view::Face::Bold, .shadow = shadow});
        const view::TextStyle small{.size = 13, .color = view::rgb(0x9fb0c8), .shadow = shadow};
        const bool room = area.max.x - area.min.x > 600;
        if (room)
            hud.text(area.min + Vec2{14, 38}, entry.description, small);
        view::TextStyle foot = small;
        foot.align_y = 1;
        hud.text({static_cast<double>(area.min.x) + 14, static_cast<double>(area.max.y) - 10},
                 room
                     ? "Space pause   → step   , . sub-step   X x-ray   R restart   drag with the left, ray with the right button"
                     : "Space pause   → step   X x-ray   R restart",
                 foot);
    }

    // Under the x-ray the picture steps back.
    static view::ScenePalette faded()
    {
        view::ScenePalette palette;
        const auto dim = [](view::Color& c) { c = view::mix(view::rgb(0x10141c), c, 0.4f); };
        dim(palette.still);
        dim(palette.kinematic);
        for (view::Color& c : palette.dynamic)
            dim(c);
        dim(palette.joint);
        return palette;
    }

    ViewerOptions m_options;
    view::Window m_window;
    LabState m_state;
    std::unique_ptr<Run> m_run;
    Hand m_hand;
    view::Camera m_camera;
    SDL_Point m_pressed_at{};
    bool m_own_camera = false; ///< the user has moved it
};

} // namespace

int run_viewer(const ViewerOptions& options)
{
    Viewer viewer(options);
    return options.screenshot.empty() ? viewer.watch() : viewer.photograph();
}

} // namespace carom::lab
