#include "pinball/game/auto_plunger.h"

#include <cmath>

namespace carom::pinball {

namespace {

// A ball that was just served settles on the rod first, and one that was launched gets away before the next pull.
constexpr float settle_time = 0.3f; // s

} // namespace

AutoPlunger::AutoPlunger(float step) : m_settle_steps(static_cast<int>(std::lround(settle_time / step))) {}

bool AutoPlunger::step(bool ready, int pull_steps)
{
    if (m_pulled == 0)
    {
        m_pause = ready && m_balls > 0 ? m_pause + 1 : 0;
        if (m_pause < m_settle_steps)
            return false;
    }
    if (++m_pulled <= pull_steps)
        return true;
    m_pulled = 0;
    m_pause = 0; // one that falls back is launched again
    return false;
}

void AutoPlunger::add_to(Hash& hash) const
{
    hash.add(m_balls);
    hash.add(m_pulled);
    hash.add(m_pause);
}

} // namespace carom::pinball
