#pragma once

namespace carom::internal {

/// False where an inverse mass is the rounding of what its arms could give at most, squared arms times inverse inertia: nothing gives way.
template <class Number>
[[nodiscard]] bool exceeds_rounding(Number inverse_mass, Number by_arms)
{
    return inverse_mass > static_cast<Number>(1e-10) * by_arms;
}

} // namespace carom::internal
