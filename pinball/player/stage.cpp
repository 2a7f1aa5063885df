#include "pinball/player/stage.h"

#include "pinball/player/palette.h"
#include "pinball/player/picture.h"
#include "pinball/player/side_panel.h"

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
    return phase == Phase::Attract || over;
}

} // namespace

void draw_frame(view::Window& window, Machine& machine, Stage& stage, const Frame& frame)
{
    const Layout layout = lay_out(window.size(), machine.game().table(), frame.xray);
    view::Canvas screen = window.canvas();
    draw_room(screen, window.size());

    const view::Camera camera = stage.camera.look(machine.game(), layout, frame.status.time);
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
    table.pop_clip();

    draw_score(screen, layout, machine, frame.status);
    if (frame.xray)
        stage.xray.widgets(window, layout, machine, frame.status);
    else if (layout.landscape)
        (void)draw_keys(screen, {layout.side.min + Vec2{0, 78 * layout.unit}, layout.side.max}, layout.unit);
    else if (waits_for_a_player(machine))
        draw_card(screen, layout, machine);
    if (frame.question != nullptr)
        draw_banner(screen, layout, frame.question, "the same key again: yes; any other: no");
    else if (frame.status.paused && !frame.xray)
        draw_banner(screen, layout, "PAUSED", "P goes on");
    else if (machine.name_entry().active())
        draw_banner(screen, layout, "YOUR NAME", "type it, or turn letters with the flippers; Enter");
    draw_table_errors(screen, layout, machine);
}

} // namespace carom::pinball
