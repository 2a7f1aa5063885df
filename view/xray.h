#pragma once

/// @file
/// The x-ray: what the engine knows, over the picture. Contacts, normals, impulses, velocities, triggers, boxes, sleep.

#include "view/canvas.h"

#include "carom/debug_draw.h"
#include "carom/scene.h"

#include <span>
#include <string_view>

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
    float m_dot = 3;       ///< radius of points, points
};

/// The colour of a role in the overlay.
[[nodiscard]] Color role_color(DrawRole role);

} // namespace carom::view
