#pragma once

/// @file
/// One run: game after game until enough balls are finished.

#include "pinball/autoplay/reflex.h"
#include "pinball/headless/judge.h"
#include "pinball/headless/stats.h"

#include <optional>

namespace carom::pinball {

class HeadlessRun
{
public:
    /// The table must outlive the run.
    HeadlessRun(const Table& table, std::uint64_t seed, int balls_at_once = 1);
    HeadlessRun(Table&&, std::uint64_t, int = 1) = delete;

    /// One step of the game.
    void step();
    /// To be called when the run is over: the last state enters the hash.
    void finish() { m_stats.finish(m_game->state_hash()); }
    [[nodiscard]] Stats& stats() { return m_stats; }
    [[nodiscard]] const Game& game() const { return *m_game; }

private:
    void hear();
    void watch();
    void lose(const char* how, const BallState& ball);
    void new_session();
    [[nodiscard]] bool captive_is_out(const BallState& ball) const;

    const Table& m_table;
    std::uint64_t m_seed;
    int m_balls_at_once;
    int m_sessions = 0;
    Stats m_stats;
    std::optional<Game> m_game{};
    std::optional<ReflexPlayer> m_player{};
    std::optional<Judge> m_judge{};
    std::vector<Position> m_captive_homes{};
};

} // namespace carom::pinball
