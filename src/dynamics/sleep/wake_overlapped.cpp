// Before a step, a shape that is new, or that the user has moved or changed, wakes the sleepers that it overlaps. Its pairs would find them too, but a
// sleeping body is in no step, and a static body wakes nothing by itself.

#include "collision/manifold.h"
#include "dynamics/broadphase/half_space_box.h"
#include "dynamics/forces/fields.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/stages.h"
#include "dynamics/state/contact_store.h"
#include "geometry/leaf_traits.h"

#include <vector>

namespace carom::internal {

namespace {

class FreshOverlaps
{
public:
    explicit FreshOverlaps(StepContext& ctx) : m_ctx(ctx), m_state(ctx.state) {}

    // The shapes of woken bodies become fresh as well, but need no query: what they touch wakes with their island.
    void wake()
    {
        const std::size_t count = m_state.fresh_shapes.size();
        for (std::size_t i = 0; i < count; ++i)
        {
            const int shape = m_state.fresh_shapes[i];
            if (m_state.shapes.is_live(shape) && m_state.broad_phase.has(shape) && !is_moving_dynamic(shape))
                look_around(shape);
        }
        for (const std::int32_t body : m_woken)
            wake_body(m_ctx.scene, body);
    }

private:
    [[nodiscard]] bool is_moving_dynamic(int shape) const
    {
        const BodyRecord& body = m_state.bodies[m_state.shapes[shape].body];
        return body.type == BodyType::Dynamic && body.awake_index != none;
    }

    [[nodiscard]] bool sleeps(int shape) const
    {
        const BodyRecord& body = m_state.bodies[m_state.shapes[shape].body];
        return body.type == BodyType::Dynamic && body.awake_index == none;
    }

    void look_around(int shape)
    {
        const auto look_at = [&](int other)
        {
            meet(shape, other);
            return true;
        };
        if (!traits_of(m_state.shapes[shape].leaf).is_bounded)
        {
            m_state.broad_phase.descend(
                Layer::Resting, [&](const FloatBox& box) { return reaches_half_space(m_state, shape, box, 0); }, look_at);
            return;
        }
        const FloatBox& box = m_state.broad_phase.box(shape);
        m_state.broad_phase.query(Layer::Resting, box, look_at);
        for (const std::int32_t half_space : m_state.broad_phase.unbounded())
        {
            if (reaches_half_space(m_state, half_space, box, 0))
                meet(shape, half_space);
        }
    }

    void meet(int shape, int other)
    {
        if (shape == other || (!sleeps(shape) && !sleeps(other)) || !may_collide(m_state, shape, other) || !overlap(shape, other))
            return;
        for (const int s : {shape, other})
        {
            if (sleeps(s))
                m_woken.push_back(m_state.shapes[s].body);
        }
    }

    // Whether the shapes overlap by more than touching shapes do. A trigger counts only if it has a field.
    [[nodiscard]] bool overlap(int shape, int other) const
    {
        const ShapeRecord& a = m_state.shapes[shape];
        const ShapeRecord& b = m_state.shapes[other];
        const bool by_trigger = a.trigger || b.trigger;
        if (by_trigger && !acts(rare_traits_of(m_state, a.trigger ? a : b).field))
            return false;
        const RelativePose pose = relative_pose(pose_at_start(m_state, a.body).frame(), pose_at_start(m_state, b.body).frame());
        const float margin = by_trigger ? 0 : -m_ctx.scene.tolerances.slop;
        return collide(leaf_view(m_state, shape), leaf_view(m_state, other), pose, margin).count > 0;
    }

    StepContext& m_ctx;
    SceneState& m_state;
    std::vector<std::int32_t> m_woken;
};

} // namespace

void wake_overlapped(StepContext& ctx)
{
    if (!ctx.state.fresh_shapes.empty())
        FreshOverlaps(ctx).wake();
}

} // namespace carom::internal
