#include "view/substep_scrubber.h"

#include "view/shape_art.h"

#include <imgui.h>

#include <algorithm>

namespace carom::view {

void SubstepScrubber::clear()
{
    m_times.clear();
    m_poses.clear();
    m_hits.clear();
    m_selected = 0;
}

void SubstepScrubber::capture(const Scene& scene)
{
    clear();
    const std::vector<SubstepPose>& recorded = scene.report().substep_poses;
    if (recorded.empty())
        return;
    m_times.push_back(0);
    for (const SubstepPose& p : recorded)
        m_times.push_back(p.time);
    std::ranges::sort(m_times);
    m_times.erase(std::unique(m_times.begin(), m_times.end()), m_times.end());
    for (const SubstepPose& p : recorded)
    {
        if (!scene.is_valid(p.body))
            continue;
        auto& poses = m_poses[p.body];
        if (poses.empty())
            poses.assign(m_times.size(), scene.body(p.body).interpolated_pose(0));
        const auto index = static_cast<std::size_t>(std::ranges::lower_bound(m_times, p.time) - m_times.begin());
        // Also later ones: a body that fell asleep or was destroyed stays where it was last seen.
        std::fill(poses.begin() + static_cast<std::ptrdiff_t>(index), poses.end(), p.pose);
    }
    for (const ImpactEvent& e : scene.impacts())
        m_hits.push_back({e.time, e.point, e.normal, e.impulse});
    m_selected = substeps();
}

void SubstepScrubber::select(int index) { m_selected = std::clamp(index, 0, std::max(substeps(), 0)); }

std::optional<Pose> SubstepScrubber::pose(BodyId body) const
{
    const auto found = m_poses.find(body);
    if (found == m_poses.end())
        return std::nullopt;
    return found->second[static_cast<std::size_t>(m_selected)];
}

void SubstepScrubber::widgets()
{
    if (empty())
    {
        ImGui::TextWrapped("Nothing moved in the last step, or there was none yet.");
        return;
    }
    int index = m_selected;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderInt("##substep", &index, 0, substeps(), index == 0 ? "start of the step" : "sub-step %d"))
        select(index);
    const auto happened = std::ranges::count_if(m_hits, [&](const Hit& h) { return h.time <= time(); });
    ImGui::Text("%.3f ms of %.3f ms", static_cast<double>(time()) * 1e3, static_cast<double>(m_times.back()) * 1e3);
    ImGui::Text("impacts so far: %d of %d", static_cast<int>(happened), static_cast<int>(m_hits.size()));
}

void SubstepScrubber::draw(Canvas& canvas, const Scene& scene) const
{
    // At the end of the step the picture itself is what is seen.
    if (empty() || m_selected == substeps())
        return;
    const float pixel = canvas.camera().meters(1);
    for (const auto& [body, poses] : m_poses)
    {
        if (!scene.is_valid(body))
            continue;
        Path way;
        for (const Pose& p : poses)
            way.push_back(p.position);
        canvas.polyline(way, {rgb(0xffffff, 0.35f), 1});
        for (const Position p : way)
            canvas.fill_circle(p, 1.5f * pixel, rgb(0xffffff, 0.6f));
        draw_ghost(canvas, scene, body, poses[static_cast<std::size_t>(m_selected)], {rgb(0xffe066), 1.5f});
    }
    for (const Hit& hit : m_hits)
    {
        if (hit.time > time())
            continue;
        canvas.stroke_circle(hit.point, 6 * pixel, {rgb(0xff8787), 2});
        canvas.line(hit.point, hit.point + hit.normal * (18 * pixel), {rgb(0xff8787), 2});
    }
}

} // namespace carom::view
