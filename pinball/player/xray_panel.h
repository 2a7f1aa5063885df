#pragma once

/// @file
/// The x-ray of the table: what the engine knows, over the picture and beside it.

#include "pinball/player/layout.h"
#include "pinball/player/machine.h"
#include "pinball/player/score_panel.h"
#include "view/window.h"
#include "view/xray.h"

namespace carom::pinball {

class XrayPanel
{
public:
    void draw(view::Canvas& table, const Machine& machine, bool paused);
    void widgets(view::Window& window, const Layout& layout, Machine& machine, const Status& status);

    [[nodiscard]] view::XrayToggles& toggles() { return m_overlay.toggles; }

private:
    void wide(view::Window& window, Machine& machine, const Status& status);
    void narrow(view::Window& window, Machine& machine, const Status& status);
    view::XrayOverlay m_overlay{};
    float m_unit = 1; ///< size of letters, 1 being usual
};

} // namespace carom::pinball
