/// @file
/// Finds elements that overlap before anything has moved.

#include "pinball/table/check_context.h"

#include <algorithm>

namespace carom::pinball {
namespace {

/// Devices need free room around them; walls, posts and standups may be set into each other.
bool is_device(const Element& element)
{
    return std::holds_alternative<Bumper>(element.part) || std::holds_alternative<Slingshot>(element.part) ||
           std::holds_alternative<DropTarget>(element.part) || std::holds_alternative<SprungTarget>(element.part) ||
           std::holds_alternative<Plunger>(element.part);
}

bool is_gate_or_flipper(const Element& element)
{
    // Gates end on what they close; flippers have a check of their own over the whole stroke.
    return std::holds_alternative<Gate>(element.part) || std::holds_alternative<Flipper>(element.part);
}

/// A ball, in play or captive, against every part. No element stands for the ball in play.
void check_ball(CheckContext& context, Point center, std::vector<Index> ball, const std::string& what)
{
    for (const Obstacle& obstacle : context.obstacles)
    {
        const double depth = context.ball_radius - clearance(obstacle, center);
        if (depth <= touch_tolerance)
            continue;
        std::vector<Index> elements = ball;
        elements.push_back(obstacle.element);
        context.report(FindingKind::Overlap, std::move(elements), center,
                       what + " overlaps \"" + context.id(obstacle.element) + "\" by " + millimetres(depth));
    }
}

void check_ball_pair(CheckContext& context, Point a, Point b, std::vector<Index> balls, const std::string& what)
{
    const double depth = 2 * context.ball_radius - length(a - b);
    if (depth > touch_tolerance)
        context.report(FindingKind::Overlap, std::move(balls), a, what + " overlap by " + millimetres(depth));
}

void check_captive_balls(CheckContext& context)
{
    for (Index i = 0; i < context.table.elements.size(); ++i)
    {
        const CaptiveBall* first = part_of<CaptiveBall>(context.table, i);
        if (first == nullptr)
            continue;
        check_ball(context, first->pos, {i}, "the captive ball");
        check_ball_pair(context, first->pos, context.table.ball.spawn, {i}, "the captive ball and the ball at its start");
        for (Index j = i + 1; j < context.table.elements.size(); ++j)
            if (const CaptiveBall* second = part_of<CaptiveBall>(context.table, j))
                check_ball_pair(context, first->pos, second->pos, {i, j}, "two captive balls");
    }
}

void check_saucers(CheckContext& context)
{
    for (Index i = 0; i < context.table.elements.size(); ++i)
        if (const Saucer* saucer = part_of<Saucer>(context.table, i))
            check_ball(context, saucer->pos, {i}, "a ball held in the saucer");
}

/// The ball must wait in the plunger's lane and within a diameter of its head.
void check_plunger_lane(CheckContext& context, Index element, const Plunger& plunger)
{
    const Point spawn = context.table.ball.spawn;
    const Point from_head = spawn - Point(plunger.pos);
    const double along = dot(from_head, plunger.axis) - plunger.half.y;
    const double across = std::abs(cross(from_head, plunger.axis));
    if (along < 0 || along > 2 * context.ball_radius || across > plunger.half.x + context.ball_radius / 2)
        context.report(FindingKind::Plunger, {element}, spawn, "the ball does not start in front of the plunger");
    const Sensor* lane = plunger.lane == none ? nullptr : part_of<Sensor>(context.table, plunger.lane);
    if (lane != nullptr && !touches(*lane, spawn, context.ball_radius))
        context.report(FindingKind::Plunger, {element, plunger.lane}, spawn,
                       "the ball starts outside the plunger's lane \"" + context.id(plunger.lane) + "\"");
}

double deepest(const Obstacle& a, const Obstacle& b)
{
    double least = clearance(a.curves, b.curves);
    if (!b.inside.empty() && contains(b.inside, a.curves.front().a))
        least = std::min(least, clearance(b, a.curves.front().a));
    return -least;
}

} // namespace

bool check_start(CheckContext& context)
{
    const std::size_t before = context.findings.size();
    check_ball(context, context.table.ball.spawn, {}, "the ball at its start");
    const bool free = context.findings.size() == before && contains(context.outline, context.table.ball.spawn);
    check_captive_balls(context);
    check_saucers(context);
    for (Index i = 0; i < context.table.elements.size(); ++i)
        if (const Plunger* plunger = part_of<Plunger>(context.table, i))
            check_plunger_lane(context, i, *plunger);
    return free;
}

void check_device_overlaps(CheckContext& context)
{
    const auto element = [&](std::size_t i) -> const Element& { return context.table.elements[context.obstacles[i].element]; };
    for (std::size_t i = 0; i < context.obstacles.size(); ++i)
        for (std::size_t j = 0; j < context.obstacles.size(); ++j)
        {
            const bool counted_before = is_device(element(j)) && j < i;
            if (i == j || counted_before || !is_device(element(i)) || is_gate_or_flipper(element(j)))
                continue;
            const double depth = deepest(context.obstacles[i], context.obstacles[j]);
            if (depth > touch_tolerance)
                context.report(FindingKind::Overlap, {context.obstacles[i].element, context.obstacles[j].element},
                               context.obstacles[i].curves.front().a, "they overlap by " + millimetres(depth));
        }
}

} // namespace carom::pinball
