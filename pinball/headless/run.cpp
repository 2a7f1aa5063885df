#include "pinball/headless/run.h"

#include <algorithm>
#include <chrono>

namespace carom::pinball {

namespace {

// A captive ball's lane is shorter than this.
constexpr float captive_reach = 0.12f; // m

const char* name_of(Verdict verdict)
{
    switch (verdict)
    {
    case Verdict::Fine: return "fine";
    case Verdict::Escaped: return "escaped";
    case Verdict::Stuck: return "stuck";
    case Verdict::Endless: return "endless";
    }
    return "";
}

double microseconds_of(auto&& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

HeadlessRun::HeadlessRun(const Table& table, std::uint64_t seed, int balls_at_once)
    : m_table(table), m_seed(seed), m_balls_at_once(balls_at_once), m_stats(table)
{
    new_session();
}

// A lost ball is not repaired: the game it was lost in is given up, and the next one has its own seed.
void HeadlessRun::new_session()
{
    Random seeds(m_seed + static_cast<std::uint64_t>(m_sessions++));
    m_game.emplace(m_table, Options{// a ball that the machine had to look for counts as stuck
                                    .seed = seeds.bits(),
                                    .ball_search = false,
                                    .balls_at_once = m_balls_at_once});
    m_player.emplace(m_table, seeds.bits());
    m_judge.emplace(m_table);
    m_stats.new_session();
    m_captive_homes.clear();
    for (const BallState& ball : m_game->balls())
        m_captive_homes.push_back(ball.position);
}

void HeadlessRun::step()
{
    const Input input = m_player->play(*m_game);
    const double microseconds = microseconds_of([&] { m_game->step(input); });
    m_stats.note_step(microseconds, static_cast<int>(std::ranges::count_if(m_game->balls(), &BallState::is_free)));
    hear();
    watch();
}

void HeadlessRun::hear()
{
    for (const GameEvent& event : m_game->events())
    {
        m_stats.note_event(event);
        if (event.kind == EventKind::Launched)
            m_stats.note_launch(event.ball, m_game->step_count());
        if (event.kind == EventKind::GameEnded)
            m_stats.note_score(m_game->score());
        if (event.kind == EventKind::Drained)
        {
            m_stats.note_drain(event.ball, m_game->step_count(), m_game->state_hash());
            m_judge->forget(event.ball);
        }
    }
}

void HeadlessRun::watch()
{
    for (const BallState& ball : m_game->balls())
    {
        const Verdict verdict = m_judge->look(ball, m_game->step_count());
        const char* fault = verdict != Verdict::Fine ? name_of(verdict) : captive_is_out(ball) ? "captive out" : nullptr;
        if (fault)
        {
            lose(fault, ball);
            return; // and with it the game that we were looking at
        }
        if (ball.is_free() && !m_judge->in_lane(ball.position))
            m_stats.note_speed(length(ball.velocity));
    }
}

bool HeadlessRun::captive_is_out(const BallState& ball) const
{
    const auto serial = static_cast<std::size_t>(ball.serial);
    return ball.captive && length(ball.position - m_captive_homes[serial]) > captive_reach;
}

void HeadlessRun::lose(const char* how, const BallState& ball)
{
    m_stats.note_lost({.how = how, .step = m_game->step_count(), .position = ball.position, .velocity = ball.velocity});
    new_session();
}

} // namespace carom::pinball
