#include "pinball/player/name_entry.h"

namespace carom::pinball {

void NameEntry::begin(int rank)
{
    *this = {};
    m_active = true;
    m_rank = rank;
    // Whatever is held now was not meant for this.
    m_held = {.left = true, .right = true, .plunger = true, .start = true};
}

void NameEntry::turn(int by)
{
    char& letter = m_name[static_cast<std::size_t>(m_cursor)];
    letter = static_cast<char>('A' + (letter - 'A' + 26 + by) % 26);
}

bool NameEntry::step(const Input& input)
{
    const Input before = m_held;
    m_held = input;
    if (!m_active)
    {
        m_swallow = m_swallow && (input.start || input.plunger);
        return false;
    }
    if (input.left && !before.left)
        turn(-1);
    if (input.right && !before.right)
        turn(1);
    const bool taken = (input.start && !before.start) || (input.plunger && !before.plunger);
    if (taken && ++m_cursor == 3)
    {
        m_active = false;
        m_swallow = true;
        return true;
    }
    return false;
}

Input NameEntry::leaves_over(const Input& input) const
{
    Input left = input;
    if (m_active || m_swallow)
        left.start = left.plunger = false;
    if (m_active)
        left.left = left.right = false;
    return left;
}

} // namespace carom::pinball
