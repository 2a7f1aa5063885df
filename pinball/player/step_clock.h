#pragma once

/// @file
/// From frames to fixed steps: one accumulator with a cap.

#include <algorithm>

namespace carom::pinball {

class StepClock
{
public:
    /// A frame this late is not caught up with: the game waits rather than running away.
    static constexpr double most_behind_ms = 100;

    explicit StepClock(double step_ms = 1) : m_step(step_ms) {}

    void set_step(double step_ms) { m_step = step_ms; }
    /// Begins a frame at this time. speed: game time over real time.
    void begin_frame(double now_ms, double speed)
    {
        m_speed = speed;
        m_done = std::max(m_done, now_ms - most_behind_ms);
        m_now = now_ms;
    }
    /// Whether a step fits before now; the step then ends at step_end_ms().
    [[nodiscard]] bool take_step()
    {
        const double real = m_step / m_speed;
        if (m_done + real > m_now)
            return false;
        m_done += real;
        return true;
    }
    [[nodiscard]] double step_end_ms() const { return m_done; }
    /// How far the frame is past the last step, 0 to 1.
    [[nodiscard]] float alpha() const { return static_cast<float>(std::clamp((m_now - m_done) * m_speed / m_step, 0.0, 1.0)); }
    /// Lets the time until now pass without steps.
    void skip_to(double now_ms) { m_done = m_now = now_ms; }

private:
    double m_step;
    double m_speed = 1;
    double m_done = 0; ///< real time up to which steps were taken, ms
    double m_now = 0;
};

} // namespace carom::pinball
