// All kernels for one instruction set, in a namespace of its own: CAROM_ISA. Every set gives the same results, bit for bit.

#include "collision/broad_phase.h"
#include "core/lane_math.h"
#include "core/prefetch.h"
#include "dynamics/solver/contact/contact_equations.h"
#include "dynamics/solver/joint/joint_axis.h"
#include "dynamics/state/scene_state.h"
#include "dynamics/solver/joint/wide_joints.h"
#include "dynamics/solver/simd/kernels.h"
#include "dynamics/solver/contact/wide_contacts.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <iterator>
#include <limits>
#include <type_traits>

namespace carom::internal::CAROM_ISA {

namespace {

// The present speeds of eight bodies, or of sixteen.
template <class F>
struct Speeds
{
    F x, y, w, flags;
};

template <class F>
struct Poses
{
    F x, y, c, s;
};

static_assert(sizeof(BodyState) == 32 && offsetof(BodyState, delta_position) == 16);

// Reads BodyState or BodySpeeds: both begin with the speeds.
template <class Body>
CAROM_INLINE Speeds<F8> speeds_of(const Body* bodies, const LaneInts& index)
{
    static_assert(offsetof(Body, velocity) == 0 && offsetof(Body, angular_velocity) == 8);
    Speeds<F8> v;
    gather4([&](int i) { return reinterpret_cast<const char*>(bodies + index.v[i]); }, v.x, v.y, v.w, v.flags);
    return v;
}

CAROM_INLINE Poses<F8> poses_of(const BodyState* states, const LaneInts& index)
{
    Poses<F8> p;
    gather4([&](int i) { return reinterpret_cast<const char*>(states + index.v[i]) + 16; }, p.x, p.y, p.c, p.s);
    return p;
}

struct Turn
{
    F8 c, s;
};

CAROM_INLINE Turn turns_of(const BodySim* const (&sims)[lane_count])
{
    static_assert(offsetof(BodySim, rotation) == 16);
    Turn q;
    F8 unused_x, unused_y;
    gather4([&](int i) { return reinterpret_cast<const char*>(sims[i]) + 16; }, q.c, q.s, unused_x, unused_y);
    return q;
}

// Several blocks, on several threads, may share an immovable body: it is not written.
CAROM_INLINE void put(BodyState* states, const LaneInts& index, const Speeds<F8>& v, unsigned fixed)
{
    const auto at = [&](int i) { return reinterpret_cast<char*>(states + index.v[i]); };
    if (fixed == 0)
    {
        scatter4(at, v.x, v.y, v.w, v.flags);
        return;
    }
    BodyState unused[lane_count];
    scatter4([&](int i) { return (fixed >> i & 1u) != 0 ? reinterpret_cast<char*>(unused + i) : at(i); }, v.x, v.y, v.w, v.flags);
}

// Fills in the masses of the states of a contact constraint or a hinge.
template <class Wide>
CAROM_INLINE void fill_masses(Wide& wide, const StateConstants* constants)
{
    static_assert(offsetof(StateConstants, inverse_mass) == 0 && offsetof(StateConstants, inverse_inertia) == 8);
    F8 mass_a, mass_b, inertia_a, inertia_b, unused_y, unused;
    gather4([&](int i) { return reinterpret_cast<const char*>(constants + wide.a.v[i]); }, mass_a, unused_y, inertia_a, unused);
    gather4([&](int i) { return reinterpret_cast<const char*>(constants + wide.b.v[i]); }, mass_b, unused_y, inertia_b, unused);
    store(wide.inverse_mass_a, mass_a);
    store(wide.inverse_mass_b, mass_b);
    store(wide.inverse_inertia_a, inertia_a);
    store(wide.inverse_inertia_b, inertia_b);
}

// Lanes whose body is immovable.
template <class F>
CAROM_INLINE auto are_fixed(F inverse_mass, F inverse_inertia)
{
    return (inverse_mass == F(0)) & (inverse_inertia == F(0));
}

#include "fill_kernels.inl"
#include "feature_kernels.inl"
#include "contact_kernels.inl"
#include "joint_kernels.inl"
#include "follow_kernels.inl"
#include "state_kernels.inl"
#include "sweep_kernels.inl"
#include "pair_kernels.inl"

} // namespace

extern const WideKernels kernels;
const WideKernels kernels = {CAROM_ISA_NAME,          fills::fill, fills::prepare, contacts::warm_start, contacts::solve, contacts::relax,
                             joints::fill,            joints::follow,   joints::warm_start,   joints::solve,   joints::relax,  joints::take_impulses,
                             follows::follow,        follows::follow_contacts, follows::stay_apart, follows::take_impulses, states::move,
                             sweeps::sweep,           pairs::look_at_pairs,            pairs::new_overlaps};

} // namespace carom::internal::CAROM_ISA
