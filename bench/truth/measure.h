#pragma once

/// @file
/// Quantities that experiments take from samples of a motion.

#include "truth/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace truth {

/// Mean and largest of a row of errors; not a number without any.
class Errors
{
public:
    void add(double error)
    {
        m_sum += error;
        // A value that is no number must not hide behind a comparison that is false.
        m_worst = std::isnan(error) ? error : std::max(m_worst, error);
        ++m_count;
    }
    [[nodiscard]] int count() const { return m_count; }
    [[nodiscard]] double mean() const { return m_count > 0 ? m_sum / m_count : std::numeric_limits<double>::quiet_NaN(); }
    [[nodiscard]] double worst() const { return m_count > 0 ? m_worst : std::numeric_limits<double>::quiet_NaN(); }

private:
    double m_sum = 0;
    double m_worst = 0;
    int m_count = 0;
};

/// The value farthest from an expected one.
class Farthest
{
public:
    explicit Farthest(double expected) : m_expected(expected) {}
    void add(double value)
    {
        if (m_count++ == 0 || !(std::abs(value - m_expected) <= std::abs(m_value - m_expected)))
        {
            m_value = value;
        }
    }
    [[nodiscard]] double value() const { return m_value; }

private:
    double m_expected;
    double m_value = std::numeric_limits<double>::quiet_NaN();
    int m_count = 0;
};

/// Extreme value of the parabola through three samples at equal distances.
[[nodiscard]] inline double vertex(double before, double at, double after)
{
    const double slope = (after - before) / 2;
    const double bend = after - 2 * at + before;
    return bend == 0 ? at : at - slope * slope / (2 * bend);
}

/// Where the cubic through four samples at -1, 0, 1, 2 crosses zero between 0 and 1; the samples at 0 and 1 differ in sign.
[[nodiscard]] inline double crossing(const std::array<double, 4>& y)
{
    const auto cubic = [&](double t)
    {
        return -y[0] * t * (t - 1) * (t - 2) / 6 + y[1] * (t + 1) * (t - 1) * (t - 2) / 2 - y[2] * (t + 1) * t * (t - 2) / 2 +
               y[3] * (t + 1) * t * (t - 1) / 6;
    };
    double low = 0;
    double high = 1;
    for (int i = 0; i < 60; ++i)
    {
        const double middle = (low + high) / 2;
        ((cubic(middle) < 0) == (y[1] < 0) ? low : high) = middle;
    }
    return low;
}

} // namespace truth
