#pragma once

// Soft constraints: a frequency and a damping ratio as coefficients of an implicit step.

#include "carom/math.h"

namespace carom::internal {

/// A constraint as a damped spring that is integrated implicitly over h (the "soft constraint" of Catto, GDC 2011):
/// impulse = -mass_scale m (v + bias_rate C) - impulse_scale accumulated.
/// impulse = -mass_scale m (v + bias_rate C) - impulse_scale accumulated.
struct Softness
{
    float bias_rate = 0;
    float mass_scale = 1;
    float impulse_scale = 0;
};

[[nodiscard]] inline Softness make_softness(float hertz, float damping_ratio, float h)
{
    if (!(hertz > 0))
        return {};
    const float omega = 2 * pi * hertz;
    const float a1 = 2 * damping_ratio + h * omega;
    const float a2 = h * omega * a1;
    const float a3 = 1 / (1 + a2);
    return {omega / a1, a2 * a3, a3};
}

} // namespace carom::internal
