#include "pinball/table/reach.h"

#include <algorithm>

namespace carom::pinball {
namespace {

constexpr double margin = 0.05; ///< m of grid around the table, so that a leak is seen

/// Shapes that stand in a ball's way for good: gates open, drop targets fall, the plunger moves back.
bool blocks(const Element& element)
{
    return !std::holds_alternative<Gate>(element.part) && !std::holds_alternative<DropTarget>(element.part);
}

struct Disc
{
    const Curve* curve = nullptr;
    Point center{};
    double radius = 0; ///< the curve lies within
};

/// Curves with circles around them: most cells are far from most curves.
std::vector<Disc> blocking_curves(const Table& table, const std::vector<Obstacle>& obstacles)
{
    std::vector<Disc> discs;
    for (const Obstacle& obstacle : obstacles)
        if (blocks(table.elements[obstacle.element]))
            for (const Curve& curve : obstacle.curves)
            {
                const Disc disc = curve.is_arc
                                      ? Disc{&curve, curve.center, curve.radius + curve.thickness}
                                      : Disc{&curve, 0.5 * (curve.a + curve.b), length(curve.b - curve.a) / 2 + curve.thickness};
                discs.push_back(disc);
            }
    return discs;
}

bool fits(const std::vector<Disc>& discs, Point p, double radius)
{
    return std::all_of(discs.begin(), discs.end(),
                       [&](const Disc& disc)
                       {
                           const double reach = disc.radius + radius;
                           const Point away = p - disc.center;
                           return dot(away, away) > reach * reach || distance(*disc.curve, p) >= radius;
                       });
}

bool drains(const Table& table, Point p)
{
    return std::any_of(table.elements.begin(), table.elements.end(),
                       [&](const Element& element)
                       {
                           const Sensor* sensor = std::get_if<Sensor>(&element.part);
                           return sensor != nullptr && sensor->kills && touches(*sensor, p, table.ball.radius);
                       });
}

} // namespace

double box_distance(Point center, Point half, Point p)
{
    const Point outside{std::max(0.0, std::abs(p.x - center.x) - half.x), std::max(0.0, std::abs(p.y - center.y) - half.y)};
    return length(outside);
}

bool touches(const Sensor& sensor, Point ball, double radius)
{
    if (sensor.radius > 0)
        return length(ball - sensor.pos) <= radius + sensor.radius;
    return box_distance(sensor.pos, sensor.half, ball) <= radius;
}

Reach::Reach(const Table& table, const std::vector<Obstacle>& obstacles, const std::vector<Point>& outline, Point start)
    : m_columns(1 + static_cast<int>((table.size.x + 2 * margin) / cell_size)),
      m_rows(1 + static_cast<int>((table.size.y + 2 * margin) / cell_size)),
      m_reached(static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows))
{
    spread(table, obstacles, outline, start);
}

int Reach::column(double x) const { return static_cast<int>(std::floor((x + margin) / cell_size)); }

int Reach::row(double y) const { return static_cast<int>(std::floor((y + margin) / cell_size)); }

Point Reach::center(int column, int row) const { return {(column + 0.5) * cell_size - margin, (row + 0.5) * cell_size - margin}; }

std::size_t Reach::at(int column, int row) const
{
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(m_columns) + static_cast<std::size_t>(column);
}

void Reach::spread(const Table& table, const std::vector<Obstacle>& obstacles, const std::vector<Point>& outline, Point start)
{
    const std::vector<Disc> discs = blocking_curves(table, obstacles);
    std::vector<std::pair<int, int>> open;
    const auto visit = [&](int c, int r)
    {
        if (c < 0 || r < 0 || c >= m_columns || r >= m_rows || m_reached[at(c, r)])
            return;
        const Point p = center(c, r);
        if (!fits(discs, p, table.ball.radius))
            return;
        m_reached[at(c, r)] = true;
        if (!drains(table, p) && !contains(outline, p))
            m_leak = m_leak.value_or(p);
        else
            m_cells.push_back(p);
        if (!drains(table, p) && contains(outline, p))
            open.emplace_back(c, r);
    };
    // The start itself may touch the plunger: begin in the cells around it.
    const int around = 2;
    for (int dr = -around; dr <= around; ++dr)
        for (int dc = -around; dc <= around; ++dc)
            visit(column(start.x) + dc, row(start.y) + dr);
    while (!open.empty())
    {
        const auto [c, r] = open.back();
        open.pop_back();
        visit(c - 1, r);
        visit(c + 1, r);
        visit(c, r - 1);
        visit(c, r + 1);
    }
}

bool Reach::comes_within(Point p, double distance) const
{
    const int around = 1 + static_cast<int>(distance / cell_size);
    for (int r = std::max(0, row(p.y) - around); r <= std::min(m_rows - 1, row(p.y) + around); ++r)
        for (int c = std::max(0, column(p.x) - around); c <= std::min(m_columns - 1, column(p.x) + around); ++c)
            if (m_reached[at(c, r)] && length(center(c, r) - p) <= distance)
                return true;
    return false;
}

} // namespace carom::pinball
