#pragma once

/// @file
/// The x-ray: what the engine knows, over the picture. Contacts, normals, impulses, velocities, triggers, boxes, sleep,
/// and the sub-steps of the last step.

#include "view/canvas.h"

#include "carom/debug_draw.h"
#include "carom/scene.h"

#include <map>
#include <optional>
#include <vector>

namespace carom::view {

struct XrayToggles
{
    bool outlines = true; ///< the shapes as the engine sees them; sleeping ones are pale
    bool triggers = true;
    bool joints = true;
    bool contacts = true;
    bool normals = true;
    bool impulses = true;
    bool friction = false;
    bool velocities = true;
    bool boxes = false; ///< fat boxes of the broad phase
    bool centers = false;
    bool islands = false;       ///< awake islands
    float velocity_time = 0.1f; ///< an arrow shows the way within this many seconds
    float impulse_points = 60;  ///< length of the strongest impulse of late
};

class XrayOverlay : public DebugDraw
{
public:
    XrayToggles toggles;

    /// Draws over the scene as it stands after the last step.
    void draw(Canvas& canvas, const Scene& scene);
    /// Check boxes with the colour that each thing is drawn in: a legend as well. Into the present Dear ImGui window.
    void widgets();

    void circle(DrawRole role, Position center, float radius, Rotation rotation) override;
    void capsule(DrawRole role, Position a, Position b, float radius_a, float radius_b) override;
    void polygon(DrawRole role, std::span<const Position> vertices, float radius) override;
    void arc(DrawRole role, Position center, float radius, float start_angle, float sweep, float half_thickness) override;
    void line(DrawRole role, Position a, Position b) override;
    void point(DrawRole role, Position p) override;
    void text(DrawRole role, Position p, std::string_view utf8) override;

private:
    [[nodiscard]] DebugDrawOptions options(const Canvas& canvas, const Scene& scene);
    void outline(DrawRole role, Path path);
    Canvas* m_canvas = nullptr;
    float m_strongest = 0; ///< N s, fades
};

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
    /// The ways of all bodies through the step, their outlines at the selected time, and the impacts so far.
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

/// The colour of a role in the overlay.
[[nodiscard]] Color role_color(DrawRole role);

} // namespace carom::view
