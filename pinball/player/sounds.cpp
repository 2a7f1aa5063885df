#include "pinball/player/sounds.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

using view::Strike;

// A ball of 80 g at 3 m/s that bounces well: the hardest blow of ordinary play, N s.
constexpr float full_impulse = 0.35f;
// Below this a touch is part of the rolling.
constexpr float least_impulse = 0.0006f;

float pan_of(const Table& table, Position point)
{
    return std::clamp(static_cast<float>(point.x) / table.size.x * 2 - 1, -1.0f, 1.0f) * 0.7f;
}

bool named(const std::string& name, const char* part) { return name.find(part) != std::string::npos; }

// The struck element decides the sound of a blow.
Strike voice_of(const Table& table, Index element)
{
    if (element == none) // ball against ball
        return {.pitch_hz = 2600, .brightness = 0.55f, .noise = 0.15f, .decay_s = 0.09f};
    const Index material = table.elements[element].material;
    const std::string name = material == none ? "" : table.materials[material].name;
    if (named(name, "metal"))
        return {.pitch_hz = 1750, .brightness = 0.8f, .noise = 0.15f, .decay_s = 0.16f};
    if (named(name, "rubber"))
        return {.pitch_hz = 170, .brightness = 0.15f, .noise = 0.3f, .decay_s = 0.08f};
    if (named(name, "plastic"))
        return {.pitch_hz = 620, .brightness = 0.3f, .noise = 0.45f, .decay_s = 0.07f};
    if (named(name, "target"))
        return {.pitch_hz = 820, .brightness = 0.5f, .noise = 0.35f, .decay_s = 0.1f};
    return {.pitch_hz = 290, .brightness = 0.2f, .noise = 0.55f, .decay_s = 0.08f};
}

std::optional<Strike> blow(const Table& table, const GameEvent& event)
{
    if (event.impulse < least_impulse)
        return std::nullopt;
    Strike strike = voice_of(table, event.element);
    strike.loudness = view::loudness_of_impulse(event.impulse, full_impulse);
    return strike;
}

std::optional<Strike> coil(const Table& table, const GameEvent& event)
{
    if (std::holds_alternative<Bumper>(table.elements[event.element].part))
        return Strike{.pitch_hz = 330, .brightness = 0.6f, .noise = 0.35f, .decay_s = 0.22f, .glide = -0.7f, .loudness = 0.75f};
    if (std::holds_alternative<Kicker>(table.elements[event.element].part))
        return Strike{.pitch_hz = 110, .brightness = 0.4f, .noise = 0.5f, .decay_s = 0.2f, .glide = -0.5f, .loudness = 0.8f};
    return Strike{.pitch_hz = 210, .brightness = 0.35f, .noise = 0.6f, .decay_s = 0.13f, .glide = -0.4f, .loudness = 0.65f};
}

Strike bell(float pitch, float loudness, float decay = 0.7f)
{
    return {.pitch_hz = pitch, .brightness = 0.35f, .noise = 0.02f, .decay_s = decay, .loudness = loudness};
}

// Rollovers of a group climb a chord: C E G C.
float chord(const Table& table, Index element)
{
    static constexpr float pitches[] = {1046.5f, 1318.5f, 1568.0f, 2093.0f};
    for (const Group& group : table.groups)
        for (std::size_t i = 0; i < group.members.size(); ++i)
            if (group.members[i] == element)
                return pitches[i % std::size(pitches)];
    return 1174.7f;
}

std::optional<Strike> rollover(const Table& table, const GameEvent& event)
{
    const Element& element = table.elements[event.element];
    if (!std::holds_alternative<Sensor>(element.part) || element.score == 0)
        return std::nullopt;
    return bell(chord(table, event.element), 0.35f);
}

std::optional<Strike> flipper(const GameEvent& event)
{
    if (event.kind == EventKind::FlipperCoil)
        return Strike{.pitch_hz = event.value == 1 ? 95.0f : 70.0f,
                      .brightness = 0.3f,
                      .noise = 0.7f,
                      .decay_s = 0.06f,
                      .loudness = event.value == 1 ? 0.32f : 0.1f};
    return Strike{.pitch_hz = event.value == 1 ? 150.0f : 110.0f,
                  .brightness = 0.25f,
                  .noise = 0.6f,
                  .decay_s = 0.07f,
                  .loudness = std::clamp(event.speed / 90, 0.05f, 0.5f)};
}

std::optional<Strike> of_rules(const GameEvent& event)
{
    switch (event.kind)
    {
    case EventKind::GameStarted: return bell(784, 0.5f, 1.0f);
    case EventKind::GroupCompleted: return bell(1568, 0.55f, 1.2f);
    case EventKind::LetterLit: return bell(1760, 0.5f, 1.0f);
    case EventKind::LevelUp: return bell(1396, 0.5f, 1.0f);
    case EventKind::BallSaved: return bell(1046, 0.5f, 1.0f);
    case EventKind::BonusCounted: return bell(1318, 0.22f, 0.12f);
    case EventKind::Jackpot:
    case EventKind::MultiballStarted: return bell(2093, 0.7f, 1.6f);
    case EventKind::Combo:
    case EventKind::SkillShot: return bell(1864, 0.55f, 1.0f);
    case EventKind::GameEnded: return bell(392, 0.5f, 1.8f);
    case EventKind::BallSearch:
        return Strike{.pitch_hz = 110, .brightness = 0.4f, .noise = 0.7f, .decay_s = 0.12f, .loudness = 0.6f};
    case EventKind::Warned: return bell(233, 0.6f, 0.9f);
    case EventKind::Tilted: return bell(117, 0.8f, 2.5f);
    case EventKind::HighScore: return bell(2637, 0.6f, 1.8f);
    default: return std::nullopt;
    }
}

std::optional<Strike> of_element(const Table& table, const GameEvent& event)
{
    switch (event.kind)
    {
    case EventKind::Impact: return blow(table, event);
    case EventKind::Fired: return coil(table, event);
    case EventKind::Hit: return bell(659, 0.3f, 0.3f);
    case EventKind::Fell: return Strike{.pitch_hz = 420, .brightness = 0.5f, .noise = 0.6f, .decay_s = 0.18f, .glide = -1.0f};
    case EventKind::Raised: return Strike{.pitch_hz = 160, .noise = 0.7f, .decay_s = 0.1f, .glide = 0.6f, .loudness = 0.35f};
    case EventKind::Spun: return Strike{.pitch_hz = 2300, .brightness = 0.6f, .noise = 0.4f, .decay_s = 0.035f, .loudness = 0.2f};
    case EventKind::Passed: return Strike{.pitch_hz = 2900, .brightness = 0.7f, .decay_s = 0.06f, .loudness = 0.15f};
    case EventKind::Entered: return rollover(table, event);
    case EventKind::Captured: return Strike{.pitch_hz = 120, .noise = 0.5f, .decay_s = 0.25f, .glide = -1.0f, .loudness = 0.5f};
    case EventKind::Ejected: return Strike{.pitch_hz = 130, .noise = 0.6f, .decay_s = 0.2f, .glide = 0.8f, .loudness = 0.6f};
    case EventKind::Drained: return Strike{.pitch_hz = 220, .noise = 0.3f, .decay_s = 0.9f, .glide = -2.0f, .loudness = 0.5f};
    case EventKind::Launched: return Strike{.pitch_hz = 300, .noise = 0.4f, .decay_s = 0.5f, .glide = 1.5f, .loudness = 0.35f};
    case EventKind::FlipperStop:
    case EventKind::FlipperCoil: return flipper(event);
    case EventKind::PlungerReleased:
        return Strike{.pitch_hz = 90,
                      .brightness = 0.5f,
                      .noise = 0.6f,
                      .decay_s = 0.2f,
                      .loudness = std::clamp(event.speed * 16, 0.1f, 0.8f)};
    case EventKind::Nudged: return Strike{.pitch_hz = 55, .brightness = 0.2f, .noise = 0.8f, .decay_s = 0.15f, .loudness = 0.5f};
    case EventKind::BobTouched: return Strike{.pitch_hz = 1900, .brightness = 0.6f, .decay_s = 0.1f, .loudness = 0.3f};
    default: return std::nullopt;
    }
}

bool has_place(const GameEvent& event) { return event.kind < EventKind::GameStarted; }

} // namespace

std::optional<Strike> strike_of(const Table& table, const GameEvent& event)
{
    std::optional<Strike> strike = has_place(event) ? of_element(table, event) : of_rules(event);
    if (strike && has_place(event))
        strike->pan = pan_of(table, event.point);
    return strike;
}

view::Drone rolling_noise(const Game& game)
{
    float sum = 0;
    float fastest = 0;
    float where = 0;
    for (const BallState& ball : game.balls())
    {
        const float speed = ball.held ? 0 : length(ball.velocity);
        sum += speed;
        fastest = std::max(fastest, speed);
        where += speed * pan_of(game.table(), ball.position);
    }
    // 2 m/s is a fast ball; a rolling one is never louder than a blow.
    return {.pitch_hz = 90 + 160 * fastest,
            .noise = 1,
            .pan = sum > 0 ? where / sum : 0,
            .loudness = 0.16f * std::min(1.0f, sum / 2)};
}

void Sounds::hear(const Game& game)
{
    for (const GameEvent& event : game.events())
        if (const auto strike = strike_of(game.table(), event))
            m_sink.play(*strike);
}

void Sounds::frame(const Game& game, bool running) { m_sink.set_drone(0, running ? rolling_noise(game) : view::Drone{}); }

} // namespace carom::pinball
