#pragma once

// How an island is solved. Only policy.cpp and the limits below decide by an island's size or content; all other code reads the choices. They depend on the island and the
// length of the step, never on threads. Tests may force any of them. Islands in free fall and islands with soft joints are then solved several at a time, as one Island.

#include <cstddef>
#include <cstdint>
#include <optional>

namespace carom::internal {

/// As in a break of fifteen balls: beyond it, one contact more or less does not decide a ball's path.
inline constexpr int few_bodies = 16;
inline constexpr int most_watched_bodies = 64; ///< island size up to which joints count as swinging whatever touches them
/// Impacts of a body in a crowd in one step: with more, the solver owns it in the next steps. A crowd that has had more than four for each body collapses:
/// there, most of them only pass speed to and fro.
[[nodiscard]] inline int most_impacts_of_a_step(int impacts_of_island, int bodies)
{
    return impacts_of_island > 4 * bodies ? 4 : 16;
}
inline constexpr int most_loops = 256; ///< closed by joints: in a sheet of hinges, the matrix of the joints fills up

inline constexpr int bodies_in_all_passes = 512; ///< of a sub-step: larger islands take fewer

/// Data by which the policy of an island is chosen.
struct IslandTally
{
    std::int32_t first = -1; ///< index in awake_bodies of its first body
    std::int32_t bodies = 0;
    std::int32_t unloaded = 0; ///< bodies that no contact loads; they fly unless the island is a crowd
    std::int32_t bouncing = 0; ///< unloaded ones that may meet something in this step that they bounce off
    std::int32_t fliers = 0;
    std::int32_t joints = 0;
    std::int32_t inner_joints = 0; ///< between two dynamic bodies
    std::int32_t jointed = 0;      ///< bodies that these join
    std::int32_t contacts = 0;
    std::int32_t bearing = 0;      ///< contacts that bore a load in the last step
    float swing = 0;               ///< rad/s, greatest angular speed of the joints' arms
    std::int32_t damped = 0;       ///< joints with a brake or damping
    bool hangs = false;            ///< a joint connects to the world or to a body that is not dynamic
    std::int32_t subdivisions = 1; ///< per sub-step, as the rotation of its bodies and arms requires
    float longest_path = 0;        ///< m in this step, longest displacement of a flier that may meet something
};

struct IslandPolicy
{
    bool free_fall = false; ///< isolated bodies in free fall: no solver, and many of them in one island
    /// One soft pass over joints, hinges in lanes, as in a pile; several such islands are solved as one.
    bool soft_joints = false;
    /// Manifolds are recomputed within the step, and chain pieces that a body may come to face have constraints.
    bool recomputes_contacts = false;
    bool converges = false; ///< contacts are solved until they converge, in up to 16 passes
    /// All that touches takes part in an impact, a body has up to 64 impacts in a sub-step, and one that becomes fast takes off. Otherwise 16
    /// bodies without those under load, 16 impacts, and only what was struck takes off.
    bool exact_impacts = false;
    bool conserves_energy = false; ///< speeds are held to the energy that loads leave, see IslandEnergy
    /// Manifolds are cached from step to step, and bodies that have been slow for long enough lose their speed (rest damping).
    bool caches_manifolds = false;
    bool caches_graph = false;  ///< its layout depends on bodies and edges alone: reused where no island of the scene has changed
    bool wide_contacts = false; ///< contacts are solved in wide constraints of eight lanes
    bool wide_joints = false;   ///< so are hinges
    std::int32_t subdivisions = 1; ///< per sub-step
    std::int32_t passes = 1;       ///< over contacts, which are as many times as stiff, see set_softness() in step.cpp
    bool direct_joints = true;     ///< joints outside of lanes are solved all at once; otherwise one after the other
};

/// Choices that tests force. A choice that another one rules out is not taken, see policy.cpp.
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
    std::optional<std::int32_t> passes{};
    std::optional<bool> direct_joints{};
};

/// In a crowd only fast movers and bodies that bounce fly: contacts of the others are speculative, and one contact more or less does not decide their paths.
[[nodiscard]] inline bool limits_flight_to_fast_movers(int unloaded_bodies) { return unloaded_bodies > few_bodies; }

/// Do contacts whose normals turn, and joints whose arms turn, subdivide the sub-steps of an island of so many bodies?
[[nodiscard]] inline bool follows_turning_contacts(int bodies) { return bodies <= few_bodies; }
[[nodiscard]] bool follows_swinging_joints(const IslandTally& island);
/// Do waves along chains under tension subdivide them as well?
[[nodiscard]] bool follows_whips(const IslandTally& island);

/// is_isolated: the island's first body has nothing near. dt: the time step, s.
[[nodiscard]] IslandPolicy choose_policy(const IslandTally& island, bool is_isolated, float dt, int most_passes,
                                         const ForcedPolicy& forced);

/// Are all joints of an island solved at once, including the rows along their axes?
[[nodiscard]] bool solves_all_joints_directly(const IslandPolicy& policy, bool some_in_lanes);

/// Number of spatial partitions that threads solve in parallel; 0: the island is not partitioned. It does not depend on the number of threads, because it
/// determines the order in which constraints are solved.
[[nodiscard]] int partitions_of(const IslandPolicy& policy, int bodies, int edges);

/// More partitions than stay in the shared processor cache. An island this large always has fliers, and its partitions relax before the fliers move, too.
[[nodiscard]] bool exceeds_shared_cache(int partitions);

/// Do all threads solve the island together?
[[nodiscard]] bool is_worth_all_threads(int partitions, int wide_joint_blocks);

/// Do the island's constraints come from memory, so that they should be prefetched? blocks: number of wide contact constraints.
[[nodiscard]] bool is_beyond_caches(int blocks);

} // namespace carom::internal
