#pragma once

/// @file
/// A coil: its driver looks at what is wanted once a millisecond, and the torque follows in a straight line (the coil's rise).

#include "pinball/elements/hash.h"

#include <cmath>

namespace carom::pinball {

class Coil
{
public:
    /// `rise` is the time from no torque to all of it, s; 0: at once.
    Coil(float torque, float rise) : m_rate(rise > 0 ? torque / rise : 0) {}

    /// The mean torque from `begin` to `begin + h`, exactly. `target(time)` gives what is wanted at a whole millisecond. Times only go forward;
    /// in those left out nothing has changed.
    template <class Target>
    [[nodiscard]] float mean_torque(double begin, double h, Target&& target)
    {
        double now = begin;
        double sum = 0;
        for (double ticks = std::ceil((begin - rounding) / tick); ticks * tick < begin + h - rounding; ++ticks)
        {
            if (ticks * tick > now)
            {
                sum += follow(ticks * tick - now);
                now = ticks * tick;
            }
            m_target = target(now);
        }
        sum += follow(begin + h - now);
        return static_cast<float>((sum - ramp_error(h)) / h);
    }

    void add_to(Hash& hash) const;

private:
    static constexpr double tick = 0.001;    // s
    static constexpr double rounding = 1e-6; // s: a tick at the very end belongs to what comes next

    /// Moves the torque on; gives its integral over that time.
    double follow(double time);
    /// A torque that rises by r N m/s gives not only r h²/2 of speed but r h³/6 of way; the even torque of that mean gives
    /// r h³/12 more. A speed that stays behind by r h²/12 while the torque rises makes up for it.
    double ramp_error(double h);

    double m_rate; ///< N m/s; 0: at once
    double m_torque = 0;
    double m_slope = 0;  ///< of the torque now, N m/s
    double m_behind = 0; ///< what was taken off the impulse, N m s
    float m_target = 0;
};

} // namespace carom::pinball
