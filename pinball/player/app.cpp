#include "pinball/player/app.h"

#include "pinball/player/controls_panel.h"
#include "pinball/player/palette.h"
#include "pinball/player/sounds.h"
#include "pinball/player/stage.h"
#include "pinball/player/step_clock.h"
#include "tour/tour.h"

#include <SDL_timer.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace carom::pinball {

namespace {

constexpr double slow_motion = 0.02;
constexpr double slowest_watched = 1.0 / 16;
constexpr double fastest_watched = 16;
constexpr double table_poll_ms = 400;

std::uint64_t seed_of_now() { return static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count()); }

} // namespace

struct App::State
{
    State(const PlayerOptions& options, Clock clock)
        : m_now(std::move(clock)), m_options(options),
          m_machine(options.table_file(), options.seed.value_or(seed_of_now()), options.autoplay, true),
          m_window({.title = title(),
                    .width = options.width,
                    .height = options.height,
                    .fullscreen = options.fullscreen,
                    .background = palette::room}),
          m_clock(step_ms())
    {
        m_sounds.sink().set_muted(options.mute);
        set_xray(options.xray);
        m_clock.skip_to(now_ms());
        if (!options.watch.empty())
            if (const std::string trouble = m_machine.watch(options.watch); !trouble.empty())
                throw std::runtime_error(trouble);
        if (options.tour)
            begin_tour();
    }

    bool frame(view::Image* capture)
    {
        if (!m_window.begin_frame())
            return false;
        m_tour&& m_touring ? tour_frame() : machine_frame();
        m_window.end_frame(capture);
        return true;
    }

    [[nodiscard]] double now_ms() const { return m_now(); }
    [[nodiscard]] double step_ms() const { return static_cast<double>(m_machine.game().table().physics.step) * 1000; }

    void machine_frame()
    {
        for (const SDL_Event& event : m_window.events())
            handle(event);
        poll_table();
        advance();
        draw();
    }

    void tour_frame()
    {
        for (const SDL_Event& event : m_window.events())
            m_tour->handle(event);
        const double now = now_ms();
        const tour::Tour::Wish wish = m_tour->frame((now - std::exchange(m_tour_ms, now)) / 1000);
        if (wish == tour::Tour::Wish::None)
            return;
        m_touring = false;
        m_clock.skip_to(now);
        m_window.set_background(palette::room);
        if (wish == tour::Tour::Wish::SeeOnTable)
            show(m_tour->lesson().chapter().table_view());
    }

    void begin_tour()
    {
        if (!m_tour)
            m_tour.emplace(m_window);
        m_touring = true;
        m_tour_ms = now_ms();
        m_buttons.release_all();
        m_window.set_background(view::WindowDef{}.background);
    }

    // A game that plays by itself, slowed down, with what the chapter was about.
    void show(const tour::TableView& what)
    {
        stop_watching();
        set_xray(true);
        m_paused = false;
        m_speed = 0.25;
        view::XrayToggles& toggles = m_stage.xray.toggles();
        toggles.contacts = toggles.normals = toggles.impulses = what.contacts;
        toggles.triggers = what.triggers;
        toggles.joints = what.joints;
        toggles.boxes = what.boxes;
        toggles.islands = what.islands;
        toggles.velocities = what.velocities;
        if (m_machine.is_idle() && !m_options.autoplay)
        {
            m_shows_itself = true;
            m_machine.play_by_itself(true);
        }
    }

    void handle(const SDL_Event& event)
    {
        if (event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_FOCUS_LOST)
            lose_focus();
        if (event.type == SDL_CONTROLLERDEVICEADDED)
            SDL_GameControllerOpen(event.cdevice.which);
        if (m_xray)
            select(event);
        if (m_controls.handle(event, m_machine.controls))
            return m_buttons.release_all();
        if (m_machine.name_entry().active() && write_name(event))
            return;
        const auto wish = m_machine.controls.wish_of(event);
        if (m_asking && Controls::pressed(event))
            return answer(wish);
        press(event);
        if (wish && !m_window.wants_keyboard())
            obey(*wish);
    }

    void press(const SDL_Event& event)
    {
        const auto time = static_cast<double>(event.common.timestamp);
        for (const ButtonPress& press : m_machine.controls.buttons_of(event))
        {
            m_buttons.push(time, press.button, press.down, press.source);
            if (press.button == Button::Start && press.down)
                take_over();
        }
        if (const auto rod = Controls::rod_of(event))
            m_buttons.hold_rod(time, *rod);
    }

    // Whoever presses start wants to play.
    void take_over()
    {
        stop_watching();
        if (!std::exchange(m_shows_itself, false))
            return;
        m_machine.play_by_itself(false);
        m_machine.restart();
        m_speed = 1;
    }

    void stop_watching()
    {
        if (!m_machine.is_watching())
            return;
        m_machine.stop_watching();
        m_speed = 1;
    }

    [[nodiscard]] bool is_in_game() const { return !m_machine.is_idle() && !m_options.autoplay && !m_machine.is_watching(); }

    void lose_focus()
    {
        m_buttons.release_all();
        m_paused = m_paused || is_in_game();
    }

    // Asks before a key ends a game, which waits meanwhile.
    void ask(Wish wish)
    {
        m_asking = wish;
        m_was_paused = std::exchange(m_paused, true);
    }

    void answer(std::optional<Wish> wish)
    {
        const Wish asked = *std::exchange(m_asking, std::nullopt);
        m_paused = m_was_paused;
        if (wish != asked)
            return;
        asked == Wish::Quit ? m_window.request_quit() : restart();
    }

    // A click on a thing of the table.
    void select(const SDL_Event& event)
    {
        if (event.type != SDL_MOUSEBUTTONDOWN || event.button.button != SDL_BUTTON_LEFT || m_window.wants_mouse())
            return;
        const Scene& scene = m_machine.game().scene();
        const Position at = m_stage.seen.to_world({static_cast<float>(event.button.x), static_cast<float>(event.button.y)});
        const auto near = scene.closest_point(at, m_stage.seen.meters(8));
        m_machine.selected = near ? scene.shape(near->shape).body() : BodyId{};
    }

    // Letters are letters while a name is written.
    bool write_name(const SDL_Event& event)
    {
        if (event.type != SDL_KEYDOWN)
            return false;                             // what goes up may have gone down before
        const SDL_Keycode key = event.key.keysym.sym; // as printed on the key
        const bool is_letter = (key >= SDLK_a && key <= SDLK_z) || (key >= SDLK_0 && key <= SDLK_9);
        if (!is_letter && key != SDLK_BACKSPACE)
            return false;
        if (is_letter)
            m_machine.name_entry().type(static_cast<char>(key));
        else
            m_machine.name_entry().erase();
        return true;
    }

    void obey(Wish wish)
    {
        view::SoundSink& sink = m_sounds.sink();
        switch (wish)
        {
        case Wish::Pause: m_paused = !m_paused; break;
        case Wish::Restart: is_in_game() ? ask(wish) : restart(); break;
        case Wish::Mute: sink.set_muted(!sink.is_muted()); break;
        case Wish::Quieter: sink.set_volume(std::max(0.0f, sink.volume() - 0.1f)); break;
        case Wish::Louder: sink.set_volume(std::min(1.0f, sink.volume() + 0.1f)); break;
        case Wish::Xray: set_xray(!m_xray); break;
        case Wish::Tour: begin_tour(); break;
        case Wish::Watch: watch(); break;
        case Wish::Slower: change_speed(0.5); break;
        case Wish::Faster: change_speed(2); break;
        case Wish::Controls: change_keys(); break;
        case Wish::Grid: m_stage.workshop.open = !m_stage.workshop.open; break;
        case Wish::Fullscreen: m_window.toggle_fullscreen(); break;
        case Wish::Quit: quit(); break;
        default:
            if (m_xray)
                obey_xray(wish);
        }
    }

    void obey_xray(Wish wish)
    {
        view::SubstepScrubber& scrubber = m_machine.scrubber;
        if (wish == Wish::SlowMotion)
        {
            m_speed = m_speed < 1 ? 1 : slow_motion;
            m_paused = false;
            return;
        }
        m_paused = true;
        if (wish == Wish::SingleStep)
            step(m_buttons.advance_to(now_ms()));
        else
            scrubber.select(scrubber.selected() + (wish == Wish::SubstepForth ? 1 : -1));
        if (wish == Wish::SingleStep)
            m_machine.look_into_step();
    }

    // The game waits meanwhile.
    void change_keys()
    {
        m_paused = m_paused || is_in_game();
        m_controls.toggle();
    }

    // One thing after the other: what was opened last is closed first.
    void quit()
    {
        if (m_machine.is_watching())
            return watch();
        is_in_game() ? ask(Wish::Quit) : m_window.request_quit();
    }

    void watch()
    {
        if (is_in_game())
            return;
        m_paused = false;
        m_trouble.clear();
        if (m_machine.is_watching())
            return stop_watching();
        m_speed = 1;
        m_trouble = m_machine.watch_last();
    }

    void change_speed(double factor)
    {
        if (m_machine.is_watching())
            m_speed = std::clamp(m_speed * factor, slowest_watched, fastest_watched);
    }

    void restart()
    {
        stop_watching();
        m_machine.restart();
        m_sounds.sink().stop_all();
        m_paused = false;
        // R starts the game that it promises.
        m_buttons.push(now_ms(), Button::Start, true, restart_source);
        m_buttons.push(now_ms() + 5, Button::Start, false, restart_source);
    }

    void set_xray(bool on)
    {
        m_xray = on;
        m_machine.record_substeps(on);
        if (!on && m_speed < 1 && !m_machine.is_watching())
            m_speed = 1;
    }

    void poll_table()
    {
        if (now_ms() < m_next_poll)
            return;
        m_next_poll = now_ms() + table_poll_ms;
        const bool watched = m_machine.is_watching();
        if (!m_machine.poll_table())
            return;
        m_window.set_title(title());
        if (watched) // that is over
            m_speed = 1;
    }

    [[nodiscard]] std::string title() const { return "Carom: " + m_machine.game().table().name; }

    void step(const Input& input)
    {
        m_machine.step(input);
        m_sounds.hear(m_machine.game());
    }

    [[nodiscard]] bool stands_still() const { return m_paused || m_machine.has_watched(); }

    void advance()
    {
        if (stands_still())
            return m_clock.skip_to(now_ms());
        m_clock.set_step(step_ms()); // another table may have another one
        m_clock.begin_frame(now_ms(), m_speed);
        bool stepped = false;
        while (m_clock.take_step() && !m_machine.has_watched())
        {
            step(m_buttons.advance_to(m_clock.step_end_ms()));
            stepped = true;
        }
        if (stepped)
            m_machine.look_into_step();
    }

    void draw()
    {
        const view::SoundSink& sink = m_sounds.sink();
        m_sounds.frame(m_machine.game(), !stands_still());
        draw_frame(m_window, m_machine, m_stage,
                   {.alpha = stands_still() ? 1 : m_clock.alpha(),
                    .xray = m_xray,
                    .question = !m_asking                 ? nullptr
                                : *m_asking == Wish::Quit ? "LEAVE THE GAME?"
                                                          : "START ANEW?",
                    .status = {.time = now_ms() / 1000,
                               .paused = m_paused,
                               .speed = m_speed,
                               .muted = sink.is_muted(),
                               .volume = sink.volume(),
                               .why_mute = sink.why_mute(),
                               .trouble = m_trouble}});
        m_controls.draw(m_window, m_machine.controls);
    }

    static constexpr int restart_source = 31;

    Clock m_now;
    PlayerOptions m_options;
    Machine m_machine;
    view::Window m_window;
    Sounds m_sounds{};
    StepClock m_clock;
    ButtonTimeline m_buttons{};
    Stage m_stage{};
    bool m_xray = false;
    bool m_paused = false;
    bool m_shows_itself = false; ///< plays because the tour sent the reader here
    bool m_was_paused = false;
    std::optional<Wish> m_asking{};
    double m_speed = 1;
    ControlsPanel m_controls{};
    std::string m_trouble{}; ///< why a wish could not be granted
    double m_next_poll = 0;
    std::optional<tour::Tour> m_tour{};
    bool m_touring = false;
    double m_tour_ms = 0;
};

namespace {

// SDL stamps events with the same clock, in whole milliseconds.
double ticks() { return static_cast<double>(SDL_GetTicks64()); }

} // namespace

App::App(const PlayerOptions& options, Clock clock)
    : m_state(std::make_unique<State>(options, clock ? std::move(clock) : Clock(ticks)))
{}

App::~App() = default;

bool App::frame(view::Image* capture) { return m_state->frame(capture); }

const Machine& App::machine() const { return m_state->m_machine; }

bool App::is_paused() const { return m_state->m_paused; }

std::optional<Wish> App::asks() const { return m_state->m_asking; }

namespace {

int run_window(const PlayerOptions& options)
{
    App app(options);
    view::Image image;
    const bool pictured = !options.screenshot.empty();
    const double end = options.seconds > 0 ? ticks() + options.seconds * 1000 : std::numeric_limits<double>::infinity();
    while (ticks() < end && app.frame(pictured ? &image : nullptr))
    {
    }
    if (!pictured || (image.width > 0 && view::save_png(image, options.screenshot)))
        return 0;
    std::fprintf(stderr, "carom-pinball: cannot write %s\n", options.screenshot.c_str());
    return 1;
}

int write_tour_pictures(const PlayerOptions& options)
{
    setenv("SDL_VIDEODRIVER", "offscreen", 0); // a picture needs no display
    view::Window window({.title = "Carom: tour", .width = options.width, .height = options.height});
    return tour::write_pictures(window, options.pictures) ? 0 : 1;
}

} // namespace

int run_app(const PlayerOptions& options)
{
    return options.pictures.empty() ? run_window(options) : write_tour_pictures(options);
}

} // namespace carom::pinball
