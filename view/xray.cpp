#include "view/xray.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace carom::view {

Color role_color(DrawRole role)
{
    switch (role)
    {
    case DrawRole::StaticShape: return rgb(0x7f90ad);
    case DrawRole::KinematicShape: return rgb(0x63e6be);
    case DrawRole::AwakeShape: return rgb(0xffffff);
    case DrawRole::SleepingShape: return rgb(0x5c6f96);
    case DrawRole::DisabledShape: return rgb(0x6b4b4b);
    case DrawRole::Trigger: return rgb(0xf783ac);
    case DrawRole::Joint: return rgb(0x91a7ff);
    case DrawRole::Box: return rgb(0x3b8f6a);
    case DrawRole::Contact: return rgb(0xff6b6b);
    case DrawRole::ContactNormal: return rgb(0xffa8a8);
    case DrawRole::Impulse: return rgb(0xffd43b);
    case DrawRole::Friction: return rgb(0xe599f7);
    case DrawRole::Velocity: return rgb(0x69db7c);
    case DrawRole::CenterOfMass: return rgb(0x66d9e8);
    case DrawRole::Island: return rgb(0xb197fc);
    }
    return {};
}

namespace {

Pen role_pen(DrawRole role, float width = 1.25f) { return {role_color(role), width}; }

float strongest_impulse(const std::vector<ContactInfo>& contacts)
{
    float strongest = 0;
    for (const ContactInfo& contact : contacts)
        for (int i = 0; i < contact.point_count; ++i)
            strongest = std::max(strongest, contact.points[i].normal_impulse);
    return strongest;
}

} // namespace

DebugDrawOptions XrayOverlay::options(const Canvas& canvas, const Scene& scene)
{
    // The scale follows the strongest impulse and forgets it slowly: arrows neither fill the screen nor vanish.
    const std::vector<ContactInfo> contacts = scene.contacts();
    m_strongest = std::max(strongest_impulse(contacts), m_strongest * 0.98f);
    // In a crowd, smaller dots: the picture below must show through.
    m_dot = contacts.size() > 120 ? 1.8f : 3;
    return {.shapes = toggles.outlines,
            .joints = toggles.joints,
            .triggers = toggles.triggers,
            .boxes = toggles.boxes,
            .contacts = toggles.contacts,
            .normals = toggles.normals,
            .impulses = toggles.impulses,
            .friction = toggles.friction,
            .velocities = toggles.velocities,
            .centers = toggles.centers,
            .islands = toggles.islands,
            .impulse_scale = canvas.camera().meters(toggles.impulse_points) / std::max(m_strongest, 1e-9f),
            .velocity_scale = toggles.velocity_time,
            .view = canvas.camera().visible()};
}

void XrayOverlay::draw(Canvas& canvas, const Scene& scene)
{
    m_canvas = &canvas;
    scene.debug_draw(*this, options(canvas, scene));
    m_canvas = nullptr;
}

void XrayOverlay::outline(DrawRole role, Path path)
{
    if (path.empty())
        return;
    if (role != DrawRole::Trigger)
        return m_canvas->polyline(path, role_pen(role), true);
    path.push_back(path.front());
    m_canvas->dashed(path, role_pen(role, 1.5f));
}

void XrayOverlay::circle(DrawRole role, Position center, float radius, Rotation rotation)
{
    Path path;
    append_arc(path, center, radius, 0, 2 * pi, m_canvas->tolerance());
    path.pop_back();
    outline(role, std::move(path));
    if (role != DrawRole::Trigger)
        m_canvas->line(center, center + rotate(rotation, {radius, 0}), role_pen(role));
}

void XrayOverlay::capsule(DrawRole role, Position a, Position b, float radius_a, float radius_b)
{
    if (radius_a <= 0 && radius_b <= 0)
        return m_canvas->line(a, b, role_pen(role));
    outline(role, capsule_outline(a, b, radius_a, radius_b, m_canvas->tolerance()));
}

void XrayOverlay::polygon(DrawRole role, std::span<const Position> vertices, float radius)
{
    outline(role, rounded_outline(vertices, radius, m_canvas->tolerance()));
}

void XrayOverlay::arc(DrawRole role, Position center, float radius, float start_angle, float sweep, float half_thickness)
{
    if (half_thickness <= 0)
        return m_canvas->arc(center, radius, start_angle, sweep, role_pen(role));
    Path band;
    append_arc(band, center, radius + half_thickness, start_angle, sweep, m_canvas->tolerance());
    const float turn = sweep > 0 ? pi : -pi;
    const auto end_at = [&](float angle) { return center + Vec2{radius * std::cos(angle), radius * std::sin(angle)}; };
    append_arc(band, end_at(start_angle + sweep), half_thickness, start_angle + sweep, turn, m_canvas->tolerance());
    append_arc(band, center, radius - half_thickness, start_angle + sweep, -sweep, m_canvas->tolerance());
    append_arc(band, end_at(start_angle), half_thickness, start_angle + turn, turn, m_canvas->tolerance());
    outline(role, std::move(band));
}

void XrayOverlay::line(DrawRole role, Position a, Position b)
{
    const bool arrow = role == DrawRole::Velocity || role == DrawRole::Impulse || role == DrawRole::Friction;
    if (arrow)
        m_canvas->arrow(a, b, role_pen(role, 2), 8);
    else if (role == DrawRole::ContactNormal)
        m_canvas->line(a, b, role_pen(role, 1.5f));
    else
        m_canvas->line(a, b, role_pen(role));
}

void XrayOverlay::point(DrawRole role, Position p)
{
    const float pixel = m_canvas->camera().meters(1);
    m_canvas->fill_circle(p, (m_dot + 1) * pixel, rgb(0x000000, 0.6f));
    m_canvas->fill_circle(p, m_dot * pixel, role_color(role));
}

void XrayOverlay::text(DrawRole role, Position p, std::string_view utf8)
{
    m_canvas->text(p, utf8, {.size = 12, .color = role_color(role), .shadow = rgb(0x000000, 0.8f)});
}

// ---- widgets --------------------------------------------------------------------------------------------------------------

namespace {

void toggle(const char* label, bool& value, DrawRole role, const char* help)
{
    const Color c = role_color(role);
    const float side = ImGui::GetFrameHeight() * 0.55f;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float shift = (ImGui::GetFrameHeight() - side) / 2;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + shift}, {at.x + side, at.y + shift + side},
                                              pack(fade(c, value ? 1 : 0.35f)), 3);
    ImGui::Dummy({side, side});
    ImGui::SameLine();
    ImGui::Checkbox(label, &value);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", help);
}

} // namespace

void XrayOverlay::widgets()
{
    struct Row
    {
        const char* label;
        bool XrayToggles::* value;
        DrawRole role;
        const char* help;
    };
    static constexpr Row rows[] = {
        {"outlines", &XrayToggles::outlines, DrawRole::AwakeShape,
         "Shapes as the engine sees them. Sleeping bodies are pale:\nthey rest and cost nothing until something touches them."},
        {"velocities", &XrayToggles::velocities, DrawRole::Velocity, "The way a body goes in the time below."},
        {"contacts", &XrayToggles::contacts, DrawRole::Contact, "Where two shapes touch."},
        {"normals", &XrayToggles::normals, DrawRole::ContactNormal, "The direction in which two shapes push each other."},
        {"impulses", &XrayToggles::impulses, DrawRole::Impulse, "How hard they pushed in the last step: force times time."},
        {"friction", &XrayToggles::friction, DrawRole::Friction, "The part of the push along the surface."},
        {"triggers", &XrayToggles::triggers, DrawRole::Trigger, "Areas that report who is inside and stop nobody."},
        {"joints", &XrayToggles::joints, DrawRole::Joint, "Springs, ropes, hinges and sliders."},
        {"boxes", &XrayToggles::boxes, DrawRole::Box, "Only shapes whose boxes overlap are looked at more closely."},
        {"centers", &XrayToggles::centers, DrawRole::CenterOfMass,
         "Centers of mass: a body moves as if all its mass were there."},
        {"islands", &XrayToggles::islands, DrawRole::Island, "Bodies that must be solved together because they touch."},
    };
    const float column = ImGui::GetContentRegionAvail().x / 2;
    int shown = 0;
    for (const Row& row : rows)
    {
        if (shown++ % 2 != 0)
            ImGui::SameLine(column + ImGui::GetStyle().WindowPadding.x);
        toggle(row.label, toggles.*row.value, row.role, row.help);
    }
    ImGui::SetNextItemWidth(column - 20);
    ImGui::SliderFloat("velocity time", &toggles.velocity_time, 0.005f, 1, "%.3f s", ImGuiSliderFlags_Logarithmic);
    ImGui::SetNextItemWidth(column - 20);
    ImGui::SliderFloat("impulse arrow", &toggles.impulse_points, 10, 200, "%.0f px");
}

} // namespace carom::view
