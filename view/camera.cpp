#include "view/camera.h"

#include <algorithm>

namespace carom::view {

Camera Camera::screen(Vec2 size)
{
    return {.center = Position{size * 0.5f}, .points_per_meter = 1, .viewport_min = {}, .viewport_max = size, .y_up = false};
}

Camera Camera::fit(const Box& box, Vec2 viewport_min, Vec2 viewport_max, float margin)
{
    Camera camera{.viewport_min = viewport_min, .viewport_max = viewport_max};
    const double width = std::max(box.upper.x - box.lower.x, 1e-6);
    const double height = std::max(box.upper.y - box.lower.y, 1e-6);
    const double room_x = std::max(viewport_max.x - viewport_min.x - 2 * margin, 1.0f);
    const double room_y = std::max(viewport_max.y - viewport_min.y - 2 * margin, 1.0f);
    camera.points_per_meter = std::min(room_x / width, room_y / height);
    camera.center = {(box.lower.x + box.upper.x) / 2, (box.lower.y + box.upper.y) / 2};
    return camera;
}

Vec2 Camera::to_screen(Position world) const
{
    const double x = (world.x - center.x) * points_per_meter;
    const double y = (world.y - center.y) * points_per_meter;
    const double mid_x = (viewport_min.x + viewport_max.x) * 0.5;
    const double mid_y = (viewport_min.y + viewport_max.y) * 0.5;
    return {static_cast<float>(mid_x + x), static_cast<float>(y_up ? mid_y - y : mid_y + y)};
}

Position Camera::to_world(Vec2 screen) const
{
    const double x = (screen.x - (viewport_min.x + viewport_max.x) * 0.5) / points_per_meter;
    const double y = (screen.y - (viewport_min.y + viewport_max.y) * 0.5) / points_per_meter;
    return {center.x + x, y_up ? center.y - y : center.y + y};
}

Box Camera::visible() const
{
    const Position a = to_world(viewport_min);
    const Position b = to_world(viewport_max);
    return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

void Camera::zoom_at(Vec2 screen_point, double factor)
{
    const Position fixed = to_world(screen_point);
    points_per_meter = std::clamp(points_per_meter * factor, 1e-3, 1e7);
    const Position moved = to_world(screen_point);
    center = {center.x + fixed.x - moved.x, center.y + fixed.y - moved.y};
}

void Camera::pan(Vec2 points)
{
    center.x -= points.x / points_per_meter;
    center.y += (y_up ? points.y : -points.y) / points_per_meter;
}

} // namespace carom::view
