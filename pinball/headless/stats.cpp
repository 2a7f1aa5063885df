#include "pinball/headless/stats.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

namespace carom::pinball {

namespace {

constexpr float speed_bin = 0.01f; // m/s
constexpr std::size_t speed_bins = 2000;

bool counts(const Table& table, const GameEvent& event)
{
    using enum EventKind;
    if (event.element == none)
        return false;
    if (event.kind == Impact)
        return std::holds_alternative<CaptiveBall>(table.elements[event.element].part);
    return event.kind == Fired || event.kind == Hit || event.kind == Fell || event.kind == Spun || event.kind == Passed ||
           event.kind == Entered || event.kind == Captured || event.kind == Drained || event.kind == FlipperStop ||
           event.kind == PlungerReleased;
}

constexpr std::pair<EventKind, const char*> rule_events[] = {
    {EventKind::BallSaved, "ball_saved"},       {EventKind::GroupCompleted, "group_completed"},
    {EventKind::LetterLit, "letter_lit"},       {EventKind::LevelUp, "level_up"},
    {EventKind::SkillShot, "skill_shot"},       {EventKind::Combo, "combo"},
    {EventKind::MultiballStarted, "multiball"}, {EventKind::Jackpot, "jackpot"},
};

bool can_be_hit(const Part& part)
{
    return !std::holds_alternative<Wall>(part) && !std::holds_alternative<Solid>(part) && !std::holds_alternative<Post>(part) &&
           !std::holds_alternative<Plane>(part) && !std::holds_alternative<Light>(part);
}

std::string hex(std::uint64_t value)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

double mean(const auto& values)
{
    return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double at_share(std::vector<double> values, double share)
{
    if (values.empty())
        return 0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

} // namespace

Stats::Stats(const Table& table)
    : m_table(&table), m_step(table.physics.step), m_hits(table.elements.size()), m_speeds(speed_bins)
{}

void Stats::note_step(double microseconds, int free_balls)
{
    for (StepTimes* times : {&m_step_times, &m_times_by_balls[free_balls]})
    {
        ++times->steps;
        times->microseconds += microseconds;
    }
    m_longest_step = std::max(m_longest_step, microseconds);
}

void Stats::note_speed(float speed)
{
    const auto bin = static_cast<std::size_t>(std::min(speed / speed_bin, static_cast<float>(speed_bins - 1)));
    ++m_speeds[bin];
    m_max_speed = std::max(m_max_speed, speed);
    m_speed_sum += static_cast<double>(speed);
    ++m_speed_count;
}

void Stats::note_event(const GameEvent& event)
{
    if (counts(*m_table, event))
        ++m_hits[event.element];
    ++m_events[event.kind];
}

void Stats::note_launch(int serial, std::int64_t step) { m_launched.try_emplace(serial, step); }

void Stats::note_drain(int serial, std::int64_t step, std::uint64_t hash)
{
    const auto launched = m_launched.find(serial);
    const std::int64_t since = launched == m_launched.end() ? step : launched->second;
    m_times.push_back(static_cast<double>(step - since) * static_cast<double>(m_step));
    m_launched.erase(serial);
    m_hash.add(hash);
}

void Stats::note_lost(LostBall lost)
{
    lost.ball = balls() + 1;
    m_lost.push_back(std::move(lost));
}

void Stats::new_session() { m_launched.clear(); }

int Stats::lost(std::string_view how) const
{
    return static_cast<int>(std::ranges::count_if(m_lost, [how](const LostBall& ball) { return ball.how == how; }));
}

double Stats::mean_ball_time() const { return mean(m_times); }

double Stats::speed_below(double share) const
{
    const double wanted = share * static_cast<double>(m_speed_count);
    double seen = 0;
    for (std::size_t bin = 0; bin < m_speeds.size(); ++bin)
    {
        seen += static_cast<double>(m_speeds[bin]);
        if (seen >= wanted)
            return static_cast<double>(bin + 1) * static_cast<double>(speed_bin);
    }
    return static_cast<double>(m_max_speed);
}

std::string Stats::to_json(const std::string& table, std::uint64_t seed) const
{
    nlohmann::ordered_json json;
    json["table"] = table;
    json["seed"] = seed;
    json["balls"] = balls();
    json["escaped"] = escaped();
    json["stuck"] = stuck();
    json["endless"] = lost("endless");
    json["captive_out"] = lost("captive out");
    json["mean_ball_time_s"] = mean_ball_time();
    json["median_ball_time_s"] = at_share(m_times, 0.5);
    json["p10_ball_time_s"] = at_share(m_times, 0.1);
    json["p90_ball_time_s"] = at_share(m_times, 0.9);
    json["mean_speed_mps"] = m_speed_count == 0 ? 0.0 : m_speed_sum / static_cast<double>(m_speed_count);
    json["p99_speed_mps"] = speed_below(0.99);
    json["max_speed_mps"] = static_cast<double>(m_max_speed);
    json["steps"] = m_step_times.steps;
    json["mean_step_us"] = mean_step_us();
    json["longest_step_us"] = m_longest_step;
    for (const auto& [balls, times] : m_times_by_balls)
        json["step_us_by_free_balls"][std::to_string(balls)] = {{"steps", times.steps}, {"mean_us", times.mean()}};
    json["games"] = m_scores.size();
    json["mean_score"] = mean(m_scores);
    json["hits"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < m_hits.size(); ++i)
        if (can_be_hit(m_table->elements[i].part))
            json["hits"][m_table->elements[i].id] = m_hits[i];
    for (const auto& [kind, name] : rule_events)
        json["rules"][name] = m_events.contains(kind) ? m_events.at(kind) : 0;
    json["lost"] = nlohmann::ordered_json::array();
    for (const LostBall& ball : m_lost)
        json["lost"].push_back({{"how", ball.how},
                                {"ball", ball.ball},
                                {"step", ball.step},
                                {"position", {ball.position.x, ball.position.y}},
                                {"velocity", {ball.velocity.x, ball.velocity.y}}});
    json["final_hash"] = hex(m_hash.value());
    return json.dump(2) + "\n";
}

} // namespace carom::pinball
