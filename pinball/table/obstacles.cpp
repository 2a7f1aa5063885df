#include "pinball/table/obstacles.h"

#include <algorithm>
#include <array>
#include <limits>

namespace carom::pinball {
namespace {

constexpr double far_away = 10; ///< m: as long as a plane needs to be on a table of at most 3 m

Obstacle plane_obstacle(const Plane& plane)
{
    const Point n = plane.normal;
    const Point left = Point(plane.point) + far_away * perp(n);
    const Point right = Point(plane.point) - far_away * perp(n);
    return {.curves = {make_line(left, right, 0)}, .inside = {left, right, right - far_away * n, left - far_away * n}};
}

Obstacle slingshot_obstacle(const Slingshot& sling)
{
    Obstacle obstacle;
    for (std::size_t i = 0; i < 3; ++i)
    {
        obstacle.curves.push_back(make_line(sling.corners[i], sling.corners[(i + 1) % 3], sling.radius));
        obstacle.inside.push_back(sling.corners[i]);
    }
    return obstacle;
}

struct ObstacleMaker
{
    Obstacle operator()(const Wall& wall) const { return {.curves = curves_of(wall.path)}; }
    Obstacle operator()(const Solid& solid) const { return {.curves = curves_of(solid.path), .inside = flatten(solid.path)}; }
    Obstacle operator()(const Post& post) const { return {.curves = {make_circle(post.pos, post.radius)}}; }
    Obstacle operator()(const Plane& plane) const { return plane_obstacle(plane); }
    Obstacle operator()(const Flipper& flipper) const { return {.curves = flipper_curves(flipper, flipper.rest)}; }
    Obstacle operator()(const Plunger& plunger) const { return {.curves = plunger_curves(plunger, 0)}; }
    Obstacle operator()(const Bumper& bumper) const { return {.curves = {make_circle(bumper.pos, bumper.radius)}}; }
    Obstacle operator()(const Slingshot& sling) const { return slingshot_obstacle(sling); }
    Obstacle operator()(const DropTarget& target) const { return {.curves = {make_line(target.a, target.b, target.radius)}}; }
    Obstacle operator()(const Standup& target) const { return {.curves = {make_line(target.a, target.b, target.radius)}}; }
    Obstacle operator()(const SprungTarget& target) const { return {.curves = sprung_target_curves(target, 0)}; }
    Obstacle operator()(const Gate& gate) const { return {.curves = {make_line(gate.a, gate.b, gate.radius)}}; }
    template <typename Untouchable>
    Obstacle operator()(const Untouchable&) const
    {
        return {};
    }
};

} // namespace

std::vector<Curve> flipper_curves(const Flipper& flipper, double angle)
{
    const Point pivot = flipper.pivot;
    const Point axis = unit(angle);
    const Point tip = pivot + double{flipper.length} * axis;
    // The faces touch both circles: their normal leans from the axis by acos of the taper.
    const double lean = (double{flipper.base_radius} - flipper.tip_radius) / flipper.length;
    const double out = std::sqrt(std::max(0.0, 1 - lean * lean));
    std::vector<Curve> curves = {make_circle(pivot, flipper.base_radius), make_circle(tip, flipper.tip_radius),
                                 make_line(pivot, tip, std::min(flipper.base_radius, flipper.tip_radius))};
    for (const double side : {-1.0, 1.0})
    {
        const Point normal = lean * axis + (side * out) * perp(axis);
        curves.push_back(make_line(pivot + double{flipper.base_radius} * normal, tip + double{flipper.tip_radius} * normal, 0));
    }
    return curves;
}

std::vector<Curve> box_curves(Point center, Point half, Point axis)
{
    const Point up = half.y * axis;
    const Point right = -half.x * perp(axis);
    const std::array<Point, 4> corners = {center - right - up, center + right - up, center + right + up, center - right + up};
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < 4; ++i)
        curves.push_back(make_line(corners[i], corners[(i + 1) % 4], 0));
    return curves;
}

std::vector<Curve> plunger_curves(const Plunger& plunger, double pulled)
{
    return box_curves(Point(plunger.pos) - pulled * Point(plunger.axis), plunger.half, plunger.axis);
}

std::vector<Curve> sprung_target_curves(const SprungTarget& target, double pushed)
{
    return box_curves(Point(target.pos) + pushed * Point(target.axis), target.half, {0, 1});
}

std::vector<Obstacle> obstacles_of(const Table& table)
{
    std::vector<Obstacle> obstacles;
    for (std::size_t i = 0; i < table.elements.size(); ++i)
    {
        Obstacle obstacle = std::visit(ObstacleMaker{}, table.elements[i].part);
        obstacle.element = static_cast<Index>(i);
        if (!obstacle.curves.empty() && table.elements[i].enabled)
            obstacles.push_back(std::move(obstacle));
    }
    return obstacles;
}

double clearance(const std::vector<Curve>& a, const std::vector<Curve>& b)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Curve& curve_a : a)
        for (const Curve& curve_b : b)
            least = std::min(least, closest_approach(curve_a, curve_b).clearance);
    return least;
}

double clearance(const Obstacle& obstacle, Point p)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Curve& curve : obstacle.curves)
        least = std::min(least, distance(curve, p));
    return !obstacle.inside.empty() && contains(obstacle.inside, p) ? -std::abs(least) : least;
}

} // namespace carom::pinball
