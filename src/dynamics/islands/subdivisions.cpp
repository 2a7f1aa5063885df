// Number of subdivisions of an island's sub-steps, from the rotation of its bodies.

#include "dynamics/islands/subdivisions.h"

#include "core/grow.h"
#include "core/task_pool.h"
#include "dynamics/forces/force_laws.h"
#include "dynamics/islands/joint_edges.h"
#include "dynamics/islands/tallies.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <utility>

namespace carom::internal {

namespace {

constexpr float most_turn_of_normal = 0.02f; // rad
constexpr float most_swing = 0.25f;          // rad, by which a joint's arm turns
constexpr float most_spring_turn = 0.9f;     // rad, phase of the fastest oscillation of springs
constexpr float few_swings_damping = 0.1f;   // damping ratio
constexpr float whip_weight =
    3; // a hanging chain of 65 bars or more that is let go flat keeps its energy within 0.4 % for 20 s by itself

class Subdivisions
{
public:
    explicit Subdivisions(StepContext& context) : ctx(context), state(context.state), scratch(context.scratch) {}

    // Sub-steps are subdivided so that normals that turn with a bar or a bat, and arms of joints, turn by a small angle in each.
    void find_subdivisions()
    {
        const bool may_turn = (scratch.graph.has_kinematic || state.joints.count() > 0) &&
                              std::any_of(scratch.graph.tallies.begin(), scratch.graph.tallies.end(),
                                          [](const IslandTally& t) { return follows_turning_contacts(t.bodies); });
        if (may_turn)
            for_each_in_chunks(ctx.scene.def.tasks, scratch.graph.island_of.size(), bodies_per_task,
                               [&](std::size_t place) { follow_contacts_of(static_cast<std::int32_t>(place)); });
        count_joints();
        find_swings();
        for (std::size_t i = 0; i < scratch.graph.joint_edges.size(); ++i)
        {
            IslandTally& t = tally(scratch, island_of_edge(scratch, scratch.graph.joint_edges[i]));
            t.swing = std::max(t.swing, scratch.graph.swings[i]);
        }
        for (IslandTally& t : scratch.graph.tallies)
            t.subdivisions = std::max(t.subdivisions, subdivisions_for(t.swing, most_swing));
    }

private:
    [[nodiscard]] std::int32_t subdivisions_for(float rate, float most_turn) const
    {
        return static_cast<std::int32_t>(
            std::ceil(std::min(ctx.h * rate / most_turn, static_cast<float>(ctx.scene.def.most_subdivisions))));
    }

    // Follows contacts of bodies in small islands.
    void follow_contacts_of(std::int32_t place)
    {
        const std::int32_t island = scratch.graph.island_of[static_cast<std::size_t>(place)]; // kinematic bodies have no island
        if (island == none || !follows_turning_contacts(tally(scratch, island).bodies))
            return;
        for (const int index : contacts_of(state, body_at(place)))
        {
            const Contact& contact = state.contacts[index];
            if ((contact.flags & contact_flag::trigger) == 0 && is_solved(contact))
                follow_contact(contact, island);
        }
    }

    // Atomic maximum: several threads may raise it.
    void follow_contact(const Contact& contact, std::int32_t island)
    {
        const std::int32_t wanted = subdivisions_for(turn_rate(contact), most_turn_of_normal);
        const std::atomic_ref most(tally(scratch, island).subdivisions);
        std::int32_t before = most.load(std::memory_order_relaxed);
        while (before < wanted && !most.compare_exchange_weak(before, wanted, std::memory_order_relaxed))
        {
        }
    }

    void count_joints()
    {
        scratch.graph.is_jointed.assign(scratch.graph.joint_edges.empty() ? 0 : state.awake_bodies.size(), 0);
        for (const JointEdge& j : scratch.graph.joint_edges)
        {
            IslandTally& t = tally(scratch, island_of_edge(scratch, j));
            ++t.joints;
            t.damped += j.damped ? 1 : 0;
            if (j.a < 0 || j.b < 0)
            {
                t.hangs = true;
                continue;
            }
            ++t.inner_joints;
            for (const std::int32_t place : {j.a, j.b})
                t.jointed += 1 - std::exchange(scratch.graph.is_jointed[static_cast<std::size_t>(place)], std::uint8_t{1});
        }
    }

    // Swing rates of joints where they are followed, on all threads.
    void find_swings()
    {
        set_size(scratch.graph.swings, scratch.graph.joint_edges.size());
        for_each_in_chunks(ctx.scene.def.tasks, scratch.graph.joint_edges.size(), joints_per_task,
                           [&](std::size_t i)
                           {
                               const JointEdge& j = scratch.graph.joint_edges[i];
                               const IslandTally& t = tally(scratch, island_of_edge(scratch, j));
                               const bool is_followed = follows_swinging_joints(t);
                               scratch.graph.swings[i] = is_followed ? swing_rate(state.joints[j.joint], follows_whips(t)) : 0;
                           });
    }

    // A pull on the arm lets the body oscillate at omega² = pull arm / inertia. A sub-step h loses a share of (h omega)² of such an oscillation's energy, and
    // that energy goes with the body's rotation: the product counts, so that a chain at rest costs nothing.
    [[nodiscard]] static float whip_rate(const BodySim& sim, Vec2 anchor, float pull)
    {
        const float omega = std::sqrt(pull * length(anchor - sim.local_center) * sim.inverse_inertia);
        return whip_weight * std::sqrt(omega * std::fabs(sim.angular_velocity));
    }

    // omega² of a body on one spring; 0 for an oscillation that is damped within a few swings, which need not be followed.
    [[nodiscard]] static float followed_rate(const JointRecord& spring, const BodySim& sim, float inverse_mass, Vec2 anchor)
    {
        const Vec2 arm = anchor - sim.local_center;
        const float own = inverse_mass + dot(arm, arm) * sim.inverse_inertia;
        const bool fades =
            spring.damping * spring.damping * own >= 4 * few_swings_damping * few_swings_damping * spring.stiffness;
        return fades ? 0 : spring.stiffness * own;
    }

    // omega² of a body on its springs if all else stood still and all springs pulled along one line.
    [[nodiscard]] float spring_rate(int body) const
    {
        if (body == none || !is_moving_dynamic(state, body))
            return 0;
        const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
        const float inverse_mass = std::max(sim.inverse_mass.x, sim.inverse_mass.y);
        float rate = 0;
        for_each_joint(state, body,
                       [&](int index)
                       {
                           const JointRecord& joint = state.joints[index];
                           if (joint.kind == JointType::Spring)
                               rate += followed_rate(joint, sim, inverse_mass,
                                                     joint.body_a == body ? joint.anchor_a : joint.anchor_b);
                       });
        return rate;
    }

    // Angular speed of a joint's arms, in rad/s.
    [[nodiscard]] float swing_rate(const JointRecord& joint, bool whips) const
    {
        const float sprung =
            joint.kind == JointType::Spring
                ? most_swing / most_spring_turn * std::sqrt(spring_rate(joint.body_a) + spring_rate(joint.body_b))
                : 0;
        const float pull = whips ? length(joint.force) : 0;
        const auto spin = [&](int body, Vec2 anchor)
        {
            const bool turns = body != none && (anchor != state.sims[static_cast<std::size_t>(body)].local_center ||
                                                joint.kind == JointType::Prismatic);
            return turns ? std::max(std::fabs(state.sims[static_cast<std::size_t>(body)].angular_velocity),
                                    whip_rate(state.sims[static_cast<std::size_t>(body)], anchor, pull))
                         : 0;
        };
        return std::max({sprung, spin(joint.body_a, joint.anchor_a), spin(joint.body_b, joint.anchor_b)});
    }

    // Angular speed of the normal, in rad/s, where a driven body turns: the normal turns with the body, and around a corner of it over which a ball may slide.
    // A freely turning body is followed exactly in flight.
    [[nodiscard]] float turn_rate(const Contact& contact) const
    {
        const float driven = std::max(driven_spin(contact.body_a), driven_spin(contact.body_b));
        if (driven * ctx.h < 0.1f * most_turn_of_normal)
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
        const bool driven = state.bodies[body].type == BodyType::Kinematic ||
                            (is_moving_dynamic(state, body) && flight_mode_of(state, body) >= 0);
        return driven ? std::fabs(state.sims[static_cast<std::size_t>(body)].angular_velocity) + greatest_spin_of_law(ctx, body)
                      : 0;
    }

    [[nodiscard]] int body_at(std::int32_t place) const { return state.awake_bodies[static_cast<std::size_t>(place)]; }

    StepContext& ctx;
    SceneState& state;
    Scratch& scratch;
};

} // namespace

void find_subdivisions(StepContext& ctx) { Subdivisions(ctx).find_subdivisions(); }

} // namespace carom::internal
