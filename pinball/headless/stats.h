#pragma once

/// @file
/// The counts of a headless run.

#include "pinball/elements/hash.h"
#include "pinball/game/game.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace carom::pinball {

struct LostBall
{
    std::string how{};
    int ball = 0; ///< of the run, from 1
    std::int64_t step = 0;
    Position position{};
    Vec2 velocity{};
};

struct StepTimes
{
    std::int64_t steps = 0;
    double microseconds = 0;
    [[nodiscard]] double mean() const { return steps == 0 ? 0.0 : microseconds / static_cast<double>(steps); }
};

class Stats
{
public:
    explicit Stats(const Table& table);

    void note_step(double microseconds, int free_balls);
    void note_speed(float speed); ///< of a free ball in play
    void note_event(const GameEvent& event);
    void note_launch(int serial, std::int64_t step);
    void note_drain(int serial, std::int64_t step, std::uint64_t hash);
    void note_lost(LostBall lost);
    void note_score(std::int64_t score) { m_scores.push_back(score); }
    void new_session();
    void finish(std::uint64_t hash) { m_hash.add(hash); }

    [[nodiscard]] int balls() const { return static_cast<int>(m_times.size() + m_lost.size()); }
    [[nodiscard]] int escaped() const { return lost("escaped"); }
    [[nodiscard]] int stuck() const { return lost("stuck"); }
    [[nodiscard]] double mean_ball_time() const;
    [[nodiscard]] double mean_step_us() const { return m_step_times.mean(); }
    /// JSON, keys in a fixed order.
    [[nodiscard]] std::string to_json(const std::string& table, std::uint64_t seed) const;

private:
    [[nodiscard]] int lost(std::string_view how) const;
    [[nodiscard]] double speed_below(double share) const;

    const Table* m_table;
    float m_step;
    StepTimes m_step_times{};
    double m_longest_step = 0;
    std::map<int, StepTimes> m_times_by_balls{};
    std::map<int, std::int64_t> m_launched{};
    std::vector<double> m_times{}; ///< s from launch to drain
    std::vector<LostBall> m_lost{};
    std::vector<std::int64_t> m_scores{};
    std::vector<std::int64_t> m_hits;
    std::map<EventKind, std::int64_t> m_events{};
    std::vector<std::int64_t> m_speeds; ///< histogram
    float m_max_speed = 0;
    double m_speed_sum = 0;
    std::int64_t m_speed_count = 0;
    Hash m_hash{};
};

} // namespace carom::pinball
