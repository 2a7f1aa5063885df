// Rolling resistance and surfaces that move, for the buckets of contacts that have them, and for those that have not. Part of kernels.inl.

namespace contacts {

struct NoFeatures
{
    static constexpr bool in_pairs = true;

    CAROM_INLINE explicit NoFeatures(WideFeatures&) {}

    template <class F>
    CAROM_INLINE F surface_speed() const
    {
        return F(0);
    }
    template <class Group>
    CAROM_INLINE void start(Group&) const
    {}
    template <class Group>
    CAROM_INLINE void roll(Group&, const WideContact&, int) const
    {}
};

struct Featured
{
    static constexpr bool in_pairs = false;
    WideFeatures& of;

    CAROM_INLINE explicit Featured(WideFeatures& features) : of(features) {}

    template <class F>
    CAROM_INLINE F surface_speed() const
    {
        return load(of.surface_speed);
    }
    template <class Group>
    CAROM_INLINE void start(Group& g) const
    {
        g.twist(load(of.rolling_impulse));
    }
    // A torque that stops rolling, at most the limit length times the load.
    template <class Group>
    CAROM_INLINE void roll(Group& g, const WideContact& constraint, int points) const
    {
        F8 loads = load(constraint.points[0].normal_impulse);
        if (points == 2)
            loads = loads + load(constraint.points[1].normal_impulse);
        const F8 k = g.inertia_a + g.inertia_b;
        const F8 old = load(of.rolling_impulse);
        const F8 updated = friction_impulse(old, select(k > all(0), all(1) / k, all(0)), g.b.w - g.a.w, load(of.rolling) * loads);
        store(of.rolling_impulse, updated);
        g.twist(updated - old);
    }
};

} // namespace contacts
