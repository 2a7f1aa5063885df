/// @file
/// Bottlenecks in which a ball can wedge.
///
/// A gap is a place where two surfaces are nearest: the circle between them touches both and nothing else enters it.
/// It is a trap from 0.4 to 1.02 ball diameters wide if a ball can get at it. Below 0.4 the ball stands so far outside
/// that it lies as on a closed wall; above 1.02 it rolls through.

#include "pinball/table/check_context.h"

#include <algorithm>

namespace carom::pinball {
namespace {

constexpr double narrowest = 0.4;
constexpr double widest = 1.02;
constexpr double same_circle = 1e-5; ///< m

bool holds_captive_ball(const CheckContext& context, const Curve& a, const Curve& b)
{
    constexpr double near = 0.001;
    return std::any_of(context.table.elements.begin(), context.table.elements.end(),
                       [&](const Element& element)
                       {
                           const CaptiveBall* ball = std::get_if<CaptiveBall>(&element.part);
                           return ball != nullptr && distance(a, ball->pos) < context.ball_radius + near &&
                                  distance(b, ball->pos) < context.ball_radius + near;
                       });
}

/// From the middle of a gap to the nearest surface: less than half the gap if something stands in it, negative in a solid.
double room_at(const CheckContext& context, Point middle)
{
    double least = 1;
    for (const Obstacle& obstacle : context.obstacles)
        least = std::min(least, clearance(obstacle, middle));
    return least;
}

Point middle_of(const Approach& gap, const Curve& a, const Curve& b)
{
    const Point across = unit(gap.on_b - gap.on_a);
    return 0.5 * (gap.on_a + a.thickness * across + gap.on_b - b.thickness * across);
}

bool is_trap(const CheckContext& context, const Approach& gap, const Curve& a, const Curve& b)
{
    const double diameter = 2 * context.ball_radius;
    if (gap.clearance < narrowest * diameter || gap.clearance > widest * diameter)
        return false;
    const Point middle = middle_of(gap, a, b);
    return room_at(context, middle) > gap.clearance / 2 - same_circle &&
           context.reach.comes_within(middle, context.ball_radius + Reach::cell_size) && !holds_captive_ball(context, a, b);
}

/// The narrowest trap between two parts, reported once.
void check_pair(CheckContext& context, const Obstacle& first, const Obstacle& second)
{
    const Curve* curve_a = nullptr;
    const Curve* curve_b = nullptr;
    Approach worst{.clearance = 1};
    for (const Curve& a : first.curves)
        for (const Curve& b : second.curves)
        {
            if (&a == &b || closest_approach(a, b).clearance > widest * 2 * context.ball_radius)
                continue;
            for (const Approach& gap : approaches(a, b))
                if (gap.clearance < worst.clearance && is_trap(context, gap, a, b))
                {
                    worst = gap;
                    curve_a = &a;
                    curve_b = &b;
                }
        }
    if (curve_a == nullptr)
        return;
    std::vector<Index> elements = {first.element};
    if (second.element != first.element)
        elements.push_back(second.element);
    context.report(FindingKind::NarrowGap, std::move(elements), middle_of(worst, *curve_a, *curve_b),
                   "the gap is " + millimetres(worst.clearance) + ": a ball of " + millimetres(2 * context.ball_radius) +
                       " can wedge in it");
}

/// Boxes and flippers are made of curves that have no room between them.
bool has_inner_gaps(const Element& element)
{
    return std::holds_alternative<Wall>(element.part) || std::holds_alternative<Solid>(element.part);
}

} // namespace

void check_narrow_gaps(CheckContext& context)
{
    for (std::size_t i = 0; i < context.obstacles.size(); ++i)
    {
        const Obstacle& first = context.obstacles[i];
        if (has_inner_gaps(context.table.elements[first.element]))
            check_pair(context, first, first);
        for (std::size_t j = i + 1; j < context.obstacles.size(); ++j)
            check_pair(context, first, context.obstacles[j]);
    }
}

} // namespace carom::pinball
