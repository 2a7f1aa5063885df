// Conservative advancement of second order. At time t the surface gives distance d and normal n. Along that fixed normal (fixed in the
// leaf's frame) the gap starts at d with rate u, and its second derivative is never below -M. For convex surfaces the gap along a fixed
// normal never exceeds the distance, so d + u s - M s²/2 > 0 proves that nothing touches before its root: we step there and look again.
// Near the hit the M term fades, and the step becomes Newton's: convergence is quadratic. The hollow side of an arc is not convex; there
// the bend of the surface itself, v²/rho, goes into M.

#include "collision/time_of_impact.h"

#include "core/trigonometry.h"
#include "geometry/surface.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

struct Sight
{
    double distance; ///< gap between ball and surface
    double nx;       ///< world
    double ny;
    double rate;          ///< of the gap along the fixed normal
    double bend;          ///< M: bound on minus its second derivative
    double speed;         ///< bound on the relative speed over the rest of the time
    double hollow_radius; ///< from the arc's center to the ball's, on the hollow side; 0 elsewhere
    double curvature;
    int feature;
};

class Approach
{
public:
    Approach(const CenterPath& ball, double radius, const LeafView& leaf, const FramePath& frame, double duration)
        : m_ball(ball), m_radius(radius), m_leaf(leaf), m_frame(frame), m_duration(duration)
    {
        // A circle about the center of mass looks the same however it turns.
        const Leaf& l = *leaf.leaf;
        if (l.type == LeafType::Circle && l.p0 == frame.local_center)
            m_frame.w = 0;
        m_ax = ball.ax - m_frame.center.ax;
        m_ay = ball.ay - m_frame.center.ay;
        m_acceleration = std::sqrt(m_ax * m_ax + m_ay * m_ay);
    }

    /// Nothing where the leaf does not face the ball.
    [[nodiscard]] std::optional<Sight> look(double t) const
    {
        const CenterPath& f = m_frame.center;
        const double rx = m_ball.x - f.x + t * (m_ball.vx - f.vx) + 0.5 * t * t * m_ax;
        const double ry = m_ball.y - f.y + t * (m_ball.vy - f.vy) + 0.5 * t * t * m_ay;
        double c = m_frame.c;
        double s = m_frame.s;
        if (m_frame.w != 0)
        {
            const SinCos turn = sin_cos(m_frame.w * t);
            c = m_frame.c * turn.cos - m_frame.s * turn.sin;
            s = m_frame.s * turn.cos + m_frame.c * turn.sin;
        }
        const std::optional<Surface<double>> surface =
            surface_at<double>(m_leaf, c * rx + s * ry + m_frame.local_center.x, c * ry - s * rx + m_frame.local_center.y);
        if (!surface)
            return std::nullopt;
        // Velocity of the ball as the turning frame sees it.
        const double vx = m_ball.vx - f.vx + t * m_ax + m_frame.w * ry;
        const double vy = m_ball.vy - f.vy + t * m_ay - m_frame.w * rx;
        Sight sight{};
        sight.distance = surface->distance - m_radius;
        sight.nx = c * surface->nx - s * surface->ny;
        sight.ny = s * surface->nx + c * surface->ny;
        sight.rate = vx * sight.nx + vy * sight.ny;
        sight.curvature = surface->curvature;
        sight.feature = surface->feature;
        const double rest = m_duration - t;
        const double w = std::fabs(m_frame.w);
        sight.speed = std::sqrt(vx * vx + vy * vy) + rest * (m_acceleration + w * w * std::sqrt(rx * rx + ry * ry));
        if (w == 0)
        {
            sight.bend = std::max(0.0, -(m_ax * sight.nx + m_ay * sight.ny));
        }
        else
        {
            const double reach = std::sqrt(rx * rx + ry * ry) + rest * sight.speed;
            sight.bend = m_acceleration + 2 * w * sight.speed + w * w * reach;
        }
        if (surface->curvature < 0)
        {
            sight.hollow_radius = -1 / surface->curvature;
            sight.bend += 2 * sight.speed * sight.speed / sight.hollow_radius;
        }
        return sight;
    }

    [[nodiscard]] double relative_speed() const
    {
        const double vx = m_ball.vx - m_frame.center.vx;
        const double vy = m_ball.vy - m_frame.center.vy;
        return std::sqrt(vx * vx + vy * vy) + m_duration * m_acceleration;
    }

private:
    CenterPath m_ball;
    double m_radius;
    LeafView m_leaf;
    FramePath m_frame;
    double m_duration;
    double m_ax;
    double m_ay;
    double m_acceleration;
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
    if (!(sight.hollow_radius > 0) || !(sight.speed > 0))
        return step;
    // The bend bound holds while the ball keeps half its distance from the arc's center; the plain speed bound always holds.
    return std::max(std::max(sight.distance, 0.0) / sight.speed, std::min(step, 0.5 * sight.hollow_radius / sight.speed));
}

constexpr int max_looks = 1024; // 1000 m/s past an unfacing piece in half radii of a pinball; others need 3 to 10
constexpr double touch = 1e-7;  // of the radius: a nanometre on a pinball
constexpr double nearly_touch = 1e-3;

} // namespace

std::optional<BallHit> ball_time_of_impact(const CenterPath& ball, double radius, const LeafView& leaf, const FramePath& frame,
                                           double duration, double least_approach)
{
    const Approach approach(ball, radius, leaf, frame, duration);
    double t = 0;
    for (int i = 0; i < max_looks && t <= duration; ++i)
    {
        const std::optional<Sight> sight = approach.look(t);
        if (!sight)
        {
            const double speed = approach.relative_speed() + std::fabs(frame.w) * radius;
            t += speed > 0 ? 0.5 * radius / speed : duration + 1;
            continue;
        }
        const bool near = sight->distance <= (i < max_looks - 1 ? touch : nearly_touch) * radius;
        if (near && sight->rate < -least_approach)
            return BallHit{t, sight->nx, sight->ny, sight->curvature, sight->feature};
        if (near && sight->bend <= 0)
            return std::nullopt; // touches, does not approach, and nothing will make it
        // Touching, it cannot approach faster than that before the bend has had its time. A step too short to move the clock would look at
        // the same place for ever.
        const double patience = near ? std::max((least_approach + sight->rate) / sight->bend, 1e-6 * duration) : 1e-12 * duration;
        t += std::max(next_step(*sight), patience);
    }
    return std::nullopt;
}

} // namespace carom::internal
