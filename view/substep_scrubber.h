#pragma once

/// @file
/// Looking into the last step.

#include "view/canvas.h"

#include "carom/scene.h"

#include <map>
#include <optional>
#include <vector>

namespace carom::view {

/// Goes back and forth within the last step: poses at the ends of its sub-steps (Scene::set_record_substeps) and the
/// impacts at their own times.
class SubstepScrubber
{
public:
    /// Call after the step to look into.
    void capture(const Scene& scene);
    void clear();
    [[nodiscard]] bool empty() const { return m_times.size() < 2; }
    [[nodiscard]] int substeps() const { return static_cast<int>(m_times.size()) - 1; }

    /// 0 is the start of the step, substeps() its end.
    void select(int index);
    [[nodiscard]] int selected() const { return m_selected; }
    [[nodiscard]] float time() const
    {
        return empty() ? 0 : m_times[static_cast<std::size_t>(m_selected)];
    } ///< within the step, s
    /// Where a body was at the selected time; empty if it did not move in that step.
    [[nodiscard]] std::optional<Pose> pose(BodyId body) const;

    /// A slider and what happened up to there. Into the present Dear ImGui window.
    void widgets();
    /// The ways of all bodies through the step, their outlines at the selected time, and the impacts so far. Nothing while
    /// the end of the step is selected.
    void draw(Canvas& canvas, const Scene& scene) const;

private:
    struct Hit
    {
        float time = 0;
        Position point{};
        Vec2 normal{};
        float impulse = 0;
    };
    std::vector<float> m_times;                  ///< start of the step, then the end of each sub-step
    std::map<BodyId, std::vector<Pose>> m_poses; ///< one for each time
    std::vector<Hit> m_hits;
    int m_selected = 0;
};

} // namespace carom::view
