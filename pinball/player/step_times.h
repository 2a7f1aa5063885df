#pragma once

/// @file
/// How long steps take, measured from outside.

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace carom::pinball {

class StepTimes
{
public:
    void measure(auto&& step)
    {
        const auto start = std::chrono::steady_clock::now();
        step();
        const double us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
        m_sum += us;
        m_most = std::max(m_most, us);
        ++m_count;
    }
    [[nodiscard]] std::int64_t count() const { return m_count; }
    [[nodiscard]] double mean_us() const { return m_count > 0 ? m_sum / static_cast<double>(m_count) : 0; }
    [[nodiscard]] double most_us() const { return m_most; }

private:
    double m_sum = 0;
    double m_most = 0;
    std::int64_t m_count = 0;
};

} // namespace carom::pinball
