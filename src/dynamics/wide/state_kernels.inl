// Bodies move, eight side by side; Rotation::from_angle and UnitSolver::integrate_position have the same for one. Part of kernels.inl.

namespace states {

using D8 = double __attribute__((vector_size(64)));

CAROM_INLINE D8 all_doubles(double x) { return D8{x, x, x, x, x, x, x, x}; }

struct Turned
{
    F8 c, s;
};

// By less than a quarter of a radian.
CAROM_INLINE Turned small_turn(F8 radians)
{
    const D8 x = __builtin_convertvector(radians, D8);
    const D8 z = x * x;
    const D8 one = all_doubles(1);
    const D8 s = x * (one + z * (all_doubles(-1.0 / 6) + z * (all_doubles(1.0 / 120) + z * all_doubles(-1.0 / 5040))));
    const D8 c = one + z * (all_doubles(-0.5) +
                            z * (all_doubles(1.0 / 24) + z * (all_doubles(-1.0 / 720) + z * all_doubles(1.0 / 40320))));
    return {__builtin_convertvector(c, F8), __builtin_convertvector(s, F8)};
}

// x += h v, of as many as go straight and turn little from the first on, eight by eight. How many that were.
std::int32_t move(BodyState* states, std::int32_t count, float h)
{
    std::int32_t first = 0;
    for (; first + lane_count <= count; first += lane_count)
    {
        const auto at = [&](int i) { return reinterpret_cast<char*>(states + first + i); };
        const auto pose_at = [&](int i) { return at(i) + 16; };
        Speeds<F8> v;
        Poses<F8> p;
        gather4(at, v.x, v.y, v.w, v.flags);
        gather4(pose_at, p.x, p.y, p.c, p.s);
        const F8 angle = h * v.w;
        const I8 plain = ((as_ints(v.flags) & all_ints(body_flag::flier | body_flag::unbound)) == I8{}) &
                         (greatest(angle, -angle) < all(0.25f));
        if (bits(plain) != 0xff)
            break;
        const Turned turn = small_turn(angle);
        const I8 turns = v.w != all(0);
        scatter4(pose_at, p.x + h * v.x, p.y + h * v.y, select(turns, turn.c * p.c - turn.s * p.s, p.c),
                 select(turns, turn.s * p.c + turn.c * p.s, p.s));
    }
    return first;
}

} // namespace states
