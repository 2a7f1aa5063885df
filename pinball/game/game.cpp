#include "pinball/game/game.h"

#include "pinball/elements/change_times.h"
#include "pinball/elements/playfield.h"
#include "pinball/game/auto_plunger.h"
#include "pinball/rules/rule_book.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace carom::pinball {

namespace {

Index plunger_of(const Table& table)
{
    for (Index i = 0; i < table.elements.size(); ++i)
        if (std::holds_alternative<Plunger>(table.elements[i].part))
            return i;
    return none;
}

} // namespace

/// Everything that restart() makes anew.
struct Session
{
    Session(const Table& table, const Options& options)
        : field(table, options.seed), rules(table, {.seed = options.seed,
                                                    .ball_save = options.ball_save,
                                                    .kickback = options.kickback,
                                                    .ball_search = options.ball_search,
                                                    .credits = options.credits,
                                                    .balls_at_once = options.balls_at_once}),
          auto_plunger(table.physics.step)
    {}

    Playfield field;
    RuleBook rules;
    AutoPlunger auto_plunger;
    Input held{};
    std::vector<GameEvent> events{};
    std::vector<GameEvent> late{}; ///< for the next step
    std::vector<BallState> balls{};
    std::vector<int> last_ranks{};
};

struct Game::State
{
    State(Table t, const Options& o)
        : table(std::move(t)), options(o), plunger(plunger_of(table)), session(std::make_unique<Session>(table, options))
    {
        note_balls();
    }

    void step(std::span<const InputChange> changes);
    [[nodiscard]] Presses press(std::span<const InputChange> changes);
    void recall();
    void serve();
    void obey();
    void note_balls();
    void note_score();
    [[nodiscard]] bool auto_pull();
    [[nodiscard]] bool lane_is_occupied() const;

    const Table table;
    Options options;
    Index plunger;
    HighScores high_scores{};
    std::unique_ptr<Session> session;
};

Game::Game(Table table, const Options& options) : m_state(std::make_unique<State>(std::move(table), options)) {}
Game::~Game() = default;
Game::Game(Game&&) noexcept = default;
Game& Game::operator=(Game&&) noexcept = default;

void Game::step(const Input& input)
{
    const InputChange at_once{.input = input};
    m_state->step({&at_once, 1});
}

void Game::step_through(std::span<const InputChange> changes)
{
    check_times("Game::step_through", "InputChange::time", changes, table().physics.step);
    m_state->step(changes);
}

void Game::restart()
{
    m_state->options.credits = credits();
    m_state->session = std::make_unique<Session>(m_state->table, m_state->options);
    m_state->note_balls();
}

// The table first, then the rules on what it told, then their orders to the table: an order shows in the next step.
void Game::State::step(std::span<const InputChange> changes)
{
    Session& s = *session;
    const bool pull = auto_pull();
    const auto buttons = [pull](const Input& input)
    {
        return Buttons{.left = input.left,
                       .right = input.right,
                       .plunger = input.plunger || pull,
                       .nudge_left = input.nudge_left,
                       .nudge_right = input.nudge_right,
                       .nudge_up = input.nudge_up,
                       .rod = input.rod};
    };
    std::vector<ButtonChange> button_changes;
    if (changes.empty() || changes.front().time > 0)
        button_changes.push_back({.buttons = buttons(s.held)});
    for (const InputChange& change : changes)
        button_changes.push_back({change.time, buttons(change.input)});
    s.field.step_through(button_changes);
    const Presses presses = press(changes);
    const auto told = s.field.events();
    s.events = std::exchange(s.late, {});
    s.events.insert(s.events.end(), told.begin(), told.end());
    const std::size_t heard = told.size();
    if (std::ranges::any_of(told, [](const GameEvent& e) { return e.kind == EventKind::Launched; }))
        s.auto_plunger.launched();
    s.rules.step(s.field.step_count(), presses, s.events,
                 {.balls_in_play = s.field.balls_in_play(),
                  .all_known = s.field.knows_all_balls(),
                  .flipper_is_held = s.held.left || s.held.right});
    s.events.insert(s.events.end(), s.rules.announced().begin(), s.rules.announced().end());
    obey();
    // The rules hear in the next step of events that an order has caused.
    s.late.assign(s.field.events().begin() + static_cast<std::ptrdiff_t>(heard), s.field.events().end());
    if (std::ranges::any_of(s.events, [](const GameEvent& e) { return e.kind == EventKind::BallEnded; }))
        s.auto_plunger.forget();
    note_score();
    note_balls();
}

// A button that went down within the step counts as pressed, also if it is up again.
Presses Game::State::press(std::span<const InputChange> changes)
{
    Presses presses;
    Input& held = session->held;
    for (const auto& [time, input] : changes)
    {
        presses.left |= input.left && !held.left;
        presses.right |= input.right && !held.right;
        presses.start |= input.start && !held.start;
        held = input;
    }
    return presses;
}

void Game::State::obey()
{
    for (const Order& order : session->rules.desk().take_orders())
        session->field.command(order.element, order.command);
    recall();
    serve();
}

// Balls that nobody could find are written off; others come in their place, unless the ball is over anyway.
void Game::State::recall()
{
    Desk& desk = session->rules.desk();
    if (!std::exchange(desk.recalls, false))
        return;
    const int lost = session->field.take_lost_balls();
    session->events.push_back({.kind = EventKind::BallMissing, .value = lost});
    for (int i = 0; i < lost && !desk.tilted; ++i)
        desk.serve(true);
}

void Game::State::serve()
{
    Desk& desk = session->rules.desk();
    if (desk.to_serve == 0)
        return;
    const auto served = session->field.serve();
    if (!served)
        return;
    desk.ball_served();
    session->events.push_back(*served);
    if (desk.to_launch > 0)
    {
        --desk.to_launch;
        session->auto_plunger.launch();
    }
}

bool Game::State::lane_is_occupied() const
{
    if (plunger == none)
        return false;
    const Index lane = std::get<Plunger>(table.elements[plunger].part).lane;
    return lane != none && session->field.state(lane).occupied;
}

bool Game::State::auto_pull()
{
    if (plunger == none)
        return false;
    const auto& rod = std::get<Plunger>(table.elements[plunger].part);
    const int pull_steps = static_cast<int>(1.2f * rod.stroke / (rod.pull_speed * table.physics.step));
    return session->auto_plunger.step(lane_is_occupied(), pull_steps);
}

void Game::State::note_balls()
{
    session->balls.clear();
    for (const Ball& ball : session->field.balls())
        session->balls.push_back(ball.state);
}

void Game::State::note_score()
{
    const bool ended = std::ranges::any_of(session->events, [](const GameEvent& e) { return e.kind == EventKind::GameEnded; });
    if (!ended)
        return;
    const RuleBook& rules = session->rules;
    std::vector<int> players(static_cast<std::size_t>(rules.desk().players));
    std::iota(players.begin(), players.end(), 0);
    // From the best to the worst: none moves one that was put in before it.
    std::ranges::stable_sort(players, std::ranges::greater{}, [&rules](int player) { return rules.score(player); });
    session->last_ranks.assign(players.size(), -1);
    for (const int player : players)
    {
        const int rank = high_scores.insert({"YOU", rules.score(player)});
        session->last_ranks[static_cast<std::size_t>(player)] = rank;
        if (rank >= 0)
            session->events.push_back({.kind = EventKind::HighScore, .ball = player, .value = rank});
    }
}

// --- What shows ----------------------------------------------------------------------------------------------------

const Table& Game::table() const { return m_state->table; }

std::int64_t Game::step_count() const { return m_state->session->field.step_count(); }

Phase Game::phase() const { return m_state->session->rules.desk().phase; }

int Game::ball_number() const { return m_state->session->rules.desk().player.ball; }

int Game::balls_per_game() const { return m_state->table.rules.balls; }

int Game::balls_served() const { return m_state->session->field.served(); }

std::int64_t Game::score() const { return m_state->session->rules.desk().player.score; }

std::int64_t Game::score(int player) const { return m_state->session->rules.score(player); }

int Game::players() const { return m_state->session->rules.desk().players; }

int Game::player_up() const { return m_state->session->rules.desk().player_up; }

int Game::extra_balls() const { return m_state->session->rules.desk().player.extra_balls; }

int Game::credits() const { return m_state->session->rules.desk().credits; }

std::int64_t Game::bonus() const { return m_state->session->rules.desk().player.bonus; }

int Game::bonus_multiplier() const { return m_state->session->rules.desk().player.multiplier; }

int Game::bumper_level() const { return m_state->session->rules.desk().player.bumper_level; }

int Game::letters() const { return m_state->session->rules.desk().player.letters; }

int Game::ball_save_steps() const { return m_state->session->rules.ball_save_steps(); }

namespace {

LampState on_if(bool lit) { return lit ? LampState::On : LampState::Off; }

LampState blink_if(bool lit) { return lit ? LampState::Blink : LampState::Off; }

} // namespace

LampState Game::lamp(Index element) const
{
    const Desk& desk = m_state->session->rules.desk();
    const auto& part = table().elements[element].part;
    if (std::holds_alternative<Kicker>(part))
        return on_if(this->element(element).lit);
    const auto* light = std::get_if<Light>(&part);
    if (!light)
        return element == desk.flashing ? LampState::Blink : desk.player.lamps[element];
    switch (light->shows)
    {
    case Lamp::Element: return light->element == none ? LampState::Off : lamp(light->element);
    case Lamp::BallSave: return blink_if(ball_save_steps() > 0);
    case Lamp::Bonus: return on_if(desk.player.multiplier >= light->number && desk.player.ball > 0);
    case Lamp::Letter: return on_if(desk.player.letters >= light->number);
    case Lamp::Lock: return blink_if(desk.player.lock_is_lit);
    case Lamp::Multiball: return blink_if(desk.multiball);
    case Lamp::ExtraBall: return blink_if(desk.player.extra_ball_is_lit);
    case Lamp::ShootAgain: return on_if(desk.player.extra_balls > 0);
    }
    return LampState::Off;
}

std::span<const Message> Game::messages() const { return m_state->session->rules.desk().messages(); }

bool Game::tilted() const { return m_state->session->rules.desk().tilted; }

std::string_view Game::message() const
{
    if (tilted())
        return "TILT";
    const Message* best = nullptr;
    for (const Message& message : messages())
        if (!best || message.priority >= best->priority)
            best = &message;
    return best ? std::string_view(best->text) : std::string_view{};
}

const ElementState& Game::element(Index element) const { return m_state->session->field.state(element); }

const std::vector<BallState>& Game::balls() const { return m_state->session->balls; }

std::span<const GameEvent> Game::events() const { return m_state->session->events; }

const Cabinet& Game::cabinet() const { return m_state->session->field.cabinet(); }

const Scene& Game::scene() const { return std::as_const(m_state->session->field).scene(); }

void Game::record_substeps(bool record) { m_state->session->field.record_substeps(record); }

std::uint64_t Game::state_hash() const
{
    Hash hash;
    const Session& s = *m_state->session;
    s.field.add_to(hash);
    s.rules.add_to(hash);
    s.auto_plunger.add_to(hash);
    for (const GameEvent& event : s.late)
    {
        hash.add(static_cast<int>(event.kind));
        hash.add(event.element);
        hash.add(event.ball);
    }
    for (const bool held :
         {s.held.left, s.held.right, s.held.plunger, s.held.start, s.held.nudge_left, s.held.nudge_right, s.held.nudge_up})
        hash.add(held);
    hash.add(int{s.held.rod});
    return hash.value();
}

const HighScores& Game::high_scores() const { return m_state->high_scores; }

void Game::set_high_scores(HighScores scores) { m_state->high_scores = std::move(scores); }

std::span<const int> Game::last_ranks() const { return m_state->session->last_ranks; }

void Game::rename_score(int rank, std::string_view name) { m_state->high_scores.rename(rank, name); }

} // namespace carom::pinball
