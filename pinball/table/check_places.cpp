/// @file
/// Whether things are where a ball can use them: inside the outline, within reach, with a drain below.

#include "pinball/table/check_context.h"

#include <algorithm>
#include <optional>

namespace carom::pinball {
namespace {

/// A point that must lie inside the outline; none where the element may stand anywhere or has its own rule.
struct PlaceOf
{
    using Place = std::optional<Point>;
    Place operator()(const Post& part) const { return Point(part.pos); }
    Place operator()(const Flipper& part) const { return Point(part.pivot); }
    Place operator()(const Plunger& part) const { return Point(part.pos); }
    Place operator()(const Bumper& part) const { return Point(part.pos); }
    Place operator()(const Slingshot& part) const { return middle(part.corners[0], part.corners[1]); }
    Place operator()(const DropTarget& part) const { return middle(part.a, part.b); }
    Place operator()(const Standup& part) const { return middle(part.a, part.b); }
    Place operator()(const SprungTarget& part) const { return Point(part.pos); }
    Place operator()(const Spinner& part) const { return middle(part.a, part.b); }
    Place operator()(const Gate& part) const { return middle(part.a, part.b); }
    Place operator()(const Sensor& part) const { return Point(part.pos); }
    Place operator()(const Booster& part) const { return Point(part.pos); }
    Place operator()(const Kicker& part) const { return Point(part.pos); }
    Place operator()(const Saucer& part) const { return Point(part.pos); }
    Place operator()(const CaptiveBall& part) const { return Point(part.pos); }
    Place operator()(const Light& part) const { return Point(part.pos); }
    template <typename Other>
    Place operator()(const Other&) const
    {
        return std::nullopt;
    }
    static Place middle(Vec2 a, Vec2 b) { return 0.5 * (Point(a) + Point(b)); }
};

/// Whether no corner of a wall or solid lies inside.
bool lies_outside(const std::vector<Point>& outline, const Chain& chain)
{
    const std::vector<Point> points = flatten(chain);
    return std::none_of(points.begin(), points.end(), [&](Point p) { return contains(outline, p); });
}

void check_chain_place(CheckContext& context, Index element, const Chain& chain)
{
    if (element != context.table.outline && lies_outside(context.outline, chain))
        context.report(FindingKind::OutsideTable, {element}, chain.start, "lies wholly outside the outline of the table");
}

/// How far a ball's centre may be from an element that it acts on, or nothing if a ball never acts on it.
struct TouchDistance
{
    double ball;
    Point p;
    std::optional<double> operator()(const Bumper& part) const { return length(p - part.pos) - part.radius - ball; }
    std::optional<double> operator()(const Slingshot& part) const
    {
        return to_line(part.corners[0], part.corners[1], part.radius);
    }
    std::optional<double> operator()(const DropTarget& part) const { return to_line(part.a, part.b, part.radius); }
    std::optional<double> operator()(const Standup& part) const { return to_line(part.a, part.b, part.radius); }
    std::optional<double> operator()(const Spinner& part) const { return to_line(part.a, part.b, 0); }
    std::optional<double> operator()(const Flipper& part) const
    {
        return length(p - part.pivot) - part.length - part.tip_radius - ball;
    }
    std::optional<double> operator()(const SprungTarget& part) const { return box_distance(part.pos, part.half, p) - ball; }
    std::optional<double> operator()(const Booster& part) const { return box_distance(part.pos, part.half, p) - ball; }
    std::optional<double> operator()(const Kicker& part) const { return box_distance(part.pos, part.half, p) - ball; }
    std::optional<double> operator()(const Saucer& part) const { return length(p - part.pos) - part.radius; }
    std::optional<double> operator()(const Sensor& part) const { return touches(part, p, ball) ? -1.0 : 1.0; }
    template <typename Other>
    std::optional<double> operator()(const Other&) const
    {
        return std::nullopt;
    }
    [[nodiscard]] double to_line(Vec2 a, Vec2 b, double thickness) const
    {
        return distance(make_line(a, b, thickness), p) - ball;
    }
};

bool is_acted_on(const Element& element) { return std::visit(TouchDistance{0, {}}, element.part).has_value(); }

/// The grid is coarser than a contact: within a cell's diagonal counts as touching.
bool is_touched(const Element& element, const std::vector<Point>& cells, double ball)
{
    return std::any_of(cells.begin(), cells.end(), [&](Point p)
                       { return std::visit(TouchDistance{ball, p}, element.part).value_or(0) <= 1.5 * Reach::cell_size; });
}

/// Cells of the ball in play and of the captive balls.
std::vector<Point> all_reached_cells(const CheckContext& context)
{
    std::vector<Point> cells = context.reach.cells();
    for (const Element& element : context.table.elements)
        if (const CaptiveBall* captive = std::get_if<CaptiveBall>(&element.part))
        {
            const Reach own(context.table, context.obstacles, context.outline, captive->pos);
            cells.insert(cells.end(), own.cells().begin(), own.cells().end());
        }
    return cells;
}

bool crosses_itself(const std::vector<Curve>& curves)
{
    for (std::size_t i = 0; i < curves.size(); ++i)
        for (std::size_t j = i + 2; j < curves.size(); ++j)
        {
            const bool joined = i == 0 && j + 1 == curves.size();
            const Approach meeting = closest_approach(curves[i], curves[j]);
            if (!joined && length(meeting.on_a - meeting.on_b) < 1e-6)
                return true;
        }
    return false;
}

} // namespace

void check_outlines(CheckContext& context)
{
    for (Index i = 0; i < context.table.elements.size(); ++i)
    {
        const Solid* solid = part_of<Solid>(context.table, i);
        const Wall* wall = part_of<Wall>(context.table, i);
        if (solid != nullptr && crosses_itself(curves_of(solid->path)))
            context.report(FindingKind::BadOutline, {i}, solid->path.start, "its outline crosses itself");
        if (wall != nullptr && i == context.table.outline && crosses_itself(curves_of(wall->path)))
            context.report(FindingKind::BadOutline, {i}, wall->path.start, "the outline of the table crosses itself");
    }
}

void check_places(CheckContext& context)
{
    for (Index i = 0; i < context.table.elements.size(); ++i)
    {
        const Element& element = context.table.elements[i];
        if (const Wall* wall = std::get_if<Wall>(&element.part))
            check_chain_place(context, i, wall->path);
        if (const Solid* solid = std::get_if<Solid>(&element.part))
            check_chain_place(context, i, solid->path);
        const std::optional<Point> place = std::visit(PlaceOf{}, element.part);
        if (place && !contains(context.outline, *place))
            context.report(FindingKind::OutsideTable, {i}, *place, "stands outside the outline of the table");
    }
    if (!contains(context.outline, context.table.ball.spawn))
        context.report(FindingKind::OutsideTable, {}, context.table.ball.spawn,
                       "the ball starts outside the outline of the table");
}

void check_drains(CheckContext& context)
{
    const auto kills = [](const Element& element)
    {
        const Sensor* sensor = std::get_if<Sensor>(&element.part);
        return sensor != nullptr && sensor->kills && element.enabled;
    };
    if (std::none_of(context.table.elements.begin(), context.table.elements.end(), kills))
        context.report(FindingKind::NoDrain, {}, {}, "no sensor has \"kills\": a ball could never be lost");
}

void check_leaks(CheckContext& context)
{
    if (const std::optional<Point> leak = context.reach.leak())
        context.report(FindingKind::Leak, {context.table.outline}, *leak,
                       "a ball can leave the outline near " + short_number(leak->x) + ", " + short_number(leak->y));
}

void check_reachable(CheckContext& context)
{
    const std::vector<Point> cells = all_reached_cells(context);
    for (Index i = 0; i < context.table.elements.size(); ++i)
    {
        const Element& element = context.table.elements[i];
        if (element.enabled && is_acted_on(element) && !is_touched(element, cells, context.ball_radius))
            context.report(FindingKind::Unreachable, {i}, std::visit(PlaceOf{}, element.part).value_or(Point{}),
                           "no ball can ever touch it");
    }
}

} // namespace carom::pinball
