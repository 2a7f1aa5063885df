// 12. A column of boxes stands; a light box bears a heavy one.

#include "truth/box2d_3_2.h"
#include "truth/experiments/experiments.h"
#include "truth/overlap.h"

#include <algorithm>

namespace truth {
namespace {

struct Column
{
    std::unique_ptr<World> world{};
    std::vector<Body> boxes{};
};

/// Boxes of 1 m from the bottom up, exactly touching, with these densities.
Column build(const Setup& setup, const std::vector<double>& densities)
{
    Column column{.world = setup.world(earth)};
    const Body floor = column.world->add_body({.motion = Motion::Static});
    column.world->add_shape(floor, box(200, 2, {0, -1}), {.friction = 0.6});
    for (const double density : densities)
    {
        const double y = static_cast<double>(column.boxes.size()) + 0.5;
        column.boxes.push_back(column.world->add_body({.position = {0, y}}));
        column.world->add_shape(column.boxes.back(), box(1, 1), {.density = density, .friction = 0.6});
    }
    return column;
}

/// The seconds after which the top is below nine tenths of its height or a meter aside; -1 if it never is in 30 s.
double fell_at(const Setup& setup, Column& column)
{
    const double top = static_cast<double>(column.boxes.size()) - 0.5;
    for (int step = 1; step <= setup.steps(30); ++step)
    {
        column.world->step(setup.dt());
        const Vec at = column.world->state(column.boxes.back()).position;
        if (!(at.y > 0.9 * top && std::abs(at.x) < 1))
        {
            return step * setup.dt();
        }
    }
    return -1;
}

void stack(const Setup& setup, int count, double bound, Metrics& metrics)
{
    const std::string name = "stack of " + std::to_string(count) + ": ";
    setup.tell(name);
    Column column = build(setup, std::vector<double>(static_cast<std::size_t>(count), 1.0));
    const double fell = fell_at(setup, column);
    const Vec top = column.world->state(column.boxes.back()).position;
    const bool stands = fell < 0;
    metrics.push_back({12, name + "fell at, s; -1 stands", -1, fell, bound});
    metrics.push_back({12, name + "sag of the top, mm", 0, stands ? (count - 0.5 - top.y) * 1000 : none, none});
    metrics.push_back({12, name + "sideways drift, mm", 0, stands ? std::abs(top.x) * 1000 : none, none});
}

double deepest(const Column& column)
{
    Placed below{box(200, 2, {0, -1})};
    double worst = 0;
    for (const Body body : column.boxes)
    {
        const State s = column.world->state(body);
        const Placed box_here{box(1, 1), s.position, s.angle};
        worst = std::max(worst, overlap(below, box_here));
        below = box_here;
    }
    return worst;
}

void mass_ratio(const Setup& setup, double ratio, double bound, Metrics& metrics)
{
    Column column = build(setup, {1, ratio});
    double worst = 0;
    for (int step = 0; step < setup.steps(10); ++step)
    {
        column.world->step(setup.dt());
        worst = std::max(worst, deepest(column));
    }
    const std::string name = "mass ratio " + std::to_string(static_cast<int>(ratio)) + ": overlap, worst, mm";
    metrics.push_back({12, name, 0, worst * 1000, bound});
}

} // namespace

Metrics stacks(const Setup& setup)
{
    Metrics metrics;
    for (const int count : {10, 20, 50, 100})
    {
        stack(setup, count, 0, metrics);
    }
    stack(setup, 200, none, metrics);
    mass_ratio(setup, 10, box2d_3_2::mass_ratio_10_penetration_mm, metrics);
    mass_ratio(setup, 100, box2d_3_2::mass_ratio_100_penetration_mm, metrics);
    mass_ratio(setup, 1000, none, metrics);
    return metrics;
}

} // namespace truth
