#include "pinball/player/name_entry.h"

#include <algorithm>

namespace carom::pinball {

void NameEntry::begin(int rank, int player)
{
    *this = {};
    m_active = true;
    m_rank = rank;
    m_player = player;
    // Whatever is held now was not meant for this.
    m_held = {.left = true, .right = true, .plunger = true, .start = true};
}

void NameEntry::type(char letter)
{
    const bool small = letter >= 'a' && letter <= 'z';
    const bool fits = small || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
    if (!m_active || !fits || m_cursor == letters)
        return;
    m_name[static_cast<std::size_t>(m_cursor)] = small ? static_cast<char>(letter - 'a' + 'A') : letter;
    ++m_cursor;
    m_typed = true;
}

void NameEntry::erase()
{
    if (m_cursor == 0)
        return;
    m_name[static_cast<std::size_t>(--m_cursor)] = 'A';
}

void NameEntry::turn(int by)
{
    m_typed = false;
    m_cursor = std::min(m_cursor, letters - 1);
    char& letter = m_name[static_cast<std::size_t>(m_cursor)];
    const int place = letter >= 'A' ? letter - 'A' : 0;
    letter = static_cast<char>('A' + (place + 26 + by) % 26);
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
    if (taken && (m_typed || ++m_cursor == letters))
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
