#pragma once

// J M^-1 J'^T: the speed along one line that a unit impulse along another gives. Its inverse, for one line, is the effective mass. The kernels have the same in lanes.

namespace carom::internal {

/// A line through a body: its direction, and the lever arm about the center of mass, cross(arm, direction).
template <class Number>
struct ImpulseLine
{
    Number x;
    Number y;
    Number turn;
};

template <class Number>
struct InverseMass
{
    Number x; ///< by axis
    Number y;
    Number turn;
};

/// The part of one body.
template <class Number>
[[nodiscard]] constexpr Number response(const InverseMass<Number>& mass, const ImpulseLine<Number>& p,
                                        const ImpulseLine<Number>& q)
{
    return p.x * q.x * mass.x + p.y * q.y * mass.y + p.turn * q.turn * mass.turn;
}

/// That of two bodies: the lines have the same directions through both, and arms of their own.
template <class Number>
[[nodiscard]] constexpr Number response(const InverseMass<Number>& mass_a, const ImpulseLine<Number>& pa,
                                        const ImpulseLine<Number>& qa, const InverseMass<Number>& mass_b, Number pb_turn,
                                        Number qb_turn)
{
    return pa.x * qa.x * (mass_a.x + mass_b.x) + pa.y * qa.y * (mass_a.y + mass_b.y) + pa.turn * qa.turn * mass_a.turn +
           pb_turn * qb_turn * mass_b.turn;
}

/// False if an inverse mass is only the rounding error of its largest possible term, squared arms times inverse inertia: then nothing can move.
template <class Number>
[[nodiscard]] bool exceeds_rounding(Number inverse_mass, Number by_arms)
{
    return inverse_mass > static_cast<Number>(1e-10) * by_arms;
}

} // namespace carom::internal
