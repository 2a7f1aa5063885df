// Paths of bodies over a whole step, put together from the recorded pieces.

#include "dynamics/continuous/path/body_path.h"

#include "core/grow.h"
#include "core/trigonometry.h"
#include "dynamics/state/scene_data.h"
#include "geometry/bounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace carom::internal {

void gather_paths(StepContext& ctx)
{
    std::vector<PathPiece>& paths = ctx.scratch.sensors.paths;
    paths.clear();
    for (std::size_t u = 0; u < ctx.scratch.solver.islands.size(); ++u)
    {
        const std::vector<PathPiece>& pieces = ctx.scratch.solver.outputs[u].path;
        append_all(paths, pieces);
    }
    for (std::size_t i = 0; i < paths.size(); ++i)
        paths[i].order = static_cast<std::int32_t>(i);
    std::sort(paths.begin(), paths.end(),
              [](const PathPiece& x, const PathPiece& y) { return std::tie(x.body, x.order) < std::tie(y.body, y.order); });
}

namespace {

// A body that woke after the step began has not moved in it.
bool took_part(const StepContext& ctx, int body)
{
    const BodyRecord& record = ctx.state.bodies[body];
    return record.type != BodyType::Static && record.awake_index != none &&
           static_cast<std::size_t>(record.awake_index) < ctx.scratch.graph.island_of.size();
}

std::span<const PathPiece> recorded(const StepContext& ctx, int body)
{
    const auto [first, last] =
        std::equal_range(ctx.scratch.sensors.paths.begin(), ctx.scratch.sensors.paths.end(), PathPiece{body, 0, 0, {}},
                         [](const PathPiece& x, const PathPiece& y) { return x.body < y.body; });
    return {first, last};
}

} // namespace

BodyPath::BodyPath(const StepContext& ctx, int body) : m_dt(static_cast<double>(ctx.dt))
{
    m_start = m_end = pose_at_start(ctx.state, body);
    const bool moved = took_part(ctx, body);
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    if (moved)
    {
        m_start.center = sim.previous_center;
        m_start.rotation = sim.previous_rotation;
    }
    m_chord.c = static_cast<double>(m_start.rotation.c);
    m_chord.s = static_cast<double>(m_start.rotation.s);
    m_chord.local_center = m_start.local_center;
    if (!moved)
        return;
    const std::span<const PathPiece> pieces = recorded(ctx, body);
    if (pieces.empty() || !ends_there(pieces, 0.01 * static_cast<double>(sim.size)))
    {
        follow_chord(ctx, body);
    }
    else
    {
        m_pieces = pieces;
        if (pieces.front().start > 0)
            lead_to(pieces.front());
    }
    measure(static_cast<double>(sim.extent));
}

void BodyPath::measure(double extent)
{
    const auto displacement = [&](const FramePath& p, double time)
    {
        const double speed = length_of(p.center.vx, p.center.vy) + 0.5 * time * length_of(p.center.ax, p.center.ay);
        const double turn = std::fabs(p.w) + 0.5 * time * std::fabs(p.alpha);
        const double arm = static_cast<double>(length(p.local_center - m_start.local_center));
        return time * (speed + turn * (extent + arm));
    };
    m_reach = displacement(m_chord, m_pieces.empty() ? m_dt : m_pieces.front().start);
    for (std::size_t i = 0; i < m_pieces.size(); ++i)
        m_reach += displacement(m_pieces[i].path, (i + 1 < m_pieces.size() ? m_pieces[i + 1].start : m_dt) - m_pieces[i].start);
}

// The path from start to end pose at constant velocity and angular velocity: the exact path of a kinematic body.
void BodyPath::follow_chord(const StepContext& ctx, int body)
{
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    m_chord.center.vx = (m_end.center.x - m_start.center.x) / m_dt;
    m_chord.center.vy = (m_end.center.y - m_start.center.y) / m_dt;
    const BodyRecord& record = ctx.state.bodies[body];
    const Rotation turn = m_end.rotation * inverse(m_start.rotation);
    const bool turns_evenly = record.type == BodyType::Kinematic && !record.has_target; // exact even beyond half a turn
    m_chord.w = turns_evenly ? static_cast<double>(sim.angular_velocity) : arc_tangent(turn.s, turn.c) / m_dt;
}

// A body that came near triggers only because it was deflected is recorded from then on: before that its path is straight.
void BodyPath::lead_to(const PathPiece& first)
{
    m_chord.local_center = first.path.local_center;
    const Vec2 arm = rotate(m_start.rotation, m_chord.local_center - m_start.local_center);
    m_chord.center.x = static_cast<double>(arm.x);
    m_chord.center.y = static_cast<double>(arm.y);
    m_chord.center.vx = (first.path.center.x - m_chord.center.x) / first.start;
    m_chord.center.vy = (first.path.center.y - m_chord.center.y) / first.start;
    m_chord.w =
        arc_tangent(first.path.s * m_chord.c - first.path.c * m_chord.s, first.path.c * m_chord.c + first.path.s * m_chord.s) /
        first.start;
}

// False where a wall has stopped the body short of the path's end afterwards (safety_sweep.cpp).
bool BodyPath::ends_there(std::span<const PathPiece> pieces, double tolerance) const
{
    const FramePath end = path_after(pieces.back().path, m_dt - pieces.back().start);
    // A hinge's pivot and the center of mass are different points.
    const Vec2 arm =
        rotate(Rotation{static_cast<float>(end.c), static_cast<float>(end.s)}, m_start.local_center - end.local_center);
    const double x = m_start.center.x + end.center.x + static_cast<double>(arm.x) - m_end.center.x;
    const double y = m_start.center.y + end.center.y + static_cast<double>(arm.y) - m_end.center.y;
    return x * x + y * y <= tolerance * tolerance;
}

FramePath BodyPath::from(double time) const
{
    const auto next = std::ranges::upper_bound(m_pieces, time, {}, &PathPiece::start);
    if (next == m_pieces.begin())
        return path_after(m_chord, time);
    const PathPiece& piece = *std::prev(next);
    return path_after(piece.path, time - piece.start);
}

double BodyPath::next_curve(double time) const
{
    const auto next = std::ranges::upper_bound(m_pieces, time, {}, &PathPiece::start);
    return next == m_pieces.end() ? m_dt : std::min(next->start, m_dt);
}

FloatBox deflected_box(const StepContext& ctx, int body)
{
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    FloatBox box = round_outwards(Box{sim.center, sim.center});
    const std::span<const PathPiece> pieces = recorded(ctx, body);
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
        const double end = i + 1 < pieces.size() ? pieces[i + 1].start : static_cast<double>(ctx.dt);
        const CenterPath& from = pieces[i].path.center;
        const CenterPath to = path_after(pieces[i].path, end - pieces[i].start).center;
        // A parabolic arc lies in the triangle of its ends and the crossing of their tangents.
        const double half = 0.5 * (end - pieces[i].start);
        for (const Position& p :
             {Position{from.x, from.y}, Position{from.x + half * from.vx, from.y + half * from.vy}, Position{to.x, to.y}})
        {
            const Position at{sim.previous_center.x + p.x, sim.previous_center.y + p.y};
            box = unite(box, round_outwards(Box{at, at}));
        }
    }
    return grow(box, sim.extent);
}

} // namespace carom::internal
