#pragma once

// The kernels that are compiled once per instruction set (dynamics/solver/simd/), behind function pointers.

#include "carom/math.h"
#include "dynamics/solver/contact/wide_contacts.h"
#include "dynamics/solver/joint/wide_joints.h"

#include <cstdint>
#include <span>

namespace carom::internal {

struct BodySim;
struct BoxPair;
struct SweptBox;
struct Contact;
struct ContactImpulses;
struct CachedManifold;
struct MovingBlocks;
struct StateConstants;

/// The data that cached manifolds are followed with.
struct FollowedScene
{
    const BodySim* sims;
    const Contact* contacts;
    const CachedManifold* cached; ///< by contact
    const SweptBox* boxes;        ///< by shape
    float sure_displacement;      ///< below this relative displacement of the bodies a manifold surely holds
    float surely;                 ///< factor on a bound of the displacement up to which a manifold surely holds
    float sure_cosine;            ///< above this cosine of the relative rotation it surely holds
    float slop;
    float speculation;
};

/// The result for a constraint's contacts; bits are lanes.
struct RefreshedContacts
{
    LaneFloats separation; ///< the least of the contact's points
    std::uint32_t unsure;  ///< must be checked one by one; what else is reported of them does not hold
    std::uint32_t begins_or_ends;
    std::uint32_t borne; ///< near, and bore a load
    std::uint32_t sunk;  ///< not borne, and deeper than the slop
};

/// The same for eight contacts outside of constraints.
struct FollowedContacts
{
    std::uint32_t sure;
    std::uint32_t touch_on; ///< touched, and are still near enough
};

/// The result for eight pairs, a bit for each.
struct SeenPairs
{
    std::uint32_t plain; ///< one of the two moves, and neither is a trigger or a half-space: the other bits hold only for these
    std::uint32_t near;  ///< may meet in the step
    std::uint32_t meet;  ///< their fat boxes overlap
    std::uint32_t stay;  ///< plain, fat boxes overlap, and there is a contact if and only if they are near: no change
};

/// Eight leaves of two or more corners each, their bodies, and the results of the sweep.
struct SweptEight
{
    const BodySim* bodies[lane_count];
    SweptBox* places[lane_count];
    const Vec2* corners[lane_count];
    int corner_counts[lane_count];
    LaneFloats radii[2];       ///< of even and of odd corners: they may differ only for leaves of two corners
    LaneFloats motion;         ///< bound on the displacement of any point
    LaneFloats lx, ly, ux, uy; ///< bounds that the fat box must hold
    std::uint32_t moved;       ///< lanes whose fat box does not hold them, or is far too large
};

struct SweepStep
{
    float dt;
    Vec2 gravity;
    float box_margin;
};

/// Receives each block some of whose boxes newly overlap boxes of the queried block: bit 8 i + j for box i of the queried block and box j of that one.
struct OverlapSink
{
    const void* context;
    void (*note)(const void* context, std::int32_t block, std::uint64_t boxes);
};

/// Operations on eight lanes at a time, on wide contact constraints and joints, on states and
/// contacts, compiled for one instruction set. Every set gives the same results, bit for bit.
struct WideKernels
{
    const char* name;
    /// Fills a constraint from its contacts, their impulses, their states and the constants of these, and computes effective
    /// masses. For each lane, `constraint` already has a and b, and `notes` the contact and the number of points.
    void (*fill)(WideContact& constraint, WideContactNotes& notes, const Contact* contacts, const ContactImpulses* impulses,
                 const BodyState* states, const StateConstants* constants, float far);
    /// After `follow`, and after lanes have been filled one by one: turns arms to the middle of a step of dt, computes effective masses,
    /// and notes which points may be struck. far: see halfway_gap().
    void (*prepare)(WideContact& constraint, WideContactNotes& notes, const BodySim* sims, float dt, float far);
    void (*warm_start)(const WideBucket& bucket, BodyState* states);
    /// One pass of sequential impulses with bias: the soft constraint also removes overlap.
    void (*solve)(const WideBucket& bucket, BodyState* states, const WideSoftness& s);
    /// One pass without bias, at the new poses: it only stops approach, and sums impulses. Also reports for each block
    /// the lanes that have been struck, or have begun to touch and are not yet reported, and those that have lost a load. `before`
    /// holds the speeds at the start of the sub-step, which decide what is an impact. Returns the least separation, at most 0.
    float (*relax)(const WideBucket& bucket, BodyState* states, const WideSoftness& s, const BodySpeeds* before, BlowBits blows);
    /// Fills joints from their records, bodies, and the constants of their states, for
    /// sub-steps of h. `joints` already has a, b, joint and turns of each lane.
    void (*fill_joints)(WideJoint& joints, const JointRecord* records, const BodySim* sims, const std::int32_t* turns,
                        const StateConstants* constants, float h);
    /// The same for hinges that were solved in the last step and whose angles do not matter: only the poses have changed.
    void (*follow_joints)(WideJoint& joints, const BodySim* sims);
    void (*warm_start_joints)(WideJoint* joints, std::int32_t count, BodyState* states);
    void (*solve_joints)(WideJoint* joints, std::int32_t count, BodyState* states, const JointSoftness& s);
    /// Relaxes at the present poses; the other passes use those that the last relaxation found.
    void (*relax_joints)(WideJoint* joints, std::int32_t count, BodyState* states, const JointSoftness& s);
    /// Writes to the records: forces over the step dt, and the impulses that warm start the next step.
    void (*take_joint_impulses)(const WideJoint& joints, JointRecord* records, float dt);
    /// Updates normal, arms and separations of a constraint to the present poses. It held the same contacts in the last step.
    void (*follow)(WideContact& constraint, const WideContactNotes& notes, const FollowedScene& scene, RefreshedContacts& found);
    /// The same for the manifolds of eight cached contacts with the same number of points; one that is not sure must be found by itself.
    void (*follow_contacts)(const LaneInts& contacts, int points, Contact* into, const FollowedScene& scene,
                            FollowedContacts& found);
    /// Of eight cached contacts without points, returns those that surely still have none.
    std::uint32_t (*stay_apart)(const LaneInts& contacts, const FollowedScene& scene);
    /// Writes the impulses of all lanes to their contacts, and whether these bear a load.
    void (*take_impulses)(const WideContact& constraint, WideContactNotes& notes, Contact* contacts, ContactImpulses* impulses);
    /// Moves states that do not fly over a time h, eight by eight from the first on, as long as none of them turns fast. Returns the number of these states.
    std::int32_t (*move)(BodyState* states, const StateConstants* constants, std::int32_t count, float h);
    /// Writes the paths of freely moving bodies and updates their boxes: as sweep_body in sweep.cpp. False where that must decide, one by one.
    bool (*sweep)(SweptEight& eight, const SweepStep& step);
    /// Finds what decides about the contacts of eight pairs, as update_of in pair_update.cpp does for one.
    void (*look_at_pairs)(const BoxPair* pairs, const SweptBox* places, float box_margin, SeenPairs& seen);
    /// Reports where boxes of block k have changed and overlap others that they did not before, each pair once.
    void (*new_overlaps)(const MovingBlocks& blocks, std::int32_t k, const OverlapSink& sink);
};

/// The best set that this machine supports, or the one that CAROM_ISA names (sse2, avx2, avx512); chosen once.
[[nodiscard]] const WideKernels& wide_kernels();

/// All sets that this machine supports, the best last.
[[nodiscard]] std::span<const WideKernels* const> all_wide_kernels();

/// Sets the kernels, for tests; no scene may step meanwhile.
void use_wide_kernels(const WideKernels& kernels);

} // namespace carom::internal
