// Triggers: what is inside, and when it came and went. The visitor's path over the step is a few straight pieces (a ball's path bends at its
// impacts); on each piece the first touch of the trigger is found by advancing no farther than the gap allows, so that nothing thin is
// missed by something fast. Leaving is arriving on the path run backwards.

#include "collision/time_of_impact.h"
#include "core/trigonometry.h"
#include "dynamics/body_store.h"
#include "dynamics/contact_store.h"
#include "dynamics/contact_update.h"
#include "dynamics/half_space_box.h"
#include "dynamics/stages.h"
#include "dynamics/wake.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace carom::internal {

namespace {

/// A body's way through a part of the step: from one pose to another, straight and evenly turning.
struct Piece
{
    float start = 0;
    float end = 0;
    Position from{};
    Position to{};
};

/// Pose at a time of the step, for a body that has no corners in its path.
BodyPose pose_along(const StepContext& ctx, int body, float time)
{
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    if (ctx.state.bodies[body].type == BodyType::Static || !is_awake(ctx.state, body))
        return {sim.center, sim.rotation, sim.local_center};
    const float t = ctx.dt > 0 ? time / ctx.dt : 1;
    const Rotation turn = sim.rotation * inverse(sim.previous_rotation);
    const float angle = turn.s != 0 ? static_cast<float>(arc_tangent(turn.s, turn.c)) : 0;
    return {sim.previous_center + t * (sim.center - sim.previous_center), Rotation::from_angle(t * angle) * sim.previous_rotation,
            sim.local_center};
}

class TriggerUpdate
{
public:
    TriggerUpdate(StepContext& ctx, int contact)
        : m_ctx(ctx), m_state(ctx.state), m_index(contact), m_contact(ctx.state.contacts[contact])
    {}

    void run()
    {
        const bool was_inside = (m_contact.flags & contact_flag::touching) != 0;
        const bool is_inside = separation(m_ctx.dt) <= 0;
        if (!was_inside)
        {
            const float enter = is_inside && !may_cross() ? m_ctx.dt : first_touch(false);
            if (is_inside || enter <= m_ctx.dt)
                enter_at(std::min(enter, m_ctx.dt));
        }
        if (!is_inside && (m_contact.flags & contact_flag::touching) != 0)
            end_touch(m_ctx.scene, m_index, m_ctx.scene.events, std::clamp(m_ctx.dt - first_touch(true), 0.0f, m_ctx.dt));
        m_contact.flags &= ~contact_flag::fresh;
    }

private:
    void enter_at(float time)
    {
        m_contact.flags |= contact_flag::touching;
        if (touches_elsewhere(m_state, m_index))
            return;
        m_ctx.scene.events.enters.push_back({shape_id(m_state, m_contact.shape_a), shape_id(m_state, m_contact.shape_b),
                                             body_id(m_state, m_contact.body_a), body_id(m_state, m_contact.body_b), time});
    }

    [[nodiscard]] float motion() const
    {
        float sum = 0;
        for (const int body : {m_contact.body_a, m_contact.body_b})
        {
            if (!is_awake(m_state, body))
                continue;
            const BodySim& sim = m_state.sims[static_cast<std::size_t>(body)];
            const Rotation turn = sim.rotation * inverse(sim.previous_rotation);
            sum += length(sim.center - sim.previous_center) +
                   sim.extent * std::fabs(static_cast<float>(arc_tangent(turn.s, turn.c)));
        }
        for (const PathPoint& p : path())
            sum += static_cast<float>(std::fabs(p.x) + std::fabs(p.y));
        return sum;
    }
    [[nodiscard]] bool may_cross() const { return motion() > 0; }

    // Corners of the visitor's path, of a ball that hit something in this step.
    [[nodiscard]] std::vector<PathPoint> path() const
    {
        std::vector<PathPoint> points;
        const int place = m_state.bodies[m_contact.body_b].awake_index;
        if (place == none || static_cast<std::size_t>(place) >= m_ctx.scratch.unit_of.size())
            return points;
        const std::int32_t unit = m_ctx.scratch.unit_of[static_cast<std::size_t>(place)];
        if (unit == none)
            return points;
        for (const PathPoint& p : m_ctx.scratch.outputs[static_cast<std::size_t>(unit)].path)
        {
            if (p.body == m_contact.body_b)
                points.push_back(p);
        }
        return points;
    }

    [[nodiscard]] BodyPose visitor_at(float time) const
    {
        BodyPose pose = pose_along(m_ctx, m_contact.body_b, time);
        const std::vector<PathPoint> corners = path();
        if (corners.empty())
            return pose;
        const BodySim& sim = m_state.sims[static_cast<std::size_t>(m_contact.body_b)];
        Piece piece{0, m_ctx.dt, sim.previous_center, sim.center};
        for (const PathPoint& p : corners)
        {
            const Position corner{sim.previous_center.x + p.x, sim.previous_center.y + p.y};
            if (p.time <= time)
            {
                piece.start = p.time;
                piece.from = corner;
            }
            else
            {
                piece.end = p.time;
                piece.to = corner;
                break;
            }
        }
        const float t = piece.end > piece.start ? (time - piece.start) / (piece.end - piece.start) : 0;
        pose.center = piece.from + t * (piece.to - piece.from);
        return pose;
    }

    [[nodiscard]] float separation(float time) const
    {
        const Manifold m = world_manifold(m_state, m_contact, pose_along(m_ctx, m_contact.body_a, time), visitor_at(time), 3e38f);
        return least_separation(m);
    }

    // The first time from the start (or, backwards, from the end) at which the two touch; beyond the step where they do not.
    // A gap closes no faster than the whole motion of both bodies in the step allows, several corners included.
    [[nodiscard]] float first_touch(bool backwards) const
    {
        const float travelled = motion();
        const float beyond = 2 * m_ctx.dt;
        if (!(travelled > 0))
            return beyond;
        const float speed = (1 + static_cast<float>(path().size())) * travelled / m_ctx.dt;
        const float nearest = 1e-3f * m_ctx.scene.tolerances.slop;
        const float least_step = 1e-4f * m_ctx.dt;
        float t = 0;
        for (int i = 0; i < 400 && t <= m_ctx.dt; ++i)
        {
            const float gap = separation(backwards ? m_ctx.dt - t : t);
            // What only touches and moves away has not come in.
            const float after = std::min(t + least_step, m_ctx.dt);
            if (gap <= nearest && separation(backwards ? m_ctx.dt - after : after) < std::max(gap, 0.0f))
                return t;
            t += std::max(std::min(gap, travelled) / speed, least_step);
        }
        return beyond;
    }

    StepContext& m_ctx;
    SceneState& m_state;
    int m_index;
    Contact& m_contact;
};

} // namespace

void update_triggers(StepContext& ctx)
{
    SceneState& state = ctx.state;
    std::vector<std::int32_t>& order = ctx.scratch.order;
    order.assign(state.trigger_contacts.begin(), state.trigger_contacts.end());
    for (const std::int32_t index : order)
    {
        Contact& contact = state.contacts[index];
        const bool moves = is_awake(state, contact.body_a) || is_awake(state, contact.body_b);
        if (!moves && (contact.flags & contact_flag::fresh) == 0)
            continue;
        TriggerUpdate(ctx, index).run();
        if ((contact.flags & contact_flag::touching) == 0 && !boxes_meet(state, contact.shape_a, contact.shape_b))
            destroy_contact(ctx.scene, index, ctx.scene.events, ctx.dt);
    }
}

} // namespace carom::internal
