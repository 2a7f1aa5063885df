#include "lab/hand.h"

#include "view/hand_spring.h"
#include "view/impact_story.h"

#include <algorithm>
#include <cmath>

namespace carom::lab {
namespace {

Vec2 mouse_at(int x, int y) { return {static_cast<float>(x), static_cast<float>(y)}; }

bool can_be_dragged(const Scene& scene, ShapeId shape)
{
    return scene.body(scene.shape(shape).body()).type() == BodyType::Dynamic;
}

} // namespace

bool Hand::handle(const SDL_Event& event, Scene& scene, view::Camera& camera)
{
    switch (event.type)
    {
    case SDL_MOUSEBUTTONDOWN: return press(event.button, scene, camera);
    case SDL_MOUSEMOTION: return move(event.motion, camera);
    case SDL_MOUSEBUTTONUP: release(event.button, scene); return false;
    case SDL_MOUSEWHEEL: camera.zoom_at(m_mouse, std::pow(1.15, static_cast<double>(event.wheel.preciseY))); return true;
    default: return false;
    }
}

bool Hand::press(const SDL_MouseButtonEvent& event, Scene& scene, const view::Camera& camera)
{
    m_mouse = mouse_at(event.x, event.y);
    const Position at = camera.to_world(m_mouse);
    if (event.button == SDL_BUTTON_RIGHT)
        m_ray_start = at;
    if (event.button != SDL_BUTTON_LEFT)
        return false;
    if (const auto body = find(scene, at, camera.meters(12)))
        grab(scene, *body, at);
    else
        m_panning = true;
    return false;
}

bool Hand::move(const SDL_MouseMotionEvent& event, view::Camera& camera)
{
    m_mouse = mouse_at(event.x, event.y);
    if (m_panning)
        camera.pan(mouse_at(event.xrel, event.yrel));
    return m_panning;
}

void Hand::release(const SDL_MouseButtonEvent& event, Scene& scene)
{
    if (event.button == SDL_BUTTON_RIGHT)
        m_ray_start.reset();
    if (event.button != SDL_BUTTON_LEFT)
        return;
    if (m_spring && scene.is_valid(m_spring))
        scene.destroy(m_spring);
    m_spring = {};
    m_panning = false;
}

std::optional<BodyId> Hand::find(const Scene& scene, Position at, float reach) const
{
    for (const ShapeId shape : scene.overlap_point(at))
        if (can_be_dragged(scene, shape))
            return scene.shape(shape).body();
    const auto near = scene.closest_point(at, reach);
    if (near && can_be_dragged(scene, near->shape))
        return scene.shape(near->shape).body();
    return std::nullopt;
}

void Hand::grab(Scene& scene, BodyId body, Position at)
{
    m_spring = view::pull_by_hand(scene, body, scene.body(body).local_point(at), at);
}

void Hand::follow(Scene& scene, const view::Camera& camera)
{
    if (m_spring && scene.is_valid(m_spring))
        view::move_hand(scene, m_spring, camera.to_world(m_mouse));
}

void Hand::draw(view::Canvas& canvas, const Scene& scene) const
{
    if (!m_ray_start)
        return;
    const Position end = canvas.camera().to_world(m_mouse);
    const Vec2 way = end - *m_ray_start;
    if (length(way) <= 0)
        return;
    const auto hit = scene.raycast_closest(*m_ray_start, way);
    canvas.line(*m_ray_start, hit ? hit->point : end, {view::rgb(0x99e9f2), 1.5f});
    if (!hit)
        return;
    const float pixel = canvas.camera().meters(1);
    canvas.fill_circle(hit->point, 3 * pixel, view::rgb(0x99e9f2));
    canvas.arrow(hit->point, hit->point + hit->normal * (30 * pixel), {view::rgb(0xffec99), 1.5f});
    canvas.text(hit->point + hit->normal * (42 * pixel), view::number(hit->fraction * length(way)) + " m",
                {.size = 13, .color = view::rgb(0xffec99), .align_x = 0.5f, .align_y = 0.5f, .shadow = view::rgb(0, 0.8f)});
}

void Hand::forget() { *this = Hand{}; }

} // namespace carom::lab
