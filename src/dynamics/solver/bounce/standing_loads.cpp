#include "dynamics/solver/bounce/standing_loads.h"

#include "core/index.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <utility>

namespace carom::internal {

namespace {

constexpr int passes = 8;
constexpr float least_response = 0.01f;

bool is_relieved(const ConstraintPoint& p) { return p.normal_impulse == 0 && p.standing_load > 0; }

bool has_relieved(const ContactConstraint& constraint)
{
    return (constraint.count > 0 && is_relieved(constraint.points[0])) ||
           (constraint.count == 2 && is_relieved(constraint.points[1]));
}

BodySpeeds speeds_of(const BodyState& s) { return {s.velocity, s.angular_velocity}; }

// Blows that are solved again together with the loads that they have taken. Points that bear something are stopped as they were.
class Settlement
{
public:
    Settlement(const SolverView& view, const Pushes& pushes, SettledBlows& blows) : m_view(view), m_pushes(pushes), m_blows(blows)
    {
        for (SettledContact& contact : blows.contacts)
        {
            save(contact);
            for (int i = 0; i < contact.constraint->count; ++i)
                contact.before[i] = before(contact, contact.constraint->points[i]);
        }
    }

    void solve(float loads)
    {
        for_each_relieved([&](const ContactConstraint& constraint, ConstraintPoint& p)
                          { push(constraint, p, p.missing_load + loads * p.standing_load); });
        for (int pass = 0; pass < passes; ++pass)
        {
            for_each_bearing([this](ContactConstraint& constraint, ConstraintPoint& p, const BeforeSettling& before)
                             { stop(constraint, p, before); });
            for_each_relieved([&](const ContactConstraint& constraint, ConstraintPoint& p)
                              { push(constraint, p, std::max(-p.normal_mass * constraint_speed(m_view, constraint, p), 0.0f)); });
        }
    }

    // The work of the loads at points that blows have parted comes out of that which blows have taken.
    void limit()
    {
        float gained = 0;
        float lost = 0;
        for_each_point(Role::Relieved,
                       [&](const ContactConstraint& constraint, const ConstraintPoint& p, const BeforeSettling& before)
                       {
                           const float mean = 0.5f * (before.speed + constraint_speed(m_view, constraint, p));
                           gained += p.normal_impulse * std::max(mean, 0.0f);
                       });
        for_each_point(Role::Bears,
                       [&](const ContactConstraint&, const ConstraintPoint& p, const BeforeSettling& before)
                       {
                           const float approach = before.may_be_struck ? std::max(p.approach, 0.0f) : 0;
                           const float rest = approach > 0 ? std::max(-before.speed, 0.0f) : 0; // is lost when the bodies meet
                           lost += 0.5f * (before.impulse * (approach + rest) + p.normal_mass * rest * rest);
                       });
        if (gained > lost)
            take_back(lost / gained);
    }

    // No constraint applies again the impulses that were given back.
    void finish()
    {
        for_each_relieved(
            [&](const ContactConstraint& constraint, ConstraintPoint& p)
            {
                m_pushes.note(constraint, p, p.normal_impulse * constraint.n);
                p.total_impulse += p.normal_impulse;
                p.normal_impulse = 0;
                forget_loads(p);
            });
    }

private:
    using Role = BeforeSettling::Role;

    template <class Visit>
    void for_each_point(Role role, const Visit& visit)
    {
        for (SettledContact& contact : m_blows.contacts)
        {
            for (int i = 0; i < contact.constraint->count; ++i)
            {
                if (contact.before[i].role == role)
                    visit(*contact.constraint, contact.constraint->points[i], contact.before[i]);
            }
        }
    }

    template <class Visit>
    void for_each_bearing(const Visit& visit)
    {
        for_each_point(Role::Bears, visit);
    }

    template <class Visit>
    void for_each_relieved(const Visit& visit)
    {
        for_each_point(Role::Relieved, [&](const ContactConstraint& constraint, ConstraintPoint& p, const BeforeSettling&)
                       { visit(constraint, p); });
    }

    [[nodiscard]] BeforeSettling before(const SettledContact& contact, const ConstraintPoint& p) const
    {
        const ContactConstraint& constraint = *contact.constraint;
        Role role = Role::Nothing;
        if (p.normal_impulse > 0)
            role = Role::Bears;
        else if (contact.is_of_struck && is_relieved(p))
            role = Role::Relieved;
        return {role,
                contact.is_of_struck,
                p.normal_impulse,
                p.tangent_impulse,
                constraint_speed(m_view, constraint, p),
                constraint_slip(m_view, constraint, p)};
    }

    void save(const SettledContact& contact)
    {
        for (const std::int32_t state : {contact.constraint->a, contact.constraint->b})
        {
            if (std::ranges::find(m_blows.speeds, state, &StateSpeeds::state) == m_blows.speeds.end())
                m_blows.speeds.push_back({state, speeds_of(m_view.states[state])});
        }
    }

    void push(const ContactConstraint& constraint, ConstraintPoint& p, float impulse) const
    {
        p.normal_impulse += impulse;
        m_pushes.apply(constraint, p, impulse * constraint.n);
    }

    void stop(const ContactConstraint& constraint, ConstraintPoint& p, const BeforeSettling& before) const
    {
        push(constraint, p,
             std::max(p.normal_mass * (before.speed - constraint_speed(m_view, constraint, p)), -p.normal_impulse));
        const float slip = constraint_slip(m_view, constraint, p) - before.slip;
        const float rub = friction_impulse(p.tangent_impulse, p.tangent_mass, slip, constraint.friction * p.normal_impulse);
        m_pushes.apply(constraint, p, (rub - std::exchange(p.tangent_impulse, rub)) * perp(constraint.n));
    }

    // Keeps this share of all changes.
    void take_back(float share)
    {
        const auto kept = [share](auto before, auto now) { return before + share * (now - before); };
        for (const auto& [state, before] : m_blows.speeds)
        {
            if (!m_pushes.has_finite_mass(state))
                continue;
            BodyState& s = m_view.states[state];
            s.velocity = kept(before.velocity, s.velocity);
            s.angular_velocity = kept(before.angular_velocity, s.angular_velocity);
        }
        for_each_relieved([share](const ContactConstraint&, ConstraintPoint& p) { p.normal_impulse *= share; });
        for_each_bearing(
            [&](const ContactConstraint&, ConstraintPoint& p, const BeforeSettling& before)
            {
                p.normal_impulse = kept(before.impulse, p.normal_impulse);
                p.tangent_impulse = kept(before.tangent, p.tangent_impulse);
            });
    }

    const SolverView& m_view;
    const Pushes& m_pushes;
    SettledBlows& m_blows;
};

bool is_blow(const ContactConstraint& constraint, float least)
{
    return std::ranges::any_of(std::span(constraint.points).first(as_index(constraint.count)),
                               [least](const ConstraintPoint& p) { return p.normal_impulse > 0 && p.approach > least; });
}

} // namespace

float load_before_last(const PointImpulses& last, int substeps)
{
    return substeps > 1 ? std::max((last.total_normal - last.normal) / static_cast<float>(substeps - 1), 0.0f) : 0;
}

float StandingLoads::share_of(float gap, float approach) const { return std::clamp(gap / (m_ctx.h * approach), 0.0f, 1.0f); }

void StandingLoads::settle(SettledBlows& blows, float share) const
{
    Settlement settlement(m_view, m_pushes, blows);
    settlement.solve(1.5f + share);
    settlement.limit();
    settlement.finish();
}

bool StandingLoads::give_back(ContactConstraint& struck, float share, int k, OwnBlocks own, SettledBlows& blows) const
{
    blows.clear();
    find_relieved(struck, k, own, blows);
    if (blows.copies.empty() && !has_relieved(struck))
        return false;
    blows.contacts.push_back({&struck, true, {}});
    for (RelievedContact& relieved : blows.copies)
        blows.contacts.push_back({&relieved.constraint, true, {}});
    for (RelievedContact& relieved : blows.copies)
        add_to_sums(relieved.constraint, -1);
    settle(blows, share);
    for (RelievedContact& relieved : blows.copies)
    {
        add_to_sums(relieved.constraint, 1);
        put_impulses(m_ctx.scratch, relieved.constraint, relieved.lane);
        note_lost_loads(m_ctx.scratch, relieved.lane);
    }
    return true;
}

bool StandingLoads::give_back(std::span<ContactConstraint> constraints, SettledBlows& blows) const
{
    float fastest = least_blow(m_ctx);
    float gap = 0;
    blows.clear();
    for (ContactConstraint& constraint : constraints)
    {
        if (!is_blow(constraint, least_blow(m_ctx)))
            continue;
        blows.struck.push_back(constraint.a);
        blows.struck.push_back(constraint.b);
        for (int i = 0; i < constraint.count; ++i)
        {
            const ConstraintPoint& p = constraint.points[i];
            if (p.normal_impulse > 0 && p.approach > fastest)
            {
                fastest = p.approach;
                gap = constraint_separation(m_view, constraint, p);
            }
        }
    }
    if (blows.struck.empty())
        return false;
    const auto is_struck = [&](std::int32_t state)
    { return m_pushes.has_finite_mass(state) && std::ranges::find(blows.struck, state) != blows.struck.end(); };
    bool any = false;
    for (ContactConstraint& constraint : constraints)
    {
        const bool may_be = is_struck(constraint.a) || is_struck(constraint.b);
        any |= may_be && has_relieved(constraint);
        blows.contacts.push_back({&constraint, may_be, {}});
    }
    if (any)
        settle(blows, share_of(gap, fastest));
    return any;
}

void StandingLoads::find_relieved(const ContactConstraint& struck, int k, OwnBlocks own, SettledBlows& blows) const
{
    for (const std::int32_t state : {struck.a, struck.b})
    {
        if (yields(struck, state))
            find_relieved(struck, state, k, own, blows);
    }
}

// A body that takes less than a hundredth of a blow's speed is relieved of nothing. It may have thousands of contacts.
bool StandingLoads::yields(const ContactConstraint& struck, std::int32_t state) const
{
    const StateConstants& c = m_view.constants[state];
    const ConstraintPoint& p = struck.points[0];
    const Vec2 n = struck.n;
    const float across = cross(state == struck.a ? p.ra : p.rb, n);
    const float response = dot(c.inverse_mass, {n.x * n.x, n.y * n.y}) + across * across * c.inverse_inertia;
    return response * p.normal_mass > least_response;
}

void StandingLoads::find_relieved(const ContactConstraint& struck, std::int32_t state, int k, OwnBlocks own,
                                  SettledBlows& blows) const
{
    for (std::int32_t at = m_ctx.scratch.solver.first_relieved[as_index(state)]; at != none;)
    {
        const RelievedLane& of = m_output.relieved_lanes[as_index(at)];
        at = of.next[of.state[0] == state ? 0 : 1];
        const std::int32_t block = of.lane / lane_count;
        if (block < own.first || block >= own.end)
            continue;
        const std::int32_t lane = of.lane + m_island.wide_store * lane_count;
        const auto is_it = [lane](const RelievedContact& known) { return known.lane == lane; };
        if (std::ranges::any_of(blows.copies, is_it))
            continue; // both bodies of the blow are its
        ContactConstraint other = constraint_of_lane(m_ctx.scratch, lane);
        if (other.contact == struck.contact)
            continue;
        note_standing_loads(m_ctx, k, lane, other);
        for (ConstraintPoint& p : other.points)
            p.approach = 0; // this blow is not its
        if (has_relieved(other))
            blows.copies.push_back({other, lane});
    }
}

void StandingLoads::note_relieved(std::int32_t lane)
{
    SolverWorkspace& solver = m_ctx.scratch.solver;
    const WideContact& block = solver.wide_contacts[as_index(m_island.wide_store + lane / lane_count)];
    RelievedLane of{lane, {block.a.v[lane % lane_count], block.b.v[lane % lane_count]}, {none, none}};
    for (int i = 0; i < 2; ++i)
    {
        if (m_pushes.has_finite_mass(of.state[i]))
            of.next[i] = std::exchange(solver.first_relieved[as_index(of.state[i])],
                                       static_cast<std::int32_t>(m_output.relieved_lanes.size()));
    }
    m_output.relieved_lanes.push_back(of);
}

void StandingLoads::forget_relieved()
{
    for (const RelievedLane& of : m_output.relieved_lanes)
    {
        for (const std::int32_t state : of.state)
            m_ctx.scratch.solver.first_relieved[as_index(state)] = none;
    }
    m_output.relieved_lanes.clear();
}

void note_standing_loads(const StepContext& ctx, int k, std::int32_t lane, ContactConstraint& constraint)
{
    const WideContactNotes& notes = ctx.scratch.solver.wide_notes[as_index(lane / lane_count)];
    const bool goes_on = constraint.halfway != 0;
    for (int i = 0; i < constraint.count; ++i)
    {
        ConstraintPoint& p = constraint.points[i];
        if ((notes.may_hit & (may_hit_bit(lane % lane_count, i) | lost_bit(lane % lane_count, i))) != 0)
            continue;
        const bool may_have_paused = goes_on || (notes.paused & may_hit_bit(lane % lane_count, i)) != 0;
        const PointImpulses& last = impulses_of(ctx.state, constraint.contact).points[i];
        const float borne = p.total_impulse - p.normal_impulse; // in this step, before this sub-step
        p.standing_load = load_before_last(last, ctx.substeps);
        if (k > 0 || !goes_on)
            p.standing_load = std::min(p.standing_load, last.normal);
        if (k > 0)
            p.standing_load = std::min(p.standing_load, (last.normal + borne) / static_cast<float>(may_have_paused ? k : k + 1));
        if (!may_have_paused)
            continue;
        const float missing = k > 0 ? static_cast<float>(k) * p.standing_load - borne : p.standing_load - last.normal;
        p.missing_load = std::clamp(missing, 0.0f, p.standing_load);
    }
}

void note_lost_loads(Scratch& scratch, std::int32_t lane, float far)
{
    const WideContact& block = scratch.solver.wide_contacts[as_index(lane / lane_count)];
    WideContactNotes& notes = scratch.solver.wide_notes[as_index(lane / lane_count)];
    const int i = lane % lane_count;
    for (int k = 0; k < notes.count; ++k)
    {
        const std::uint32_t paused = may_hit_bit(i, k);
        if (block.points[k].normal_impulse.v[i] > 0)
            continue;
        if (block.points[k].separation.v[i] > far || (notes.paused & paused) != 0)
            notes.may_hit |= lost_bit(i, k);
        notes.paused = static_cast<std::uint16_t>(notes.paused | paused);
    }
}

} // namespace carom::internal
