#pragma once

// The equations of one contact, for one number or for eight or sixteen lanes: whatever solves a contact solves it by these. contact_solver.cpp explains them.

#include "core/compiler.h"

namespace carom::internal {

// One lane, as the lanes have them.
CAROM_INLINE float select(bool which, float a, float b) { return which ? a : b; }
CAROM_INLINE float greatest(float a, float b) { return a > b ? a : b; }
CAROM_INLINE float least(float a, float b) { return a < b ? a : b; }
CAROM_INLINE double greatest(double a, double b) { return a > b ? a : b; }
CAROM_INLINE double least(double a, double b) { return a < b ? a : b; }

/// The target of a normal: its speed should become -bias, with a softness that is a compliance beside k = J M^-1 J^T: mass_scale = k / (k + compliance), and
/// give is its inverse.
template <class F>
struct NormalTarget
{
    F speed;
    F bias;
    F mass_scale;
    F give;
};

/// The accumulated impulse x of one normal: k give x + (speed + bias - k old) = 0, and x >= 0. mass = 1 / k. A rigid one changes by as little as its speed
/// asks for, without the rounding of the load that it bears.
template <class F>
CAROM_INLINE F normal_impulse(F mass, F old, const NormalTarget<F>& t)
{
    return greatest(t.mass_scale * (old - mass * (t.speed + t.bias)), F(0));
}

template <class F>
struct NormalImpulses
{
    F first;
    F second;
};

/// Those of two points at once. One after the other, they never agree within a pass: each turns the body a little at the expense of the other, boxes that
/// overlap are shot apart and stacks lean. A linear complementarity problem with four cases: A x + b >= 0, x >= 0, and one of each pair is 0.
template <class F>
CAROM_INLINE NormalImpulses<F> normal_impulses(F k11, F k22, F k12, F old1, F old2, const NormalTarget<F>& t1,
                                               const NormalTarget<F>& t2)
{
    const F a11 = k11 * t1.give;
    const F a22 = k22 * t2.give;
    const F b1 = t1.speed + t1.bias - (k11 * old1 + k12 * old2);
    const F b2 = t2.speed + t2.bias - (k12 * old1 + k22 * old2);
    const F inverse_det = F(1) / (a11 * a22 - k12 * k12);
    const F both1 = inverse_det * (k12 * b2 - a22 * b1);
    const F both2 = inverse_det * (k12 * b1 - a11 * b2);
    const F only1 = greatest(-b1 / a11, F(0));
    const F only2 = greatest(-b2 / a22, F(0));
    const auto second_sinks = k12 * only1 + b2 < F(0); // then it bears the load alone
    const auto both = (both1 >= F(0)) & (both2 >= F(0));
    return {select(both, both1, select(second_sinks, F(0), only1)), select(both, both2, select(second_sinks, only2, F(0)))};
}

/// Coulomb's law for friction, and for rolling with a torque: the accumulated impulse that stops the slip, within a limit in proportion to the load.
template <class F>
CAROM_INLINE F friction_impulse(F old, F mass, F slip, F limit)
{
    return least(greatest(old - mass * slip, -limit), limit);
}

} // namespace carom::internal
