// Whole turns of bodies, and the angles of hinges.

#include "dynamics/state/turns.h"

#include "core/trigonometry.h"

namespace carom::internal {

namespace {

constexpr double full_turn = 2 * 3.14159265358979323846;

std::int32_t nearest_turns(double angle)
{
    const double turns = std::round(angle / full_turn);
    return std::fabs(turns) < 1e9 ? static_cast<std::int32_t>(turns) : 0;
}

double angle_of(Rotation q) { return arc_tangent(q.s, q.c); }

// Wraps around after 2^31 turns.
void add_turns(std::int32_t& sum, std::int32_t turns)
{
    sum = static_cast<std::int32_t>(static_cast<std::uint32_t>(sum) + static_cast<std::uint32_t>(turns));
}

struct Turned
{
    Rotation rotation{};
    std::int32_t turns = 0;
};

Turned turned(const SceneState& state, int body)
{
    if (body == none)
        return {};
    const auto i = static_cast<std::size_t>(body);
    return {state.sims[i].rotation, state.turns[i]};
}

double whole_angle(const Turned& t) { return angle_of(t.rotation) + full_turn * t.turns; }

struct HingeTurn
{
    double angle;       ///< within -pi and pi
    std::int32_t turns; ///< since both bodies were at turn 0
};

HingeTurn hinge_turn(const SceneState& state, const JointRecord& joint)
{
    const Turned a = turned(state, joint.body_a);
    const Turned b = turned(state, joint.body_b);
    const Rotation relative = b.rotation * inverse(a.rotation) * Rotation::from_angle(-joint.reference_angle);
    const double angle = angle_of(relative);
    return {angle, nearest_turns(whole_angle(b) - whole_angle(a) - static_cast<double>(joint.reference_angle) - angle)};
}

// A rotation by less than a quarter turn passes pi, where another turn begins, if it changes the sign of s on the negative side.
std::int32_t turns_across(Rotation before, Rotation after)
{
    const int change = (after.s < 0 ? 1 : 0) - (before.s < 0 ? 1 : 0);
    return before.c + after.c < 0 ? change : 0;
}

} // namespace

std::int32_t whole_turns(Rotation before, Rotation after, double displacement)
{
    return nearest_turns(displacement - (angle_of(after) - angle_of(before)));
}

void begin_at_middle(SceneState& state, std::int32_t body, Rotation half, BodyState& s)
{
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    sim.rotation = half * sim.previous_rotation;
    s.delta_rotation = inverse(half);
    add_turns(state.turns[static_cast<std::size_t>(body)], turns_across(sim.previous_rotation, sim.rotation));
}

void begin_at_start(SceneState& state, std::int32_t body, BodyState& s)
{
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    add_turns(state.turns[static_cast<std::size_t>(body)], turns_across(sim.rotation, sim.previous_rotation));
    sim.rotation = sim.previous_rotation;
    s.delta_rotation = {};
}

void count_turns(std::int32_t& turns, Rotation before, Rotation after, double displacement)
{
    add_turns(turns, turns_by(before, after, displacement));
}

void count_turns(std::int32_t& turns, Rotation before, Rotation after)
{
    if (before.c < 0 || after.c < 0)
        count_turns(turns, before, after, angle_of(after * inverse(before)));
}

void count_turns(std::int32_t& turns, Rotation before, Rotation after, const BodyState& s)
{
    if (s.delta_rotation.c > 0)
        add_turns(turns, turns_across(before, after));
    else
        count_turns(turns, before, after, angle_of(s.delta_rotation));
    add_turns(turns, s.turns);
}

float hinge_angle(const SceneState& state, const JointRecord& joint)
{
    const HingeTurn h = hinge_turn(state, joint);
    return static_cast<float>(h.angle) + 2 * pi * static_cast<float>(h.turns - joint.turns); // as the lanes compute it
}

float shortest_angle(const SceneState& state, const JointRecord& joint)
{
    return static_cast<float>(hinge_turn(state, joint).angle);
}

void begin_counting(const SceneState& state, JointRecord& joint) { joint.turns = hinge_turn(state, joint).turns; }

} // namespace carom::internal
