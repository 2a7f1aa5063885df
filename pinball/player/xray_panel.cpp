#include "pinball/player/xray_panel.h"

#include "view/body_story.h"
#include "view/impact_panel.h"
#include "view/shape_art.h"

#include <imgui.h>

#include <algorithm>

namespace carom::pinball {

namespace {

// In a lower window there is a tab for each subject.
constexpr float least_height = 700; // points

void key_help(const Controls& controls)
{
    float used = 0;
    for (const KeyLine& line : controls.xray_key_lines())
    {
        const float width = ImGui::CalcTextSize((line.keys + line.meaning).c_str()).x + 5;
        if (used > 0 && used + 11 + width <= ImGui::GetContentRegionAvail().x)
            ImGui::SameLine(0, 11);
        else
            used = 0;
        used += (used > 0 ? 11 : 0) + width;
        ImGui::TextUnformatted(line.keys.c_str());
        ImGui::SameLine(0, 5);
        ImGui::TextDisabled("%s", line.meaning.c_str());
    }
}

void time_line(const Machine& machine, const Status& status)
{
    const double time =
        static_cast<double>(machine.game().step_count()) * static_cast<double>(machine.game().table().physics.step);
    const char* how = status.paused      ? "paused"
                      : status.speed < 1 ? "slow motion"
                      : status.speed > 1 ? "fast motion"
                                         : "real time";
    ImGui::Text("%.3f s, %s", time, how);
    const StepReport& report = machine.game().scene().report();
    ImGui::TextWrapped("pairs %d, touching %d, impacts %d, %.0f us a step", report.pairs, report.touching,
                       report.flight_impacts + report.bulk_impacts, static_cast<double>(report.ms.total) * 1000);
}

void within_step(Machine& machine, const Status& status)
{
    if (status.paused)
        machine.scrubber.widgets();
    else
        ImGui::TextWrapped("%s stops the game; then look into its last step with %s and %s",
                           machine.controls.label(Wish::Pause).c_str(), machine.controls.label(Wish::SubstepBack).c_str(),
                           machine.controls.label(Wish::SubstepForth).c_str());
}

} // namespace

void XrayPanel::draw(view::Canvas& table, const Machine& machine, bool paused)
{
    m_overlay.draw(table, machine.game().scene());
    if (paused)
        machine.scrubber.draw(table, machine.game().scene());
    if (machine.impacts.last())
        view::draw_impact(table, *machine.impacts.last(), m_unit);
    const Scene& scene = machine.game().scene();
    if (scene.is_valid(machine.selected))
        view::draw_ghost(table, scene, machine.selected, scene.body(machine.selected).pose(), {view::rgb(0xffe066), 3});
}

namespace {

void selected_widgets(view::Window& window, const Machine& machine, float unit)
{
    const Scene& scene = machine.game().scene();
    if (!scene.is_valid(machine.selected))
        return ImGui::TextWrapped("Click a thing on the table: it tells its story.");
    view::story_widgets(window.fonts(),
                        view::body_story(scene, machine.selected, machine.game().table().physics.step, machine.namer()), unit);
}

} // namespace

void XrayPanel::wide(view::Window& window, Machine& machine, const Status& status)
{
    key_help(machine.controls);
    time_line(machine, status);
    ImGui::Separator();
    m_overlay.widgets();
    ImGui::Separator();
    within_step(machine, status);
    ImGui::Separator();
    selected_widgets(window, machine, m_unit);
    ImGui::Separator();
    view::impact_widgets(window.fonts(), machine.impacts.last(), m_unit);
}

void XrayPanel::narrow(view::Window& window, Machine& machine, const Status& status)
{
    const auto tab = [](const char* name, const auto& content)
    {
        if (!ImGui::BeginTabItem(name))
            return;
        ImGui::BeginChild(name);
        content();
        ImGui::EndChild();
        ImGui::EndTabItem();
    };
    if (!ImGui::BeginTabBar("tabs"))
        return;
    tab("Impact", [&] { view::impact_widgets(window.fonts(), machine.impacts.last(), m_unit); });
    tab("Selected", [&] { selected_widgets(window, machine, m_unit); });
    tab("Step",
        [&]
        {
            time_line(machine, status);
            within_step(machine, status);
            for (const KeyLine& line : machine.controls.xray_key_lines())
                ImGui::Text("%-5s %s", line.keys.c_str(), line.meaning.c_str());
        });
    tab("Show", [&] { m_overlay.widgets(); });
    ImGui::EndTabBar();
}

void XrayPanel::widgets(view::Window& window, const Layout& layout, Machine& machine, const Status& status)
{
    const Vec2 size = layout.side.size();
    ImGui::SetNextWindowPos({layout.side.min.x, layout.side.min.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    // Letters grow with the window.
    m_unit = std::clamp(std::min(size.x / 380, size.y / 760), 0.85f, 3.0f);
    ImGui::PushFont(window.fonts().get(view::Face::Sans, 14 * m_unit).font);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {6 * m_unit, 3 * m_unit});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {7 * m_unit, 5 * m_unit});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::Begin("x-ray", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar();
    if (layout.landscape && size.y >= least_height)
        wide(window, machine, status);
    else
        narrow(window, machine, status);
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopFont();
}

} // namespace carom::pinball
