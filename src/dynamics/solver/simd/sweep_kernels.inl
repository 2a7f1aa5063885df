// Finds how far the bodies of eight leaves may go in a step, and the leaves' boxes; sweep_body in
// sweep.cpp and leaf_bounds in bounds.cpp do the same for one. Part of kernels.inl.

namespace sweeps {

// As length(Vec2): in double, rounded once.
CAROM_INLINE F8 length_of(F8 x, F8 y)
{
    const D8 dx = doubles(x);
    const D8 dy = doubles(y);
    return floats(root(dx * dx + dy * dy));
}

// Displacements of eight bodies.
struct Displacements
{
    F8 x, y;    ///< of their centers
    F8 any_displacement; ///< of any point beyond that, by rotation and by the curvature of its parabola
    F8 motion;  ///< of any point
    I8 sound;

    CAROM_INLINE Displacements(const BodySim* const (&bodies)[lane_count], const SweepStep& step)
    {
        static_assert(offsetof(BodySim, velocity) == 32 && offsetof(BodySim, angular_velocity) == 40 && offsetof(BodySim, extent) == 44);
        static_assert(offsetof(BodySim, inverse_mass) == 92 && offsetof(BodySim, inverse_inertia) == 100 &&
                      offsetof(BodySim, gravity_scale) == 104 && offsetof(BodySim, force) == 108 && offsetof(BodySim, torque) == 116);
        const auto at = [&](int offset) { return [&bodies, offset](int i) { return reinterpret_cast<const char*>(bodies[i]) + offset; }; };
        F8 vx, vy, w, extent, inverse_mass_x, inverse_mass_y, inverse_inertia, gravity_scale, fx, fy, torque, unused;
        gather4(at(32), vx, vy, w, extent);
        gather4(at(92), inverse_mass_x, inverse_mass_y, inverse_inertia, gravity_scale);
        gather4(at(108), fx, fy, torque, unused);
        const float dt = step.dt;
        x = dt * vx + dt * dt * (gravity_scale * step.gravity.x + inverse_mass_x * fx);
        y = dt * vy + dt * dt * (gravity_scale * step.gravity.y + inverse_mass_y * fy);
        const F8 angle = (magnitude(w) + dt * inverse_inertia * magnitude(torque)) * dt;
        const F8 bend = 0.5f * length_of(x - dt * vx, y - dt * vy);
        any_displacement = extent * least(angle, all(2)) + bend;
        motion = length_of(x, y) + any_displacement;
        sound = motion + magnitude(w) + magnitude(torque) < all(1e15f);
    }
};

struct Bounds
{
    F8 lx, ly, ux, uy;
};

// Bounds of the leaves, in floats, rounded outwards.
CAROM_INLINE Bounds tight_bounds(const SweptEight& eight)
{
    static_assert(offsetof(BodySim, center) == 0 && offsetof(BodySim, rotation) == 16 && offsetof(BodySim, local_center) == 24);
    F8 c, s, center_x, center_y;
    gather4([&](int i) { return reinterpret_cast<const char*>(eight.bodies[i]) + 16; }, c, s, center_x, center_y);
    Bounds b = {all(3e38f), all(3e38f), all(-3e38f), all(-3e38f)};
    const auto add = [&](F8 x, F8 y, F8 r)
    {
        const F8 turned_x = c * x - s * y;
        const F8 turned_y = c * y + s * x;
        b = {least(b.lx, turned_x - r), least(b.ly, turned_y - r), greatest(b.ux, turned_x + r), greatest(b.uy, turned_y + r)};
    };
    int most = 0;
    for (const int count : eight.corner_counts)
        most = count > most ? count : most;
    for (int k = 0; k < most; k += 2)
    { // an odd last corner is read together with the one before it
        const auto two_corners = [&](int i)
        {
            const int last = eight.corner_counts[i] - 2;
            return reinterpret_cast<const char*>(eight.corners[i] + (k < last ? k : last));
        };
        F8 x0, y0, x1, y1;
        gather4(two_corners, x0, y0, x1, y1);
        add(x0, y0, load(eight.radii[0]));
        add(x1, y1, load(eight.radii[1]));
    }
    const auto each = [&](double Position::*axis)
    {
        const auto of = [&](int i) { return eight.bodies[i]->center.*axis; };
        return eight_of(of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7));
    };
    D8 x = each(&Position::x);
    D8 y = each(&Position::y);
    x -= doubles(c * center_x - s * center_y);
    y -= doubles(s * center_x + c * center_y);
    // As rounded_outwards.
    constexpr float spacing = 0x1p-23f;
    const auto outwards = [&](D8 from, F8 to, float by)
    {
        const F8 bound = floats(from + doubles(to));
        return bound + by * magnitude(bound);
    };
    return {outwards(x, b.lx, -spacing), outwards(y, b.ly, -spacing), outwards(x, b.ux, spacing), outwards(y, b.uy, spacing)};
}

// Bounds of the boxes over their displacements, with a margin.
CAROM_INLINE Bounds swept(const Bounds& tight, const Displacements& displacement, float margin)
{
    const F8 none = all(0);
    return {tight.lx + least(displacement.x, none) - displacement.any_displacement - margin, tight.ly + least(displacement.y, none) - displacement.any_displacement - margin,
            tight.ux + greatest(displacement.x, none) + displacement.any_displacement + margin, tight.uy + greatest(displacement.y, none) + displacement.any_displacement + margin};
}

CAROM_INLINE void put_paths(const SweptEight& eight, const Bounds& tight, const Displacements& displacement)
{
    static_assert(offsetof(SweptBox, path) == 0 && offsetof(BoxPath, box) == 0 && offsetof(BoxPath, shift) == 16 &&
                  offsetof(BoxPath, any_displacement) == 24 && offsetof(SweptBox, layer) == 28);
    const auto at = [&](int offset) { return [&eight, offset](int i) { return reinterpret_cast<char*>(eight.places[i]) + offset; }; };
    F8 unused_x, unused_y, unused_displacement, kinds;
    gather4(at(16), unused_x, unused_y, unused_displacement, kinds);
    scatter4(at(0), tight.lx, tight.ly, tight.ux, tight.uy);
    scatter4(at(16), displacement.x, displacement.y, displacement.any_displacement, kinds);
}

bool sweep(SweptEight& eight, const SweepStep& step)
{
    const Displacements displacement(eight.bodies, step);
    if (bits(displacement.sound) != 0xff)
        return false;
    const Bounds tight = tight_bounds(eight);
    put_paths(eight, tight, displacement);
    const Bounds needed = swept(tight, displacement, 0.25f * step.box_margin);
    static_assert(offsetof(SweptBox, box) == 32);
    Bounds fat;
    gather4([&](int i) { return reinterpret_cast<const char*>(eight.places[i]) + 32; }, fat.lx, fat.ly, fat.ux, fat.uy);
    const I8 holds = (fat.lx <= needed.lx) & (fat.ly <= needed.ly) & (fat.ux >= needed.ux) & (fat.uy >= needed.uy);
    const F8 slack = all(8 * step.box_margin);
    const I8 too_wide = (fat.ux - fat.lx > (needed.ux - needed.lx) + slack) | (fat.uy - fat.ly > (needed.uy - needed.ly) + slack);
    eight.moved = bits(~holds | too_wide);
    store(eight.motion, displacement.motion);
    store(eight.lx, needed.lx);
    store(eight.ly, needed.ly);
    store(eight.ux, needed.ux);
    store(eight.uy, needed.uy);
    return true;
}

} // namespace sweeps
