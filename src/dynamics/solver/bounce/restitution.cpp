// Lets bodies bounce off where constraints have stopped them in a sub-step, and reports the impacts. Constraints outside of
// lanes are checked one by one; in lanes, only those are checked that the kernels have found struck while relaxing.

#include "dynamics/solver/bounce/restitution.h"
#include "dynamics/solver/bounce/bounce_limit.h"
#include "dynamics/solver/bounce/impact_event.h"
#include "dynamics/solver/bounce/pushes.h"
#include "dynamics/solver/bounce/standing_loads.h"
#include "dynamics/solver/joint/direct/direct_solver.h"

#include "core/grow.h"
#include "core/index.h"
#include "core/nonzero.h"
#include "core/prefetch.h"
#include "core/refuse.h"
#include "dynamics/narrowphase/material.h"
#include "dynamics/narrowphase/touch_tracker.h"
#include "dynamics/solver/contact/partitions.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/scene_data.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

constexpr std::size_t enough_lanes = 64; // to share among threads
constexpr float touching = 0.1f;         // of the slop
constexpr float tiny_share = 1e-4f;      // of the rest speed: a push that changes no speed by more is left

class Bounces
{
public:
    explicit Bounces(const BouncingIsland& of)
        : m_ctx(of.ctx), m_scratch(of.ctx.scratch), m_island(of.island), m_output(of.output), m_view(of.view),
          m_pushes(of.view, m_scratch.solver.unpushed, of.notes_pushes), m_loads(of.ctx, of.island, of.output, of.view, m_pushes),
          m_joints(of.joints), m_kinetic_before(of.kinetic_before),
          m_wide(m_scratch.solver.wide_contacts.data() + m_island.wide_store),
          m_notes(m_scratch.solver.wide_notes.data() + m_island.wide_store), m_blows(blow_bits(m_scratch, m_island))
    {}

    void note_approaches()
    {
        for (ContactConstraint& constraint : constraints())
            note_approach(m_view, constraint, m_joints == nullptr ? least_blow(m_ctx) : std::numeric_limits<float>::max());
    }

    void carry_approaches_on()
    {
        for (ContactConstraint& constraint : constraints())
            carry_approach_on(m_view, constraint);
    }

    void bounce(int k, WorkerTeam& team)
    {
        for (ContactConstraint& constraint : constraints())
            end_approaches(constraint);
        const bool gave_back = m_joints == nullptr && m_loads.give_back(constraints(), m_output.settled);
        for (ContactConstraint& constraint : constraints())
            bounce_constraint(constraint, gave_back, k);
        if (!m_output.struck_constraints.empty())
            bounce_through_joints(k);
        bounce_lanes(k, team);
    }

private:
    /// The constraints outside of lanes. Those that have come within the step do not bounce: flight has seen to that.
    [[nodiscard]] std::span<ContactConstraint> constraints() const
    {
        return {m_scratch.solver.constraints.data() + m_island.first_constraint, as_index(m_island.constraint_count)};
    }

    // All contacts of the island may answer: what is struck hangs together.
    void bounce_through_joints(int k)
    {
        std::vector<ContactBounce>& bounces = m_output.contact_bounces;
        bounces.clear();
        for (ContactConstraint& constraint : constraints())
            note_bounce(constraint);
        for (ContactConstraint& constraint : m_output.late_constraints)
            note_bounce(constraint);
        for (const StruckConstraint& struck : m_output.struck_constraints)
        {
            ContactBounce& bounce = *std::ranges::find(bounces, struck.constraint, &ContactBounce::constraint);
            for (int i = 0; i < struck.constraint->count; ++i)
            {
                if (bounce.stopped[i] > 0)
                    bounce.wanted[i] = wanted_speed(struck.constraint->points[i], struck.restitution, struck.kick_speed);
                bounce.answers[i] |= bounce.wanted[i] > 0;
            }
        }
        take_speeds(m_view, m_island, m_output.stopped_speeds);
        m_joints->bounce_contacts(bounces, tiny_share * m_ctx.rest_speed);
        if (gets_no_energy())
            limit_bounce(m_view, m_island, bounces, m_output.stopped_speeds, m_kinetic_before);
        for (const StruckConstraint& struck : m_output.struck_constraints)
            finish_impact(*struck.constraint, struck, k, m_output);
        m_output.struck_constraints.clear();
    }

    void note_bounce(ContactConstraint& constraint)
    {
        if (constraint.count == 0)
            return;
        ContactBounce& bounce = m_output.contact_bounces.emplace_back(ContactBounce{&constraint});
        for (int i = 0; i < constraint.count; ++i)
        {
            const ConstraintPoint& p = constraint.points[i];
            bounce.stopped[i] = p.normal_impulse;
            bounce.answers[i] = constraint_separation(m_view, constraint, p) <= touching * m_ctx.scene.tolerances.slop;
        }
    }

    // Kickers and driven bodies give energy.
    [[nodiscard]] bool gets_no_energy() const
    {
        const auto is_driven = [this](std::int32_t i)
        {
            const BodyState& s = m_view.states[i];
            return !m_pushes.has_finite_mass(i) && (s.velocity != Vec2{} || s.angular_velocity != 0);
        };
        return std::ranges::all_of(
            m_output.struck_constraints, [&](const StruckConstraint& struck)
            { return struck.kick_speed == 0 && !is_driven(struck.constraint->a) && !is_driven(struck.constraint->b); });
    }

    // Two partitions share no body that has finite mass: threads bounce the lanes of partitions side by side, then one thread those of boundary constraints.
    void bounce_lanes(int k, WorkerTeam& team)
    {
        find_struck_lanes();
        if (m_output.struck_lanes.size() < enough_lanes)
            bounce_blocks(0, m_island.wide_count, k, m_output, all_blocks());
        else
            bounce_parts(k, team);
        m_loads.forget_relieved();
        for_each_lane(m_blows.relieved, [&](std::int32_t lane)
                      { note_lost_loads(m_scratch, m_island.wide_store * lane_count + lane, halfway_gap(m_ctx)); });
    }

    void bounce_parts(int k, WorkerTeam& team)
    {
        std::vector<ImpactReport>& in_parts = m_output.reports_of_parts;
        in_parts.resize(std::max(in_parts.size(), as_index(m_island.partitions)));
        const int boundary = contact_buckets(m_scratch, m_island)
                                 .by_part(team, [&](int first, int last, int partition)
                                          { bounce_blocks(first, last, k, in_parts[as_index(partition)], {first, last}); });
        for (ImpactReport& report : std::span(in_parts).first(as_index(m_island.partitions)))
            take(report);
        bounce_blocks(boundary, m_island.wide_count, k, m_output, all_blocks());
    }

    [[nodiscard]] OwnBlocks all_blocks() const { return {0, m_island.wide_count}; }

    void find_struck_lanes()
    {
        std::vector<std::int32_t>& lanes = m_output.struck_lanes;
        lanes.clear();
        for_each_lane(m_blows.struck, [&](std::int32_t lane) { lanes.push_back(lane); });
        if (!lanes.empty())
            for_each_lane(m_blows.relieved, [&](std::int32_t lane) { m_loads.note_relieved(lane); });
    }

    template <class Visit>
    void for_each_lane(const std::uint8_t* of_blocks, const Visit& visit) const
    {
        for_each_nonzero(of_blocks, static_cast<std::size_t>(m_island.wide_count),
                         [&](std::size_t g)
                         {
                             for (unsigned bits = of_blocks[g]; bits != 0; bits &= bits - 1)
                                 visit(static_cast<std::int32_t>(g) * lane_count + std::countr_zero(bits));
                         });
    }

    void take(ImpactReport& report)
    {
        append_all(m_output.impacts, report.impacts);
        append_all(m_output.begins, report.begins);
        append_all(m_output.kicked_shapes, report.kicked_shapes);
        m_output.bulk_impacts += std::exchange(report.bulk_impacts, 0);
        report.impacts.clear();
        report.begins.clear();
        report.kicked_shapes.clear();
    }

    void bounce_blocks(int first, int last, int k, ImpactReport& report, OwnBlocks own)
    {
        const std::span<const std::int32_t> lanes = m_output.struck_lanes;
        for (auto i = static_cast<std::size_t>(std::ranges::lower_bound(lanes, first * lane_count) - lanes.begin());
             i < lanes.size() && lanes[i] < last * lane_count; ++i)
        {
            prefetch_struck(i);
            bounce_lane(lanes[i], k, report, own);
        }
    }

    // Prefetches the contact indices of a later lane, then the contact, then its shapes and position.
    [[gnu::always_inline]] void prefetch_struck(std::size_t i) const
    {
        const std::vector<std::int32_t>& lanes = m_output.struck_lanes;
        const SceneState& state = m_ctx.state;
        const auto contact_of = [&](std::size_t lane)
        { return m_notes[lanes[lane] / lane_count].contact.v[lanes[lane] % lane_count]; };
        if (i + 2 * prefetch_distance < lanes.size())
            prefetch_line(&m_notes[lanes[i + 2 * prefetch_distance] / lane_count]);
        if (i + prefetch_distance < lanes.size())
            prefetch(state.contacts[contact_of(i + prefetch_distance)]);
        if (i + prefetch_distance / 2 >= lanes.size())
            return;
        const Contact& contact = state.contacts[contact_of(i + prefetch_distance / 2)];
        for (const std::int32_t shape : {contact.shape_a, contact.shape_b})
            prefetch(state.shapes[shape]);
        prefetch_line(&state.sims[static_cast<std::size_t>(contact.body_a)]);
    }

    // For a lane that bears a load. Points bounce once in a step.
    void bounce_lane(std::int32_t lane, int k, ImpactReport& report, OwnBlocks own)
    {
        const WideContact& wide = m_wide[lane / lane_count];
        WideContactNotes& notes = m_notes[lane / lane_count];
        const int i = lane % lane_count;
        const std::int32_t index = m_island.wide_store * lane_count + lane;
        ContactConstraint constraint = constraint_of_lane(m_scratch, index);
        std::uint32_t struck = 0;
        for (int p = 0; p < notes.count; ++p)
        {
            if ((notes.may_hit & may_hit_bit(i, p)) == 0)
                constraint.points[p].approach = 0;
            else if (constraint.points[p].normal_impulse > 0 && constraint.points[p].approach > least_blow(m_ctx))
                struck |= may_hit_bit(i, p);
        }
        const float approach = greatest_approach(constraint);
        const bool strikes = approach > least_blow(m_ctx);
        const unsigned bit = 1u << i;
        if ((notes.unreported & bit) != 0 && !touches(m_ctx.state.contacts[constraint.contact])) // flight may have begun it
            begin_touch(constraint, k, report);
        notes.unreported &= ~bit;
        if (!strikes)
            return;
        for (int p = 0; p < notes.count; ++p)
            constraint.halfway = static_cast<std::uint8_t>(constraint.halfway | (notes.halfway >> (i + p * lane_count) & 1) << p);
        note_standing_loads(m_ctx, k, index, constraint);
        add_to_sums(constraint, -1); // as outside of lanes, where the impulses of a sub-step count at its end
        const float share = m_loads.share_of(gap_of(wide, constraint, i), approach);
        const bool gave_back = m_loads.give_back(constraint, share, k, own, report.settled);
        resolve_impact(constraint, approach, gave_back, k, report);
        add_to_sums(constraint, 1);
        put_impulses(m_scratch, constraint, index);
        if (gave_back)
            note_lost_loads(m_scratch, index);
        const std::uint32_t halfway = gave_back ? 0 : halfway_points(wide, constraint, i);
        notes.halfway = static_cast<std::uint16_t>((notes.halfway & ~(may_hit_bit(i, 0) | may_hit_bit(i, 1))) | halfway);
        struck &= ~halfway;
        if (gave_back || approach > m_ctx.rest_speed)
            notes.may_hit &= ~struck;
    }

    // The points that have been stopped in part: the bodies meet within the next sub-step.
    [[nodiscard]] std::uint32_t halfway_points(const WideContact& wide, const ContactConstraint& constraint, int lane) const
    {
        std::uint32_t halfway = 0;
        for (int p = 0; p < constraint.count; ++p)
        {
            const float rest = -constraint_speed(m_view, constraint, constraint.points[p]);
            if (constraint.points[p].normal_impulse > 0 &&
                is_halfway(wide.points[p].separation.v[lane], rest, m_view.h, least_blow(m_ctx)))
                halfway |= may_hit_bit(lane, p);
        }
        return halfway;
    }

    // That of the point which is struck fastest, in m.
    static float gap_of(const WideContact& wide, const ContactConstraint& constraint, int lane)
    {
        const ConstraintPoint& p = constraint.points[0];
        const ConstraintPoint& q = constraint.points[1];
        const bool is_second =
            constraint.count == 2 && q.normal_impulse > 0 && (p.normal_impulse <= 0 || q.approach > p.approach);
        return wide.points[is_second ? 1 : 0].separation.v[lane];
    }

    // Warm starting must not push points again that have bounced off.
    void forget_pushes(const ContactConstraint& constraint, const StruckConstraint& struck)
    {
        for (int i = 0; i < constraint.count; ++i)
        {
            if (constraint.points[i].normal_impulse == 0)
                m_pushes.note(constraint, constraint.points[i], struck.pushed[i]);
        }
    }

    // A normal that has turned away from the approach ends it.
    void end_approaches(ContactConstraint& constraint) const
    {
        for (ConstraintPoint& p : points_of(constraint))
        {
            if (p.approach > 0 && approach_before(m_scratch, constraint, p) <= 0)
                p.approach = 0;
        }
    }

    void bounce_constraint(ContactConstraint& constraint, bool gave_back, int k)
    {
        if (!bears_load(constraint))
            return;
        if (!touches(m_ctx.state.contacts[constraint.contact]))
            begin_touch(constraint, k, m_output);
        const float approach = greatest_approach(constraint);
        if (m_joints == nullptr)
            resolve_impact(constraint, approach, gave_back, k, m_output);
        else if (approach > m_ctx.rest_speed)
            m_output.struck_constraints.push_back(begin_impact(constraint, approach, m_output));
    }

    static std::span<ConstraintPoint> points_of(ContactConstraint& constraint)
    {
        return std::span(constraint.points).first(as_index(constraint.count));
    }

    // The greatest approach of the points that were stopped, without some of them, as bits.
    static float greatest_approach(ContactConstraint& constraint, std::uint32_t without = 0)
    {
        float approach = 0;
        for (int i = 0; i < constraint.count; ++i)
        {
            if (constraint.points[i].normal_impulse > 0 && (without >> i & 1) == 0)
                approach = std::max(approach, constraint.points[i].approach);
        }
        return approach;
    }

    // Blows that are too weak to bounce may have taken back loads.
    void resolve_impact(ContactConstraint& constraint, float approach, bool gave_back, int k, ImpactReport& report)
    {
        const float first = greatest_approach(constraint, constraint.halfway); // a blow that goes on has been reported
        if (first > m_ctx.rest_speed && constraint.hit == 0)
        {
            const StruckConstraint struck = begin_impact(constraint, first, report);
            bounce_points(constraint, struck.restitution, struck.kick_speed);
            finish_impact(constraint, struck, k, report);
        }
        if (gave_back && approach > least_blow(m_ctx))
            lay_aside(constraint);
    }

    void lay_aside(ContactConstraint& constraint) const
    {
        for (ConstraintPoint& p : points_of(constraint))
        {
            if (p.approach <= least_blow(m_ctx))
                continue;
            m_pushes.note(constraint, p, p.normal_impulse * constraint.n + p.tangent_impulse * perp(constraint.n));
            take_impulse(p);
        }
    }

    [[nodiscard]] StruckConstraint begin_impact(ContactConstraint& constraint, float approach, ImpactReport& report) const
    {
        constraint.hit = 1;
        const Contact& contact = m_ctx.state.contacts[constraint.contact];
        const float e = mixed_restitution(m_ctx.scene, contact.shape_a, contact.shape_b, approach);
        const KickResult kick = kick_speed(m_ctx.scene, contact.shape_a, contact.shape_b, approach);
        if (kick.a_fired)
            report.kicked_shapes.push_back(contact.shape_a);
        if (kick.b_fired)
            report.kicked_shapes.push_back(contact.shape_b);
        StruckConstraint struck{&constraint, e, kick.speed, {}};
        for (int i = 0; i < constraint.count; ++i)
            struck.pushed[i] =
                constraint.points[i].normal_impulse * constraint.n + constraint.points[i].tangent_impulse * perp(constraint.n);
        return struck;
    }

    void finish_impact(ContactConstraint& constraint, const StruckConstraint& struck, int k, ImpactReport& report)
    {
        auto event = event_of<ImpactEvent>(m_ctx.state, m_ctx.state.contacts[constraint.contact]);
        event.time = m_ctx.h * static_cast<float>(k + 1);
        event.restitution = struck.restitution;
        event.friction = constraint.friction;
        event.kick_speed = struck.kick_speed;
        fill_impact(m_ctx, m_view, constraint, event);
        take_impulses(constraint, struck.restitution, struck.kick_speed);
        forget_pushes(constraint, struck);
        ++report.bulk_impacts;
        if (event.impulse > 0 && is_finite(event.energy_lost)) // others may have parted the bodies, or speeds overflowed
            append(report.impacts, event);
    }

    [[nodiscard]] static float wanted_speed(const ConstraintPoint& p, float e, float kick)
    {
        return e * std::max(p.approach, 0.0f) + kick;
    }

    // The separating speed that a point still lacks.
    [[nodiscard]] float missing_speed(const ContactConstraint& constraint, const ConstraintPoint& p, float e, float kick) const
    {
        return wanted_speed(p, e, kick) - constraint_speed(m_view, constraint, p);
    }

    void push(const ContactConstraint& constraint, ConstraintPoint& p, float impulse) const
    {
        p.normal_impulse += impulse;
        m_pushes.note(constraint, p, impulse * constraint.n);
        m_pushes.apply(constraint, p, impulse * constraint.n);
    }

    // Two points that are struck at once bounce at once: a box that lands flat bounces flat.
    void bounce_points(ContactConstraint& constraint, float e, float kick)
    {
        if (e <= 0 && kick <= 0)
            return;
        ConstraintPoint& p = constraint.points[0];
        ConstraintPoint& q = constraint.points[1];
        if (constraint.count == 2 && constraint.coupling != 0 && p.normal_impulse > 0 && q.normal_impulse > 0)
        {
            const float k11 = 1 / p.normal_mass;
            const float k22 = 1 / q.normal_mass;
            const float inverse_det = 1 / (k11 * k22 - constraint.coupling * constraint.coupling);
            const float d1 = missing_speed(constraint, p, e, kick);
            const float d2 = missing_speed(constraint, q, e, kick);
            const float j1 = inverse_det * (k22 * d1 - constraint.coupling * d2);
            const float j2 = inverse_det * (k11 * d2 - constraint.coupling * d1);
            if (p.normal_impulse + j1 >= 0 && q.normal_impulse + j2 >= 0)
            {
                push(constraint, p, j1);
                push(constraint, q, j2);
                return;
            }
        }
        for (int i = 0; i < constraint.count; ++i)
        {
            ConstraintPoint& r = constraint.points[i];
            if (r.normal_impulse > 0)
                push(constraint, r, std::max(r.normal_mass * missing_speed(constraint, r, e, kick), -r.normal_impulse));
        }
    }

    // Points that bounce off are not pushed again by warm starting.
    static void take_impulses(ContactConstraint& constraint, float e, float kick)
    {
        for (ConstraintPoint& p : points_of(constraint))
        {
            if (wanted_speed(p, e, kick) > 0)
                take_impulse(p);
        }
    }

    static void take_impulse(ConstraintPoint& p)
    {
        p.total_impulse += p.normal_impulse;
        p.total_tangent += p.tangent_impulse;
        p.normal_impulse = p.tangent_impulse = 0;
    }

    void begin_touch(const ContactConstraint& constraint, int k, ImpactReport& report) const
    {
        const Contact& contact = m_ctx.state.contacts[constraint.contact];
        begin_touch_within_step(m_ctx.state, report,
                                {constraint.contact, contact.shape_a, contact.shape_b,
                                 place_on_a(m_ctx, m_view, constraint, constraint.points[0].ra), constraint.n,
                                 m_ctx.h * static_cast<float>(k + 1)});
    }

    const StepContext& m_ctx;
    Scratch& m_scratch;
    const Island& m_island;
    IslandOutput& m_output;
    const SolverView& m_view;
    Pushes m_pushes;
    StandingLoads m_loads;
    DirectSolve* m_joints;
    double m_kinetic_before;
    const WideContact* m_wide;
    WideContactNotes* m_notes;
    BlowBits m_blows;
};

} // namespace

void note_approaches(const BouncingIsland& island) { Bounces(island).note_approaches(); }

void carry_approaches_on(const BouncingIsland& island) { Bounces(island).carry_approaches_on(); }

void bounce(const BouncingIsland& island, int k, WorkerTeam& team) { Bounces(island).bounce(k, team); }

} // namespace carom::internal
