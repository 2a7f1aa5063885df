#include "pinball/player/controls_panel.h"

#include <imgui.h>

#include <algorithm>

namespace carom::pinball {

void ControlsPanel::toggle()
{
    m_open = !m_open;
    m_waiting.reset();
}

void ControlsPanel::keep(const Controls& controls)
{
    const std::filesystem::path file = Controls::file_of_user();
    m_trouble = file.empty() ? "The keys cannot be kept: there is no folder for them." : controls.save(file);
}

bool ControlsPanel::handle(const SDL_Event& event, Controls& controls)
{
    if (!m_open)
        return false;
    const auto pressed = Controls::pressed(event);
    if (!m_waiting)
    {
        if (pressed == Control{Control::Kind::Key, SDL_SCANCODE_ESCAPE})
        {
            toggle();
            return true;
        }
        return false;
    }
    if (!pressed)
        return false;
    controls.bind(*m_waiting, *pressed);
    m_waiting.reset();
    keep(controls);
    return true;
}

void ControlsPanel::row(const Controls& controls, std::size_t action)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", Controls::actions()[action].meaning);
    ImGui::TableNextColumn();
    std::string keys;
    for (const Control control : controls.controls_of(action))
        keys += (keys.empty() ? "" : ", ") + label_of(control);
    ImGui::TextWrapped("%s", m_waiting == action ? "press a key or a button of the gamepad"
                             : keys.empty()      ? "none"
                                                 : keys.c_str());
    ImGui::TableNextColumn();
    ImGui::PushID(static_cast<int>(action));
    if (ImGui::SmallButton("add"))
        m_waiting = action;
    ImGui::PopID();
}

void ControlsPanel::draw(view::Window& window, Controls& controls)
{
    if (!m_open)
        return;
    const Vec2 size = window.size();
    const float width = std::min(520.0f, size.x - 20);
    ImGui::SetNextWindowBgAlpha(0.98f);
    ImGui::SetNextWindowPos({(size.x - width) / 2, 10});
    ImGui::SetNextWindowSize({width, std::min(760.0f, size.y - 20)});
    if (ImGui::Begin("Keys", &m_open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNav))
    {
        ImGui::TextWrapped("A gamepad's triggers are the flippers; its left stick nudges, and pulled back it holds the plunger.");
        if (ImGui::Button("all as they were"))
        {
            controls = Controls();
            keep(controls);
        }
        if (!m_trouble.empty())
            ImGui::TextWrapped("%s", m_trouble.c_str());
        if (ImGui::BeginTable("keys", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY))
        {
            ImGui::TableSetupColumn("action", ImGuiTableColumnFlags_WidthStretch, 1);
            ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthStretch, 1.3f);
            ImGui::TableSetupColumn("add", ImGuiTableColumnFlags_WidthFixed);
            for (std::size_t i = 0; i < Controls::actions().size(); ++i)
                row(controls, i);
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

} // namespace carom::pinball
