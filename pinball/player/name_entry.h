#pragma once

/// @file
/// Three letters for the high scores: typed, or the flippers turn the letter and start or plunger takes it. A name that was typed is taken
/// whole.

#include "pinball/game/game.h"

#include <string>

namespace carom::pinball {

class NameEntry
{
public:
    static constexpr int letters = 3;

    /// `player` from 0, or -1 where only one plays.
    void begin(int rank, int player = -1);
    [[nodiscard]] bool active() const { return m_active; }
    [[nodiscard]] int rank() const { return m_rank; }
    [[nodiscard]] int player() const { return m_player; }
    [[nodiscard]] int cursor() const { return m_cursor; } ///< letters: all are typed
    [[nodiscard]] const std::string& name() const { return m_name; }

    /// A letter or digit of the keyboard; anything else is none.
    void type(char letter);
    void erase();
    /// True in the step in which the last letter was taken.
    [[nodiscard]] bool step(const Input& input);
    /// The buttons that are left to the game.
    [[nodiscard]] Input leaves_over(const Input& input) const;

private:
    void turn(int by);

    bool m_active = false;
    bool m_typed = false;
    bool m_swallow = false; ///< the button that ended the entry is still down
    int m_rank = -1;
    int m_player = -1;
    int m_cursor = 0;
    std::string m_name = "AAA";
    Input m_held{};
};

} // namespace carom::pinball
