#pragma once

/// @file
/// The mouse in the world: drag things by a spring, move and zoom the picture, shoot rays.

#include "carom/scene.h"
#include "view/canvas.h"

#include <SDL_events.h>

#include <optional>

namespace carom::lab {

class Hand
{
public:
    /// Left button: drag a body, or the picture where there is none. Right: a ray from where it was pressed.
    /// Wheel: zoom. True if the camera was changed.
    bool handle(const SDL_Event& event, Scene& scene, view::Camera& camera);
    /// Moves the spring's end with the mouse; call in each frame.
    void follow(Scene& scene, const view::Camera& camera);
    void draw(view::Canvas& canvas, const Scene& scene) const;
    /// Lets go without touching the scene: it is being replaced.
    void forget();

private:
    bool press(const SDL_MouseButtonEvent& event, Scene& scene, const view::Camera& camera);
    bool move(const SDL_MouseMotionEvent& event, view::Camera& camera);
    void release(const SDL_MouseButtonEvent& event, Scene& scene);
    void grab(Scene& scene, BodyId body, Position at);
    [[nodiscard]] std::optional<BodyId> find(const Scene& scene, Position at, float reach) const;

    Vec2 m_mouse{};
    JointId m_spring{};
    std::optional<Position> m_ray_start;
    bool m_panning = false;
};

} // namespace carom::lab
