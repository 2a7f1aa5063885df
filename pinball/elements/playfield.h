#pragma once

/// @file
/// The table as a world: the scene, its elements and its balls. It is stepped with the buttons and tells events.

#include "carom/scene.h"
#include "pinball/elements/cabinet.h"
#include "pinball/elements/device.h"
#include "pinball/elements/random.h"
#include "pinball/elements/rolling.h"
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
    bool nudge_left = false;  ///< a hand on the left side: the cabinet moves to the right
    bool nudge_right = false; ///< a hand on the right side: it moves to the left
    bool nudge_up = false;    ///< a hand at the front: it moves up the table
    std::uint8_t rod = 0;     ///< how far a hand holds the plunger's rod back, in 255ths of its stroke
};

/// The buttons from a time of the step on, until the next change.
struct ButtonChange
{
    double time = 0; ///< s since the step began
    Buttons buttons{};
};

struct Ball
{
    BallState state{};
    Index element = none; ///< of a captive ball
    bool in_lane = false;
    bool drained = false;
    const Playfield* field = nullptr; ///< that it rolls on
};

/// The column before the plunger, in which a ball waits or falls back.
class PlungerLane
{
public:
    explicit PlungerLane(const Table& table);
    [[nodiscard]] bool contains(Position p) const;
    /// A ball that lies there is before the rod: over the lane's sensor.
    [[nodiscard]] bool is_before_rod(Position p) const;

private:
    Vec2 m_origin{};
    Vec2 m_axis{0, 1};
    float m_half_width = 0; ///< 0: there is no plunger
    float m_behind = 0;
    float m_reach = 0; ///< from the rod to the far end of the sensor, with half a ball
};

class Playfield
{
public:
    /// The table must outlive the playfield.
    Playfield(const Table& table, std::uint64_t seed);
    ~Playfield();

    /// One step with the buttons as they are held all through it.
    void step(const Buttons& buttons);
    /// One step in which the buttons change, in the order of time; up to the first change they stay as they were. Coils and
    /// rods feel a change within the step, however long that is. Refuses times (carom::Error) that go back or lie outside of the step.
    void step_through(std::span<const ButtonChange> changes);

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
    [[nodiscard]] const Cabinet& cabinet() const { return m_cabinet; }
    void record_substeps(bool record) { m_scene.set_record_substeps(record); }
    void add_to(Hash& hash) const;

    // For the elements.
    [[nodiscard]] Scene& scene() { return m_scene; }
    [[nodiscard]] Random& random() { return m_random; }
    /// A factor near 1 for the next speed that a coil or a spring gives: Physics::scatter.
    [[nodiscard]] float scatter_factor();
    /// The changes of this step; the first is at its start.
    [[nodiscard]] std::span<const ButtonChange> button_changes() const { return m_changes; }
    /// The buttons at a time since the step began.
    [[nodiscard]] const Buttons& buttons_at(double time) const;
    [[nodiscard]] double time() const; ///< s, at the start of the step
    [[nodiscard]] float h() const { return m_table.physics.step; }
    [[nodiscard]] std::span<Ball> all_balls() { return m_balls; }
    [[nodiscard]] Ball* find_ball(BodyId body);
    void emit(const GameEvent& event) { m_events.push_back(event); }
    /// A fixed body at the origin that holds the element's shapes.
    BodyId add_fixed(bool enabled = true);
    /// The material of the element's surface, tagged with the element.
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
    /// Gives a free ball this velocity.
    void throw_ball(Ball& ball, Vec2 velocity);
    /// Takes balls off the table that are neither captive nor held nor before the plunger; says how many.
    int take_lost_balls();
    /// Whether it is known where all balls are: held, captive, or before the plunger.
    [[nodiscard]] bool knows_all_balls() const;

private:
    void add_devices();
    void shake();
    void let_balls_roll();
    static Load roll(void* user, const BodyMotion& motion);
    void rub(Ball& ball, const ImpactEvent& impact) const;
    void read_balls();
    void hear_impacts();
    void hear_triggers();
    [[nodiscard]] Ball* ball_of(ShapeId shape);
    [[nodiscard]] Index element_of(ShapeId shape) const;
    void strike(Ball& ball, Index element, const ImpactEvent& impact, Vec2 normal);
    void strike_balls(Ball& a, Ball& b, const ImpactEvent& impact);
    void watch_lane();
    void count_vain_plunges();
    [[nodiscard]] bool is_lost(const Ball& ball) const;
    void remove_drained();

    const Table& m_table;
    Scene m_scene;
    Random m_random;
    std::vector<ButtonChange> m_changes{{}};
    PlungerLane m_lane;
    Cabinet m_cabinet;
    Vec2 m_slope; ///< acceleration down the table at rest, m/s²
    Floor m_floor{};
    std::vector<std::unique_ptr<Device>> m_devices{};
    std::vector<Ball> m_balls{};
    std::vector<GameEvent> m_events{};
    std::int64_t m_step = 0;
    int m_next_serial = 0;
    int m_served = 0;
    int m_vain_plunges = 0; ///< hard ones after which a ball still lay before the rod
};

} // namespace carom::pinball
