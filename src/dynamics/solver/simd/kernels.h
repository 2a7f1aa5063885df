#pragma once

// What is compiled once per instruction set (dynamics/solver/simd/), behind pointers.

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

/// Where the manifolds of constraints that stay are followed.
struct FollowedScene
{
    const BodySim* sims;
    const Contact* contacts;
    const CachedManifold* kept; ///< by contact
    const SweptBox* boxes;      ///< by shape
    float sure_displacement;    ///< bodies that have moved less against each other are surely followed
    float surely;               ///< of a bound on the way: how far it is surely kept
    float sure_cosine;          ///< and have turned by an angle of at least this cosine
    float slop;
    float speculation;
};

/// What has become of a constraint's contacts; bits are lanes.
struct RefreshedContacts
{
    LaneFloats separation; ///< the least of the contact's points
    std::uint32_t unsure;  ///< to be looked at one by one; what else is told of them does not hold
    std::uint32_t begins_or_ends;
    std::uint32_t borne; ///< near, and it bore a load
    std::uint32_t sunk;  ///< not borne, and deeper than the slop
    std::uint32_t unloaded;
};

/// The same of eight contacts by themselves.
struct FollowedContacts
{
    std::uint32_t sure;
    std::uint32_t touch_on; ///< touched, and are as near as that
};

/// Of eight pairs, a bit for each.
struct SeenPairs
{
    std::uint32_t plain; ///< one of the two moves, and neither is a trigger or a half-space: of these the others hold
    std::uint32_t near;  ///< may meet in the step
    std::uint32_t meet;  ///< by their fat boxes
    std::uint32_t stay;  ///< plain, they meet, and have a contact if and only if they are near
};

/// Eight leaves of two corners or more each, their bodies, and what sweep finds of them.
struct SweptEight
{
    const BodySim* bodies[lane_count];
    SweptBox* places[lane_count];
    const Vec2* corners[lane_count];
    int corner_counts[lane_count];
    LaneFloats radii[2];       ///< of even corners, of odd ones: only of two corners they may differ
    LaneFloats motion;         ///< how far any point may come
    LaneFloats lx, ly, ux, uy; ///< what the fat box must hold
    std::uint32_t moved;       ///< lanes whose fat box does not, or holds far too much
};

struct SweepStep
{
    float dt;
    Vec2 gravity;
    float box_margin;
};

/// Hears of each block some of whose boxes have come to overlap boxes of the one that is asked for: bit 8 i + j for box i of this and j of that.
struct OverlapSink
{
    const void* context;
    void (*note)(const void* context, std::int32_t block, std::uint64_t boxes);
};

/// What is done eight at a time, to wide contact constraints and joints, to states and contacts, compiled for one instruction set. Every set does the same, bit for bit.
struct WideKernels
{
    const char* name;
    /// A constraint from its contacts, their impulses, and the constants of their states, effective masses too. Of each lane `constraint` has a and b, `notes` the contact
    /// and how many points.
    void (*fill)(WideContact& constraint, WideContactNotes& notes, const Contact* contacts, const ContactImpulses* impulses,
                 const StateConstants* constants);
    /// Effective masses anew, once lanes have been filled one by one.
    void (*prepare)(WideContact& constraint, std::int32_t points);
    void (*warm_start)(const WideBucket& bucket, BodyState* states);
    /// One pass of sequential impulses; with bias the soft constraint also removes overlap, without it only stops approach and sums impulses.
    void (*solve)(const WideBucket& bucket, BodyState* states, const WideSoftness& s);
    /// Also notes of each group which lanes have been struck, or have begun to touch and this is not yet told.
    /// A blow is told by the speeds that bodies had before.
    /// Returns the least separation, at most 0.
    float (*relax)(const WideBucket& bucket, BodyState* states, const WideSoftness& s, const BodySpeeds* before,
                   std::uint8_t* struck);
    /// Joints from their records, bodies, and the constants of their states, for sub-steps of h. `joints` has a, b, joint and turns of each lane.
    void (*fill_joints)(WideJoint& joints, const JointRecord* records, const BodySim* sims, const std::int32_t* turns,
                        const StateConstants* constants, float h);
    /// The same where no angle matters, of hinges that have been solved in the last step: that poses are others is all that has changed.
    void (*follow_joints)(WideJoint& joints, const BodySim* sims);
    void (*warm_start_joints)(WideJoint* joints, std::int32_t count, BodyState* states);
    void (*solve_joints)(WideJoint* joints, std::int32_t count, BodyState* states, const JointSoftness& s);
    /// At the poses that the bodies have come to; the other passes are at those that relaxing last found.
    void (*relax_joints)(WideJoint* joints, std::int32_t count, BodyState* states, const JointSoftness& s);
    /// To the records: forces over the step dt, and what the next one is warm started with.
    void (*take_joint_impulses)(const WideJoint& joints, JointRecord* records, float dt);
    /// Normal, arms and separations of a constraint whose contacts it held in the last step, at the poses that bodies have now.
    void (*follow)(WideContact& constraint, const WideContactNotes& notes, const FollowedScene& scene, RefreshedContacts& found);
    /// The manifolds of eight contacts that have as many points and are kept, likewise; of those that are not sure it is to be found by itself.
    void (*follow_contacts)(const LaneInts& contacts, int points, Contact* into, const FollowedScene& scene,
                            FollowedContacts& found);
    /// Of eight contacts that are kept and have no points, those that have come to no point for sure.
    std::uint32_t (*stay_apart)(const LaneInts& contacts, const FollowedScene& scene);
    /// Impulses of all lanes, and to their contacts whether they bear a load.
    void (*take_impulses)(const WideContact& constraint, WideContactNotes& notes, Contact* contacts, ContactImpulses* impulses);
    /// Moves states that do not fly over a time h, eight by eight from the first on, as long as none of them turns fast. How many that were.
    std::int32_t (*move)(BodyState* states, const StateConstants* constants, std::int32_t count, float h);
    /// Paths of bodies that move freely, into their places, and their boxes: as sweep_body in sweep.cpp. False where it must decide, one by one.
    bool (*sweep)(SweptEight& eight, const SweepStep& step);
    /// Of eight pairs what decides about their contacts, as update_of in pair_update.cpp has it for one.
    void (*look_at_pairs)(const BoxPair* pairs, const SweptBox* places, float box_margin, SeenPairs& seen);
    /// Where boxes of block k have changed and overlap others that they did not before, each two once.
    void (*new_overlaps)(const MovingBlocks& blocks, std::int32_t k, const OverlapSink& sink);
};

/// The best that this machine has, or that CAROM_ISA allows (sse2, avx2, avx512); chosen once.
[[nodiscard]] const WideKernels& wide_kernels();

/// All that this machine can run, the best last.
[[nodiscard]] std::span<const WideKernels* const> all_wide_kernels();

/// For tests, while no scene steps.
void use_wide_kernels(const WideKernels& kernels);

} // namespace carom::internal
