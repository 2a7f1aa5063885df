// Stage 4, units: who is solved together. Islands (touching contacts and joints between dynamic bodies) persist until the graph changes;
// units are islands joined further where rows or flight paths may meet in this step. Everything a unit needs is laid side by side:
// its states, copies of the kinematic bodies it meets, its rows sorted by colour.
// A unit's kind depends on its content alone, never on threads or the order of other units.

#include "core/trigonometry.h"
#include "dynamics/body_store.h"
#include "dynamics/contact_store.h"
#include "dynamics/contact_update.h"
#include "dynamics/force_laws.h"
#include "dynamics/joint_direct.h"
#include "dynamics/joint_solver.h"
#include "dynamics/material.h"
#include "dynamics/prepare.h"
#include "dynamics/stages.h"
#include "dynamics/unit_energy.h"
#include "dynamics/wide_kernels.h"
#include "dynamics/wide_prepare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <optional>

namespace carom::internal {

namespace {

constexpr int precise_limit = 32;    // bodies: beyond it a contact more or less does not decide where a ball goes
constexpr float slice_turn = 0.02f;  // rad
constexpr float slice_swing = 0.25f; // rad, of a joint's arm
constexpr int slice_limit = 32;
constexpr int color_limit = 63; // the mask's last bit stands for "no colour left"

// --- union-find over places in awake_bodies ---------------------------------------------------------------------------------------

std::int32_t find_root(std::vector<std::int32_t>& parent, std::int32_t i)
{
    while (parent[static_cast<std::size_t>(i)] != i)
    {
        std::int32_t& up = parent[static_cast<std::size_t>(i)];
        up = parent[static_cast<std::size_t>(up)];
        i = up;
    }
    return i;
}

// The lesser place becomes the root: the result does not depend on the order of the links.
void link(std::vector<std::int32_t>& parent, std::int32_t a, std::int32_t b)
{
    a = find_root(parent, a);
    b = find_root(parent, b);
    if (a != b)
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

bool is_moving_dynamic(const SceneState& state, int body)
{
    return body != none && state.bodies[body].type == BodyType::Dynamic && state.bodies[body].awake_index != none;
}

void link_bodies(StepContext& ctx, int a, int b)
{
    if (is_moving_dynamic(ctx.state, a) && is_moving_dynamic(ctx.state, b))
        link(ctx.scratch.parent, ctx.state.bodies[a].awake_index, ctx.state.bodies[b].awake_index);
}

void reset_parents(StepContext& ctx)
{
    std::vector<std::int32_t>& parent = ctx.scratch.parent;
    parent.resize(ctx.state.awake_bodies.size());
    for (std::size_t i = 0; i < parent.size(); ++i)
        parent[i] = static_cast<std::int32_t>(i);
}

// --- what is solved in this step --------------------------------------------------------------------------------------------------

bool gets_rows(const SceneState& state, const Contact& contact)
{
    return contact.manifold.count > 0 && (contact.flags & contact_flag::passing) == 0 &&
           (is_moving_dynamic(state, contact.body_a) || is_moving_dynamic(state, contact.body_b));
}

constexpr std::int32_t earthbound = -2; ///< in Builder::flight

// What may fly: a body without joints, or one on a single hinge to the world that nothing drives.
std::int32_t flight_of(const SceneState& state, int body)
{
    const BodyRecord& record = state.bodies[body];
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    const int edge = record.first_joint;
    if (edge == none)
        return sim.inverse_mass != Vec2{} || sim.inverse_inertia != 0 ? none : earthbound;
    const JointRecord& joint = state.joints[edge >> 1];
    const int other = joint.body_a == body ? joint.body_b : joint.body_a;
    const bool hinged = joint.kind == JointType::Revolute && !joint.enable_motor && joint.hertz == 0 &&
                        joint.next[edge & 1] == none && (other == none || state.bodies[other].type == BodyType::Static) &&
                        sim.inverse_inertia > 0;
    if (!hinged)
        return earthbound;
    // A body that may not move along is held twice: it turns only if the pivot is its center of mass.
    const Vec2 anchor = joint.body_a == body ? joint.anchor_a : joint.anchor_b;
    const bool centered = anchor == sim.local_center;
    return centered || (sim.inverse_mass.x > 0 && sim.inverse_mass.y > 0) ? edge >> 1 : earthbound;
}

// The hinge's two points must be in one place; flight does not pull them together.
bool is_closed(const StepContext& ctx, int index, int body)
{
    const JointRecord& joint = ctx.state.joints[index];
    const auto world = [&](int b, Vec2 anchor)
    { return b == none ? Position(anchor) : transform(ctx.state.sims[static_cast<std::size_t>(b)].pose(), anchor); };
    const Vec2 gap = world(joint.body_b, joint.anchor_b) - world(joint.body_a, joint.anchor_a);
    return body != none && length(gap) <= 0.1f * ctx.scene.tolerances.slop;
}

// Is it borne, or does it overlap something that must be pushed out? Then it does not fly. What will be apart by itself within the step need not
// be pushed.
bool is_loaded(const StepContext& ctx, const Contact& contact)
{
    const float separation = least_separation(contact.manifold);
    const bool loaded = separation <= ctx.scene.tolerances.speculation && (contact.flags & contact_flag::loaded) != 0;
    return loaded || (separation < -ctx.scene.tolerances.slop &&
                      motion_of(ctx, contact.body_a) + motion_of(ctx, contact.body_b) < -4 * separation);
}

// --- building ---------------------------------------------------------------------------------------------------------------------

struct Builder
{
    StepContext& ctx;
    SceneState& state;
    Scratch& scratch;
    std::vector<std::int32_t> flight;        ///< by place in awake_bodies: earthbound, none (free), or the hinge it turns on
    std::vector<std::int32_t> grounded;      ///< the same of what could fly but bears or is borne by something
    std::vector<std::uint8_t> may_be_struck; ///< by what flies, by place in awake_bodies

    explicit Builder(StepContext& context) : ctx(context), state(context.state), scratch(context.scratch) {}

    void find_fliers()
    {
        flight.assign(state.awake_bodies.size(), earthbound);
        grounded.assign(state.awake_bodies.size(), earthbound);
        if (!ctx.scene.def.continuous)
            return;
        for (std::size_t i = 0; i < state.awake_bodies.size(); ++i)
        {
            const int body = state.awake_bodies[i];
            if (state.bodies[body].type != BodyType::Dynamic)
                continue;
            const std::int32_t kind = flight_of(state, body);
            if (kind != earthbound && (kind == none || is_closed(ctx, kind, body)))
                flight[i] = kind;
        }
    }

    // The one walk over all contacts; what follows goes over the links. A body that a contact loads does not fly.
    void gather_links()
    {
        scratch.links.clear();
        for (const std::int32_t index : state.awake_contacts)
        {
            Contact& contact = state.contacts[index];
            contact.color = contact.wide = none;
            const bool touching = (contact.flags & contact_flag::touching) != 0;
            const bool solved = contact.manifold.count > 0 && (contact.flags & contact_flag::passing) == 0;
            if (!touching && !solved)
                continue;
            const Link l{index, place_of(contact.body_a), place_of(contact.body_b), touching, solved};
            if (l.a < 0 && l.b < 0)
                continue;
            scratch.links.push_back(l);
            ctx.report.touching += touching ? 1 : 0;
            if (solved && is_loaded(ctx, contact))
            {
                ground(l.a);
                ground(l.b);
            }
        }
    }

    [[nodiscard]] std::int32_t place_of(int body) const
    {
        const BodyRecord& record = state.bodies[body];
        if (record.awake_index == none || record.type == BodyType::Static)
            return none;
        return record.type == BodyType::Dynamic ? record.awake_index : -2 - record.awake_index;
    }

    void ground(std::int32_t place)
    {
        if (place < 0 || flight[static_cast<std::size_t>(place)] == earthbound)
            return;
        grounded[static_cast<std::size_t>(place)] = flight[static_cast<std::size_t>(place)];
        flight[static_cast<std::size_t>(place)] = earthbound;
    }

    // Islands: relabelled only when the graph has changed.
    void label_islands()
    {
        if (!state.graph_dirty)
            return;
        reset_parents(ctx);
        for (const Link& l : scratch.links)
        {
            if (l.touching && l.a >= 0 && l.b >= 0)
                link(scratch.parent, l.a, l.b);
        }
        for (int j = 0; j < state.joints.capacity(); ++j)
        {
            if (state.joints.is_live(j))
                link_bodies(ctx, state.joints[j].body_a, state.joints[j].body_b);
        }
        for (const std::int32_t body : state.awake_bodies)
        {
            const std::int32_t root = find_root(scratch.parent, state.bodies[body].awake_index);
            state.bodies[body].island = state.awake_bodies[static_cast<std::size_t>(root)];
        }
        state.graph_dirty = false;
    }

    // In a crowd only what shoots through it flies: the others' contacts are speculative, and a contact more or less does not decide their
    // way.
    void ground_crowds()
    {
        std::vector<std::int32_t> fliers(scratch.units.size(), 0);
        for (std::size_t i = 0; i < flight.size(); ++i)
        {
            if (flight[i] != earthbound)
                ++fliers[static_cast<std::size_t>(scratch.unit_of[i])];
        }
        for (std::size_t i = 0; i < flight.size(); ++i)
        {
            if (flight[i] == earthbound || fliers[static_cast<std::size_t>(scratch.unit_of[i])] <= precise_limit)
                continue;
            if (!shoots(state.awake_bodies[i]))
                std::swap(flight[i], grounded[i]);
        }
    }

    // Goes half its size or more in a sub-step, also as its neighbours see it.
    [[nodiscard]] bool shoots(int body) const
    {
        const float limit = 0.5f * state.sims[static_cast<std::size_t>(body)].size / ctx.h;
        const Vec2 v = state.sims[static_cast<std::size_t>(body)].velocity;
        bool shoots = length(v) > limit;
        for (int edge = state.bodies[body].first_contact; shoots && edge != none; edge = state.contacts[edge >> 1].next[edge & 1])
        {
            const Contact& contact = state.contacts[edge >> 1];
            const int other = other_body(contact, body);
            shoots = !gets_rows(state, contact) || state.bodies[other].type != BodyType::Dynamic ||
                     length(v - state.sims[static_cast<std::size_t>(other)].velocity) > limit;
        }
        return shoots;
    }

    // A contact whose normal turns with a bar or a bat, and a joint whose arm swings, are followed in slices of at most this turn.
    void choose_slices()
    {
        std::vector<std::int32_t> bodies(scratch.units.size(), 0);
        for (const std::int32_t u : scratch.unit_of)
        {
            if (u != none)
                ++bodies[static_cast<std::size_t>(u)];
        }
        const auto slice = [&](int a, int b, float rate, float most_turn, int most_bodies)
        {
            const std::int32_t u = unit_of_pair(a, b);
            if (u == none || bodies[static_cast<std::size_t>(u)] > most_bodies)
                return;
            const auto wanted = static_cast<int>(std::ceil(std::min(ctx.h * rate / most_turn, static_cast<float>(slice_limit))));
            std::int32_t& slices = scratch.units[static_cast<std::size_t>(u)].slices;
            slices = std::max(slices, wanted);
        };
        for (const Link& l : scratch.links)
        {
            const std::int32_t u = scratch.unit_of[static_cast<std::size_t>(l.a >= 0 ? l.a : l.b)];
            if (!l.solved || bodies[static_cast<std::size_t>(u)] > precise_limit)
                continue;
            const Contact& c = state.contacts[l.contact];
            slice(c.body_a, c.body_b, turn_rate(c), slice_turn, precise_limit);
        }
        for (int j = 0; j < state.joints.capacity(); ++j)
        {
            if (state.joints.is_live(j))
                slice(state.joints[j].body_a, state.joints[j].body_b, swing_rate(state.joints[j]), slice_swing,
                      UnitEnergy::most_bodies);
        }
    }

    // How fast a joint's arms turn, in rad/s.
    [[nodiscard]] float swing_rate(const JointRecord& joint) const
    {
        if (joint.kind == JointType::Spring)
            return 0;
        const auto spin = [&](int body, Vec2 anchor)
        {
            const bool turns = body != none && (anchor != state.sims[static_cast<std::size_t>(body)].local_center ||
                                                joint.kind == JointType::Prismatic);
            return turns ? std::fabs(state.sims[static_cast<std::size_t>(body)].angular_velocity) : 0;
        };
        return std::max(spin(joint.body_a, joint.anchor_a), spin(joint.body_b, joint.anchor_b));
    }

    // Of the normal, in rad/s, where a driven body turns: with it, and around a corner of it that a ball may slide over. What turns freely
    // is followed exactly in flight.
    [[nodiscard]] float turn_rate(const Contact& contact) const
    {
        const float driven = std::max(driven_spin(contact.body_a), driven_spin(contact.body_b));
        if (driven * ctx.h < 0.1f * slice_turn)
            return 0;
        const BodySim& a = state.sims[static_cast<std::size_t>(contact.body_a)];
        const BodySim& b = state.sims[static_cast<std::size_t>(contact.body_b)];
        const Vec2 arm = b.center - a.center;
        const Vec2 slide = b.velocity - a.velocity - cross(a.angular_velocity, arm);
        const float radius = std::max(state.shapes[contact.shape_a].leaf.r0, state.shapes[contact.shape_b].leaf.r0);
        return driven + ((contact.flags & contact_flag::round) != 0 && radius > 0 ? length(slide) / radius : 0);
    }

    [[nodiscard]] float driven_spin(int body) const
    {
        const bool driven =
            state.bodies[body].type == BodyType::Kinematic || (is_moving_dynamic(state, body) && flight_of(state, body) >= 0);
        return driven ? std::fabs(state.sims[static_cast<std::size_t>(body)].angular_velocity) + greatest_spin_of_law(ctx, body)
                      : 0;
    }

    [[nodiscard]] bool flies(int body) const
    {
        return is_moving_dynamic(state, body) && flight[static_cast<std::size_t>(state.bodies[body].awake_index)] != earthbound;
    }

    // Islands first, then what this step adds.
    void link_units()
    {
        reset_parents(ctx);
        for (const std::int32_t body : state.awake_bodies)
        {
            if (state.bodies[body].type == BodyType::Dynamic)
                link_bodies(ctx, body, state.bodies[body].island);
        }
        for (const Link& l : scratch.links)
        {
            if (l.solved && l.a >= 0 && l.b >= 0)
                link(scratch.parent, l.a, l.b);
        }
    }

    // A ball that will hit something may then go anywhere within its reach: whoever else flies there must be in the same unit, or the
    // two would meet in different times.
    void link_deflected()
    {
        struct Reach
        {
            FloatBox box;
            int body;
        };
        std::vector<Reach> reaches;
        for (std::size_t i = 0; i < state.awake_bodies.size(); ++i)
        {
            const int body = state.awake_bodies[i];
            if (flight[i] == earthbound || !may_be_deflected(body))
                continue;
            const Position c = state.sims[static_cast<std::size_t>(body)].center;
            const double r =
                static_cast<double>(scratch.motion[i]) + static_cast<double>(state.sims[static_cast<std::size_t>(body)].extent);
            reaches.push_back({round_outwards(c.x - r, c.y - r, c.x + r, c.y + r), body});
        }
        may_be_struck.assign(state.awake_bodies.size(), 0);
        for (const Reach& reach : reaches)
        {
            state.broad_phase.query(Layer::Moving, reach.box,
                                    [&](int shape)
                                    {
                                        const int body = state.shapes[shape].body;
                                        link_bodies(ctx, reach.body, body);
                                        may_be_struck[static_cast<std::size_t>(state.bodies[body].awake_index)] = 1;
                                        return true;
                                    });
        }
        // Two that are both deflected: reach against reach, by a sweep along x.
        std::sort(reaches.begin(), reaches.end(),
                  [](const Reach& a, const Reach& b) { return a.box.lx != b.box.lx ? a.box.lx < b.box.lx : a.body < b.body; });
        for (std::size_t i = 0; i < reaches.size(); ++i)
        {
            for (std::size_t j = i + 1; j < reaches.size() && reaches[j].box.lx <= reaches[i].box.ux; ++j)
            {
                if (overlaps(reaches[i].box, reaches[j].box))
                    link_bodies(ctx, reaches[i].body, reaches[j].body);
            }
        }
    }

    [[nodiscard]] bool may_be_deflected(int body) const
    {
        for (int edge = state.bodies[body].first_contact; edge != none; edge = state.contacts[edge >> 1].next[edge & 1])
        {
            if (gets_rows(state, state.contacts[edge >> 1]))
                return scratch.motion[static_cast<std::size_t>(state.bodies[body].awake_index)] >
                       ctx.scene.tolerances.speculation;
        }
        return false;
    }

    // Units in the order of their first body; every dynamic body gets its unit.
    void number_units()
    {
        const std::size_t n = state.awake_bodies.size();
        scratch.units.clear();
        scratch.unit_of.assign(n, none);
        for (std::size_t i = 0; i < n; ++i)
        {
            if (state.bodies[state.awake_bodies[i]].type != BodyType::Dynamic)
                continue;
            const auto root = static_cast<std::size_t>(find_root(scratch.parent, static_cast<std::int32_t>(i)));
            if (root == i)
            {
                scratch.unit_of[i] = static_cast<std::int32_t>(scratch.units.size());
                scratch.units.emplace_back();
            }
            else
            {
                scratch.unit_of[i] = scratch.unit_of[root];
            }
        }
    }

    [[nodiscard]] std::int32_t unit_of_pair(int a, int b) const
    {
        const int body = is_moving_dynamic(state, a) ? a : b;
        return is_moving_dynamic(state, body) ? scratch.unit_of[static_cast<std::size_t>(state.bodies[body].awake_index)] : none;
    }

    // A stable counting sort of items by unit: fills `sorted` and calls set_range(unit, first, count).
    template <class Item, class UnitOf, class SetRange>
    void sort_by_unit(const std::vector<Item>& items, std::vector<Item>& sorted, UnitOf&& unit_of, SetRange&& set_range)
    {
        std::vector<std::int32_t> starts(scratch.units.size() + 1, 0);
        std::vector<std::int32_t> units(items.size());
        for (std::size_t i = 0; i < items.size(); ++i)
        {
            units[i] = unit_of(items[i]);
            if (units[i] != none)
                ++starts[static_cast<std::size_t>(units[i]) + 1];
        }
        for (std::size_t u = 0; u < scratch.units.size(); ++u)
        {
            set_range(scratch.units[u], starts[u], starts[u + 1]);
            starts[u + 1] += starts[u];
        }
        sorted.resize(static_cast<std::size_t>(starts.back()));
        for (std::size_t i = 0; i < items.size(); ++i)
        {
            if (units[i] != none)
                sorted[static_cast<std::size_t>(starts[static_cast<std::size_t>(units[i])]++)] = items[i];
        }
    }

    // Bodies in flight meet things at their own time; a row would stop them early.
    [[nodiscard]] bool in_flight(std::int32_t place) const
    {
        return place >= 0 && flight[static_cast<std::size_t>(place)] != earthbound;
    }

    void sort_links()
    {
        std::erase_if(scratch.links, [&](const Link& l) { return !l.solved || in_flight(l.a) || in_flight(l.b); });
        sort_by_unit(
            scratch.links, scratch.solved_links,
            [&](const Link& l) { return scratch.unit_of[static_cast<std::size_t>(l.a >= 0 ? l.a : l.b)]; },
            [](Unit& unit, int first, int count)
            {
                unit.first_row = first;
                unit.row_count = count;
            });
    }

    void sort_joints()
    {
        std::vector<std::int32_t> chosen;
        for (int j = 0; j < state.joints.capacity(); ++j)
        {
            if (!state.joints.is_live(j))
                continue;
            const JointRecord& joint = state.joints[j];
            const bool enabled = (joint.body_a == none || state.bodies[joint.body_a].enabled) &&
                                 (joint.body_b == none || state.bodies[joint.body_b].enabled);
            if (enabled && (is_moving_dynamic(state, joint.body_a) || is_moving_dynamic(state, joint.body_b)))
                chosen.push_back(j);
        }
        sort_by_unit(
            chosen, scratch.solved_joints, [&](int j) { return unit_of_pair(state.joints[j].body_a, state.joints[j].body_b); },
            [](Unit& unit, int first, int count)
            {
                unit.first_joint = first;
                unit.joint_count = count;
            });
    }

    // States unit by unit: dynamic bodies in awake order.
    void lay_out_states()
    {
        std::vector<std::int32_t> places(state.awake_bodies.size());
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i] = static_cast<std::int32_t>(i);
        std::vector<std::int32_t> sorted;
        sort_by_unit(
            places, sorted, [&](int i) { return scratch.unit_of[static_cast<std::size_t>(i)]; },
            [](Unit& unit, int first, int count)
            {
                unit.first_state = first;
                unit.state_count = count;
            });
        scratch.states.clear();
        scratch.constants.clear();
        scratch.state_bodies.clear();
        scratch.state_of.assign(state.awake_bodies.size(), none);
        scratch.fliers.clear();
        scratch.laws.clear();
        for (Unit& unit : scratch.units)
        {
            const int first = unit.first_state;
            const std::optional<StepContext> cut = unit.slices > 1 ? std::optional(sliced(ctx, unit.slices)) : std::nullopt;
            const StepContext& unit_ctx = cut ? *cut : ctx;
            unit.first_state = static_cast<std::int32_t>(scratch.states.size());
            unit.first_flier = static_cast<std::int32_t>(scratch.fliers.size());
            unit.first_law = static_cast<std::int32_t>(scratch.laws.size());
            unit.precise = unit.state_count <= precise_limit;
            unit.dynamic_count = unit.state_count;
            unit.alone = unit.dynamic_count == 1 && is_alone(sorted[static_cast<std::size_t>(first)]);
            add_fixed_state(none); // stands for every body that does not move, so that units share nothing
            for (int i = first; i < first + unit.state_count; ++i)
                add_dynamic_state(unit_ctx, unit, sorted[static_cast<std::size_t>(i)]);
            unit.flier_count = static_cast<std::int32_t>(scratch.fliers.size()) - unit.first_flier;
            unit.law_count = static_cast<std::int32_t>(scratch.laws.size()) - unit.first_law;
            for (int i = 0; i < unit.flier_count; ++i)
                copy_kinematic_neighbours(unit, scratch.fliers[static_cast<std::size_t>(unit.first_flier + i)].body);
            add_rows(unit_ctx, unit);
            unit.state_count = static_cast<std::int32_t>(scratch.states.size()) - unit.first_state;
        }
    }

    void add_dynamic_state(const StepContext& unit_ctx, const Unit& unit, std::int32_t place)
    {
        const int body = state.awake_bodies[static_cast<std::size_t>(place)];
        const auto index = static_cast<std::int32_t>(scratch.states.size());
        scratch.state_of[static_cast<std::size_t>(place)] = index;
        scratch.states.push_back(initial_state(state, body));
        scratch.constants.push_back(state_constants(unit_ctx, body));
        scratch.state_bodies.push_back(body);
        state.bodies[body].crowded = !unit.precise;
        if (force_law_of(ctx, body) != nullptr)
            scratch.laws.push_back({index, scratch.constants.back().angular_acceleration, scratch.constants.back().acceleration});
        if (unit.alone)
        {
            scratch.states.back().flags |= body_flag::alone;
            ++ctx.report.flight_bodies;
        }
        else if (const std::int32_t kind = flight[static_cast<std::size_t>(place)]; kind != earthbound)
        {
            scratch.states.back().flags |= body_flag::flier;
            ++ctx.report.flight_bodies;
            if (kind != none)
                forget_impulses(state.joints[kind]);
            scratch.fliers.push_back(make_flier(unit_ctx, index, body, kind));
        }
        else if (const std::int32_t could = grounded[static_cast<std::size_t>(place)];
                 could != earthbound && (unit.precise || may_take_off(place, could)))
        {
            scratch.fliers.push_back(make_flier(unit_ctx, index, body, could));
            scratch.fliers.back().landed = true;
        }
    }

    [[nodiscard]] bool is_free_of_loads(int body) const
    {
        const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
        return sim.force == Vec2{} && sim.torque == 0 && force_law_of(ctx, body) == nullptr;
    }

    [[nodiscard]] bool is_alone(std::int32_t place) const
    {
        const int body = state.awake_bodies[static_cast<std::size_t>(place)];
        const BodyRecord& record = state.bodies[body];
        return flight[static_cast<std::size_t>(place)] == none && record.first_joint == none && meets_nothing(record) &&
               is_free_of_loads(body) && !ctx.scene.def.record_substeps;
    }

    // Pairs without points do not meet on the ways that both set out on; triggers want to see the way.
    [[nodiscard]] bool meets_nothing(const BodyRecord& record) const
    {
        for (int edge = record.first_contact; edge != none; edge = state.contacts[edge >> 1].next[edge & 1])
        {
            const Contact& contact = state.contacts[edge >> 1];
            if (contact.manifold.count > 0 ||
                (contact.flags & (contact_flag::trigger | contact_flag::plain)) != contact_flag::plain)
                return false;
        }
        return true;
    }

    // In a crowd only what flies, or a law, makes anything fast enough to fly within the step.
    [[nodiscard]] bool may_take_off(std::int32_t place, std::int32_t kind) const
    {
        return may_be_struck[static_cast<std::size_t>(place)] != 0 || kind != none ||
               force_law_of(ctx, state.awake_bodies[static_cast<std::size_t>(place)]) != nullptr;
    }

    // A flier may land on a kinematic body, which then needs its place in the unit.
    void copy_kinematic_neighbours(const Unit& unit, int body)
    {
        for (int edge = state.bodies[body].first_contact; edge != none; edge = state.contacts[edge >> 1].next[edge & 1])
        {
            const int other = other_body(state.contacts[edge >> 1], body);
            if (state.bodies[other].type == BodyType::Kinematic)
                static_cast<void>(state_for(unit, other));
        }
    }

    std::int32_t add_fixed_state(int body)
    {
        scratch.states.push_back(body == none ? BodyState{} : initial_state(state, body));
        scratch.constants.emplace_back();
        scratch.state_bodies.push_back(body);
        return static_cast<std::int32_t>(scratch.states.size()) - 1;
    }

    // The state of a body as this unit's rows see it. Kinematic bodies are copied into every unit they meet: their path is a function of
    // time alone, and units then share nothing that is written.
    std::int32_t state_for(const Unit& unit, int body)
    {
        if (body == none || state.bodies[body].awake_index == none)
            return unit.first_state;
        const auto place = static_cast<std::size_t>(state.bodies[body].awake_index);
        if (state.bodies[body].type == BodyType::Dynamic)
            return scratch.state_of[place];
        std::int32_t& copy = scratch.state_of[place];
        if (copy < unit.first_state)
            copy = add_fixed_state(body);
        return copy;
    }

    // Rows sorted by colour: the least colour that neither moving body has yet, in the order of the contacts.
    void add_rows(const StepContext& unit_ctx, Unit& unit)
    {
        scratch.color_masks.resize(scratch.states.size());
        std::fill(scratch.color_masks.begin() + unit.first_state, scratch.color_masks.end(), 0);
        const std::span<Link> links =
            std::span(scratch.solved_links)
                .subspan(static_cast<std::size_t>(unit.first_row), static_cast<std::size_t>(unit.row_count));
        for (Link& l : links)
        { // from here on: states
            l.a = state_at(unit, l.a);
            l.b = state_at(unit, l.b);
        }
        unit.first_row = static_cast<std::int32_t>(scratch.rows.size());
        unit.first_impact_row = static_cast<std::int32_t>(scratch.impact_rows.size());
        unit.first_wide = static_cast<std::int32_t>(scratch.wide_rows.size());
        unit.first_core = static_cast<std::int32_t>(scratch.cores.size());
        if (is_wide(unit))
            add_wide_rows(unit_ctx, unit, links);
        else
            add_narrow_rows(unit_ctx, unit, links);
        unit.row_count = static_cast<std::int32_t>(scratch.rows.size()) - unit.first_row;
        unit.wide_count = static_cast<std::int32_t>(scratch.wide_rows.size()) - unit.first_wide;
        unit.core_count = static_cast<std::int32_t>(scratch.cores.size()) - unit.first_core;
        unit.impact_row_count = static_cast<std::int32_t>(scratch.impact_rows.size()) - unit.first_impact_row;
        add_joints(unit_ctx, unit);
    }

    // Not what is looked at anew within the step, sliced, or watched for its energy.
    [[nodiscard]] static bool is_wide(const Unit& unit)
    {
        return !unit.precise && unit.slices == 1 && (unit.joint_count == 0 || unit.dynamic_count > UnitEnergy::most_bodies);
    }

    void add_narrow_rows(const StepContext& unit_ctx, Unit& unit, std::span<const Link> links)
    {
        std::vector<std::int32_t>& order = scratch.order;
        order.resize(links.size());
        for (std::size_t i = 0; i < links.size(); ++i)
        {
            assign_color(unit, links[i]);
            order[i] = static_cast<std::int32_t>(i);
        }
        const auto color = [&](int i) { return state.contacts[links[static_cast<std::size_t>(i)].contact].color; };
        std::stable_sort(order.begin(), order.end(), [&](int x, int y) { return color(x) < color(y); });
        for (const std::int32_t i : order)
            add_row(unit_ctx, unit, links[static_cast<std::size_t>(i)]);
    }

    // Eight by eight, each group of one colour and one number of points. What does not fit follows in rows of its own.
    void add_wide_rows(const StepContext& unit_ctx, Unit& unit, std::span<const Link> links)
    {
        std::vector<std::int32_t>& filled = scratch.lanes_of_bin; // of each bin; then where its next lane goes
        filled.assign(2 * (color_limit + 1), 0);
        const auto bin_of = [&](const Contact& c)
        { return static_cast<std::size_t>(2 * c.color + (c.manifold.count == 2 ? 0 : 1)); };
        std::vector<std::int32_t>& narrow = scratch.order;
        narrow.clear();
        for (std::size_t i = 0; i < links.size(); ++i)
        {
            assign_color(unit, links[i]);
            const Contact& contact = state.contacts[links[i].contact];
            if (contact.color == color_limit || !fits_lane(ctx, contact, links[i]))
                narrow.push_back(static_cast<std::int32_t>(i));
            else
                ++filled[bin_of(contact)];
        }
        std::int32_t lane = unit.first_wide * lane_count;
        for (std::int32_t& count : filled)
        {
            const std::int32_t first = lane;
            lane += (count + lane_count - 1) / lane_count * lane_count;
            count = first;
        }
        add_empty_rows(scratch, unit.first_state, lane / lane_count);
        std::size_t next_narrow = 0;
        for (std::size_t i = 0; i < links.size(); ++i)
        {
            if (next_narrow < narrow.size() && narrow[next_narrow] == static_cast<std::int32_t>(i))
            {
                ++next_narrow;
                continue;
            }
            Contact& contact = state.contacts[links[i].contact];
            contact.wide = filled[bin_of(contact)]++;
            fill_lane(ctx, links[i], contact.wide);
            unbind(links[i].a, links[i].b);
        }
        wide_kernels().prepare(scratch.wide_rows.data() + unit.first_wide, lane / lane_count - unit.first_wide);
        for (const std::int32_t i : narrow)
            add_row(unit_ctx, unit, links[static_cast<std::size_t>(i)]);
    }

    void assign_color(Unit& unit, const Link& l)
    {
        const int color = free_color(l.a, l.b);
        state.contacts[l.contact].color = color;
        if (color == color_limit)
            ctx.report.flags |= static_cast<std::uint32_t>(StepFlag::ColorsExhausted);
        else
            unit.colors = std::max(unit.colors, color + 1);
    }

    // The least that neither moving body has yet; it is theirs then.
    int free_color(std::int32_t a, std::int32_t b)
    {
        const auto dynamic = [&](std::int32_t s)
        { return (scratch.states[static_cast<std::size_t>(s)].flags & body_flag::dynamic) != 0; };
        std::uint64_t unused_a = 0;
        std::uint64_t unused_b = 0;
        std::uint64_t& mask_a = dynamic(a) ? scratch.color_masks[static_cast<std::size_t>(a)] : unused_a;
        std::uint64_t& mask_b = dynamic(b) ? scratch.color_masks[static_cast<std::size_t>(b)] : unused_b;
        const int color = std::min(std::countr_one(mask_a | mask_b), color_limit);
        if (color == color_limit)
            return color;
        mask_a |= std::uint64_t{1} << color;
        mask_b |= std::uint64_t{1} << color;
        return color;
    }

    void add_row(const StepContext& unit_ctx, const Unit& unit, const Link& l)
    {
        const Contact& contact = state.contacts[l.contact];
        scratch.rows.push_back(prepare_row(unit_ctx, l.contact, contact.manifold, l.a, l.b));
        follow_closely(contact, unit, scratch.rows.back());
        if ((contact.flags & contact_flag::loaded) == 0)
            scratch.impact_rows.push_back(static_cast<std::int32_t>(scratch.rows.size()) - 1);
        unbind(l.a, l.b);
    }

    void unbind(std::int32_t a, std::int32_t b)
    {
        scratch.states[static_cast<std::size_t>(a)].flags &= ~body_flag::unbound;
        scratch.states[static_cast<std::size_t>(b)].flags &= ~body_flag::unbound;
    }

    [[nodiscard]] std::int32_t state_at(const Unit& unit, std::int32_t place)
    {
        if (place >= 0)
            return scratch.state_of[static_cast<std::size_t>(place)];
        return state_for(unit, place == none ? none : state.awake_bodies[static_cast<std::size_t>(-2 - place)]);
    }

    // The hinges of a unit with more joints than are solved directly go side by side, by colour; the others one by one.
    void add_joints(const StepContext& unit_ctx, Unit& unit)
    {
        const int first = unit.first_joint;
        const int count = unit.joint_count;
        const bool wide = is_wide(unit) && count > DirectSolve::most_rows / 2;
        unit.first_joint = static_cast<std::int32_t>(scratch.joints.size());
        unit.first_wide_joint = static_cast<std::int32_t>(scratch.wide_joints.size());
        if (wide)
            std::fill(scratch.color_masks.begin() + unit.first_state, scratch.color_masks.end(), 0);
        scratch.joint_lanes.clear();
        for (int i = first; i < first + count; ++i)
        {
            const std::int32_t joint = scratch.solved_joints[static_cast<std::size_t>(i)];
            if (!wide || !add_wide_joint(unit, joint))
                add_joint(unit_ctx, unit, joint);
        }
        fill_wide_joints(unit);
        unit.joint_count = static_cast<std::int32_t>(scratch.joints.size()) - unit.first_joint;
        unit.wide_joint_count = static_cast<std::int32_t>(scratch.wide_joints.size()) - unit.first_wide_joint;
    }

    // Finds its colour; false where it must stand alone.
    bool add_wide_joint(const Unit& unit, std::int32_t index)
    {
        const JointRecord& joint = state.joints[index];
        const std::int32_t a = state_for(unit, joint.body_a);
        const std::int32_t b = state_for(unit, joint.body_b);
        if (!fits_joint_lane(ctx, joint, a, b) || may_fly(joint.body_a) || may_fly(joint.body_b))
            return false;
        const std::int32_t color = free_color(a, b);
        if (color == color_limit)
            return false;
        scratch.joint_lanes.push_back({2 * color + (only_holds(joint) ? 0 : 1), index, a, b});
        return true;
    }

    // About a hinge to the world.
    [[nodiscard]] bool may_fly(int body) const
    {
        if (!is_moving_dynamic(state, body))
            return false;
        const auto place = static_cast<std::size_t>(state.bodies[body].awake_index);
        return flight[place] != earthbound || grounded[place] != earthbound;
    }

    void fill_wide_joints(const Unit& unit)
    {
        std::stable_sort(scratch.joint_lanes.begin(), scratch.joint_lanes.end(),
                         [](const JointLane& x, const JointLane& y) { return x.bin < y.bin; });
        int lane = 0;
        std::int32_t bin = none;
        for (const JointLane& l : scratch.joint_lanes)
        {
            if (l.bin != bin || lane == lane_count)
            {
                scratch.wide_joints.push_back(empty_wide_joint(unit.first_state));
                lane = 0;
            }
            bin = l.bin;
            fill_joint_lane(ctx, l.joint, l.a, l.b, scratch.wide_joints.back(), lane++);
            if (!only_holds(state.joints[l.joint]))
                unbind(l.a, l.b);
        }
    }

    void add_joint(const StepContext& unit_ctx, const Unit& unit, std::int32_t joint)
    {
        const JointRecord& record = state.joints[joint];
        const std::int32_t a = state_for(unit, record.body_a);
        const std::int32_t b = state_for(unit, record.body_b);
        scratch.joints.push_back(prepare_joint(unit_ctx, joint, a, b));
        if (only_holds(record) || record.kind == JointType::Spring)
            return;
        unbind(a, b);
    }

    void index_fliers()
    {
        scratch.flier_of_state.assign(scratch.states.size(), none);
        scratch.versions.assign(scratch.states.size(), 0);
        scratch.holds.resize(std::max(scratch.holds.size(), scratch.fliers.size() * Flier::most_held));
        for (std::size_t i = 0; i < scratch.fliers.size(); ++i)
        {
            scratch.flier_of_state[static_cast<std::size_t>(scratch.fliers[i].state)] = static_cast<std::int32_t>(i);
            scratch.fliers[i].held = scratch.holds.data() + i * Flier::most_held;
        }
    }

    void count()
    {
        ctx.report.units = static_cast<int>(scratch.units.size());
        for (const Unit& unit : scratch.units)
            ctx.report.colors = std::max(ctx.report.colors, static_cast<int>(unit.colors));
    }
};

} // namespace

void build_units(StepContext& ctx)
{
    ctx.scratch.rows.clear();
    ctx.scratch.impact_rows.clear();
    ctx.scratch.joints.clear();
    ctx.scratch.wide_rows.clear();
    ctx.scratch.wide_joints.clear();
    ctx.scratch.cores.clear();
    Builder builder(ctx);
    builder.find_fliers();
    builder.gather_links();
    builder.label_islands();
    builder.link_units();
    builder.number_units();
    builder.ground_crowds();
    builder.link_deflected();
    builder.number_units();
    builder.ground_crowds();
    builder.choose_slices();
    builder.sort_links();
    builder.sort_joints();
    builder.lay_out_states();
    builder.index_fliers();
    builder.count();
}

} // namespace carom::internal
