#pragma once

/// @file
/// A scene that is being watched: time, pause, slow motion, single steps, and what the last steps cost.

#include "scenes/scenes.h"
#include "view/impact_story.h"
#include "view/substep_scrubber.h"

#include <deque>

namespace carom::lab {

class Run
{
public:
    static constexpr std::size_t history_steps = 240;

    Run(const scenes::SceneEntry& entry, const SceneDef& base);

    [[nodiscard]] const scenes::SceneEntry& entry() const { return *m_entry; }
    [[nodiscard]] Scene& scene() { return m_built.scene; }
    [[nodiscard]] const Scene& scene() const { return m_built.scene; }

    /// Lets this much real time pass.
    void advance(double seconds);
    void step();

    bool paused = false;
    double speed = 1; ///< 1: real time, 0.1: slow motion

    /// For drawing between steps.
    [[nodiscard]] float alpha() const;
    [[nodiscard]] const std::deque<StageTimes>& history() const { return m_history; }
    view::SubstepScrubber scrubber;
    view::ImpactWatch impacts{view::kind_name};

private:
    const scenes::SceneEntry* m_entry;
    scenes::BuiltScene m_built;
    double m_waiting = 0; ///< s that are not stepped yet
    std::deque<StageTimes> m_history;
};

} // namespace carom::lab
