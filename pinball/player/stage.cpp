#include "pinball/player/stage.h"

#include "pinball/player/palette.h"
#include "pinball/player/picture.h"
#include "pinball/player/side_panel.h"

#include <cstdio>
#include <string>

namespace carom::pinball {

namespace {

void draw_room(view::Canvas& screen, Vec2 window)
{
    screen.fill_box({{0, 0}, Position(window)},
                    view::Paint::linear({0, 0}, view::rgb(0x191623), {0, static_cast<double>(window.y)}, view::rgb(0x08080d)));
}

bool waits_for_a_player(const Machine& machine)
{
    const Phase phase = machine.game().phase();
    const bool over = phase == Phase::GameOver && machine.game().message().empty() && !machine.name_entry().active();
    return (phase == Phase::Attract || over) && !machine.is_watching();
}

void draw_side(view::Canvas& screen, const Layout& layout, const Machine& machine, const Status& status)
{
    const Area area{layout.side.min + Vec2{0, 78 * layout.unit}, layout.side.max};
    if (shows_rules(machine, status))
        (void)draw_rules(screen, area, machine, layout.unit);
    else
        (void)draw_keys(screen, area, machine, layout.unit);
}

std::string watching_text(const Machine& machine, const Status& status)
{
    const auto label = [&machine](Wish wish) { return machine.controls.label(wish); };
    if (machine.has_watched())
        return (machine.came_out_the_same() ? "It came out as it was played, to the last bit. "
                                            : "It came out differently: it was played on another version of the machine. ") +
               label(Wish::Watch) + " goes back.";
    char speed[32];
    std::snprintf(speed, sizeof speed, status.speed < 1 ? "1/%.0f" : "%.0f", status.speed < 1 ? 1 / status.speed : status.speed);
    return "A recorded game, at " + std::string(speed) + " times its speed. " + label(Wish::Slower) + " slower, " +
           label(Wish::Faster) + " faster, " + label(Wish::Watch) + " goes back.";
}

// Words over the table.
void draw_what_happens(view::Canvas& screen, const Layout& layout, const Machine& machine, const Frame& frame)
{
    const Status& status = frame.status;
    const std::string pause = machine.controls.label(Wish::Pause) + " goes on";
    if (frame.question != nullptr)
        draw_banner(screen, layout, frame.question, "the same key again: yes; any other: no");
    else if (status.paused && !frame.xray && layout.landscape)
        draw_banner(screen, layout, "PAUSED", pause.c_str());
    else if (machine.name_entry().active())
        draw_banner(screen, layout, "YOUR NAME",
                    ("type it, or turn letters with the flippers; " + machine.controls.label(Button::Start)).c_str());
    if (machine.is_watching())
        draw_strip(screen, layout, {watching_text(machine, status)});
    else if (!status.trouble.empty() && machine.is_idle())
        draw_strip(screen, layout, {status.trouble});
    else if (status.paused && !frame.xray && !layout.landscape)
        draw_strip(screen, layout, {pause});
}

} // namespace

void draw_frame(view::Window& window, Machine& machine, Stage& stage, const Frame& frame)
{
    const Layout layout = lay_out(window.size(), machine.game().table(), frame.xray);
    view::Canvas screen = window.canvas();
    draw_room(screen, window.size());

    view::Camera camera = stage.camera.look(machine.game(), layout, frame.status.time);
    // The cabinet moves, and the player with the room does not.
    camera.center = camera.center - machine.game().cabinet().offset();
    stage.seen = camera;
    view::Canvas table = window.canvas(camera);
    // A little more than the table, for the names at an impact near its edge.
    const Vec2 more{layout.landscape ? camera.meters(22) : 0, 0};
    table.push_clip({camera.visible().lower - more, camera.visible().upper + more});
    draw_table(table, {.game = machine.game(),
                       .effects = machine.effects(),
                       .art = machine.art(),
                       .alpha = frame.alpha,
                       .time = frame.status.time,
                       .plain = frame.xray});
    if (frame.xray)
        stage.xray.draw(table, machine, frame.status.paused);
    if (stage.workshop.open)
        stage.workshop.draw_on(table, machine, window.mouse());
    table.pop_clip();

    draw_score(screen, layout, machine, frame.status);
    if (frame.xray)
        stage.xray.widgets(window, layout, machine, frame.status);
    else if (stage.workshop.open)
        stage.workshop.draw_list(screen, layout);
    else if (layout.landscape)
        draw_side(screen, layout, machine, frame.status);
    else if (waits_for_a_player(machine) || frame.status.paused)
        draw_card(screen, layout, machine, frame.status);
    draw_what_happens(screen, layout, machine, frame);
    draw_table_errors(screen, layout, machine);
}

} // namespace carom::pinball
