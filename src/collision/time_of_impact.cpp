// Conservative advancement of second order. At time t the surface gives distance d and normal n. Along that fixed normal (fixed in the
// leaf's frame) the gap starts at d with rate u, and its second derivative is never below -M. For convex surfaces the gap along a fixed
// normal never exceeds the distance, so d + u s - M s²/2 > 0 proves that nothing touches before its root. The search steps to the root and looks again.
// Near the hit the M term fades, and the step becomes Newton's: convergence is quadratic. The hollow side of an arc is not convex; there
// the curvature of the surface itself, v²/rho, is part of M.

#include "collision/time_of_impact.h"

#include "collision/flush.h"
#include "collision/probes.h"
#include "core/trigonometry.h"
#include "geometry/leaf_traits.h"
#include "geometry/surface.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

struct Vector
{
    double x = 0;
    double y = 0;
};
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
double size(Vector a) { return std::sqrt(dot(a, a)); }
Vector turned(SinCos q, Vector v) { return {q.cos * v.x - q.sin * v.y, q.sin * v.x + q.cos * v.y}; }
Vector turned_back(SinCos q, Vector v) { return {q.cos * v.x + q.sin * v.y, q.cos * v.y - q.sin * v.x}; }

SinCos rotation_at(const FramePath& f, double t)
{
    if (t == 0 || (f.w == 0 && f.alpha == 0))
        return {f.s, f.c};
    const SinCos turn = sin_cos(t * (f.w + 0.5 * t * f.alpha));
    return {f.s * turn.cos + f.c * turn.sin, f.c * turn.cos - f.s * turn.sin};
}

/// The relation of a probe to the surface at one moment.
struct Sight
{
    double distance; ///< gap between probe and surface
    Vector n;        ///< from the surface to the probe, world
    Vector point;    ///< on the probe
    Vector v;        ///< velocity of the probe in the rotating frame
    Vector a;
    double rate; ///< rate of the gap along the fixed normal
    double acceleration;
    double bend;  ///< M: bound on minus the gap's second derivative
    double speed; ///< bound on the relative speed over the rest of the time
    double push;  ///< the second derivative itself, along the fixed normal
    double jerk;  ///< bound on the third derivative over the rest of the time; no_bound on the hollow side or under torques
    double hollow_radius; ///< from the arc's center to the probe's, on the hollow side; 0 elsewhere
    double curvature;
    int feature;
    bool end_of_arc;
    bool faces; ///< whether the surface answers for this direction; otherwise only the distance and the speed are valid
};

constexpr double no_bound = 1e300;
constexpr double corner = 1e-5; // relative to the size: sharp corners that are nearer than this count as coincident

class Approach
{
public:
    Approach(const Probe& probe, const FramePath& carrier, const LeafView& leaf, const FramePath& frame, double duration,
             double length)
        : m_probe(probe), m_carrier(carrier), m_leaf(leaf), m_frame(frame), m_duration(duration), m_length(length),
          m_local{static_cast<double>(probe.point.x) - static_cast<double>(carrier.local_center.x),
                  static_cast<double>(probe.point.y) - static_cast<double>(carrier.local_center.y)},
          m_reach(size(m_local))
    {
        // A circle about the center of rotation looks the same at every angle.
        const Leaf& l = *leaf.leaf;
        if (l.type == LeafType::Circle && l.p0 == frame.local_center)
            m_frame.w = m_frame.alpha = 0;
        if (m_reach == 0)
            m_carrier.w = m_carrier.alpha = 0;
        m_a = {carrier.center.ax - frame.center.ax, carrier.center.ay - frame.center.ay};
        m_w_probe = std::fabs(m_carrier.w) + duration * std::fabs(m_carrier.alpha);
        m_w_frame = std::fabs(m_frame.w) + duration * std::fabs(m_frame.alpha);
    }

    /// Time before which the two do not touch. Exact for discs that turn about their centers and are accelerated alike; 0: unknown.
    [[nodiscard]] double earliest_touch() const
    {
        const Leaf& l = *m_leaf.leaf;
        if (l.type != LeafType::Circle || l.p0 != m_frame.local_center || m_reach != 0 || m_a.x != 0 || m_a.y != 0)
            return 0;
        const CenterPath& p = m_carrier.center;
        const CenterPath& f = m_frame.center;
        return first_meeting_of_circles(p.x - f.x, p.y - f.y, p.vx - f.vx, p.vy - f.vy,
                                        m_probe.radius + static_cast<double>(l.r0));
    }

    /// True where the surface is farther from the probe than the tolerance at t = 0, or does not answer.
    [[nodiscard]] bool starts_beyond(double tolerance) const
    {
        const SinCos turn_probe = {m_carrier.s, m_carrier.c};
        const SinCos turn_frame = {m_frame.s, m_frame.c};
        const Vector q = turned(turn_probe, m_local);
        const Vector r = {m_carrier.center.x + q.x - m_frame.center.x, m_carrier.center.y + q.y - m_frame.center.y};
        const Vector in_leaf = place_in_leaf(turn_frame, r);
        const std::optional<Surface<double>> surface = surface_for(in_leaf.x, in_leaf.y, turn_probe, turn_frame);
        return !surface || surface->distance - m_probe.radius > tolerance;
    }

    [[nodiscard]] Sight look(double t) const
    {
        const CenterPath& p = m_carrier.center;
        const CenterPath& f = m_frame.center;
        const SinCos turn_probe = rotation_at(m_carrier, t);
        const SinCos turn_frame = rotation_at(m_frame, t);
        const double wp = m_carrier.w + t * m_carrier.alpha;
        const double wf = m_frame.w + t * m_frame.alpha;
        const Vector q = turned(turn_probe, m_local);
        const Vector to_carrier = {p.x + t * p.vx + 0.5 * t * t * p.ax, p.y + t * p.vy + 0.5 * t * t * p.ay};
        const Vector r = {to_carrier.x + q.x - (f.x + t * f.vx + 0.5 * t * t * f.ax),
                          to_carrier.y + q.y - (f.y + t * f.vy + 0.5 * t * t * f.ay)};
        // Velocity of the probe in the rotating frame.
        const Vector v = {p.vx - f.vx + t * m_a.x - wp * q.y + wf * r.y, p.vy - f.vy + t * m_a.y + wp * q.x - wf * r.x};
        const Vector in_leaf = place_in_leaf(turn_frame, r);
        const std::optional<Surface<double>> surface = surface_for(in_leaf.x, in_leaf.y, turn_probe, turn_frame);
        Sight sight{};
        bound_motion(sight, t, r, v);
        if (!surface)
        {
            sight.distance = std::max(distance_to_line(m_leaf, in_leaf.x, in_leaf.y) - m_probe.radius,
                                      displacement_to_the_end(m_leaf, in_leaf.x, in_leaf.y));
            return sight;
        }
        sight.faces = true;
        sight.distance = surface->distance - m_probe.radius;
        sight.n = turned(turn_frame, {surface->nx, surface->ny});
        if (const int vertex = corner_met(surface->distance, in_leaf); vertex >= 0)
        {
            const std::optional<Vector> n = shared_normal(vertex, turn_frame, turn_probe);
            sight.faces = n.has_value();
            sight.n = n.value_or(sight.n);
        }
        sight.point = {to_carrier.x + q.x - m_probe.radius * sight.n.x, to_carrier.y + q.y - m_probe.radius * sight.n.y};
        sight.v = v;
        sight.rate = dot(v, sight.n);
        sight.curvature = surface->curvature;
        sight.feature = surface->feature;
        sight.end_of_arc = m_leaf.leaf->type == LeafType::Arc && surface->feature != 0;
        // The gap's own acceleration: the probe's in the rotating frame, and the curvature of the surface under its sliding.
        const Vector a = {m_a.x - m_carrier.alpha * q.y - wp * wp * q.x + 2 * wf * v.y + wf * wf * r.x + m_frame.alpha * r.y,
                          m_a.y + m_carrier.alpha * q.x - wp * wp * q.y - 2 * wf * v.x + wf * wf * r.y - m_frame.alpha * r.x};
        sight.a = a;
        const double slide = v.y * sight.n.x - v.x * sight.n.y;
        sight.push = dot(a, sight.n);
        sight.acceleration = sight.push + surface->curvature * slide * slide;
        sight.jerk = surface->curvature < 0 ? no_bound : bound_jerk(t, r, v);
        sight.bend += std::max(0.0, -dot(m_a, sight.n));
        if (surface->curvature < 0)
        {
            sight.hollow_radius = -1 / surface->curvature;
            sight.bend += 2 * sight.speed * sight.speed / sight.hollow_radius;
        }
        if (!sight.faces || !faces_probe(sight, turn_probe) || is_behind_seam(*surface, {r.x - q.x, r.y - q.y}, turn_frame))
        {
            sight.faces = false;
            sight.distance = std::fabs(sight.distance);
        }
        return sight;
    }

    /// Corrects a touch for flush neighbors: false where a neighbor hides it; otherwise true, and the sight may have another normal.
    [[nodiscard]] bool keep_to_union(double t, Sight& sight, const LeafView& probe_leaf, const FlushNeighbours& of_probe,
                                     const FlushNeighbours& of_surface) const
    {
        const SinCos turn_probe = rotation_at(m_carrier, t);
        const SinCos turn_frame = rotation_at(m_frame, t);
        const CenterPath& f = m_frame.center;
        const Vector frame_center = {f.x + t * f.vx + 0.5 * t * t * f.ax, f.y + t * f.vy + 0.5 * t * t * f.ay};
        const CenterPath& c = m_carrier.center;
        const Vector carrier_center = {c.x + t * c.vx + 0.5 * t * t * c.ax, c.y + t * c.vy + 0.5 * t * t * c.ay};
        const Vector to_origin =
            turned(turn_probe, {static_cast<double>(m_carrier.local_center.x), static_cast<double>(m_carrier.local_center.y)});
        const auto narrow = [](Vector v) { return Vec2{static_cast<float>(v.x), static_cast<float>(v.y)}; };
        const Vector origin = place_in_leaf(
            turn_frame, {carrier_center.x - to_origin.x - frame_center.x, carrier_center.y - to_origin.y - frame_center.y});
        const RelativePose pose{narrow(origin),
                                {static_cast<float>(turn_frame.cos * turn_probe.cos + turn_frame.sin * turn_probe.sin),
                                 static_cast<float>(turn_frame.cos * turn_probe.sin - turn_frame.sin * turn_probe.cos)}};
        const RelativePose back{pose.to_b({}), inverse(pose.rotation)};
        if (!is_in_own_cone(turned_back(turn_probe, {-sight.n.x, -sight.n.y})))
            return false;
        const Vec2 n = narrow(turned_back(turn_frame, sight.n));
        const Vec2 on_probe = narrow(place_in_leaf(turn_frame, {sight.point.x - frame_center.x, sight.point.y - frame_center.y}));
        const Vec2 on_surface = on_probe - static_cast<float>(sight.distance) * n;
        const Vec2 in_probe = pose.to_b(on_probe);
        const FlushAnswer by_surface = ask_flush(m_leaf, of_surface, probe_leaf, pose, {&on_surface, 1}, n);
        const FlushAnswer by_probe =
            ask_flush(probe_leaf, of_probe, m_leaf, back, {&in_probe, 1}, -inverse_rotate(pose.rotation, n));
        if (by_surface.verdict == FlushVerdict::Hidden || by_probe.verdict == FlushVerdict::Hidden)
            return false;
        const auto turn = [&](Vec2 normal)
        {
            sight.n = turned(turn_frame, {static_cast<double>(normal.x), static_cast<double>(normal.y)});
            sight.rate = dot(sight.v, sight.n);
            sight.acceleration = sight.push = dot(sight.a, sight.n);
            sight.curvature = 0;
        };
        if (by_surface.verdict == FlushVerdict::Turned)
            turn(edge_normal(m_leaf, by_surface.edge));
        else if (by_probe.verdict == FlushVerdict::Turned)
            turn(-rotate(pose.rotation, edge_normal(probe_leaf, by_probe.edge)));
        return true;
    }

private:
    // Whether a direction is in the normal cone of a polygon's vertex, in its frame. Otherwise an edge that has sunk in a little meets its support's side.
    [[nodiscard]] bool is_in_own_cone(Vector out) const
    {
        const auto cross = [](Vec2 a, Vector b) { return static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x; };
        return m_probe.before == Vec2{} || (cross(m_probe.before, out) >= -1e-3 && cross(m_probe.after, out) <= 1e-3);
    }

    // A point relative to the frame's center of rotation, in the leaf's frame.
    [[nodiscard]] Vector place_in_leaf(SinCos turn_frame, Vector r) const
    {
        const Vector local = turned_back(turn_frame, r);
        return {local.x + static_cast<double>(m_frame.local_center.x), local.y + static_cast<double>(m_frame.local_center.y)};
    }

    // The surface as the probe meets it. A vertex that has passed through a thin line by less than its band still counts as outside, on the side of
    // its shape: rounding must not decide that.
    [[nodiscard]] std::optional<Surface<double>> surface_for(double px, double py, SinCos turn_probe, SinCos turn_frame) const
    {
        const Leaf& leaf = *m_leaf.leaf;
        const std::optional<Surface<double>> plain = surface_at<double>(m_leaf, px, py);
        if (!traits_of(leaf).is_line || m_probe.band == 0 || (plain && plain->feature != 0) ||
            (plain && plain->distance > m_probe.band))
            return plain;
        // The surface at the same point, solid on both sides.
        Leaf both = leaf;
        both.sides = Sides::Both;
        const std::optional<Surface<double>> seen = surface_at<double>(LeafView{.leaf = &both, .span = m_leaf.span}, px, py);
        if (!seen || seen->distance > m_probe.band)
            return plain;
        // Out through a concave corner: the point is behind both pieces, and beyond the ends of both.
        const auto thickness = static_cast<double>(leaf.r0);
        const auto from_behind = [&](double curvature)
        { return Surface<double>{-(seen->distance + thickness) - thickness, -seen->nx, -seen->ny, curvature, 0}; };
        if (seen->feature == 1 && !plain && !start_may_answer(leaf, start_tangent(m_leaf)))
            return from_behind(0);
        if (seen->feature != 0)
            return plain;
        const Vector out = turned_back(
            turn_frame, turned(turn_probe, {static_cast<double>(m_probe.outward.x), static_cast<double>(m_probe.outward.y)}));
        const double towards = out.x * seen->nx + out.y * seen->ny;
        if (leaf.sides == Sides::Both ? towards <= 0.1 * size(out) : plain.has_value())
            return plain;
        // The probe has passed through to the other side.
        return from_behind(-seen->curvature);
    }

    // The leaf's vertex where two sharp corners coincide, or -1. There, the direction between them and the nearer edge's normal mean nothing.
    [[nodiscard]] int corner_met(double distance, Vector p) const
    {
        const Leaf& leaf = *m_leaf.leaf;
        const double tiny = corner * m_length;
        if (leaf.type != LeafType::Polygon || m_probe.before == Vec2{} || std::fabs(distance) > tiny ||
            m_probe.radius + static_cast<double>(leaf.r0) > tiny)
            return -1;
        for (int i = 0; i < leaf.count; ++i)
        {
            if (size({p.x - static_cast<double>(m_leaf.points[i].x), p.y - static_cast<double>(m_leaf.points[i].y)}) <= tiny)
                return i;
        }
        return -1;
    }

    // The normal has to be in the normal cones of both corners: between the normals of the leaf's two edges, and between the negated normals of the probe's.
    [[nodiscard]] std::optional<Vector> shared_normal(int vertex, SinCos turn_frame, SinCos turn_probe) const
    {
        const auto cross = [](Vector a, Vector b) { return a.x * b.y - a.y * b.x; };
        const auto world = [](SinCos q, Vec2 v, double sign)
        { return turned(q, {sign * static_cast<double>(v.x), sign * static_cast<double>(v.y)}); };
        const Leaf& leaf = *m_leaf.leaf;
        const Vector first = world(turn_frame, m_leaf.normals[vertex > 0 ? vertex - 1 : leaf.count - 1], 1);
        const Vector last = world(turn_frame, m_leaf.normals[vertex], 1);
        const Vector own_first = world(turn_probe, m_probe.before, -1);
        const Vector own_last = world(turn_probe, m_probe.after, -1);
        const Vector from = cross(first, own_first) > 0 ? own_first : first;
        const Vector to = cross(last, own_last) < 0 ? own_last : last;
        const Vector middle = {from.x + to.x, from.y + to.y};
        const double l = size(middle);
        if (cross(from, to) < -1e-3 || l < 0.1)
            return std::nullopt;
        return Vector{middle.x / l, middle.y / l};
    }

    // Whether a corner that has sunk a little into the previous piece meets this one from behind: then its body is before neither piece.
    [[nodiscard]] bool is_behind_seam(const Surface<double>& surface, Vector carrier, SinCos turn_frame) const
    {
        const Leaf& leaf = *m_leaf.leaf;
        if (leaf.type != LeafType::Segment || leaf.sides != Sides::Both || surface.feature != 0 ||
            (!leaf.has_previous && !leaf.has_next))
            return false;
        const Vector center = place_in_leaf(turn_frame, carrier);
        const Vec2 along = leaf.p1 - leaf.p0;
        const bool from_left = surface.ny * static_cast<double>(along.x) - surface.nx * static_cast<double>(along.y) > 0;
        return is_left_of_chain(leaf, center.x, center.y) != from_left;
    }

    // Only part of the probe may be surface, and a leaf that has been inside an arc's circle is not met by the arc's bulge.
    [[nodiscard]] bool faces_probe(const Sight& sight, SinCos turn_probe) const
    {
        if (m_probe.part == Probe::Part::All)
            return true;
        if (m_probe.part == Probe::Part::Bulge && sight.distance < -1e-3 * m_probe.radius)
            return false;
        const Vector d = turned_back(turn_probe, {-sight.n.x, -sight.n.y});
        return faces(m_probe, d.x, d.y);
    }

    void bound_motion(Sight& sight, double t, Vector r, Vector v) const
    {
        const double rest = m_duration - t;
        const double own = (m_w_probe * m_w_probe + std::fabs(m_carrier.alpha)) * m_reach;
        const double turning = m_w_frame * m_w_frame + std::fabs(m_frame.alpha);
        const double speed = size(v);
        // Bounded by the accelerations, or, where the body spins fast, by its center's speed and the spin.
        const Vector center_v = {m_carrier.center.vx - m_frame.center.vx + t * m_a.x,
                                 m_carrier.center.vy - m_frame.center.vy + t * m_a.y};
        const double center_speed = size(center_v) + rest * size(m_a);
        const double displacement = size(r) + 2 * m_reach + rest * center_speed;
        sight.speed = std::min(speed + rest * (size(m_a) + own + turning * (size(r) + rest * speed)),
                               center_speed + m_w_probe * m_reach + m_w_frame * displacement);
        sight.bend = own;
        if (turning > 0)
            sight.bend += 2 * m_w_frame * sight.speed + turning * (size(r) + rest * sight.speed);
    }

    // For p = R(-w_f t) r, each derivative of the rotation adds a factor w_f. There is no bound under torques, which are left out.
    [[nodiscard]] double bound_jerk(double t, Vector r, Vector v) const
    {
        if (m_carrier.alpha != 0 || m_frame.alpha != 0)
            return no_bound;
        const double rest = m_duration - t;
        const double push = size(m_a) + m_w_probe * m_w_probe * m_reach;
        const double speed = size(v) + m_w_frame * size(r) + rest * push;
        const double displacement = size(r) + rest * speed;
        return m_w_frame * (m_w_frame * (m_w_frame * displacement + 3 * speed) + 3 * push) +
               m_w_probe * m_w_probe * m_w_probe * m_reach;
    }

    // Beyond its ends a piece of a chain leaves everything to its neighbors, except for the corner that it shares with the previous piece. Returns a lower
    // bound on the distance to the points that the piece answers for; 0 is always safe.
    static double displacement_to_the_end(const LeafView& view, double px, double py)
    {
        const Leaf& leaf = *view.leaf;
        if (leaf.type != LeafType::Segment)
            return 0;
        const Vec2 tangent = start_tangent(view);
        const double x = px - static_cast<double>(leaf.p0.x);
        const double y = py - static_cast<double>(leaf.p0.y);
        const double along = static_cast<double>(tangent.x) * x + static_cast<double>(tangent.y) * y;
        if (along < 0 && leaf.has_previous)
        {
            const double behind_corner =
                -(static_cast<double>(leaf.previous_tangent.x) * x + static_cast<double>(leaf.previous_tangent.y) * y);
            return start_may_answer(leaf, tangent) ? std::max(0.0, std::min(-along, behind_corner)) : -along;
        }
        return leaf.has_next ? std::max(0.0, along - static_cast<double>(length(leaf.p1 - leaf.p0))) : 0;
    }

    Probe m_probe;
    FramePath m_carrier;
    LeafView m_leaf;
    FramePath m_frame;
    double m_duration;
    double m_length; ///< size that tolerances are relative to
    Vector m_local;  ///< probe relative to the carrier's center, body frame
    double m_reach;
    Vector m_a;
    double m_w_probe;
    double m_w_frame;
};

// The first positive root of d + u s - M s²/2; infinite where there is none.
double safe_step(double d, double u, double bend)
{
    d = std::max(d, 0.0);
    const double root = std::sqrt(u * u + 2 * bend * d);
    if (u < 0)
        return 2 * d / (root - u);
    return bend > 0 ? (u + root) / bend : 1e300;
}

double next_step(const Sight& sight)
{
    const double step = safe_step(sight.distance, sight.rate, sight.bend);
    if (!(sight.speed > 0))
        return step;
    const double plain = std::max(sight.distance, 0.0) / sight.speed;
    if (sight.end_of_arc) // the arc itself may curve towards the path
        return std::min(step, plain);
    // The bound M holds while the probe keeps half its distance from the arc's center; the plain speed bound always holds.
    return std::max(plain, sight.hollow_radius > 0 ? std::min(step, 0.5 * sight.hollow_radius / sight.speed) : step);
}

constexpr int max_looks = 1024;     // a pebble that turns at 50,000 rad/s takes hundreds; others need 3 to 10
constexpr double touch = 1e-7;      // relative to the size: a nanometer on a pinball
constexpr double blind_step = 1e-3; // relative to the size, along a surface that does not answer

Touch touch_of(const Sight& sight, double t, bool probe_on_a)
{
    const double sign = probe_on_a ? -1 : 1; // n runs from the surface to the probe
    return {t,
            sight.point.x,
            sight.point.y,
            sign * sight.n.x,
            sign * sight.n.y,
            sight.distance,
            sight.rate,
            sight.acceleration,
            sight.curvature,
            sight.feature,
            {}};
}

// Time to wait at a touch. The approach cannot exceed least_approach before the bound M allows it, and hardly before the gap's own acceleration does,
// which for a short while is a better estimate than its bound.
double patience_at(const Sight& sight, double least_approach, double duration)
{
    const double slack = least_approach + sight.rate;
    // slack + a t - J t²/2 stays above 0 until then.
    const double kept =
        sight.jerk > 0 ? (sight.push + std::sqrt(sight.push * sight.push + 2 * sight.jerk * slack)) / sight.jerk : 0;
    const double soon = sight.acceleration < 0 ? 0.5 * slack / -sight.acceleration : duration;
    return std::max({slack / sight.bend, kept, std::min(soon, 5e-3 * duration), 1e-6 * duration});
}

/// Flush neighbors of the probe's leaf and of the surface.
struct FlushBeside
{
    const LeafView& probe_leaf;
    const FlushNeighbours* of_probe;
    const FlushNeighbours* of_surface;

    FlushBeside(const Flush& flush, bool probe_on_a, const LeafView& a, const LeafView& b)
        : probe_leaf(probe_on_a ? a : b), of_probe(probe_on_a ? flush.of_a : flush.of_b),
          of_surface(probe_on_a ? flush.of_b : flush.of_a)
    {}
    [[nodiscard]] bool leave(const Approach& approach, double t, Sight& sight) const
    {
        return of_probe == nullptr || approach.keep_to_union(t, sight, probe_leaf, *of_probe, *of_surface);
    }
};

std::optional<Touch> first_touch_of_probe(const Approach& approach, double length, bool probe_on_a, double duration,
                                          double least_approach, const MicroCollision& press, const FlushBeside& flush,
                                          std::int64_t& looks)
{
    double t = approach.earliest_touch();
    for (int i = 0; i < max_looks && t <= duration; ++i)
    {
        ++looks;
        Sight sight = approach.look(t);
        if (!sight.faces)
        {
            t += sight.speed > 0 ? std::max(sight.distance, blind_step * length) / sight.speed : duration + 1;
            continue;
        }
        const bool near = sight.distance <= (i < max_looks - 1 ? touch : nearly_touch) * length;
        const double least = std::max(least_approach, pressed_speed(sight.acceleration, press, length));
        if (near && sight.rate < -least)
        {
            if (flush.leave(approach, t, sight) && sight.rate < -least)
                return touch_of(sight, t, probe_on_a);
            t += blind_step * length / sight.speed;
            continue;
        }
        if (near && sight.end_of_arc)
        {
            t += blind_step * length / sight.speed;
            continue;
        }
        if (near && sight.bend <= 0)
            return std::nullopt; // touches, does not approach, and has no acceleration towards the surface
        // A step too short to advance t would repeat the same look forever.
        const double patience = near ? patience_at(sight, least, duration) : 1e-12 * duration;
        t += std::max(next_step(sight), patience);
    }
    return std::nullopt;
}

} // namespace

double pressed_speed(double acceleration, const MicroCollision& press, double length)
{
    if (acceleration >= 0)
        return 0;
    const auto at_depth = [&](double depth) { return std::sqrt(-2 * acceleration * depth); };
    const double least = std::min(press.least_blow, at_depth(press.depth));
    return std::min(std::max(-acceleration * press.wait, least), at_depth(nearly_touch * length));
}

FramePath path_after(const FramePath& path, double time)
{
    FramePath later = path;
    CenterPath& c = later.center;
    c.x += time * (c.vx + 0.5 * time * c.ax);
    c.y += time * (c.vy + 0.5 * time * c.ay);
    c.vx += time * c.ax;
    c.vy += time * c.ay;
    const SinCos q = rotation_at(path, time);
    later.c = q.cos;
    later.s = q.sin;
    later.w += time * path.alpha;
    return later;
}

FramePath run_back(const FramePath& path)
{
    FramePath back = path;
    back.center.vx = -path.center.vx;
    back.center.vy = -path.center.vy;
    back.w = -path.w;
    return back;
}

double probe_size(const LeafView& v)
{
    const Leaf& leaf = *v.leaf;
    switch (leaf.type)
    {
    case LeafType::HalfSpace: return 1e300;
    case LeafType::Circle: return leaf.r0;
    case LeafType::Polygon: return static_cast<double>(length(v.points[1] - v.points[0])) + static_cast<double>(leaf.r0);
    case LeafType::Capsule: return std::max(leaf.r0, leaf.r1);
    case LeafType::Segment: return static_cast<double>(length(leaf.p1 - leaf.p0)) + static_cast<double>(leaf.r0);
    case LeafType::Arc: return static_cast<double>(leaf.arc_radius) + static_cast<double>(leaf.r0);
    }
    return 1;
}

namespace {

/// How far a leaf extends from its center of rotation: along a direction, and in any direction.
struct Reach
{
    double along = -1e300;
    double most = 0;
};

Reach reach_of(const LeafView& v, const FramePath& path, Vector direction)
{
    const Vector d = turned_back({path.s, path.c}, direction);
    Reach reach;
    const auto add = [&](Vec2 point, float radius)
    {
        const Vector p = {static_cast<double>(point.x) - static_cast<double>(path.local_center.x),
                          static_cast<double>(point.y) - static_cast<double>(path.local_center.y)};
        reach.along = std::max(reach.along, dot(p, d) + static_cast<double>(radius));
        reach.most = std::max(reach.most, size(p) + static_cast<double>(radius));
    };
    const Leaf& leaf = *v.leaf;
    switch (leaf.type)
    {
    case LeafType::Circle: add(leaf.p0, leaf.r0); break;
    case LeafType::Segment:
        add(leaf.p0, leaf.r0);
        add(leaf.p1, leaf.r0);
        break;
    case LeafType::Capsule:
        add(leaf.p0, leaf.r0);
        add(leaf.p1, leaf.r1);
        break;
    case LeafType::Polygon:
        for (int i = 0; i < leaf.count; ++i)
            add(v.points[i], leaf.r0);
        break;
    case LeafType::Arc: add(leaf.p0, leaf.arc_radius + leaf.r0); break;
    case LeafType::HalfSpace: reach.along = reach.most = 1e300; break;
    }
    return reach;
}

// Bound on the displacement by rotation of a point 1 m from the center.
double most_turn(const FramePath& path, double duration)
{
    return std::min(2.0, duration * (std::fabs(path.w) + 0.5 * duration * std::fabs(path.alpha)));
}

// Two leaves along an axis from a to b: their gap, and a bound on how much it can close in the given time.
class Interval
{
public:
    Interval(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b, Vector axis, double duration)
        : m_path_a(path_a), m_path_b(path_b), m_axis(axis), m_a(reach_of(a, path_a, axis)),
          m_b(reach_of(b, path_b, {-axis.x, -axis.y}))
    {
        const CenterPath& ca = path_a.center;
        const CenterPath& cb = path_b.center;
        m_gap = dot({cb.x - ca.x, cb.y - ca.y}, axis) - m_a.along - m_b.along;
        const double speed = -dot({cb.vx - ca.vx, cb.vy - ca.vy}, axis);
        const double acceleration = -dot({cb.ax - ca.ax, cb.ay - ca.ay}, axis);
        m_closing = duration * (std::max(speed, 0.0) + 0.5 * duration * std::max(acceleration, 0.0)) +
                    m_a.most * most_turn(path_a, duration) + m_b.most * most_turn(path_b, duration) +
                    nearly_touch * std::min(m_a.most, m_b.most);
    }

    [[nodiscard]] bool stays_open() const { return m_gap > m_closing; }
    [[nodiscard]] double gap() const { return m_gap; }

    /// Whether a corner is on the far side and cannot reach the other leaf.
    [[nodiscard]] bool leaves_out(const Probe& probe, bool on_a) const
    {
        const FramePath& path = on_a ? m_path_a : m_path_b;
        const Vector d = turned_back({path.s, path.c}, on_a ? m_axis : Vector{-m_axis.x, -m_axis.y});
        const Vector p = {static_cast<double>(probe.point.x) - static_cast<double>(path.local_center.x),
                          static_cast<double>(probe.point.y) - static_cast<double>(path.local_center.y)};
        return m_gap + (on_a ? m_a : m_b).along - dot(p, d) - probe.radius > m_closing;
    }

private:
    const FramePath& m_path_a;
    const FramePath& m_path_b;
    Vector m_axis;
    Reach m_a;
    Reach m_b;
    double m_gap;
    double m_closing;
};

// The edges of a polygon at t = 0. A probe does not meet the polygon if it is beyond one of the edges by more than both can approach along its normal in the
// given time: this saves most of the cost of a look.
class Faces
{
public:
    /// Slack: the distance up to which a probe counts as meeting the polygon.
    Faces(const LeafView& leaf, const FramePath& frame, const FramePath& carrier, double duration, double slack)
        : m_leaf(leaf), m_count(leaf.leaf->type == LeafType::Polygon && leaf.leaf->count <= most ? leaf.leaf->count : 0)
    {
        if (m_count == 0)
            return;
        const SinCos turn_frame = {frame.s, frame.c};
        const CenterPath& c = carrier.center;
        const CenterPath& f = frame.center;
        const auto in_leaf = [&](double x, double y) { return turned_back(turn_frame, {x, y}); };
        const Vector apart = in_leaf(c.x - f.x, c.y - f.y);
        m_center = {apart.x + static_cast<double>(frame.local_center.x), apart.y + static_cast<double>(frame.local_center.y)};
        m_turn = {carrier.s * frame.c - carrier.c * frame.s, carrier.c * frame.c + carrier.s * frame.s};
        m_local_center = carrier.local_center;
        m_swing = most_turn(carrier, duration);
        const Vector v = in_leaf(c.vx - f.vx, c.vy - f.vy);
        const Vector a = in_leaf(c.ax - f.ax, c.ay - f.ay);
        double reach = 0;
        for (int i = 0; i < m_count; ++i)
            reach = std::max(reach, size(minus(leaf.points[i], frame.local_center)));
        const double own = slack + static_cast<double>(leaf.leaf->r0) +
                           (reach + static_cast<double>(leaf.leaf->r0)) * most_turn(frame, duration);
        for (int i = 0; i < m_count; ++i)
        {
            const Vector n = wide(leaf.normals[i]);
            const double closing = duration * (std::max(-dot(v, n), 0.0) + 0.5 * duration * std::max(-dot(a, n), 0.0));
            m_limits[i] = dot(n, wide(leaf.points[i])) + own + closing;
        }
    }

    [[nodiscard]] bool are_out_of_reach(const Probe& probe) const
    {
        if (m_count == 0)
            return false;
        const Vector local = minus(probe.point, m_local_center);
        const Vector q = turned(m_turn, local);
        const Vector p = {m_center.x + q.x, m_center.y + q.y};
        const double own = probe.radius + (m_swing > 0 ? m_swing * size(local) : 0);
        bool is_beyond = false;
        for (int i = 0; i < m_count; ++i)
            is_beyond |= dot(wide(m_leaf.normals[i]), p) > m_limits[i] + own;
        return is_beyond;
    }

private:
    static constexpr int most = 8;

    static Vector wide(Vec2 v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }
    static Vector minus(Vec2 v, Vec2 w)
    {
        return {static_cast<double>(v.x) - static_cast<double>(w.x), static_cast<double>(v.y) - static_cast<double>(w.y)};
    }

    const LeafView& m_leaf;
    int m_count;
    Vector m_center; ///< center of the carrier in the leaf's frame; the rotation below likewise
    SinCos m_turn{};
    Vec2 m_local_center{};
    double m_swing = 0; ///< bound on the displacement by the carrier's rotation of a point 1 m from its center
    double m_limits[most];
};

} // namespace

bool stay_apart(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b, Axis axis,
                double duration)
{
    return Interval(a, path_a, b, path_b, {axis.x, axis.y}, duration).stays_open();
}

bool are_apart(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b, Axis axis, double distance)
{
    return !axis.is_none() && Interval(a, path_a, b, path_b, {axis.x, axis.y}, 0).gap() > distance;
}

Axis line_of_centers(const FramePath& a, const FramePath& b)
{
    const Vector d = {b.center.x - a.center.x, b.center.y - a.center.y};
    const double l = size(d);
    return l > 0 ? Axis{d.x / l, d.y / l} : Axis{};
}

std::optional<Touch> first_touch(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b,
                                 double duration, double least_approach, const MicroCollision& press, const ProbeSet& held,
                                 Axis axis, const Flush& flush, std::int64_t* looks)
{
    std::int64_t looks_taken = 0;
    const double length = std::min(probe_size(a), probe_size(b));
    std::optional<Interval> interval;
    if (!axis.is_none())
        interval.emplace(a, path_a, b, path_b, Vector{axis.x, axis.y}, duration);
    const Faces faces_of_a(a, path_a, path_b, duration, nearly_touch * length);
    const Faces faces_of_b(b, path_b, path_a, duration, nearly_touch * length);
    std::optional<Touch> first;
    for_each_probe_pair(a, b,
                        [&](const Probe& probe, int number, bool on_a)
                        {
                            if (held.has(number, on_a) || (interval && interval->leaves_out(probe, on_a)) ||
                                (on_a ? faces_of_b : faces_of_a).are_out_of_reach(probe))
                                return;
                            const Approach approach(probe, on_a ? path_a : path_b, on_a ? b : a, on_a ? path_b : path_a, duration,
                                                    length);
                            const double left = first ? first->time : duration;
                            const std::optional<Touch> hit = first_touch_of_probe(
                                approach, length, on_a, left, least_approach, press, FlushBeside(flush, on_a, a, b), looks_taken);
                            if (hit && (!first || hit->time < first->time))
                                first = hit;
                        });
    if (looks != nullptr)
        *looks += looks_taken;
    return first;
}

namespace {

// A corner on a corner is seen from both sides: it counts once, as the touch that approaches faster.
Touch* find_twin(Touches& touches, const Touch& t, double length)
{
    Touch* end = touches.list + touches.count;
    Touch* twin = std::find_if(touches.list, end, [&](const Touch& o)
                               { return size({o.x - t.x, o.y - t.y}) < 1e-3 * length && o.nx * t.nx + o.ny * t.ny > 0.99; });
    return twin != end ? twin : nullptr;
}

void add_touch(Touches& touches, const Touch& t, double length)
{
    Touch* twin = find_twin(touches, t, length);
    if (twin == nullptr)
    {
        if (touches.count < Touches::capacity)
            touches.list[touches.count++] = t;
        return;
    }
    const ProbeSet probes = twin->probes;
    if (t.rate < twin->rate)
        *twin = t;
    twin->probes.of_a |= probes.of_a | t.probes.of_a;
    twin->probes.of_b |= probes.of_b | t.probes.of_b;
}

} // namespace

Touches touches_now(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b, double tolerance,
                    const Flush& flush)
{
    const double length = std::min(probe_size(a), probe_size(b));
    const Faces faces_of_a(a, path_a, path_b, 0, tolerance);
    const Faces faces_of_b(b, path_b, path_a, 0, tolerance);
    Touches touches;
    for_each_probe_pair(
        a, b,
        [&](const Probe& probe, int number, bool on_a)
        {
            if ((on_a ? faces_of_b : faces_of_a).are_out_of_reach(probe))
                return;
            const Approach approach(probe, on_a ? path_a : path_b, on_a ? b : a, on_a ? path_b : path_a, 0, length);
            if (approach.starts_beyond(tolerance))
                return;
            Sight sight = approach.look(0);
            if (!sight.faces || sight.distance > tolerance || !FlushBeside(flush, on_a, a, b).leave(approach, 0, sight))
                return;
            Touch t = touch_of(sight, 0, on_a);
            t.probes.add(number, on_a);
            add_touch(touches, t, length);
        });
    return touches;
}

} // namespace carom::internal
