#pragma once

/// @file
/// For table makers: a grid in metres over the table, where the mouse points, and what the checker finds, drawn where it found it. The
/// checker runs beside the game each time the table is another one.

#include "pinball/player/layout.h"
#include "pinball/player/machine.h"
#include "pinball/table/checker.h"
#include "view/canvas.h"

#include <future>
#include <vector>

namespace carom::pinball {

class Workshop
{
public:
    bool open = false;

    /// In the table's own canvas. `mouse` in points of the window.
    void draw_on(view::Canvas& table, const Machine& machine, Vec2 mouse);
    /// The findings in words: beside the table, or at its lower edge.
    void draw_list(view::Canvas& screen, const Layout& layout) const;

private:
    void check(const Machine& machine);
    [[nodiscard]] std::vector<std::string> lines() const;

    std::uint64_t m_version = 0; ///< of the table that was checked last
    std::future<std::vector<Finding>> m_running{};
    std::vector<Finding> m_findings{};
    bool m_done = false;
};

} // namespace carom::pinball
