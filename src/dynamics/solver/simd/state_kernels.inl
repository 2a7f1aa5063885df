// Moves eight bodies side by side; Rotation::from_angle and integrate_position in integrate.cpp do the same for one. Part of kernels.inl.

namespace states {

// For less than a quarter of a radian.
CAROM_INLINE Turn small_turn(F8 radians)
{
    const D8 x = doubles(radians);
    const D8 z = x * x;
    const D8 s = x * (1.0 + z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040))));
    const D8 c = 1.0 + z * (-0.5 + z * (1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320))));
    return {floats(c), floats(s)};
}

// x += h v, or drift(), for all but fliers, eight by eight from the first on, as long as all turn little. Returns the number of these states.
std::int32_t move(BodyState* states, const StateConstants* constants, std::int32_t count, float h)
{
    static_assert(offsetof(StateConstants, acceleration) == 16);
    std::int32_t first = 0;
    for (; first + lane_count <= count; first += lane_count)
    {
        const auto at = [&](int i) { return reinterpret_cast<char*>(states + first + i); };
        const auto pose_at = [&](int i) { return at(i) + 16; };
        Speeds<F8> v;
        Poses<F8> p;
        gather4(at, v.x, v.y, v.w, v.flags);
        gather4(pose_at, p.x, p.y, p.c, p.s);
        const auto have = [&](std::uint32_t flag) { return (as_ints(v.flags) & all_ints(flag)) != I8{}; };
        const I8 flies = have(body_flag::flier);
        const I8 drifts = have(body_flag::unbound);
        const F8 angle = h * v.w;
        const I8 turns_little = (magnitude(angle) < all(0.25f)) & (p.c > all(-0.9f)); // adds no whole turn
        if (bits(flies | turns_little) != 0xff)
            break;
        F8 displacement_x = h * v.x;
        F8 displacement_y = h * v.y;
        if (bits(drifts) != 0)
        {
            F8 ax, ay, unused_linear, unused_angular;
            gather4([&](int i) { return reinterpret_cast<const char*>(constants + first + i) + 16; }, ax, ay, unused_linear,
                    unused_angular);
            const F8 half = all(0.5f * h * h);
            displacement_x -= select(drifts, half * ax, all(0));
            displacement_y -= select(drifts, half * ay, all(0));
        }
        const Turn turn = small_turn(angle);
        const I8 stays = flies | (v.w == all(0));
        scatter4(pose_at, select(flies, p.x, p.x + displacement_x), select(flies, p.y, p.y + displacement_y),
                 select(stays, p.c, turn.c * p.c - turn.s * p.s), select(stays, p.s, turn.s * p.c + turn.c * p.s));
    }
    return first;
}

} // namespace states
