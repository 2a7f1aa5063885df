// Thresholds by which the policy of an island is chosen, and their reasons.

#include "dynamics/islands/policy.h"

#include "dynamics/state/scene_state.h"

#include <algorithm>
#include <bit>

namespace carom::internal {

namespace {

constexpr int enough_soft_joints = 8;
constexpr int few_joints = 64;        // so few are solved at once in a pile as well
constexpr int few_damped_joints = 42; // with all of them solved at once, rain takes 1.5 times as long
constexpr float calm_swing = 0.1f;    // rad per step
constexpr int edges_to_a_partition = 2048;
constexpr int edges_to_a_huge_partition = 8192; // their constraints stay in a cache between solving and relaxation
constexpr int few_partitions = 16;              // their constraints stay in the shared processor cache
constexpr int most_partitions = plane_cells;    // at most one to a plane cell
// With fewer, waiting at the end of each color costs more than a second thread gains.
constexpr int joint_blocks_worth_threads = 1536;
constexpr int blocks_in_caches = 8'192;

template <class Value>
void force(Value& choice, const std::optional<Value>& forced)
{
    choice = forced.value_or(choice);
}

// Soft joints suit two kinds of islands: jointed bodies that lie on something, with at least one load-bearing contact to four joints; and islands in which
// every joint has a brake or damping and nothing turns fast near something that it may meet. In neither does a joint connect to something that does not move.
bool has_soft_joints(const IslandTally& t, float dt)
{
    const bool calm = t.subdivisions == 1;
    const bool rests = 4 * t.bearing >= t.joints && calm;
    const bool is_damped = t.damped == t.joints && (t.contacts == 0 || (calm && dt * t.swing < calm_swing));
    return t.joints >= enough_soft_joints && t.bodies <= most_watched_bodies && !t.hangs && t.fliers == 0 && (rests || is_damped);
}

// As in a pile of many figures, or on a bridge under a heap: one pass over joints is enough where contacts pass on most of what they bear, or where all are
// damped. It depends on edges alone, so that the graph may be cached.
bool lies_in_a_pile(const IslandTally& t)
{
    return t.contacts >= 4 * t.joints || (!t.hangs && (4 * t.contacts >= t.joints || t.damped == t.joints));
}

bool has_many_loops(const IslandTally& t) { return t.inner_joints - t.jointed > most_loops; }

// Several figures whose joints all have friction: row after row loses little that friction would not take.
bool is_damped_crowd(const IslandTally& t) { return t.joints > few_damped_joints && !t.hangs && t.damped == t.joints; }

// Wide constraints do not support manifolds that change within the step, subdivided sub-steps, or the energies of joints.
bool may_be_wide(const IslandTally& t, const IslandPolicy& policy)
{
    return policy.soft_joints ||
           (!policy.recomputes_contacts && policy.subdivisions == 1 && (t.joints == 0 || !policy.conserves_energy));
}

// Joints that are solved row by row are soft as in one pass: stiffer contacts would have the better of them.
int passes_of(const IslandTally& t, const IslandPolicy& policy, int most)
{
    const bool joint_rows = t.joints > 0 && (policy.wide_joints || !policy.direct_joints);
    return joint_rows ? 1 : std::clamp(bodies_in_all_passes / t.bodies, 1, most);
}

} // namespace

IslandPolicy choose_policy(const IslandTally& island, bool is_isolated, float dt, int most_passes, const ForcedPolicy& forced)
{
    IslandPolicy policy;
    policy.subdivisions = island.subdivisions;
    policy.free_fall = is_isolated && island.bodies == 1 && island.fliers == 1 && forced.free_fall.value_or(true);
    if (policy.free_fall)
        return policy; // there may be thousands of such islands
    policy.soft_joints = forced.soft_joints.value_or(has_soft_joints(island, dt));
    const bool few = island.bodies <= few_bodies && !policy.soft_joints;
    policy.recomputes_contacts = policy.converges = policy.exact_impacts = few;
    policy.caches_manifolds = !few;
    policy.conserves_energy = few || (!policy.soft_joints && island.joints > 0 && follows_swinging_joints(island));
    policy.caches_graph = island.bodies > (island.joints > 0 ? most_watched_bodies : few_bodies) && !policy.soft_joints &&
                          (island.joints == 0 || !follows_swinging_joints(island));
    policy.subdivisions = policy.soft_joints ? 1 : island.subdivisions;
    force(policy.recomputes_contacts, forced.recomputes_contacts);
    force(policy.converges, forced.converges);
    force(policy.exact_impacts, forced.exact_impacts);
    force(policy.conserves_energy, forced.conserves_energy);
    force(policy.caches_manifolds, forced.caches_manifolds);
    force(policy.subdivisions, forced.subdivisions);
    policy.wide_contacts = may_be_wide(island, policy) && forced.wide_contacts.value_or(true);
    const bool many = island.joints > few_joints && (lies_in_a_pile(island) || has_many_loops(island));
    policy.wide_joints = policy.wide_contacts && forced.wide_joints.value_or(policy.soft_joints || many);
    policy.direct_joints = forced.direct_joints.value_or(!has_many_loops(island) && !is_damped_crowd(island));
    force(policy.caches_graph, forced.caches_graph);
    policy.passes = forced.passes.value_or(passes_of(island, policy, most_passes));
    policy.caches_graph &= policy.wide_contacts;
    return policy;
}

bool solves_all_joints_directly(const IslandPolicy& policy, bool some_in_lanes) { return !some_in_lanes && policy.direct_joints; }

bool follows_swinging_joints(const IslandTally& island)
{
    return island.bodies <= most_watched_bodies || !(lies_in_a_pile(island) || has_many_loops(island));
}

bool follows_whips(const IslandTally& island) { return island.bodies > most_watched_bodies; }

int partitions_of(const IslandPolicy& policy, int bodies, int edges)
{
    const int few = std::min(edges / edges_to_a_partition, few_partitions);
    const int many = std::min({edges / edges_to_a_huge_partition, bodies / bodies_to_a_cell, most_partitions});
    const int parts = std::max(few, many);
    return policy.wide_contacts && parts > 1 ? static_cast<int>(std::bit_floor(static_cast<unsigned>(parts))) : 0;
}

bool exceeds_shared_cache(int partitions) { return partitions > few_partitions; }

bool is_worth_all_threads(int partitions, int wide_joint_blocks)
{
    return partitions > 0 || wide_joint_blocks >= joint_blocks_worth_threads;
}

bool is_beyond_caches(int blocks) { return blocks > blocks_in_caches; }

} // namespace carom::internal
