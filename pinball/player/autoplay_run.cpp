#include "pinball/player/autoplay_run.h"

#include "pinball/player/palette.h"
#include "pinball/player/sounds.h"
#include "pinball/player/stage.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace carom::pinball {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int) { interrupted = 1; }

// A ball on its way among the parts, and something that has just been hit.
bool is_worth_a_picture(const Game& game)
{
    if (game.phase() != Phase::InPlay)
        return false;
    const Vec2 size = game.table().size;
    const bool rolls = std::ranges::any_of(game.balls(),
                                           [&](const BallState& b)
                                           {
                                               const Vec2 at = to_vec2(b.position);
                                               return b.is_free() && at.y > 0.3f * size.y && at.y < 0.85f * size.y &&
                                                      at.x < 0.88f * size.x && length(b.velocity) > 0.5f;
                                           });
    const auto fired = [&](Index i)
    {
        const auto& part = game.table().elements[i].part;
        const bool shines = std::holds_alternative<Bumper>(part) || std::holds_alternative<Slingshot>(part);
        const std::int64_t age = game.step_count() - game.element(i).last_hit;
        return shines && age >= 20 && age < 60;
    };
    if (!rolls)
        return false;
    for (Index i = 0; i < game.table().elements.size(); ++i)
        if (fired(i))
            return true;
    return false;
}

class AutoplayRun
{
public:
    explicit AutoplayRun(const PlayerOptions& options)
        : m_options(options), m_seed(options.seed.value_or(1)), m_machine(options.table_file(), m_seed, true, false),
          m_step_s(static_cast<double>(m_machine.game().table().physics.step))
    {
        m_sounds.sink().set_muted(options.mute);
        m_machine.record_substeps(options.xray);
    }

    int run()
    {
        const auto before = std::signal(SIGINT, on_interrupt);
        play(m_options.seconds);
        const int result = m_options.screenshot.empty() ? 0 : take_picture();
        std::signal(SIGINT, before);
        report();
        return interrupted != 0 ? 130 : result;
    }

private:
    void step()
    {
        m_machine.step({});
        m_served += static_cast<int>(std::ranges::count(m_machine.game().events(), EventKind::Served, &GameEvent::kind));
        m_sounds.hear(m_machine.game());
    }

    void play(double seconds)
    {
        const bool on_terminal = isatty(STDERR_FILENO) != 0;
        const auto steps = static_cast<std::int64_t>(seconds / m_step_s);
        for (std::int64_t i = 1; i <= steps && interrupted == 0; ++i)
        {
            step();
            if (on_terminal && i % 20'000 == 0)
                std::fprintf(stderr, "\r%.0f of %.0f s, score %lld ", static_cast<double>(i) * m_step_s, seconds,
                             static_cast<long long>(m_machine.game().score()));
        }
        if (on_terminal && steps >= 20'000)
            std::fprintf(stderr, "\n");
    }

    // The game goes on, for twenty seconds at most, until there is something to see.
    void wait_for_a_moment()
    {
        const auto most = static_cast<std::int64_t>(20 / m_step_s);
        for (std::int64_t i = 0; i < most && interrupted == 0 && !is_worth_a_picture(m_machine.game()); ++i)
            step();
    }

    int take_picture()
    {
        view::Window window({.title = "Carom",
                             .width = m_options.width,
                             .height = m_options.height,
                             .fullscreen = m_options.fullscreen,
                             .background = palette::room});
        wait_for_a_moment();
        m_machine.look_into_step();
        Stage stage;
        view::Image image;
        const double time = static_cast<double>(m_machine.game().step_count()) * m_step_s;
        const view::SoundSink& sink = m_sounds.sink();
        const Frame frame{
            .xray = m_options.xray,
            .status = {.time = time, .muted = sink.is_muted(), .volume = sink.volume(), .why_mute = sink.why_mute()}};
        // Sizes of text that are asked for in one frame are baked before the next.
        for (int i = 0; i < 3 && window.begin_frame(); ++i)
        {
            draw_frame(window, m_machine, stage, frame);
            window.end_frame(&image);
        }
        if (view::save_png(image, m_options.screenshot))
            return 0;
        std::fprintf(stderr, "carom-pinball: cannot write %s\n", m_options.screenshot.c_str());
        return 1;
    }

    void report() const
    {
        const Game& game = m_machine.game();
        std::printf("%s, seed %llu: %d balls served, %.1f s played; the last game: score %lld, ball %d of %d\n",
                    game.table().name.c_str(), static_cast<unsigned long long>(m_seed), m_served,
                    static_cast<double>(m_machine.times().count()) * m_step_s, static_cast<long long>(game.score()),
                    game.ball_number(), game.balls_per_game());
        std::printf("steps of %.0f ms: mean %.1f us, longest %.0f us, %lld steps\n", m_step_s * 1000, m_machine.times().mean_us(),
                    m_machine.times().most_us(), static_cast<long long>(m_machine.times().count()));
    }

    PlayerOptions m_options;
    std::uint64_t m_seed;
    Machine m_machine;
    double m_step_s;
    int m_served = 0;
    Sounds m_sounds{};
};

} // namespace

int run_autoplay(const PlayerOptions& options) { return AutoplayRun(options).run(); }

} // namespace carom::pinball
