// The order in which the parts of the table lie on top of each other.

#include "pinball/player/parts.h"

namespace carom::pinball {

namespace {

template <class P, class Draw>
void each(const Picture& picture, Draw draw)
{
    const auto& elements = picture.table().elements;
    for (Index i = 0; i < elements.size(); ++i)
        if (const auto* part = std::get_if<P>(&elements[i].part); part != nullptr && elements[i].visible)
            draw(i, *part);
}

} // namespace

void draw_table(view::Canvas& canvas, const Picture& picture)
{
    const auto draw = [&](Index i, const auto& part) { draw_part(canvas, picture, i, part); };
    draw_cabinet(canvas, picture);
    draw_art(canvas, picture);
    each<Light>(picture, draw);
    each<Booster>(picture, draw);
    each<Kicker>(picture, draw);
    each<Sensor>(picture, draw);
    each<Saucer>(picture, draw);
    draw_shadows(canvas, picture);
    draw_balls(canvas, picture, false);
    each<Plunger>(picture, draw);
    each<DropTarget>(picture, draw);
    each<Standup>(picture, draw);
    each<SprungTarget>(picture, draw);
    each<Wall>(picture, draw);
    each<Solid>(picture, draw);
    each<Post>(picture, draw);
    each<Slingshot>(picture, draw);
    each<Gate>(picture, draw);
    each<Flipper>(picture, draw);
    each<Bumper>(picture, draw);
    draw_balls(canvas, picture, true);
    each<Spinner>(picture, draw);
}

} // namespace carom::pinball
