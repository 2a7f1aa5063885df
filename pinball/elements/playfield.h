#pragma once

/// @file
/// The table as a world: the scene, its elements and its balls. It is stepped with the buttons and tells events.

#include "carom/scene.h"
#include "pinball/elements/device.h"
#include "pinball/elements/random.h"
#include "pinball/table/table.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace carom::pinball {

/// Categories of Filter. What moves by itself meets balls alone: a flipper passes over the walls beside it.
inline constexpr std::uint64_t fixed_category = 1;
inline constexpr std::uint64_t ball_category = 2;
inline constexpr std::uint64_t moving_category = 4;

struct Buttons
{
    bool left = false;
    bool right = false;
    bool plunger = false;
};

struct Ball
{
    BallState state{};
    Index element = none; ///< of a captive ball
    bool in_lane = false;
    bool drained = false;
};

/// The column before the plunger, in which a ball waits or falls back.
class PlungerLane
{
public:
    explicit PlungerLane(const Table& table);
    [[nodiscard]] bool contains(Position p) const;

private:
    Vec2 m_origin{};
    Vec2 m_axis{0, 1};
    float m_half_width = 0; ///< 0: there is no plunger
    float m_behind = 0;
};

class Playfield
{
public:
    /// The table must outlive the playfield.
    Playfield(const Table& table, std::uint64_t seed);
    ~Playfield();

    void step(const Buttons& buttons);

    /// Puts a ball before the plunger and reports it; nothing while another one is in the way.
    std::optional<GameEvent> serve();
    void command(Index element, Command command);
    [[nodiscard]] const ElementState& state(Index element) const { return m_devices[element]->state; }
    [[nodiscard]] const std::vector<Ball>& balls() const { return m_balls; }
    [[nodiscard]] int balls_in_play() const; ///< all but the captive ones
    [[nodiscard]] int served() const { return m_served; }
    [[nodiscard]] std::span<const GameEvent> events() const { return m_events; }
    [[nodiscard]] std::int64_t step_count() const { return m_step; }
    [[nodiscard]] const Scene& scene() const { return m_scene; }
    [[nodiscard]] const Table& table() const { return m_table; }
    void record_substeps(bool record) { m_scene.set_record_substeps(record); }
    void add_to(Hash& hash) const;

    // For the elements.
    [[nodiscard]] Scene& scene() { return m_scene; }
    [[nodiscard]] Random& random() { return m_random; }
    [[nodiscard]] const Buttons& buttons() const { return m_buttons; }
    [[nodiscard]] float h() const { return m_table.physics.step; }
    [[nodiscard]] std::span<Ball> all_balls() { return m_balls; }
    [[nodiscard]] Ball* find_ball(BodyId body);
    void emit(const GameEvent& event) { m_events.push_back(event); }
    /// A fixed body at the origin that holds the element's shapes.
    BodyId add_fixed(bool enabled = true);
    /// What the element's surface is like, tagged with the element.
    [[nodiscard]] ShapeDef surface(Index element) const;
    /// The same for something that moves by itself.
    [[nodiscard]] ShapeDef moving_surface(Index element) const;
    /// A trigger that balls set off.
    [[nodiscard]] static ShapeDef trigger(Index element);
    /// A ball at rest; a captive one belongs to an element.
    Ball& add_ball(Vec2 position, Index captive_element = none);
    /// Takes a ball out of the world at a place, and lets it back in from there.
    void hold(Ball& ball, Position at);
    void release(Ball& ball, Vec2 velocity);

private:
    void add_devices();
    void roll_balls();
    void read_balls();
    void hear_impacts();
    void hear_triggers();
    [[nodiscard]] Ball* ball_of(ShapeId shape);
    [[nodiscard]] Index element_of(ShapeId shape) const;
    void strike(Ball& ball, Index element, const ImpactEvent& impact, Vec2 normal);
    void strike_balls(Ball& a, Ball& b, const ImpactEvent& impact);
    void watch_lane();
    void remove_drained();

    const Table& m_table;
    Scene m_scene;
    Random m_random;
    Buttons m_buttons{};
    PlungerLane m_lane;
    Vec2 m_slope{};       ///< acceleration down the table, m/s²
    float m_friction = 0; ///< greatest deceleration by the playfield, m/s²
    std::vector<std::unique_ptr<Device>> m_devices{};
    std::vector<Ball> m_balls{};
    std::vector<GameEvent> m_events{};
    std::int64_t m_step = 0;
    int m_next_serial = 0;
    int m_served = 0;
};

} // namespace carom::pinball
