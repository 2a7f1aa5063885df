// Triggers: which visitors are inside, and when they enter and exit. The paths of both bodies through the step consist of pieces on which they are known
// exactly (dynamics/continuous/path/trace.h). On each piece the visitor enters when the two first touch (collision/time_of_impact.h). It exits when they first
// touch on the piece run backwards. The contact manifolds at the ends of a piece decide whether the visitor is inside there. Where rounding or a
// one-sided line hides the time from the search, it is found between the ends by bisection.
//
// A visitor that exits and enters again within one piece, as the corner of a rotating body may, counts as inside all the time, unless it is outside at the
// middle.

#include "collision/time_of_impact.h"
#include "dynamics/broadphase/half_space_box.h"
#include "dynamics/continuous/path/body_path.h"
#include "dynamics/narrowphase/touch_tracker.h"
#include "dynamics/sensors/crossings.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/stages.h"
#include "dynamics/state/contact_store.h"
#include "geometry/bounds.h"

#include <algorithm>
#include <optional>

namespace carom::internal {

namespace {

BodyPose pose_on(const FramePath& path, const Position& origin)
{
    return {{origin.x + path.center.x, origin.y + path.center.y},
            {static_cast<float>(path.c), static_cast<float>(path.s)},
            path.local_center};
}

/// A part of the step in which the path of each body is a single piece. The paths are relative to the starting point of a.
struct Part
{
    double start;
    double length;
    FramePath a;
    FramePath b;
};

class TriggerUpdate
{
public:
    TriggerUpdate(StepContext& ctx, int contact)
        : m_ctx(ctx), m_state(ctx.state), m_index(contact), m_contact(ctx.state.contacts[contact]), m_a(ctx, m_contact.body_a),
          m_b(ctx, m_contact.body_b), m_dt(static_cast<double>(ctx.dt)), m_inside(touches(m_contact))
    {}

    void run()
    {
        m_contact.flags &= ~contact_flag::fresh;
        const double reach = m_a.reach() + m_b.reach();
        const bool far_out = boxes_are_apart(reach);
        const float separation = far_out ? 1 : separation_of(m_a.start(), m_b.start());
        expect(separation <= 0, 0); // shapes were created, moved or changed between the steps
        const bool far_in = static_cast<double>(separation) < -2 * reach;
        if (far_out || far_in || reach == 0)
            return;
        follow_paths();
        expect(is_inside(m_a.end(), m_b.end()), m_dt);
    }

private:
    void follow_paths()
    {
        for (double t = 0; t < m_dt;)
        {
            const double next = std::min(m_a.next_curve(t), m_b.next_curve(t));
            const Part part = part_between(t, next);
            follow(part, next < m_dt ? is_inside(part, part.length) : is_inside(m_a.end(), m_b.end()));
            t = next;
        }
    }

    [[nodiscard]] Part part_between(double start, double end) const
    {
        Part part{start, end - start, m_a.from(start), m_b.from(start)};
        part.b.center.x += m_b.start().center.x - m_a.start().center.x;
        part.b.center.y += m_b.start().center.y - m_a.start().center.y;
        return part;
    }

    void follow(const Part& part, bool ends_inside)
    {
        if (m_inside && ends_inside)
            return;
        const double length = part.length;
        const std::optional<double> in = m_inside ? std::nullopt : first_touch_on(part);
        const std::optional<double> out = ends_inside ? std::nullopt : last_touch_on(part);
        if (ends_inside)
            cross(part.start + (in ? *in : halved(part, 0, length)));
        else if (m_inside)
            cross(part.start + (out ? *out : halved(part, 0, length)));
        else if (in || out)
            pass(part, in ? *in : other_moment(part, *out, 0), out ? *out : other_moment(part, *in, length));
    }

    // The visitor enters and exits on one part. Because of rounding at the ends, it may not enter at all.
    void pass(const Part& part, double in, double out)
    {
        if (out <= in)
            return;
        cross(part.start + in);
        come_out_half_way(part, 0.5 * (in + out));
        cross(part.start + out);
    }

    // At the top of its flight, the visitor may be outside between two passages.
    void come_out_half_way(const Part& part, double middle)
    {
        if (is_inside(part, middle))
            return;
        const std::optional<double> out = last_touch_on({part.start, middle, part.a, part.b});
        const std::optional<double> in =
            first_touch_on({part.start + middle, part.length - middle, path_after(part.a, middle), path_after(part.b, middle)});
        if (!in || !out || *out >= middle || *in <= 0)
            return;
        cross(part.start + *out);
        cross(part.start + middle + *in);
    }

    // A body that passes through a one-sided line touches it once. The other time is when its middle passes through, on the way to that end of the part.
    [[nodiscard]] double other_moment(const Part& part, double touch, double end) const
    {
        const bool one_sided = m_state.shapes[m_contact.shape_a].leaf.sides != Sides::Both ||
                               m_state.shapes[m_contact.shape_b].leaf.sides != Sides::Both;
        for (double share = 1e-6; one_sided && share < 1; share *= 10)
        {
            const double inside = touch + share * (end - touch);
            if (is_inside(part, inside))
                return halved(part, inside, end);
        }
        return touch;
    }

    // --- queries --------------------------------------------------------------------------------------------------------------------

    [[nodiscard]] float separation_of(const BodyPose& a, const BodyPose& b) const
    {
        return least_separation(world_manifold(m_state, m_contact, a, b, 0));
    }
    [[nodiscard]] bool is_inside(const BodyPose& a, const BodyPose& b) const { return separation_of(a, b) <= 0; }

    // Whether the boxes of the leaves are too far apart at the start for this step.
    [[nodiscard]] bool boxes_are_apart(double reach) const
    {
        const Box a = leaf_bounds(leaf_view(m_state, m_contact.shape_a), m_a.start().frame());
        const Box b = leaf_bounds(leaf_view(m_state, m_contact.shape_b), m_b.start().frame());
        return std::max({a.lower.x - b.upper.x, b.lower.x - a.upper.x, a.lower.y - b.upper.y, b.lower.y - a.upper.y}) > reach;
    }

    [[nodiscard]] bool is_inside(const Part& part, double time) const
    {
        const Position& origin = m_a.start().center;
        return is_inside(pose_on(path_after(part.a, time), origin), pose_on(path_after(part.b, time), origin));
    }

    [[nodiscard]] std::optional<double> touch_time(const FramePath& a, const FramePath& b, double length) const
    {
        const Leaf leaf_a = free_standing(m_contact.shape_a);
        const Leaf leaf_b = free_standing(m_contact.shape_b);
        const std::optional<Touch> touch = first_touch(view(leaf_a, m_state.leaf_store), a, view(leaf_b, m_state.leaf_store), b,
                                                       length, 1e-6 * static_cast<double>(m_ctx.scene.def.length_scale));
        return touch ? std::optional(touch->time) : std::nullopt;
    }

    // The leaf of a chain leaves some directions at its ends to the neighboring leaf. A trigger tests the whole leaf.
    [[nodiscard]] Leaf free_standing(std::int32_t shape) const
    {
        Leaf leaf = m_state.shapes[shape].leaf;
        leaf.has_previous = leaf.has_next = false;
        return leaf;
    }

    [[nodiscard]] std::optional<double> first_touch_on(const Part& part) const { return touch_time(part.a, part.b, part.length); }

    [[nodiscard]] std::optional<double> last_touch_on(const Part& part) const
    {
        const std::optional<double> back =
            touch_time(run_back(path_after(part.a, part.length)), run_back(path_after(part.b, part.length)), part.length);
        return back ? std::optional(std::max(part.length - *back, 0.0)) : std::nullopt;
    }

    // Bisects for the time at which the visitor changes from `m_inside` to the opposite. Where rounding hides the change, the time is one of the ends.
    [[nodiscard]] double halved(const Part& part, double from, double to) const
    {
        const bool before = is_inside(part, from);
        if (before == is_inside(part, to))
            return before == m_inside ? to : from;
        for (int i = 0; i < 50; ++i)
        {
            const double middle = 0.5 * (from + to);
            (is_inside(part, middle) == before ? from : to) = middle;
        }
        return to;
    }

    // --- reporting ------------------------------------------------------------------------------------------------------------------

    void expect(bool inside, double time)
    {
        if (inside != m_inside)
            cross(time);
    }

    void cross(double time)
    {
        m_inside = !m_inside;
        internal::cross(m_contact);
        m_ctx.scratch.sensors.crossings.push_back(
            {m_index, m_state.shapes[m_contact.shape_a].owner, m_state.shapes[m_contact.shape_b].owner,
             static_cast<std::int32_t>(m_ctx.scratch.sensors.crossings.size()), time, m_inside});
    }

    StepContext& m_ctx;
    SceneState& m_state;
    int m_index;
    Contact& m_contact;
    BodyPath m_a;
    BodyPath m_b;
    double m_dt;
    bool m_inside;
};

// Whether a body is awake or the contact is fresh, and both bodies are sound. Unsound bodies are about to be quarantined.
bool needs_update(const StepContext& ctx, const Contact& contact)
{
    const bool moves = is_awake(ctx.state, contact.body_a) || is_awake(ctx.state, contact.body_b);
    const auto is_unsound = [&](int body)
    { return std::find(ctx.scratch.unsound.begin(), ctx.scratch.unsound.end(), body) != ctx.scratch.unsound.end(); };
    return (moves || (contact.flags & contact_flag::fresh) != 0) && !is_unsound(contact.body_a) && !is_unsound(contact.body_b);
}

} // namespace

void mark_traced(StepContext& ctx)
{
    const SceneState& state = ctx.state;
    Scratch& scratch = ctx.scratch;
    for (const std::int32_t index : state.trigger_contacts)
    {
        for (const int body : {state.contacts[index].body_a, state.contacts[index].body_b})
        {
            const int place = state.bodies[body].awake_index;
            if (place == none || state.bodies[body].type != BodyType::Dynamic)
                continue;
            scratch.solver.states[static_cast<std::size_t>(scratch.solver.state_of[static_cast<std::size_t>(place)])].flags |=
                body_flag::traced;
            scratch.solver.islands[static_cast<std::size_t>(scratch.graph.island_of[static_cast<std::size_t>(place)])].traced =
                true;
        }
    }
}

void update_triggers(StepContext& ctx)
{
    SceneState& state = ctx.state;
    std::vector<std::int32_t>& order = ctx.scratch.order;
    gather_paths(ctx);
    find_deflected_pairs(ctx);
    order.assign(state.trigger_contacts.begin(), state.trigger_contacts.end());
    ctx.scratch.sensors.crossings.clear();
    for (const std::int32_t index : order)
    {
        const Contact& contact = state.contacts[index];
        if (!needs_update(ctx, contact))
            continue;
        TriggerUpdate(ctx, index).run();
        if (!touches(contact) && !boxes_meet(state, contact.shape_a, contact.shape_b))
            destroy_contact(ctx.scene, index, ctx.scene.events, ctx.dt);
    }
    report_crossings(ctx);
}

} // namespace carom::internal
