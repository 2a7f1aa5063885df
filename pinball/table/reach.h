#pragma once

/// @file
/// Where a ball's centre can get to, on a grid: gates open, drop targets down, flippers at rest.

#include "pinball/table/obstacles.h"

#include <optional>
#include <vector>

namespace carom::pinball {

class Reach
{
public:
    /// Spreads from the start through every cell where a ball fits, until a drain or the outline ends it.
    Reach(const Table& table, const std::vector<Obstacle>& obstacles, const std::vector<Point>& outline, Point start);

    /// A cell outside the outline that a ball can get to.
    [[nodiscard]] std::optional<Point> leak() const { return m_leak; }
    /// True if the ball's centre can come to within this distance of p.
    [[nodiscard]] bool comes_within(Point p, double distance) const;
    /// The reached cells' centres.
    [[nodiscard]] const std::vector<Point>& cells() const { return m_cells; }

    static constexpr double cell_size = 0.002; ///< m

private:
    [[nodiscard]] int column(double x) const;
    [[nodiscard]] int row(double y) const;
    [[nodiscard]] Point center(int column, int row) const;
    [[nodiscard]] std::size_t at(int column, int row) const;
    void spread(const Table& table, const std::vector<Obstacle>& obstacles, const std::vector<Point>& outline, Point start);

    int m_columns = 0;
    int m_rows = 0;
    std::vector<bool> m_reached{};
    std::vector<Point> m_cells{};
    std::optional<Point> m_leak{};
};

/// True if the ball's circle touches the sensor's area.
[[nodiscard]] bool touches(const Sensor& sensor, Point ball, double radius);
[[nodiscard]] double box_distance(Point center, Point half, Point p);

} // namespace carom::pinball
