#pragma once

/// @file
/// From world metres (y up) to window points (y down) and back.

#include "carom/math.h"

namespace carom::view {

struct Camera
{
    Position center{}; ///< what is seen in the middle of the viewport
    double points_per_meter = 100;
    Vec2 viewport_min{}; ///< the part of the window that is used, points
    Vec2 viewport_max{1280, 800};
    bool y_up = true;

    /// Points from the top left corner as the world: one metre is one point, y down.
    [[nodiscard]] static Camera screen(Vec2 size);
    /// Shows all of the box in the viewport, with a margin in points.
    [[nodiscard]] static Camera fit(const Box& box, Vec2 viewport_min, Vec2 viewport_max, float margin = 0);

    [[nodiscard]] Vec2 to_screen(Position world) const;
    [[nodiscard]] Position to_world(Vec2 screen) const;
    [[nodiscard]] float points(float meters) const { return static_cast<float>(meters * points_per_meter); }
    [[nodiscard]] float meters(float points) const { return static_cast<float>(points / points_per_meter); }
    [[nodiscard]] Box visible() const;

    /// Zooms by factor (2: twice as big) and keeps the world point under this screen point where it is.
    void zoom_at(Vec2 screen, double factor);
    /// Moves the picture by this many points.
    void pan(Vec2 points);
};

} // namespace carom::view
