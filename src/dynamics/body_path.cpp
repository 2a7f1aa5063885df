#include "dynamics/body_path.h"

#include "core/trigonometry.h"
#include "dynamics/scene_data.h"
#include "dynamics/wake.h"

#include <algorithm>
#include <tuple>

namespace carom::internal {

void gather_paths(StepContext& ctx)
{
    std::vector<PathPiece>& paths = ctx.scratch.paths;
    paths.clear();
    for (std::size_t u = 0; u < ctx.scratch.units.size(); ++u)
    {
        const std::vector<PathPiece>& pieces = ctx.scratch.outputs[u].path;
        paths.insert(paths.end(), pieces.begin(), pieces.end());
    }
    for (std::size_t i = 0; i < paths.size(); ++i)
        paths[i].order = static_cast<std::int32_t>(i);
    std::sort(paths.begin(), paths.end(),
              [](const PathPiece& x, const PathPiece& y) { return std::tie(x.body, x.order) < std::tie(y.body, y.order); });
}

namespace {

// What woke after the step began has not moved in it.
bool took_part(const StepContext& ctx, int body)
{
    const BodyRecord& record = ctx.state.bodies[body];
    return record.type != BodyType::Static && record.awake_index != none &&
           static_cast<std::size_t>(record.awake_index) < ctx.scratch.unit_of.size();
}

std::span<const PathPiece> recorded(const StepContext& ctx, int body)
{
    const auto [first, last] = std::equal_range(ctx.scratch.paths.begin(), ctx.scratch.paths.end(), PathPiece{body, 0, 0, {}},
                                                [](const PathPiece& x, const PathPiece& y) { return x.body < y.body; });
    return {first, last};
}

} // namespace

BodyPath::BodyPath(const StepContext& ctx, int body) : m_dt(static_cast<double>(ctx.dt))
{
    m_start = m_end = pose_at_start(ctx.state, body);
    m_pieces = {&m_chord, 1};
    m_chord.path.c = static_cast<double>(m_end.rotation.c);
    m_chord.path.s = static_cast<double>(m_end.rotation.s);
    m_chord.path.local_center = m_end.local_center;
    if (!took_part(ctx, body))
        return;
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    m_start.center = sim.previous_center;
    m_start.rotation = sim.previous_rotation;
    m_moves = m_start.center != m_end.center || m_start.rotation != m_end.rotation;
    follow_chord(ctx, body);
    const std::span<const PathPiece> pieces = recorded(ctx, body);
    if (!pieces.empty() && ends_there(pieces, 0.01 * static_cast<double>(sim.size)))
        m_pieces = pieces;
}

// Not so where a wall has stopped the body short of it afterwards (stop_at_wall.cpp).
bool BodyPath::ends_there(std::span<const PathPiece> pieces, double tolerance) const
{
    const PathPiece& last = pieces.back();
    const FramePath end = path_after(last.path, m_dt - last.start);
    // A hinge's pivot and the center of mass are different points.
    const Vec2 arm =
        rotate(Rotation{static_cast<float>(end.c), static_cast<float>(end.s)}, m_start.local_center - end.local_center);
    const double x = m_start.center.x + end.center.x + static_cast<double>(arm.x) - m_end.center.x;
    const double y = m_start.center.y + end.center.y + static_cast<double>(arm.y) - m_end.center.y;
    return x * x + y * y <= tolerance * tolerance;
}

// From pose to pose, straight and evenly turning: the very path of a kinematic body.
void BodyPath::follow_chord(const StepContext& ctx, int body)
{
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    FramePath& path = m_chord.path;
    path.c = static_cast<double>(m_start.rotation.c);
    path.s = static_cast<double>(m_start.rotation.s);
    path.center.vx = (m_end.center.x - m_start.center.x) / m_dt;
    path.center.vy = (m_end.center.y - m_start.center.y) / m_dt;
    const BodyRecord& record = ctx.state.bodies[body];
    const Rotation turn = m_end.rotation * inverse(m_start.rotation);
    const bool turns_evenly = record.type == BodyType::Kinematic && !record.has_target; // by more than half a turn, even
    path.w = turns_evenly ? static_cast<double>(sim.angular_velocity) : arc_tangent(turn.s, turn.c) / m_dt;
}

FramePath BodyPath::from(double time) const
{
    // The last piece that has begun. The first one counts as begun.
    std::size_t i = m_pieces.size() - 1;
    while (i > 0 && m_pieces[i].start > time)
        --i;
    return path_after(m_pieces[i].path, time - m_pieces[i].start);
}

double BodyPath::next_bend(double time) const
{
    for (const PathPiece& piece : m_pieces)
    {
        if (piece.start > time)
            return std::min(piece.start, m_dt);
    }
    return m_dt;
}

} // namespace carom::internal
