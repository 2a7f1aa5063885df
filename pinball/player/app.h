#pragma once

/// @file
/// The machine in a window, in real time.

#include "pinball/player/controls.h"
#include "pinball/player/machine.h"
#include "pinball/player/options.h"
#include "view/image.h"

#include <functional>
#include <memory>
#include <optional>

namespace carom::pinball {

/// Turns what comes in by the window into a game and draws it. The clock is the program's own unless a test gives another one.
class App
{
public:
    /// In ms, as SDL stamps events.
    using Clock = std::function<double()>;
    explicit App(const PlayerOptions& options, Clock clock = {});
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    /// Takes what has come in, moves on to the present and draws. False once it is over.
    [[nodiscard]] bool frame(view::Image* capture = nullptr);

    [[nodiscard]] const Machine& machine() const;
    [[nodiscard]] bool is_paused() const;
    [[nodiscard]] std::optional<Wish> asks() const; ///< whether it was meant, before it ends a game

private:
    struct State;
    std::unique_ptr<State> m_state;
};

/// Until the user ends it, or the time of the options is over. The exit code of the program.
int run_app(const PlayerOptions& options);

} // namespace carom::pinball
