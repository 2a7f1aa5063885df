// Stage 1, sweep: paths and boxes. Reads velocities and forces, writes fat boxes of the moving layer.

#include "core/prefetch.h"
#include "core/task_pool.h"
#include "core/trigonometry.h"
#include "dynamics/body_store.h"
#include "dynamics/force_laws.h"
#include "dynamics/quarantine.h"
#include "dynamics/stages.h"

#include <cmath>
#include <span>

namespace carom::internal {

namespace {

constexpr std::size_t bodies_per_task = 512;

// The velocity that reaches the target at the end of the step, the shorter way round.
void aim_at_target(BodySim& sim, const BodyTarget& target, float dt)
{
    const Rotation turn = target.rotation * inverse(sim.rotation);
    sim.velocity = (1 / dt) * (target.center - sim.center);
    sim.angular_velocity = static_cast<float>(arc_tangent(turn.s, turn.c)) / dt;
}

// How far a point may come by turning, by the bend of its parabola, and any way that a force law may push.
float free_motion(const StepContext& ctx, int body, const BodySim& sim, Vec2 shift)
{
    const float gained = ctx.dt * sim.inverse_inertia * std::fabs(sim.torque) + greatest_spin_of_law(ctx, body);
    const float angle = (std::fabs(sim.angular_velocity) + gained) * ctx.dt;
    const float bend = 0.5f * length(shift - ctx.dt * sim.velocity);
    return sim.extent * (angle < 2 ? angle : 2.0f) + bend + greatest_shift_of_law(ctx, body);
}

// A fat box that held a fast path is far too wide for a body that has slowed down.
bool too_wide(F4 fat, F4 needed, float margin)
{
    const auto size = [](F4 box) { return swap_halves(box) - box; };
    return (bits(size(fat) > size(needed) + 8 * margin) & 3) != 0;
}

// Impulses may make a velocity that leads out of all numbers; such a body is put aside before it takes others along.
bool is_sound(const BodySim& sim, float motion)
{
    return motion + std::fabs(sim.angular_velocity) + std::fabs(sim.torque) < 1e15f;
}

// Writes to its own body and boxes alone.
void sweep_body(const StepContext& ctx, int body, float& motion, MovedBoxes& moved)
{
    SceneState& state = ctx.state;
    BodyRecord& record = state.bodies[body];
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    if (record.has_target)
        aim_at_target(sim, state.targets[static_cast<std::size_t>(body)], ctx.dt);
    const Vec2 shift = predicted_shift(ctx, record, sim);
    const float any_way = free_motion(ctx, body, sim, shift);
    motion = length(shift) + any_way;
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
                      state.broad_phase.set_path(shape, {box_of(tight), shift, any_way});
                      const F4 needed = grown(swept(tight, shift, any_way), 0.25f * margin);
                      const F4 fat = load4(&state.broad_phase.box(shape).lx);
                      if (contains(fat, needed) && !too_wide(fat, needed, margin))
                          return;
                      moved.items.push_back(shape);
                      // What moves farther than its margin gets a new box in the next step anyhow.
                      moved.boxes.push_back(box_of(grown(needed, motion < margin ? margin : 0)));
                  });
}

// What sweep_body will read.
[[gnu::always_inline]] inline void prefetch_body(const SceneState& state, int body)
{
    prefetch(state.sims[static_cast<std::size_t>(body)]);
    const int shape = state.bodies[body].first_shape;
    if (shape == none)
        return;
    __builtin_prefetch(&state.shapes[shape]); // the first line: leaves but for arcs
    state.broad_phase.prefetch_place(shape);
}

// True where all are sound.
bool sweep_all(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    const std::vector<std::int32_t>& bodies = ctx.state.awake_bodies;
    scratch.motion.resize(bodies.size());
    const std::span<MovedBoxes> parts = find_in_parts(ctx.scene.def.tasks, bodies.size(), bodies_per_task, scratch.moved_of_task,
                                                      [&](std::size_t first, std::size_t last, MovedBoxes& moved)
                                                      {
                                                          moved.items.clear();
                                                          moved.boxes.clear();
                                                          moved.unsound.clear();
                                                          for (std::size_t i = first; i < last; ++i)
                                                          {
                                                              if (i + turns_ahead < last)
                                                                  prefetch_body(ctx.state, bodies[i + turns_ahead]);
                                                              sweep_body(ctx, bodies[i], scratch.motion[i], moved);
                                                          }
                                                      });
    MovedBoxes& all = scratch.moved;
    all.items.clear();
    all.boxes.clear();
    scratch.unsound.clear();
    for (const MovedBoxes& some : parts)
    {
        all.items.insert(all.items.end(), some.items.begin(), some.items.end());
        all.boxes.insert(all.boxes.end(), some.boxes.begin(), some.boxes.end());
        scratch.unsound.insert(scratch.unsound.end(), some.unsound.begin(), some.unsound.end());
    }
    for (const std::int32_t body : scratch.unsound)
        quarantine(ctx, body, 0);
    return scratch.unsound.empty();
}

} // namespace

void sweep_paths(StepContext& ctx)
{
    while (!sweep_all(ctx))
    { // without those that were put aside
    }
    const MovedBoxes& moved = ctx.scratch.moved;
    ctx.scratch.all_fitted =
        !moved.items.empty() && ctx.state.broad_phase.update_moving(ctx.scene.def.tasks, moved.items, moved.boxes);
}

} // namespace carom::internal
