#pragma once

// Tells an effective mass from rounding error.

namespace carom::internal {

/// False if an inverse mass is only the rounding error of its largest possible term, squared arms times inverse inertia: then nothing can move.
template <class Number>
[[nodiscard]] bool exceeds_rounding(Number inverse_mass, Number by_arms)
{
    return inverse_mass > static_cast<Number>(1e-10) * by_arms;
}

} // namespace carom::internal
