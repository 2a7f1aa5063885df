#pragma once

/// @file
/// The window in which the player gives actions other keys.

#include "pinball/player/controls.h"
#include "view/window.h"

#include <optional>
#include <string>

namespace carom::pinball {

class ControlsPanel
{
public:
    void toggle();
    /// Takes the event where a key is being waited for: true.
    [[nodiscard]] bool handle(const SDL_Event& event, Controls& controls);
    void draw(view::Window& window, Controls& controls);

private:
    void row(const Controls& controls, std::size_t action);
    void keep(const Controls& controls);

    bool m_open = false;
    std::optional<std::size_t> m_waiting{}; ///< action that gets what is pressed next
    std::string m_trouble{};
};

} // namespace carom::pinball
