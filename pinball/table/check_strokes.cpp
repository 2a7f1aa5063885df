/// @file
/// Whether what moves has room to move: flippers over their whole stroke, plungers and sprung targets over their travel.

#include "pinball/table/check_context.h"

#include <algorithm>

namespace carom::pinball {
namespace {

/// A tip of 65 mm moves 0.3 mm in a quarter of a degree, far less than any wall or bat is thick together.
constexpr double angle_step = 0.25 * 3.14159265358979323846 / 180;
constexpr int travel_steps = 25;

double stroke_angle(const Flipper& flipper, int step, int steps)
{
    return flipper.rest + (double{flipper.up} - flipper.rest) * step / steps;
}

int stroke_steps(const Flipper& flipper)
{
    return 1 + static_cast<int>(std::abs(double{flipper.up} - flipper.rest) / angle_step);
}

/// Every angle's bat, from rest to up.
std::vector<std::vector<Curve>> stroke(const Flipper& flipper)
{
    std::vector<std::vector<Curve>> bats;
    const int steps = stroke_steps(flipper);
    for (int step = 0; step <= steps; ++step)
        bats.push_back(flipper_curves(flipper, stroke_angle(flipper, step, steps)));
    return bats;
}

double reach_of(const Flipper& flipper) { return double{flipper.length} + std::max(flipper.base_radius, flipper.tip_radius); }

// A guide may run out over the base of the bat, level with it: no deeper in the bat than in the base, which only turns about itself.
bool lies_on_base(const CheckContext& context, Index flipper, const Obstacle& obstacle, double deepest)
{
    constexpr double as_deep = 0.0005;  // m
    constexpr double from_middle = 0.6; // of the base's radius
    const Flipper& f = *part_of<Flipper>(context.table, flipper);
    const double base = clearance({make_circle(f.pivot, f.base_radius)}, obstacle.curves);
    const auto stays_outside = [&](const Curve& c)
    { return length(closest_point(c, f.pivot) - Point(f.pivot)) > from_middle * double{f.base_radius}; };
    return deepest > base - as_deep && std::ranges::all_of(obstacle.curves, stays_outside);
}

void check_stroke_against(CheckContext& context, Index flipper, const std::vector<std::vector<Curve>>& bats,
                          const Obstacle& obstacle)
{
    double least = 1;
    for (const std::vector<Curve>& bat : bats)
        least = std::min(least, clearance(bat, obstacle.curves));
    if (least < -touch_tolerance && !lies_on_base(context, flipper, obstacle, least))
        context.report(FindingKind::FlipperStroke, {flipper, obstacle.element}, bats.front().front().a,
                       "the flipper sweeps through it, up to " + millimetres(-least) + " deep");
}

void check_stroke_pair(CheckContext& context, Index first, Index second)
{
    const Flipper& a = *part_of<Flipper>(context.table, first);
    const Flipper& b = *part_of<Flipper>(context.table, second);
    if (length(Point(a.pivot) - Point(b.pivot)) > reach_of(a) + reach_of(b))
        return;
    // Every second angle: each flipper may be anywhere while the other one moves.
    const std::vector<std::vector<Curve>> bats_a = stroke(a);
    const std::vector<std::vector<Curve>> bats_b = stroke(b);
    double least = 1;
    for (std::size_t i = 0; i < bats_a.size(); i += 2)
        for (std::size_t j = 0; j < bats_b.size(); j += 2)
            least = std::min(least, clearance(bats_a[i], bats_b[j]));
    if (least < -touch_tolerance)
        context.report(FindingKind::FlipperStroke, {first, second}, a.pivot, "the flippers sweep through each other");
}

bool within_reach(const Flipper& flipper, const Obstacle& obstacle)
{
    return clearance(obstacle, flipper.pivot) < reach_of(flipper);
}

void check_flipper(CheckContext& context, Index element, const Flipper& flipper)
{
    const std::vector<std::vector<Curve>> bats = stroke(flipper);
    for (const Obstacle& obstacle : context.obstacles)
        if (part_of<Flipper>(context.table, obstacle.element) == nullptr && within_reach(flipper, obstacle))
            check_stroke_against(context, element, bats, obstacle);
    for (Index other = element + 1; other < context.table.elements.size(); ++other)
        if (part_of<Flipper>(context.table, other) != nullptr)
            check_stroke_pair(context, element, other);
}

/// Moves a set of curves along and reports what it meets beyond what it meets at rest.
template <typename CurvesAt>
void check_way(CheckContext& context, Index element, double travel, const CurvesAt& curves_at)
{
    for (const Obstacle& obstacle : context.obstacles)
    {
        if (obstacle.element == element || part_of<Gate>(context.table, obstacle.element) != nullptr ||
            clearance(curves_at(0), obstacle.curves) < -touch_tolerance)
            continue;
        for (int step = 1; step <= travel_steps; ++step)
        {
            const double moved = travel * step / travel_steps;
            if (clearance(curves_at(moved), obstacle.curves) >= -touch_tolerance)
                continue;
            context.report(FindingKind::NoRoom, {element, obstacle.element}, curves_at(0).front().a,
                           "it meets \"" + context.id(obstacle.element) + "\" after " + millimetres(moved) + " of the " +
                               millimetres(travel) + " it may move");
            break;
        }
    }
}

} // namespace

void check_flippers(CheckContext& context)
{
    const auto is_flipper = [](const Element& element) { return std::holds_alternative<Flipper>(element.part); };
    if (std::ranges::none_of(context.table.elements, is_flipper))
        context.report(FindingKind::NoFlipper, {}, {}, "there is no flipper: nobody can play");
}

void check_flipper_strokes(CheckContext& context)
{
    for (Index i = 0; i < context.table.elements.size(); ++i)
        if (const Flipper* flipper = part_of<Flipper>(context.table, i))
            check_flipper(context, i, *flipper);
}

void check_travel(CheckContext& context)
{
    for (Index i = 0; i < context.table.elements.size(); ++i)
    {
        if (const Plunger* plunger = part_of<Plunger>(context.table, i))
            check_way(context, i, plunger->stroke, [&](double moved) { return plunger_curves(*plunger, moved); });
        if (const SprungTarget* target = part_of<SprungTarget>(context.table, i))
            check_way(context, i, target->max_travel, [&](double moved) { return sprung_target_curves(*target, moved); });
    }
}

} // namespace carom::pinball
