#pragma once

// How an island is solved. Only policy.cpp decides by an island's size or content; all else asks the choices below by name. They depend on the island alone, never on threads or on other
// islands. Tests may force any of them.

#include <cstddef>
#include <cstdint>
#include <optional>

namespace carom::internal {

inline constexpr int few_bodies =
    16; ///< as in a break of fifteen balls: beyond it a contact more or less does not decide where a ball goes
inline constexpr int most_watched_bodies = 64;     ///< whose energy is watched: IslandEnergy has room for so many
inline constexpr int most_converging_bodies = 32;  ///< IslandSolver has room for the speeds of so many
inline constexpr int most_direct_rows = 128;       ///< beyond, DirectSolve takes longer than soft rows
inline constexpr int most_subdivisions = 32;       ///< where a kinematic body or a joint's arm turns
inline constexpr int most_hinge_subdivisions = 64; ///< where a body on a hinge turns a contact: what it errs by is its own energy

/// What is known of an island when its policy is chosen.
struct IslandTally
{
    std::int32_t first = -1; ///< place in awake_bodies of its first body
    std::int32_t bodies = 0;
    std::int32_t unloaded = 0; ///< bodies that no contact loads; they fly unless they are a crowd
    std::int32_t fliers = 0;
    std::int32_t joints = 0;
    std::int32_t contacts = 0;
    std::int32_t bearing = 0;      ///< contacts that bore a load in the last step
    float swing = 0;               ///< rad/s, of the joints' arms
    std::int32_t damped = 0;       ///< joints that brake or damp what they hold
    bool hangs = false;            ///< a joint holds to what does not move
    std::int32_t subdivisions = 1; ///< of each sub-step, as what turns in it asks for
    float longest_path = 0;        ///< m in this step, of its fliers that may meet something
};

struct IslandPolicy
{
    bool free_fall = false;   ///< bodies with nothing near, each by itself: no solver, and many to an island
    bool soft_joints = false; ///< joints are soft constraints in lanes, and several such islands are solved as one
    bool recomputes_contacts =
        false; ///< manifolds are found anew within the step, and pieces of a chain that a body may come to face have constraints
    bool converges = false; ///< contacts are solved until they agree, in up to 16 passes; else in one
    bool exact_impacts =
        false; ///< all that an impact touches reflects at once, and whatever becomes fast takes off; else impacts go two by two
    bool conserves_energy = false; ///< speeds are held to the energy that loads leave, see IslandEnergy
    bool caches_manifolds =
        false; ///< manifolds are followed from step to step; and what has been slow for long enough loses its speed
    bool caches_graph = false;                   ///< where nothing of it has changed, everyone stays in place
    bool wide_contacts = false;                  ///< contacts are solved eight side by side
    bool wide_joints = false;                    ///< hinges likewise
    std::int32_t subdivisions = 1;               ///< of each sub-step
    std::int32_t direct_rows = most_direct_rows; ///< up to so many rows, joints outside of lanes are solved all at once; 0: never
};

/// What tests force. A choice that another rules out is not taken, see policy.cpp.
struct ForcedPolicy
{
    std::optional<bool> free_fall{};
    std::optional<bool> soft_joints{};
    std::optional<bool> recomputes_contacts{};
    std::optional<bool> converges{};
    std::optional<bool> exact_impacts{};
    std::optional<bool> conserves_energy{};
    std::optional<bool> caches_manifolds{};
    std::optional<bool> caches_graph{};
    std::optional<bool> wide_contacts{};
    std::optional<bool> wide_joints{};
    std::optional<std::int32_t> subdivisions{};
    std::optional<std::int32_t> direct_rows{};
};

/// In a crowd only fast movers fly: the contacts of the others are speculative, and one more or less does not decide their path.
[[nodiscard]] inline bool is_crowd(int unloaded_bodies) { return unloaded_bodies > few_bodies; }

/// Do contacts, and do joints, whose normals and arms turn subdivide the sub-steps of an island of so many bodies?
[[nodiscard]] inline bool follows_turning_contacts(int bodies) { return bodies <= few_bodies; }
[[nodiscard]] inline bool follows_swinging_joints(int bodies) { return bodies <= most_watched_bodies; }

/// With fewer joints in the scene none is soft.
[[nodiscard]] bool may_have_soft_joints(std::size_t joints_of_scene);

/// is_isolated: its first body has nothing near. dt: of the step, s.
[[nodiscard]] IslandPolicy choose_policy(const IslandTally& island, bool is_isolated, float dt, const ForcedPolicy& forced);

/// Are all of an island's joints solved at once, with rows for what they do along their axes?
[[nodiscard]] bool solves_all_joints_directly(const IslandPolicy& policy, int rows, bool some_in_lanes);

/// Spatial partitions that threads solve side by side; 0: the island is not cut. Whatever the number of threads, for the order in which constraints are solved depends on it.
[[nodiscard]] int partitions_of(const IslandPolicy& policy, int bodies, int edges);

/// More than stay in the cache that processors share. Something always flies in so large an island, and its partitions relax before that flies, too.
[[nodiscard]] bool are_many(int partitions);

/// Do all threads solve it together?
[[nodiscard]] bool is_worth_all_threads(int partitions, int wide_joint_blocks);

/// Do its constraints come from memory, so that they should be prefetched? blocks: of wide contacts.
[[nodiscard]] bool is_beyond_caches(int blocks);

} // namespace carom::internal
