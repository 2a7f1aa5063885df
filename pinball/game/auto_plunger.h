#pragma once

/// @file
/// Holds and lets go of the plunger for balls that the machine launches by itself.

#include "pinball/elements/hash.h"

namespace carom::pinball {

class AutoPlunger
{
public:
    /// `step` is the length of a step, s.
    explicit AutoPlunger(float step = 0.001f);

    /// Another ball to launch.
    void launch() { ++m_balls; }
    /// One has left the lane, whoever launched it.
    void launched() { m_balls = m_balls > 0 ? m_balls - 1 : 0; }
    /// No ball is waited for any more.
    void forget() { m_balls = 0; }
    /// Whether to hold the plunger in this step. `ready`: a ball lies before it. `pull_steps`: how long a full pull takes.
    [[nodiscard]] bool step(bool ready, int pull_steps);
    void add_to(Hash& hash) const;

private:
    int m_settle_steps;
    int m_balls = 0;
    int m_pulled = 0; ///< steps; 0: at rest
    int m_pause = 0;
};

} // namespace carom::pinball
