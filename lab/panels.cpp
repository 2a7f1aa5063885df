#include "lab/panels.h"

#include "lab/stage_plot.h"
#include "view/body_story.h"
#include "view/impact_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace carom::lab {
namespace {

constexpr float side_width = 264;
constexpr float story_width = 340;

bool is_narrow(Vec2 window) { return window.x < 900; }

ImGuiWindowFlags fixed()
{
    return ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse;
}

void begin_at(const char* name, Vec2 at, Vec2 size)
{
    ImGui::SetNextWindowPos({at.x, at.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::Begin(name, nullptr, fixed());
    ImGui::PopStyleVar();
}

// In its name or in what is said of it.
bool is_found(const scenes::SceneEntry& entry, const std::string& search)
{
    const auto has = [&](std::string_view text)
    {
        const auto same = [](char a, char b)
        { return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)); };
        return std::search(text.begin(), text.end(), search.begin(), search.end(), same) != text.end();
    };
    return search.empty() || has(entry.name) || has(entry.description);
}

void scene_list(Run& run, LabState& state)
{
    std::array<char, 40> text{};
    state.search.copy(text.data(), text.size() - 1);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("###search", "type to find a scene", text.data(), text.size()))
        state.search = text.data();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 4});
    for (const scenes::SceneEntry& entry : scenes::all_scenes())
    {
        if (!is_found(entry, state.search))
            continue;
        const bool chosen = &entry == &run.entry();
        if (ImGui::Selectable(std::string(entry.name).c_str(), chosen))
            state.wanted = &entry;
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", std::string(entry.description).c_str());
    }
    ImGui::PopStyleVar();
}

void time_controls(Run& run, LabState& state)
{
    if (ImGui::Button(run.paused ? "Play" : "Pause", {72, 0}))
        run.paused = !run.paused;
    ImGui::SameLine();
    if (ImGui::Button("Step", {72, 0}))
    {
        run.paused = true;
        run.step();
    }
    ImGui::SameLine();
    if (ImGui::Button("Restart", {72, 0}))
        state.wanted = &run.entry();
    auto speed = static_cast<float>(run.speed);
    ImGui::SetNextItemWidth(90);
    if (ImGui::SliderFloat("speed", &speed, 0.01f, 2, "%.2f", ImGuiSliderFlags_Logarithmic))
        run.speed = static_cast<double>(speed);
    ImGui::SameLine(168);
    ImGui::Checkbox("x-ray", &state.xray);
}

// They hold from the next start, so that a scene stays the same from its first step on.
void world_controls(LabState& state)
{
    ImGui::SetNextItemWidth(160);
    ImGui::SliderInt("sub-steps", &state.base.substeps, 1, 16);
    ImGui::Checkbox("sleeping", &state.base.sleeping);
    ImGui::SameLine();
    ImGui::Checkbox("continuous", &state.base.continuous);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Off: fast balls pass through thin walls. Try it with \"bullet\".\nHolds from the next restart.");
}

template <class Change>
void slider_of(const char* name, float value, float low, float high, const char* format, const Change& change)
{
    ImGui::SetNextItemWidth(150);
    if (ImGui::SliderFloat(name, &value, low, high, format, ImGuiSliderFlags_AlwaysClamp))
        change(value);
}

// The material of all of a body's shapes, its density, and the springs that hold it.
void selected_controls(Scene& scene, BodyId id)
{
    Vec2 gravity = scene.gravity();
    slider_of("gravity, m/s²", -gravity.y, -20, 20, "%.1f", [&](float g) { scene.set_gravity({gravity.x, -g}); });
    const Body body = scene.body(id);
    const std::vector<ShapeId> shapes = body.shapes();
    if (shapes.empty())
        return;
    const auto for_all = [&](const auto& change)
    {
        for (const ShapeId shape : shapes)
        {
            ShapeDef def = scene.shape(shape).def();
            change(def);
            scene.shape(shape).set_def(def);
        }
    };
    const ShapeDef first = scene.shape(shapes.front()).def();
    slider_of("bounciness e", first.restitution, 0, 1, "%.2f",
              [&](float e) { for_all([&](ShapeDef& d) { d.restitution = e; }); });
    slider_of("friction", first.friction, 0, 2, "%.2f", [&](float mu) { for_all([&](ShapeDef& d) { d.friction = mu; }); });
    if (body.type() == BodyType::Dynamic)
        slider_of("density, kg/m²", first.density, 0.05f, 20, "%.2f",
                  [&](float rho) { for_all([&](ShapeDef& d) { d.density = rho; }); });
    for (const JointId joint : body.joints())
    {
        const JointDef def = scene.joint(joint).def();
        if (const auto* spring = std::get_if<SpringDef>(&def))
        {
            ImGui::PushID(static_cast<int>(joint.slot));
            slider_of("stiffness, N/m", spring->stiffness, 0, 5000, "%.0f",
                      [&](float k)
                      {
                          SpringDef changed = *spring;
                          changed.stiffness = k;
                          scene.joint(joint).set_def(changed);
                      });
            ImGui::PopID();
        }
    }
}

void selected_panel(view::Window& window, Run& run, LabState& state)
{
    if (!run.scene().is_valid(state.selected))
    {
        ImGui::TextWrapped("Click a thing: it tells who pushes it, and why it moves or does not.");
        return;
    }
    selected_controls(run.scene(), state.selected);
    ImGui::Separator();
    view::story_widgets(window.fonts(), view::body_story(run.scene(), state.selected, run.entry().h));
}

void number_row(const char* name, const std::string& value)
{
    ImGui::TextUnformatted(name);
    ImGui::SameLine(135);
    ImGui::TextUnformatted(value.c_str());
}

void numbers(const Run& run)
{
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 2});
    const StepReport& r = run.scene().report();
    const auto n = [](int value) { return std::to_string(value); };
    number_row("time", view::number(static_cast<float>(run.scene().time())) + " s");
    number_row("steps", std::to_string(run.scene().step_count()));
    number_row("bodies", n(r.bodies) + ", awake " + n(r.awake_bodies));
    number_row("shapes, joints", n(r.shapes) + ", " + n(r.joints));
    number_row("pairs, touching", n(r.pairs) + ", " + n(r.touching));
    number_row("islands, colors", n(r.islands) + ", " + n(r.colors));
    number_row("in flight", n(r.flight_bodies) + ", impacts " + n(r.flight_impacts));
    number_row("bulk impacts", n(r.bulk_impacts));
    if (r.flags != 0)
        ImGui::TextColored({1, 0.6f, 0.4f, 1}, "step flags: %u", r.flags);
    stage_plot(run.history());
    ImGui::PopStyleVar();
}

void xray_panel(Run& run, LabState& state)
{
    state.overlay.widgets();
    ImGui::Separator();
    ImGui::TextUnformatted("within the last step");
    if (run.paused)
        run.scrubber.widgets();
    else
        ImGui::TextDisabled("pause to look into it");
}

// `flags` are ImGuiTabItemFlags.
void tab(const char* name, const auto& content, int flags = 0)
{
    if (!ImGui::BeginTabItem(name, nullptr, flags))
        return;
    ImGui::BeginChild(name);
    content();
    ImGui::EndChild();
    ImGui::EndTabItem();
}

// The tab of a thing comes to the front when that is clicked.
void story_tabs(view::Window& window, Run& run, LabState& state)
{
    const bool is_new = state.selected != std::exchange(state.told, state.selected) && run.scene().is_valid(state.selected);
    tab("Impact", [&] { view::impact_widgets(window.fonts(), run.impacts.last()); });
    tab("Selected", [&] { selected_panel(window, run, state); }, is_new ? ImGuiTabItemFlags_SetSelected : 0);
    tab("X-ray", [&] { xray_panel(run, state); });
}

void knowledge_panel(view::Window& window, Run& run, LabState& state)
{
    const Vec2 size = window.size();
    begin_at("knowledge", {size.x - story_width, 0}, {story_width, size.y});
    if (ImGui::BeginTabBar("stories"))
    {
        story_tabs(window, run, state);
        ImGui::EndTabBar();
    }
    ImGui::End();
}

void wide_panels(view::Window& window, Run& run, LabState& state)
{
    const Vec2 size = window.size();
    begin_at("control", {0, 0}, {side_width, size.y});
    time_controls(run, state);
    if (ImGui::BeginTabBar("tabs"))
    {
        tab("Scenes", [&] { scene_list(run, state); });
        tab("Numbers", [&] { numbers(run); });
        tab("World", [&] { world_controls(state); });
        ImGui::EndTabBar();
    }
    ImGui::End();

    if (state.xray)
        knowledge_panel(window, run, state);
}

void narrow_panels(view::Window& window, Run& run, LabState& state)
{
    const Vec2 size = window.size();
    const float top = picture_area(size, state.xray).max.y;
    begin_at("tabs", {0, top}, {size.x, size.y - top});
    time_controls(run, state);
    if (ImGui::BeginTabBar("tabs"))
    {
        tab("Scenes", [&] { scene_list(run, state); });
        story_tabs(window, run, state);
        tab("Numbers", [&] { numbers(run); });
        tab("World", [&] { world_controls(state); });
        ImGui::EndTabBar();
    }
    ImGui::End();
}

} // namespace

Viewport picture_area(Vec2 window, bool xray)
{
    if (is_narrow(window))
        return {{0, 0}, {window.x, std::max(window.y * 0.55f, 100.0f)}};
    return {{side_width, 0}, {window.x - (xray ? story_width : 0), window.y}};
}

void draw_panels(view::Window& window, Run& run, LabState& state)
{
    if (is_narrow(window.size()))
        narrow_panels(window, run, state);
    else
        wide_panels(window, run, state);
}

} // namespace carom::lab
