#include "lab/stage_plot.h"

#include "view/color.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

namespace carom::lab {
namespace {

struct Stage
{
    const char* name;
    float StageTimes::* value;
    view::Color color;
};

constexpr Stage stages[] = {
    {"sweep", &StageTimes::sweep, view::rgb(0x4dabf7)},       {"pairs", &StageTimes::pairs, view::rgb(0x63e6be)},
    {"contacts", &StageTimes::contacts, view::rgb(0xffd43b)}, {"islands", &StageTimes::islands, view::rgb(0xffa94d)},
    {"solve", &StageTimes::solve, view::rgb(0xff6b6b)},       {"commit", &StageTimes::commit, view::rgb(0xda77f2)},
    {"events", &StageTimes::events, view::rgb(0x868e96)},
};

// Twice the median: a few slow steps (the first, or another program's turn) do not flatten the rest.
float scale_of(const std::deque<StageTimes>& history)
{
    std::vector<float> totals;
    for (const StageTimes& t : history)
        totals.push_back(t.total);
    std::ranges::sort(totals);
    return totals.empty() ? 1 : std::max(totals[totals.size() / 2] * 2, 1e-3f);
}

void column(ImDrawList& list, const StageTimes& times, ImVec2 foot, float width, float height, float scale)
{
    float y = foot.y;
    for (const Stage& stage : stages)
    {
        const float tall = times.*stage.value / scale * height;
        const float top = std::max(y - tall, foot.y - height);
        list.AddRectFilled({foot.x, top}, {foot.x + width, y}, view::pack(stage.color));
        y = top;
    }
}

void legend(const std::deque<StageTimes>& history)
{
    int shown = 0;
    for (const Stage& stage : stages)
    {
        double sum = 0;
        for (const StageTimes& t : history)
            sum += static_cast<double>(t.*stage.value);
        const double mean = history.empty() ? 0 : sum / static_cast<double>(history.size());
        const view::Color& c = stage.color;
        const float half = ImGui::GetWindowContentRegionMax().x / 2;
        const float left = shown++ % 2 == 0 ? ImGui::GetStyle().WindowPadding.x : half + 4;
        if (left > half)
            ImGui::SameLine(left);
        ImGui::TextColored({c.r, c.g, c.b, 1}, "%s", stage.name);
        ImGui::SameLine(left + 68);
        ImGui::TextColored({c.r, c.g, c.b, 1}, "%.3f", mean);
    }
}

} // namespace

void stage_plot(const std::deque<StageTimes>& history)
{
    ImGui::TextDisabled("mean ms; plot up to %.2f ms", static_cast<double>(scale_of(history)));
    const float width = ImGui::GetContentRegionAvail().x;
    constexpr float height = 70;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float scale = scale_of(history);
    list.AddRectFilled(at, {at.x + width, at.y + height}, view::pack(view::rgb(0x0b0f16)), 3);
    const float wide = width / 240;
    float x = at.x + width - wide * static_cast<float>(history.size());
    for (const StageTimes& times : history)
    {
        column(list, times, {x, at.y + height}, wide + 0.1f, height, scale);
        x += wide;
    }
    ImGui::Dummy({width, height});
    legend(history);
}

} // namespace carom::lab
