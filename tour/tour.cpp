#include "tour/tour.h"

#include <SDL_events.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace carom::tour {

Tour::Tour(view::Window& window) : m_window(window), m_panel(load_text("interface"))
{
    for (std::unique_ptr<Chapter>& chapter : all_chapters())
    {
        m_lessons.push_back(std::make_unique<Lesson>(std::move(chapter)));
        m_titles.push_back(m_lessons.back()->text().title);
    }
}

Tour::~Tour() = default;

void Tour::open(int chapter)
{
    m_chapter = std::clamp(chapter, 0, chapters() - 1);
    m_panel.set_page(0);
    lesson().let_go();
}

void Tour::turn_page(int by)
{
    const int page = m_panel.page() + by;
    if (page >= 0 && page < m_panel.pages())
        return m_panel.set_page(page);
    if (m_chapter + by < 0 || m_chapter + by >= chapters())
        return;
    open(m_chapter + by);
    if (by < 0)
        m_panel.set_page(1 << 20); // the last
}

void Tour::handle(const SDL_Event& event)
{
    if (event.type == SDL_KEYDOWN && !m_window.wants_keyboard())
        key(event.key.keysym.scancode);
    take_mouse(event);
}

void Tour::key(SDL_Scancode code)
{
    Lesson& l = lesson();
    switch (code)
    {
    case SDL_SCANCODE_SPACE: l.paused = !l.paused; break;
    case SDL_SCANCODE_RIGHT: turn_page(1); break;
    case SDL_SCANCODE_LEFT: turn_page(-1); break;
    case SDL_SCANCODE_PAGEDOWN: open(m_chapter + 1); break;
    case SDL_SCANCODE_PAGEUP: open(m_chapter - 1); break;
    case SDL_SCANCODE_PERIOD:
        l.paused = true;
        l.step();
        break;
    case SDL_SCANCODE_COMMA: l.back(); break;
    case SDL_SCANCODE_N: l.run_to_next(); break;
    case SDL_SCANCODE_S: l.speed = l.speed < 1 ? 1 : 0.2; break;
    case SDL_SCANCODE_R: l.restart(); break;
    case SDL_SCANCODE_F11: m_window.toggle_fullscreen(); break;
    case SDL_SCANCODE_RETURN: m_wish = Wish::SeeOnTable; break;
    case SDL_SCANCODE_ESCAPE:
    case SDL_SCANCODE_T: m_wish = Wish::Leave; break;
    default: break;
    }
}

void Tour::take_mouse(const SDL_Event& event)
{
    const auto at = [&](int x, int y) { return m_camera.to_world({static_cast<float>(x), static_cast<float>(y)}); };
    if (event.type == SDL_MOUSEBUTTONDOWN && event.button.button == SDL_BUTTON_LEFT && !m_window.wants_mouse())
        lesson().grab(at(event.button.x, event.button.y), m_camera.meters(12));
    else if (event.type == SDL_MOUSEMOTION)
        lesson().drag(at(event.motion.x, event.motion.y));
    else if (event.type == SDL_MOUSEBUTTONUP && event.button.button == SDL_BUTTON_LEFT)
        lesson().let_go();
}

void Tour::picture(const TourLayout& layout)
{
    m_camera = view::Camera::fit(lesson().chapter().view(), layout.picture_min, layout.picture_max, 14 * layout.unit);
    view::Canvas canvas = m_window.canvas(m_camera);
    canvas.push_clip(m_camera.visible());
    lesson().chapter().draw(canvas, lesson().alpha());
    canvas.pop_clip();
}

Tour::Wish Tour::frame(double seconds)
{
    const TourLayout layout = lay_out(m_window.size());
    lesson().advance(std::min(seconds, 0.1));
    picture(layout);
    const PanelWish wish = m_panel.draw(m_window, layout, lesson(), m_chapter, m_titles);
    if (wish.turn_page + wish.turn_chapter != 0)
        turn_page(wish.turn_page + wish.turn_chapter);
    if (wish.chapter)
        open(*wish.chapter);
    if (wish.see_on_table)
        m_wish = Wish::SeeOnTable;
    return std::exchange(m_wish, Wish::None);
}

namespace {

// Sizes of text asked for in one frame are baked before the next; pages settle in the third.
void turn_to(view::Window& window, Tour& tour, int page)
{
    tour.panel().set_page(page);
    if (window.begin_frame())
    {
        (void)tour.frame(0);
        window.end_frame();
    }
    tour.lesson().restart();
    for (int i = 0; i < tour.lesson().chapter().picture_steps(); ++i)
        tour.lesson().step();
}

bool photograph(view::Window& window, Tour& tour, const std::filesystem::path& file)
{
    view::Image image;
    for (int i = 0; i < 3; ++i)
    {
        if (!window.begin_frame())
            return false;
        (void)tour.frame(0);
        window.end_frame(&image);
    }
    if (view::save_png(image, file.string()))
        return true;
    std::fprintf(stderr, "carom-pinball: cannot write %s\n", file.string().c_str());
    return false;
}

} // namespace

bool write_pictures(view::Window& window, const std::string& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    Tour tour(window);
    for (int chapter = 0; chapter < tour.chapters(); ++chapter)
    {
        tour.open(chapter);
        Lesson& lesson = tour.lesson();
        lesson.paused = true;
        int page = 0;
        do
        {
            turn_to(window, tour, page);
            const std::string name = lesson.chapter().name() + '-' + std::to_string(page + 1) + ".png";
            if (!photograph(window, tour, std::filesystem::path(folder) / name))
                return false;
            std::printf("%s\n", name.c_str());
        } while (++page < tour.panel().pages());
    }
    return true;
}

} // namespace carom::tour
