#include "pinball/player/score_panel.h"

#include "pinball/player/attract.h"
#include "pinball/player/dot_matrix.h"
#include "pinball/player/palette.h"
#include "pinball/player/side_panel.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

using view::Canvas;
using view::Face;
using view::TextStyle;

constexpr int score_row = 2;
constexpr int line_row = 19;

std::string resting_line(const Machine& machine, double time)
{
    const Game& game = machine.game();
    const std::string ball = (game.players() > 1 ? "PLAYER " + std::to_string(game.player_up() + 1) + "  " : "") + "BALL " +
                             std::to_string(game.ball_number());
    const bool second = std::fmod(time, 4.0) >= 2.0;
    if (game.phase() == Phase::Ready && second)
        return "PULL THE PLUNGER";
    if (game.phase() == Phase::InPlay && game.bonus_multiplier() > 1)
        return ball + "   " + std::to_string(game.bonus_multiplier()) + "X";
    return ball;
}

void write_large(DotMatrix& dots, const std::string& text)
{
    dots.centered(score_row, text, DotMatrix::width(text, 2) <= DotMatrix::columns ? 2 : 1);
}

void write_name(DotMatrix& dots, const NameEntry& entry, double time)
{
    const std::string who = entry.player() >= 0 ? "PLAYER " + std::to_string(entry.player() + 1) + "  " : "";
    dots.centered(1, who + "RANK " + std::to_string(entry.rank() + 1));
    std::string name = entry.name();
    if (std::fmod(time, 0.5) > 0.3 && entry.cursor() < NameEntry::letters)
        name[static_cast<std::size_t>(entry.cursor())] = '_';
    dots.centered(11, name, 2);
}

DotMatrix compose(const Machine& machine, const Status& status)
{
    const Game& game = machine.game();
    DotMatrix dots;
    if (machine.name_entry().active())
    {
        write_name(dots, machine.name_entry(), status.time);
        return dots;
    }
    const std::string message(game.message());
    if (machine.is_idle() && message.empty())
    {
        const DisplayPage page = attract_page(machine, status.time);
        write_large(dots, page.large);
        dots.centered(line_row, page.small, 1, 0.75f);
        return dots;
    }
    write_large(dots, with_commas(game.score()));
    if (!message.empty())
        dots.centered(line_row, message);
    else
        dots.centered(line_row, resting_line(machine, status.time), 1, 0.75f);
    return dots;
}

// A dark glass with a thin frame around the dots. Gives its lower edge.
float draw_display(Canvas& screen, const Layout& layout, float top, const DotMatrix& dots)
{
    const float pitch = layout.dot_pitch;
    const Area& area = layout.score;
    const Vec2 size{pitch * DotMatrix::columns, pitch * DotMatrix::rows};
    const Vec2 corner{std::round((area.min.x + area.max.x - size.x) / 2), std::round(top)};
    const Vec2 border{5, 5};
    const Box glass{Position(corner - border), Position(corner + size + border)};
    screen.fill_box(glass, view::rgb(0x0a0604), 5);
    dots.draw(screen, corner, pitch);
    screen.stroke_box(glass, {view::Paint::linear(glass.lower, palette::wood_light, glass.upper, palette::wood_dark), 2}, 5);
    return corner.y + size.y + border.y;
}

std::string ball_text(const Game& game)
{
    if (game.ball_number() == 0)
        return "no game yet";
    if (game.phase() == Phase::GameOver)
        return "game over";
    return "ball " + std::to_string(game.ball_number()) + " of " + std::to_string(game.balls_per_game());
}

std::string sound_text(const Status& status)
{
    if (!status.why_mute.empty())
        return "no sound";
    if (status.muted)
        return "muted";
    return "volume " + std::to_string(static_cast<int>(std::lround(10 * status.volume)));
}

std::string save_text(const Game& game)
{
    const double seconds = game.ball_save_steps() * static_cast<double>(game.table().physics.step);
    return "ball save " + std::to_string(static_cast<int>(std::ceil(seconds))) + " s";
}

std::string bonus_text(const Game& game)
{
    std::string text = "bonus " + with_commas(game.bonus());
    if (game.bonus_multiplier() > 1)
        text += " x" + std::to_string(game.bonus_multiplier());
    return text;
}

// One line below the display: ball, bonus, and the ball save while it is lit.
void draw_line(Canvas& screen, const Layout& layout, const Machine& machine, const Status& status, float y, bool with_score)
{
    const Game& game = machine.game();
    TextStyle style{.size = 13 * layout.unit, .color = palette::text_faint};
    const float left = layout.score.min.x + 10 * layout.unit;
    const float right = layout.score.max.x - 10 * layout.unit;
    screen.text({left, y}, with_score ? with_commas(game.score()) + " points" : ball_text(game), style);
    style.align_x = 0.5f;
    const bool saving = game.ball_save_steps() > 0;
    style.color = saving ? view::rgb(0xffb347) : palette::text_faint;
    screen.text({(left + right) / 2, y}, saving ? save_text(game) : bonus_text(game), style);
    style.align_x = 1;
    style.color = palette::text_faint;
    screen.text({right, y}, status.paused ? "paused" : sound_text(status), style);
}

// Label on the left, value on the right.
float draw_row(Canvas& screen, const Layout& layout, float y, const std::string& label, const std::string& value,
               view::Color color)
{
    const float pad = 34 * layout.unit;
    screen.text({layout.score.min.x + pad, y}, label, {.size = 15 * layout.unit, .color = palette::text_faint});
    screen.text({layout.score.max.x - pad, y}, value,
                {.size = 15 * layout.unit, .color = color, .face = Face::Bold, .align_x = 1});
    return y + 25 * layout.unit;
}

float draw_rows(Canvas& screen, const Layout& layout, const Machine& machine, const Status& status, float y)
{
    const Game& game = machine.game();
    const bool plays = !machine.is_idle();
    for (int player = 0; player < game.players() && game.players() > 1; ++player)
        y = draw_row(screen, layout, y, "player " + std::to_string(player + 1), with_commas(game.score(player)),
                     plays && player == game.player_up() ? palette::gold : palette::text);
    y = draw_row(screen, layout, y, "ball",
                 plays ? std::to_string(game.ball_number()) + " of " + std::to_string(game.balls_per_game()) : "-",
                 palette::text);
    y = draw_row(screen, layout, y, "bonus", with_commas(game.bonus()) + " x" + std::to_string(game.bonus_multiplier()),
                 palette::text);
    const bool saving = game.ball_save_steps() > 0;
    y = draw_row(screen, layout, y, "ball save", saving ? save_text(game).substr(10) : "out",
                 saving ? view::rgb(0xffb347) : palette::text_faint);
    if (game.extra_balls() > 0)
        y = draw_row(screen, layout, y, "extra ball", "shoot again", palette::gold);
    if (game.credits() > 0)
        y = draw_row(screen, layout, y, "free games", std::to_string(game.credits()), palette::gold);
    return draw_row(screen, layout, y, "sound", sound_text(status), palette::text);
}

} // namespace

std::string with_commas(std::int64_t value)
{
    std::string text = std::to_string(value);
    for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3)
        text.insert(static_cast<std::size_t>(i), ",");
    return text;
}

void draw_score(Canvas& screen, const Layout& layout, const Machine& machine, const Status& status)
{
    const float u = layout.unit;
    if (!layout.side.empty() && !layout.landscape)
        return draw_line(screen, layout, machine, status, 4 * u, true);
    const DotMatrix dots = compose(machine, status);
    if (!layout.landscape)
    {
        const float bottom = draw_display(screen, layout, 7, dots);
        return draw_line(screen, layout, machine, status, bottom + 3 * u, false);
    }
    screen.text({(layout.score.min.x + layout.score.max.x) / 2, 26 * u}, machine.game().table().name,
                {.size = 30 * u, .color = palette::gold, .face = Face::Bold, .align_x = 0.5f});
    float y = draw_display(screen, layout, 78 * u, dots) + 24 * u;
    y = draw_rows(screen, layout, machine, status, y) + 18 * u;
    draw_high_scores(screen, {{layout.score.min.x, y}, layout.score.max}, machine, u);
}

} // namespace carom::pinball
