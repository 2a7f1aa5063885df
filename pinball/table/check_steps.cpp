/// @file
/// Steps between a guide and a flipper at rest. A ball that rolls down the guide must come onto the bat without being thrown up: where its centre
/// would have to turn upwards at once, the turn throws it.

#include "pinball/table/check_context.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace carom::pinball {
namespace {

constexpr double steepest = 0.25;     ///< of the ball's speed that the bat may be hit with
constexpr double way_before = 0.015;  ///< m of the guide that are looked at before its end
constexpr double pace = 0.0001;       ///< m
constexpr double farthest_turn = 1.0; ///< rad about the end of the guide

struct Meeting
{
    Point center{};
    double share = 0; ///< of the speed along the way that goes into the bat
};

// The ball's touch of the bat at a place of its way; `normal` is that of the surface under it.
std::optional<Meeting> meeting_at(const std::vector<Curve>& bat, Point center, Point normal, Point down, double radius)
{
    const auto nearest = std::ranges::min_element(bat, {}, [&](const Curve& c) { return distance(c, center); });
    if (distance(*nearest, center) > radius)
        return std::nullopt;
    const Point way = dot(perp(normal), down) > 0 ? perp(normal) : -1 * perp(normal);
    return Meeting{center, -dot(way, unit(center - closest_point(*nearest, center)))};
}

// Down a line to its end at `end` and about it.
std::optional<Meeting> roll(const std::vector<Curve>& bat, Point end, Point down, double thickness, double radius)
{
    const Point up = perp(down).y > 0 ? perp(down) : -1 * perp(down);
    const double off = thickness + radius;
    for (double before = way_before; before > 0; before -= pace)
    {
        if (const auto met = meeting_at(bat, end - before * down + off * up, up, down, radius))
            return met;
    }
    for (double turn = 0; turn < farthest_turn; turn += pace / off)
    {
        const Point normal = std::cos(turn) * up + std::sin(turn) * down;
        if (const auto met = meeting_at(bat, end + off * normal, normal, down, radius))
            return met;
    }
    return std::nullopt;
}

void check_guide(CheckContext& context, Index flipper, const std::vector<Curve>& bat, Point pivot, const Obstacle& guide)
{
    for (const Curve& line : guide.curves)
    {
        if (line.is_arc || length(line.b - line.a) < way_before)
            continue;
        for (const auto& [from, to] : {std::pair(line.a, line.b), std::pair(line.b, line.a)})
        {
            const Point down = unit(to - from);
            const bool leads_here = down.y < -0.1 && length(to - pivot) < 3 * context.ball_radius;
            const auto met = leads_here ? roll(bat, to, down, line.thickness, context.ball_radius) : std::nullopt;
            if (!met || met->share < steepest || !context.reach.comes_within(met->center, Reach::cell_size))
                continue;
            context.report(FindingKind::Step, {guide.element, flipper}, met->center,
                           "a ball that rolls from it onto the flipper is thrown up: it meets the bat with " +
                               std::to_string(std::lround(100 * met->share)) +
                               " % of its speed; let the guide end over the base of the bat, level with it");
        }
    }
}

} // namespace

void check_steps(CheckContext& context)
{
    for (Index i = 0; i < context.table.elements.size(); ++i)
    {
        const Flipper* flipper = part_of<Flipper>(context.table, i);
        if (flipper == nullptr)
            continue;
        const std::vector<Curve> bat = flipper_curves(*flipper, flipper->rest);
        for (const Obstacle& obstacle : context.obstacles)
        {
            if (part_of<Wall>(context.table, obstacle.element) != nullptr)
                check_guide(context, i, bat, flipper->pivot, obstacle);
        }
    }
}

} // namespace carom::pinball
