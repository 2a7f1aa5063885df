#include "pinball/elements/playfield.h"

#include "pinball/elements/change_times.h"
#include "pinball/elements/make.h"
#include "pinball/elements/rolling.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

// Shapes are tagged with their element's index + 1; balls with this bit and their serial number.
constexpr std::uint64_t ball_tag = std::uint64_t{1} << 63;

// Softer touches than this are rolling and leaning, not hits: a ball at rest sinks and rises by less.
constexpr float quietest_impact = 0.02f; // m/s

// A free ball on the round end of a guide begins to roll off at a few micrometres a second: it must not fall asleep meanwhile.
constexpr float sleep_speed = 2e-5f; // m/s

// Sub-steps of at most a quarter of a millisecond, however long the step is, and where that can be, such that one begins at every whole
// millisecond: there buttons change and coils look at them. 4 in 1 ms, 25 in 1/240 s, 50 in 1/120 s.
int substeps_of(float step)
{
    for (int in_millisecond = 4; in_millisecond <= 12; ++in_millisecond)
    {
        const float count = 1000 * static_cast<float>(in_millisecond) * step;
        if (std::abs(count - std::round(count)) < 1e-3f && count < 64.5f)
            return static_cast<int>(std::round(count));
    }
    return std::clamp(static_cast<int>(std::ceil(4000 * step)), 1, 64);
}

SceneDef scene_def(const Table& table)
{
    SceneDef def;
    def.gravity = {0, -table.physics.g * Rotation::from_angle(table.physics.slope).s};
    def.length_scale = 0.02f; // a ball is 27 mm
    def.fixed_step = table.physics.step;
    def.substeps = substeps_of(table.physics.step);
    def.friction_rule = MixRule::OtherDecides;
    def.restitution_rule = MixRule::OtherDecides;
    return def;
}

} // namespace

namespace {

constexpr double same_time = 1e-6; // s: nobody presses a button that exactly

// The step as it was meant: 0.001f is not a thousandth, and over an hour that adds up.
double nominal(float step)
{
    const double rate = 1 / static_cast<double>(step);
    const double whole = std::round(rate);
    return std::abs(rate - whole) < 1e-3 ? 1 / whole : 1 / rate;
}

} // namespace

PlungerLane::PlungerLane(const Table& table)
{
    for (const auto& element : table.elements)
    {
        const auto* plunger = std::get_if<Plunger>(&element.part);
        if (!plunger || plunger->lane == none)
            continue;
        const Sensor& sensor = std::get<Sensor>(table.elements[plunger->lane].part);
        const Vec2 half = sensor.radius > 0 ? Vec2{sensor.radius, sensor.radius} : sensor.half;
        m_origin = plunger->pos;
        m_axis = plunger->axis;
        m_half_width = std::abs(half.x * m_axis.y) + std::abs(half.y * m_axis.x) + 0.002f;
        m_behind = plunger->stroke;
        m_reach =
            dot(m_axis, sensor.pos - m_origin) + std::abs(half.x * m_axis.x) + std::abs(half.y * m_axis.y) + table.ball.radius;
        return;
    }
}

bool PlungerLane::contains(Position p) const
{
    const Vec2 d = p - Position(m_origin);
    return std::abs(cross(m_axis, d)) < m_half_width && dot(m_axis, d) > -m_behind;
}

bool PlungerLane::is_before_rod(Position p) const { return contains(p) && dot(m_axis, p - Position(m_origin)) < m_reach; }

Playfield::Playfield(const Table& table, std::uint64_t seed)
    : m_table(table), m_scene(scene_def(table)), m_random(seed), m_lane(table), m_cabinet(table.cabinet),
      m_slope(m_scene.gravity()),
      m_floor{.slope = m_scene.gravity(),
              .friction = table.physics.mu_playfield * table.physics.g * Rotation::from_angle(table.physics.slope).c,
              .ball_mass = table.ball.mass}
{
    add_devices();
}

Playfield::~Playfield() = default;

void Playfield::add_devices()
{
    for (Index i = 0; i < m_table.elements.size(); ++i)
        m_devices.push_back(std::visit([&](const auto& part) { return make(*this, i, part); }, m_table.elements[i].part));
}

double Playfield::time() const { return static_cast<double>(m_step) * nominal(h()); }

const Buttons& Playfield::buttons_at(double time) const
{
    const ButtonChange* last = &m_changes.front();
    for (const ButtonChange& change : m_changes)
        if (change.time <= time + same_time)
            last = &change;
    return last->buttons;
}

float Playfield::scatter_factor()
{
    const float scatter = m_table.physics.scatter;
    return scatter > 0 ? 1 + m_random.between(-scatter, scatter) : 1;
}

// Everything on the table feels the opposite of what the cabinet does.
void Playfield::shake()
{
    const auto hand = [this](bool Buttons::* button, Vec2 direction)
    {
        for (std::size_t i = 1; i < m_changes.size(); ++i)
            if (m_changes[i].buttons.*button && !(m_changes[i - 1].buttons.*button))
            {
                if (!m_cabinet.push(direction, m_changes[i].time))
                    continue;
                emit({.kind = EventKind::Nudged,
                      .point = Position(0.5f * m_table.size),
                      .normal = direction,
                      .speed = std::abs(dot(m_table.cabinet.nudge_speed, direction))});
            }
    };
    hand(&Buttons::nudge_left, {1, 0});
    hand(&Buttons::nudge_right, {-1, 0});
    hand(&Buttons::nudge_up, {0, 1});
    if (m_cabinet.step(h()))
        emit({.kind = EventKind::BobTouched, .point = Position(0.5f * m_table.size)});
    const Vec2 felt = m_slope - m_cabinet.acceleration();
    if (felt == m_floor.slope)
        return;
    m_floor.slope = felt;
    m_scene.set_gravity(felt);
}

void Playfield::step(const Buttons& buttons)
{
    const ButtonChange at_once{.buttons = buttons};
    step_through({&at_once, 1});
}

void Playfield::step_through(std::span<const ButtonChange> changes)
{
    check_times("Playfield::step_through", "ButtonChange::time", changes, h());
    m_events.clear();
    m_changes = {{.buttons = m_changes.back().buttons}};
    m_changes.insert(m_changes.end(), changes.begin(), changes.end());
    shake();
    for (auto& device : m_devices)
        device->before_step(*this);
    let_balls_roll();
    m_scene.step(h());
    ++m_step;
    read_balls();
    hear_impacts();
    hear_triggers();
    for (auto& device : m_devices)
        device->after_step(*this);
    watch_lane();
    count_vain_plunges();
    remove_drained();
}

namespace {

// The rest of the greatest friction impulse that sideways friction has left, over the ball's mass.
float room_to_rub(const ImpactEvent& impact, float mass)
{
    const float greatest = impact.friction * impact.impulse;
    const float left = greatest * greatest - impact.friction_impulse * impact.friction_impulse;
    return left > 0 ? std::sqrt(left) / mass : 0.0f;
}

} // namespace

// A force law: in every sub-step first what has struck the ball, then the playfield.
Load Playfield::roll(void* user, const BodyMotion& motion)
{
    Ball& ball = *static_cast<Ball*>(user);
    for (const ImpactEvent& impact : motion.impacts)
        ball.field->rub(ball, impact);
    const Floor& floor = ball.field->m_floor;
    const Vec2 friction = playfield_friction(motion.velocity, ball.state.rolling, floor.slope, floor.friction, motion.h);
    ball.state.rolling = rolling_after(ball.state.rolling, friction, motion.h);
    return {.force = floor.ball_mass * friction};
}

// Two balls that rub on each other do so after the step: here each is alone.
void Playfield::rub(Ball& ball, const ImpactEvent& impact) const
{
    const bool ball_is_a = impact.body_a == ball.state.body;
    const BodyId other = ball_is_a ? impact.body_b : impact.body_a;
    if (std::ranges::any_of(m_balls, [other](const Ball& b) { return b.state.body == other; }))
        return;
    const Vec2 normal = ball_is_a ? -impact.normal : impact.normal;
    ball.state.rolling = rub_wall(ball.state.rolling, normal, room_to_rub(impact, m_floor.ball_mass));
}

// Anew in every step: balls come and go, and their places in memory with them.
void Playfield::let_balls_roll()
{
    for (Ball& ball : m_balls)
    {
        ball.field = this;
        m_scene.set_force_law(ball.state.body,
                              {.function = roll, .user = &ball, .greatest_force = m_floor.ball_mass * m_floor.friction});
    }
}

void Playfield::read_balls()
{
    for (Ball& ball : m_balls)
    {
        const Body body = m_scene.body(ball.state.body);
        ball.state.position = body.position();
        ball.state.velocity = body.velocity();
        ball.state.spin = body.angular_velocity();
    }
}

// --- What happened -------------------------------------------------------------------------------------------------

Ball* Playfield::find_ball(BodyId body)
{
    const auto found = std::ranges::find_if(m_balls, [body](const Ball& b) { return b.state.body == body; });
    return found == m_balls.end() ? nullptr : &*found;
}

Ball* Playfield::ball_of(ShapeId shape) { return m_scene.is_valid(shape) ? find_ball(m_scene.shape(shape).body()) : nullptr; }

Index Playfield::element_of(ShapeId shape) const
{
    if (!m_scene.is_valid(shape))
        return none;
    const std::uint64_t tag = m_scene.shape(shape).user_data();
    return tag == 0 || (tag & ball_tag) != 0 ? none : static_cast<Index>(tag - 1);
}

void Playfield::hear_impacts()
{
    for (const ImpactEvent& impact : m_scene.impacts())
    {
        Ball* a = ball_of(impact.shape_a);
        Ball* b = ball_of(impact.shape_b);
        if (a && b)
            strike_balls(*a, *b, impact);
        else if (a)
            strike(*a, element_of(impact.shape_b), impact, -impact.normal);
        else if (b)
            strike(*b, element_of(impact.shape_a), impact, impact.normal);
    }
}

void Playfield::strike(Ball& ball, Index element, const ImpactEvent& impact, Vec2 normal)
{
    if (element == none)
        return;
    if (impact.approach_speed >= quietest_impact)
        emit({.kind = EventKind::Impact,
              .element = element,
              .point = impact.point,
              .normal = normal,
              .impulse = impact.impulse,
              .speed = impact.approach_speed,
              .ball = ball.state.serial});
    m_devices[element]->on_strike(*this, ball, {impact.point, normal, impact.approach_speed, impact.impulse, impact.kick_speed});
}

void Playfield::strike_balls(Ball& a, Ball& b, const ImpactEvent& impact)
{
    rub_balls(a.state.rolling, b.state.rolling, impact.normal, room_to_rub(impact, m_table.ball.mass));
    if (impact.approach_speed < quietest_impact)
        return;
    // A free ball strikes a captive one; of two captive ones the faster strikes the slower.
    const bool a_is_slower = std::abs(impact.speed_a) < std::abs(impact.speed_b);
    const bool a_is_hit = a.element != none && (b.element == none || a_is_slower);
    const Ball& striker = a_is_hit ? b : a;
    emit({.kind = EventKind::Impact,
          .element = a_is_hit ? a.element : b.element,
          .point = impact.point,
          .normal = a_is_hit ? impact.normal : -impact.normal,
          .impulse = impact.impulse,
          .speed = impact.approach_speed,
          .ball = striker.state.serial});
}

void Playfield::hear_triggers()
{
    for (const TriggerEvent& event : m_scene.trigger_enters())
    {
        const Index element = element_of(event.trigger);
        Ball* ball = find_ball(event.visitor_body);
        if (element != none && ball)
            m_devices[element]->on_enter(*this, *ball);
    }
    for (const TriggerEvent& event : m_scene.trigger_exits())
    {
        const Index element = element_of(event.trigger);
        if (element != none)
            m_devices[element]->on_exit(*this, event.visitor_body, find_ball(event.visitor_body));
    }
}

void Playfield::watch_lane()
{
    for (Ball& ball : m_balls)
    {
        const bool in_lane = m_lane.contains(ball.state.position);
        if (ball.in_lane && !in_lane && !ball.drained)
            emit({.kind = EventKind::Launched,
                  .point = ball.state.position,
                  .speed = length(ball.state.velocity),
                  .ball = ball.state.serial});
        ball.in_lane = in_lane;
    }
}

// --- Balls ---------------------------------------------------------------------------------------------------------

Ball& Playfield::add_ball(Vec2 position, Index captive_element)
{
    const BallDef& def = m_table.ball;
    const BodyId body = m_scene.create_body({.type = BodyType::Dynamic,
                                             .position = position,
                                             .sleep_speed = captive_element == none ? sleep_speed : 0,
                                             .user_data = ball_tag});
    ShapeDef shape;
    if (def.material != none)
    {
        const Material& material = m_table.materials[def.material];
        shape.friction = material.friction;
        shape.restitution = material.restitution;
        shape.restitution_curve = material.curve;
    }
    shape.yields_material = true;
    shape.filter.category = ball_category;
    shape.user_data = ball_tag + static_cast<std::uint64_t>(m_next_serial);
    m_scene.create_shape(body, Circle{{}, def.radius}, shape);
    m_scene.body(body).set_mass({.mass = def.mass, .center = {}, .inertia = 0.4f * def.mass * def.radius * def.radius});

    Ball ball;
    ball.state = {.body = body, .serial = m_next_serial++, .captive = captive_element != none, .position = position};
    ball.element = captive_element;
    ball.in_lane = m_lane.contains(position);
    m_balls.push_back(ball);
    return m_balls.back();
}

std::optional<GameEvent> Playfield::serve()
{
    const Vec2 spawn = m_table.ball.spawn;
    const QueryFilter balls{.mask = ball_category};
    if (!m_scene.overlap_shape(Circle{{}, m_table.ball.radius}, {.position = spawn}, balls).empty())
        return std::nullopt;
    const Ball& ball = add_ball(spawn);
    ++m_served;
    return GameEvent{.kind = EventKind::Served, .point = spawn, .ball = ball.state.serial};
}

// A hard plunge takes the ball away from the rod. One that lies there at the next hard one has not moved.
void Playfield::count_vain_plunges()
{
    constexpr float hard = 0.5f; // of the stroke
    if (std::ranges::none_of(m_balls,
                             [this](const Ball& b) { return b.state.is_free() && m_lane.is_before_rod(b.state.position); }))
        m_vain_plunges = 0;
    for (const GameEvent& event : m_events)
        if (event.kind == EventKind::PlungerReleased)
            m_vain_plunges += event.speed > hard * std::get<Plunger>(m_table.elements[event.element].part).stroke ? 1 : 0;
}

void Playfield::remove_drained()
{
    for (const Ball& ball : m_balls)
        if (ball.drained)
            m_scene.destroy(ball.state.body);
    std::erase_if(m_balls, [](const Ball& ball) { return ball.drained; });
}

int Playfield::balls_in_play() const
{
    return static_cast<int>(std::ranges::count_if(m_balls, [](const Ball& b) { return !b.state.captive; }));
}

void Playfield::hold(Ball& ball, Position at)
{
    Body body = m_scene.body(ball.state.body);
    body.set_velocity({});
    body.set_angular_velocity(0);
    body.teleport(at, 0);
    body.set_enabled(false);
    ball.state.held = true;
    ball.state.position = at;
    ball.state.velocity = {};
    ball.state.rolling = {};
    ball.state.spin = 0;
}

void Playfield::release(Ball& ball, Vec2 velocity)
{
    Body body = m_scene.body(ball.state.body);
    body.set_enabled(true);
    body.set_velocity(velocity);
    ball.state.held = false;
    ball.state.velocity = velocity;
}

void Playfield::throw_ball(Ball& ball, Vec2 velocity)
{
    m_scene.body(ball.state.body).set_velocity(velocity);
    ball.state.velocity = velocity;
}

// Before the rod it lies where it belongs, unless the rod cannot move it.
bool Playfield::is_lost(const Ball& ball) const
{
    constexpr int most_vain_plunges = 3;
    const bool waits = m_lane.is_before_rod(ball.state.position) && m_vain_plunges < most_vain_plunges;
    return ball.state.is_free() && !waits;
}

int Playfield::take_lost_balls()
{
    int lost = 0;
    for (Ball& ball : m_balls)
        if (is_lost(ball))
        {
            ball.drained = true;
            ++lost;
        }
    remove_drained();
    m_vain_plunges = 0;
    return lost;
}

bool Playfield::knows_all_balls() const
{
    return std::ranges::none_of(m_balls, [this](const Ball& ball) { return is_lost(ball); });
}

// --- For the elements ----------------------------------------------------------------------------------------------

BodyId Playfield::add_fixed(bool enabled) { return m_scene.create_body({.type = BodyType::Static, .enabled = enabled}); }

ShapeDef Playfield::surface(Index element) const
{
    ShapeDef def;
    if (const Index material = m_table.elements[element].material; material != none)
    {
        def.friction = m_table.materials[material].friction;
        def.restitution = m_table.materials[material].restitution;
        def.restitution_curve = m_table.materials[material].curve;
    }
    def.filter = {.category = fixed_category, .mask = ball_category};
    def.user_data = element + 1;
    return def;
}

ShapeDef Playfield::moving_surface(Index element) const
{
    ShapeDef def = surface(element);
    def.filter.category = moving_category;
    return def;
}

ShapeDef Playfield::trigger(Index element)
{
    ShapeDef def;
    def.trigger = true;
    def.filter = {.category = fixed_category, .mask = ball_category};
    def.user_data = element + 1;
    return def;
}

void Playfield::command(Index element, Command command) { m_devices[element]->command(*this, command); }

void Playfield::add_to(Hash& hash) const
{
    hash.add(m_scene.state_hash());
    hash.add(m_random.state());
    hash.add(m_step);
    hash.add(m_vain_plunges);
    hash.add(m_next_serial);
    m_cabinet.add_to(hash);
    for (const Ball& ball : m_balls)
    {
        hash.add(ball.state.serial);
        hash.add(ball.state.held);
        hash.add(ball.in_lane);
        hash.add(ball.state.rolling);
    }
    for (const auto& device : m_devices)
    {
        const ElementState& s = device->state;
        for (const float value : {s.angle, s.speed, s.travel})
            hash.add(value);
        for (const bool value : {s.down, s.lit, s.occupied})
            hash.add(value);
        hash.add(s.last_hit);
        device->add_to(hash);
    }
}

} // namespace carom::pinball
