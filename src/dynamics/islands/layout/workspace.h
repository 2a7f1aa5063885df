#pragma once

// Slots of all that islands contain, and memory for finding them.

#include "dynamics/islands/workspace.h"
#include "dynamics/solver/workspace.h"
#include "dynamics/state/coloring.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

/// Contact edge that gets a constraint, between the states of its bodies.
struct SolvedEdge : EdgeTraits
{
    std::uint16_t partition = 0; ///< in a lane
    std::int32_t contact = none;
    std::int32_t a = none; ///< state
    std::int32_t b = none;
};

/// Slots of a task's contact edges: first the number of edges in each bucket, then the slot of the next one. All 0 between steps.
struct SlotsOfTask
{
    std::vector<std::int32_t> lanes; ///< by partition and bucket
    std::int32_t constraints[color_limit + 1] = {};
    std::uint64_t colors = 0;            ///< colors of its edges, one bit each
    bool has_features = false;           ///< whether some edge in a lane is not plain
    std::vector<std::int32_t> uncolored; ///< indices among the island's edges
    std::vector<WideCore> cores;

    [[nodiscard]] std::int32_t& place_for(const SolvedEdge& l)
    {
        return l.has(edge_flag::in_lane) ? lanes[static_cast<std::size_t>(place_of(l))] : constraints[l.color()];
    }

private:
    [[nodiscard]] static int place_of(const SolvedEdge& l)
    {
        const int kind = l.has(edge_flag::plain) ? 0 : plain_buckets;
        return l.partition * buckets_to_a_partition + kind + 2 * l.color() + (l.points() == 2 ? 0 : 1);
    }
};

/// States and work of an island in one plane cell.
struct CellOfIsland
{
    std::int32_t cell;
    std::int32_t states;
    std::int64_t work;
};

/// Neighbors in a list that belong to one island.
struct IslandRun
{
    std::int32_t island;
    std::int32_t first;
    std::int32_t count;
    std::int32_t sorted_first = 0; ///< index of the first when the list is sorted by island
};

/// A joint and the states of its bodies.
struct SolvedJoint
{
    std::int32_t joint;
    std::int32_t a;
    std::int32_t b;
};

/// A hinge that is solved in a lane.
struct JointLane
{
    std::int32_t bucket; ///< by color, and by whether it also acts on its angle
    std::int32_t lane;   ///< block * lane_count + lane
    SolvedJoint place;
};

/// A body that flies in this step, or may take off.
struct FlierSeed
{
    std::int32_t state;
    std::int32_t body;
    std::int32_t kind; ///< none, or the hinge about which it turns
    bool landed;
};

struct StatePair
{
    std::int32_t a;
    std::int32_t b;
};

struct CachedBody
{
    std::int32_t body;
    std::uint8_t cell; ///< plane cell
};

/// How much of the last step an islands stage uses again. Each includes those before it.
enum class Reuse : std::uint8_t
{
    Nothing,
    Graph,      ///< islands, layout and the slots of hinges: states and constraints are filled
    Constraints ///< wide contact constraints as well, refreshed in place by the contacts stage: only states are filled
};

/// Inputs of the islands of the last step, see cached_graph.cpp.
struct CachedGraph
{
    std::vector<CachedBody> bodies;
    std::vector<JointEdge> joints;
    std::vector<std::uint8_t> bound;   ///< by state: constraints, limits or motors hold it
    bool is_valid = false;             ///< the layout depends on bodies and edges alone
    bool is_current = false;           ///< and no body or joint has changed, been added or been removed since
    bool edges_are_unchanged = false;  ///< contact edges are unchanged
    bool joints_are_unchanged = false; ///< and joint edges are unchanged
    bool had_hinged_fliers = false;    ///< GraphWorkspace::has_hinged_fliers when joint edges were gathered
};

/// Wide contact constraints of the last step, see narrowphase/cached_constraints.cpp.
struct CachedConstraints
{
    bool are_valid = false;             ///< the graph was unchanged: each island has its own storage for them
    std::uint64_t unchanged_for = 0;    ///< number of steps, including this one
    std::uint64_t stamp = 0;            ///< as in SceneState::lanes_stamp; unique within a scene
    std::vector<std::int32_t> contacts; ///< awake contacts when the constraints were filled
    std::vector<std::int32_t> loose;    ///< those of the contacts without a lane
    int touching = 0;                   ///< touching contacts, for the report
};

struct LayoutWorkspace
{
    std::vector<StatePair> joint_states; ///< by index in solved_joints
    std::vector<std::int32_t> island_starts;
    std::vector<std::vector<IslandRun>> runs_of_task;
    std::vector<std::vector<CellOfIsland>> cells_of_task;
    std::vector<std::int32_t> edge_order;       ///< indices of the contact edges that get constraints, by island
    std::vector<SolvedEdge> solved_edges;       ///< in the same order
    std::vector<std::int32_t> lane_edges;       ///< edge in each lane; none: empty
    std::vector<std::int32_t> constraint_edges; ///< edge of each constraint
    std::vector<SlotsOfTask> slots_of_task;
    std::vector<std::uint64_t> joint_colors;  ///< by state: a bit for each color of its hinges in lanes
    std::vector<std::uint8_t> bound_by_joint; ///< by state
    std::vector<SolvedJoint> joints_outside_lanes;
    std::vector<JointLane> joint_lanes;
    std::vector<JointLane> sorted_lanes;
    std::vector<FlierSeed> flier_seeds;
};

} // namespace carom::internal
