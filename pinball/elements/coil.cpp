#include "pinball/elements/coil.h"

#include <cmath>

namespace carom::pinball {

double Coil::follow(double time)
{
    const double before = m_torque;
    const auto target = static_cast<double>(m_target);
    const double needed = m_rate > 0 ? std::abs(target - before) / m_rate : 0;
    if (needed >= time)
    {
        m_slope = needed > 0 ? std::copysign(m_rate, target - before) : 0;
        m_torque += m_slope * time;
        return 0.5 * time * (before + m_torque);
    }
    m_slope = 0;
    m_torque = target;
    return 0.5 * needed * (before + target) + (time - needed) * target;
}

double Coil::ramp_error(double h)
{
    const double before = m_behind;
    m_behind = m_slope * h * h / 12;
    return m_behind - before;
}

void Coil::add_to(Hash& hash) const
{
    hash.add(m_torque);
    hash.add(m_target);
    hash.add(m_slope);
    hash.add(m_behind);
}

} // namespace carom::pinball
