#include "pinball/table/checker.h"

#include "pinball/table/check_context.h"

#include <array>

namespace carom::pinball {

CheckContext::CheckContext(const Table& checked)
    : table(checked), obstacles(obstacles_of(checked)),
      outline(flatten(std::get<Wall>(checked.elements[checked.outline].part).path)),
      reach(checked, obstacles, outline, checked.ball.spawn), ball_radius(checked.ball.radius)
{}

void CheckContext::report(FindingKind kind, std::vector<Index> elements, Point where, std::string sentence)
{
    Finding finding{
        .kind = kind, .where = {static_cast<float>(where.x), static_cast<float>(where.y)}, .sentence = std::move(sentence)};
    for (const Index element : elements)
        finding.elements.push_back(id(element));
    findings.push_back(std::move(finding));
}

std::string_view name(FindingKind kind)
{
    constexpr std::array<std::string_view, 13> names = {
        "overlap",    "outside the table", "bad outline", "leak",    "no drain", "flipper stroke", "no room",
        "narrow gap", "resting place",     "unreachable", "plunger", "step",     "no flipper"};
    return names[static_cast<std::size_t>(kind)];
}

std::string to_string(const Finding& finding)
{
    std::string text(name(finding.kind));
    for (std::size_t i = 0; i < finding.elements.size(); ++i)
        text += (i == 0 ? " \"" : ", \"") + finding.elements[i] + "\"";
    return text + ": " + finding.sentence;
}

std::vector<Finding> check(const Table& table)
{
    CheckContext context(table);
    check_outlines(context);
    check_places(context);
    const bool ball_is_free = check_start(context);
    check_device_overlaps(context);
    check_flipper_strokes(context);
    check_travel(context);
    check_drains(context);
    check_flippers(context);
    if (ball_is_free)
    {
        check_leaks(context);
        check_reachable(context);
        check_narrow_gaps(context);
        check_resting_places(context);
        check_steps(context);
    }
    return std::move(context.findings);
}

} // namespace carom::pinball
