#pragma once

// The effect of an impact's rows on velocities: rates, impulses, effective masses, and two rows at once.

#include "dynamics/continuous/impact/reflect.h"
#include "dynamics/solver/effective_mass.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace carom::internal {

using Bodies = std::vector<ImpactBody>;

// An impulse along a direction changes the velocities by (d, turn) on b and by its opposite on a.
struct Direction
{
    double x;
    double y;
    double turn_a;
    double turn_b;
};

inline Direction normal_of(const ImpactRow& r) { return {r.nx, r.ny, r.turn_a, r.turn_b}; }

inline Direction tangent_of(const ImpactRow& r)
{
    const double x = -r.ny;
    const double y = r.nx;
    return {x, y, r.arm_a_x * y - r.arm_a_y * x, r.arm_b_x * y - r.arm_b_y * x};
}

inline double rate_along(const Bodies& bodies, const ImpactRow& r, const Direction& d)
{
    const ImpactBody& a = bodies[static_cast<std::size_t>(r.a)];
    const ImpactBody& b = bodies[static_cast<std::size_t>(r.b)];
    return d.x * (b.vx - a.vx) + d.y * (b.vy - a.vy) + d.turn_b * b.w - d.turn_a * a.w;
}

inline void push_along(Bodies& bodies, const ImpactRow& r, const Direction& d, double impulse)
{
    ImpactBody& a = bodies[static_cast<std::size_t>(r.a)];
    ImpactBody& b = bodies[static_cast<std::size_t>(r.b)];
    a.vx -= a.inverse_mass_x * impulse * d.x;
    a.vy -= a.inverse_mass_y * impulse * d.y;
    a.w -= a.inverse_inertia * impulse * d.turn_a;
    b.vx += b.inverse_mass_x * impulse * d.x;
    b.vy += b.inverse_mass_y * impulse * d.y;
    b.w += b.inverse_inertia * impulse * d.turn_b;
}

// Inverse effective mass of the direction, J M^-1 J^T; 0 where no body yields, as through the pivot of a body that only turns.
inline double compliance(const Bodies& bodies, const ImpactRow& r, const Direction& d)
{
    const ImpactBody& a = bodies[static_cast<std::size_t>(r.a)];
    const ImpactBody& b = bodies[static_cast<std::size_t>(r.b)];
    const ImpulseLine<double> through_a{d.x, d.y, d.turn_a};
    const ImpulseLine<double> through_b{d.x, d.y, d.turn_b};
    const double k = response(a.inverse(), through_a, through_a) + response(b.inverse(), through_b, through_b);
    const double at_most = (r.arm_a_x * r.arm_a_x + r.arm_a_y * r.arm_a_y) * a.inverse_inertia +
                           (r.arm_b_x * r.arm_b_x + r.arm_b_y * r.arm_b_y) * b.inverse_inertia;
    return exceeds_rounding(k, at_most) ? k : 0;
}

inline bool are_a_pair(const std::vector<ImpactRow>& rows, int i, int j)
{
    const ImpactRow& p = rows[static_cast<std::size_t>(i)];
    const ImpactRow& q = rows[static_cast<std::size_t>(j)];
    return p.kind == ImpactRow::Kind::Contact && q.kind == p.kind && p.a == q.a && p.b == q.b;
}

inline double couple(const Bodies& bodies, const ImpactRow& p, const ImpactRow& q)
{
    const InverseMass<double> a = bodies[static_cast<std::size_t>(p.a)].inverse();
    const InverseMass<double> b = bodies[static_cast<std::size_t>(p.b)].inverse();
    return response<double>(a, {p.nx, p.ny, p.turn_a}, {q.nx, q.ny, q.turn_a}) +
           response<double>(b, {p.nx, p.ny, p.turn_b}, {q.nx, q.ny, q.turn_b});
}

struct Two
{
    double x;
    double y;
};

// K (x, y) + b >= 0, x >= 0, y >= 0, complementary. Two corners of a box are solved together, so mirrored ones get the same answer.
inline std::optional<Two> solve_two(double k11, double k12, double k22, double b1, double b2)
{
    const double det = k11 * k22 - k12 * k12;
    if (!(det > 1e-9 * k11 * k22))
        return std::nullopt;
    const double x = (k12 * b2 - k22 * b1) / det;
    const double y = (k12 * b1 - k11 * b2) / det;
    if (x >= 0 && y >= 0)
        return Two{x, y};
    const double alone = std::max(-b1 / k11, 0.0);
    if (k12 * alone + b2 >= 0)
        return Two{alone, 0};
    return Two{0, std::max(-b2 / k22, 0.0)};
}

} // namespace carom::internal
