// Stage 1, sweep: paths and boxes. Reads velocities and forces, writes fat boxes of the moving layer.

#include "core/grow.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "core/trigonometry.h"
#include "dynamics/forces/force_laws.h"
#include "dynamics/solver/simd/kernels.h"
#include "dynamics/stages.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/quarantine.h"
#include "dynamics/task_sizes.h"
#include "geometry/leaf_traits.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

// Sets the velocity that reaches the target at the end of the step, turning the shorter way.
void aim_at_target(BodySim& sim, const BodyTarget& target, float dt)
{
    const Rotation turn = target.rotation * inverse(sim.rotation);
    sim.velocity = (1 / dt) * (target.center - sim.center);
    sim.angular_velocity = static_cast<float>(arc_tangent(turn.s, turn.c)) / dt;
}

// Bound on a point's displacement by rotation, by the curvature of its parabola, and in any direction by a force law.
float free_motion(const StepContext& ctx, int body, const BodySim& sim, Vec2 shift)
{
    const float gained = ctx.dt * sim.inverse_inertia * std::fabs(sim.torque) + greatest_spin_of_law(ctx, body);
    const float angle = (std::fabs(sim.angular_velocity) + gained) * ctx.dt;
    const float bend = 0.5f * length(shift - ctx.dt * sim.velocity);
    return sim.extent * (angle < 2 ? angle : 2.0f) + bend + greatest_shift_of_law(ctx, body);
}

// A fat box made for a fast path is far too wide for a body that has slowed down.
bool too_wide(F4 fat, F4 needed, float margin)
{
    const auto size = [](F4 box) { return swapped_halves(box) - box; };
    return (bits(size(fat) > size(needed) + F4(8 * margin)) & 3) != 0;
}

// Impulses may produce a velocity beyond all finite numbers; such a body is quarantined before it affects others.
bool is_sound(const BodySim& sim, float motion)
{
    return motion + std::fabs(sim.angular_velocity) + std::fabs(sim.torque) < 1e15f;
}

// A body that moves farther than its margin gets a new box in the next step anyway.
void move_box(MovedBoxes& moved, int shape, F4 needed, float motion, float margin)
{
    moved.items.push_back(shape);
    moved.boxes.push_back(box_of(grown(needed, motion < margin ? margin : 0)));
}

// Writes to this body and its boxes alone.
void sweep_body(const StepContext& ctx, int body, float& motion, MovedBoxes& moved)
{
    SceneState& state = ctx.state;
    BodyRecord& record = state.bodies[body];
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    if (record.has_target)
        aim_at_target(sim, state.targets[static_cast<std::size_t>(body)], ctx.dt);
    const Vec2 shift = predicted_shift(ctx, record, sim);
    const float any_displacement = free_motion(ctx, body, sim, shift);
    motion = length(shift) + any_displacement;
    if (!is_sound(sim, motion))
    {
        moved.unsound.push_back(body);
        return;
    }
    const float margin = ctx.scene.tolerances.box_margin;
    const Pose pose = sim.pose();
    for_each_leaf(state, body,
                  [&](int shape)
                  {
                      const F4 tight = outer_bounds(leaf_view(state, shape), pose);
                      state.broad_phase.set_path(shape, {box_of(tight), shift, any_displacement});
                      const F4 needed = grown(swept(tight, shift, any_displacement), 0.25f * margin);
                      const F4 fat = load4(&state.broad_phase.box(shape).lx);
                      if (!contains(fat, needed) || too_wide(fat, needed, margin))
                          move_box(moved, shape, needed, motion, margin);
                  });
}

// Prefetches what sweep_body will read.
[[gnu::always_inline]] inline void prefetch_body(const SceneState& state, int body)
{
    prefetch(state.sims[static_cast<std::size_t>(body)]);
    const int shape = state.bodies[body].first_shape;
    if (shape == none)
        return;
    prefetch_line(&state.shapes[shape]); // the first line holds the leaf, except for an arc
    state.broad_phase.prefetch_place(shape);
}

// Sweeps a task's bodies. Leaves with corners go through a kernel, eight at a time, where no force law acts.
class TaskSweep
{
public:
    TaskSweep(const StepContext& ctx, std::size_t first, std::size_t last, MovedBoxes& moved)
        : m_ctx(ctx), m_first(first), m_last(last), m_moved(moved)
    {}

    void run()
    {
        m_side_by_side = m_ctx.scene.law_count == 0;
        if (sweep())
            return;
        m_side_by_side = false; // to find the unsound bodies
        sweep();
    }

private:
    // False where the lanes hold an unsound body. Filled lanes are swept before a body that is swept by itself, so that boxes stay in order.
    bool sweep()
    {
        m_moved.items.clear();
        m_moved.boxes.clear();
        m_moved.unsound.clear();
        m_lanes = 0;
        const std::vector<std::int32_t>& bodies = m_ctx.state.awake_bodies;
        for (std::size_t i = m_first; i < m_last; ++i)
        {
            prefetch_later(i);
            if (m_side_by_side && is_plain(bodies[i]))
            {
                if (!put_in_lanes(i))
                    return false;
                continue;
            }
            if (!sweep_lanes())
                return false;
            sweep_body(m_ctx, bodies[i], m_ctx.scratch.broad.motion[i], m_moved);
        }
        return sweep_lanes();
    }

    [[gnu::always_inline]] void prefetch_later(std::size_t i) const
    {
        if (i + prefetch_distance < m_last)
            prefetch_body(m_ctx.state, m_ctx.state.awake_bodies[i + prefetch_distance]);
    }

    [[nodiscard]] bool is_plain(int body) const
    {
        const BodyRecord& record = m_ctx.state.bodies[body];
        bool plain = record.type == BodyType::Dynamic && record.first_shape != none;
        for_each_leaf(m_ctx.state, body, [&](int shape) { plain &= traits_of(m_ctx.state.shapes[shape].leaf).has_corners; });
        return plain;
    }

    bool put_in_lanes(std::size_t place)
    {
        bool sound = true;
        const int body = m_ctx.state.awake_bodies[place];
        for_each_leaf(m_ctx.state, body,
                      [&](int shape)
                      {
                          m_shapes[m_lanes] = shape;
                          m_body_places[m_lanes] = place;
                          m_eight.bodies[m_lanes] = &m_ctx.state.sims[static_cast<std::size_t>(body)];
                          m_eight.places[m_lanes] = &m_ctx.state.broad_phase.place(shape);
                          put_corners(leaf_view(m_ctx.state, shape), m_lanes);
                          if (++m_lanes == lane_count)
                              sound &= sweep_lanes();
                      });
        return sound;
    }

    void put_corners(const LeafView& view, int lane)
    {
        const Leaf& leaf = *view.leaf;
        m_eight.corners[lane] = view.points;
        m_eight.corner_counts[lane] = leaf.count;
        m_eight.radii[0].v[lane] = m_eight.radii[1].v[lane] = leaf.r0;
        if (leaf.type == LeafType::Polygon)
            return;
        m_eight.corners[lane] = &leaf.p0;
        m_eight.corner_counts[lane] = 2;
        if (traits_of(leaf).has_two_ends)
        {
            m_eight.radii[1].v[lane] = leaf.r1;
            return;
        }
        m_centers[lane][0] = m_centers[lane][1] = leaf.p0;
        m_eight.corners[lane] = m_centers[lane];
    }

    // Unused lanes repeat the first one.
    bool sweep_lanes()
    {
        const int count = std::exchange(m_lanes, 0);
        if (count == 0)
            return true;
        for (int i = count; i < lane_count; ++i)
        {
            m_eight.bodies[i] = m_eight.bodies[0];
            m_eight.places[i] = m_eight.places[0];
            m_eight.corners[i] = m_eight.corners[0];
            m_eight.corner_counts[i] = m_eight.corner_counts[0];
            for (LaneFloats& radii : m_eight.radii)
                radii.v[i] = radii.v[0];
        }
        const float margin = m_ctx.scene.tolerances.box_margin;
        if (!m_kernels.sweep(m_eight, {m_ctx.dt, m_ctx.state.gravity, margin}))
            return false;
        for (int i = 0; i < count; ++i)
        {
            m_ctx.scratch.broad.motion[m_body_places[i]] = m_eight.motion.v[i];
            if ((m_eight.moved >> i & 1u) != 0)
                move_box(m_moved, m_shapes[i], four_of(m_eight.lx.v[i], m_eight.ly.v[i], m_eight.ux.v[i], m_eight.uy.v[i]),
                         m_eight.motion.v[i], margin);
        }
        return true;
    }

    const StepContext& m_ctx;
    std::size_t m_first;
    std::size_t m_last;
    MovedBoxes& m_moved;
    SweptEight m_eight;
    Vec2 m_centers[lane_count][2]; ///< of circles
    int m_shapes[lane_count];
    std::size_t m_body_places[lane_count]; ///< index in awake_bodies
    int m_lanes = 0;
    bool m_side_by_side = false;
    const WideKernels& m_kernels = wide_kernels();
};

// True if all bodies are sound.
bool sweep_all(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    const std::vector<std::int32_t>& bodies = ctx.state.awake_bodies;
    set_size(scratch.broad.motion, bodies.size());
    const std::span<MovedBoxes> parts =
        find_in_chunks(ctx.scene.def.tasks, bodies.size(), bodies_per_task, scratch.broad.moved_of_task,
                       [&](std::size_t first, std::size_t last, MovedBoxes& moved) { TaskSweep(ctx, first, last, moved).run(); });
    MovedBoxes& all = scratch.broad.moved;
    all.items.clear();
    all.boxes.clear();
    scratch.unsound.clear();
    for (const MovedBoxes& some : parts)
    {
        append_all(all.items, some.items);
        append_all(all.boxes, some.boxes);
        append_all(scratch.unsound, some.unsound);
    }
    for (const std::int32_t body : scratch.unsound)
        quarantine(ctx, body, 0);
    return scratch.unsound.empty();
}

} // namespace

void sweep_paths(StepContext& ctx)
{
    wake_overlapped(ctx);
    while (!sweep_all(ctx))
    { // again, without the quarantined bodies
    }
    const MovedBoxes& moved = ctx.scratch.broad.moved;
    ctx.scratch.broad.all_fitted =
        !moved.items.empty() && ctx.state.broad_phase.update_moving(ctx.scene.def.tasks, moved.items, moved.boxes);
}

} // namespace carom::internal
