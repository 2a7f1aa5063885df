#pragma once

// Where everything that islands need goes, and memory for finding that.

#include "dynamics/islands/workspace.h"
#include "dynamics/solver/contact/coloring.h"
#include "dynamics/solver/workspace.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

/// Of a task's links: first how many go into each bin, then where the next one goes. All 0 between steps.
struct SlotsOfTask
{
    std::vector<std::int32_t> lanes; ///< by part
    std::int32_t constraints[color_limit + 1] = {};
    std::uint64_t colors = 0;            ///< that they have
    std::vector<std::int32_t> uncolored; ///< of the island's links
    std::vector<WideCore> cores;

    [[nodiscard]] std::int32_t& place_for(const ContactEdge& l)
    {
        return l.has(edge_flag::in_lane) ? lanes[l.bucket] : constraints[l.bucket];
    }
};

/// What an island has in a cell of the plane.
struct CellOfIsland
{
    std::int32_t cell;
    std::int32_t states;
    std::int64_t work;
};

/// Neighbours in a list that are of one island.
struct IslandRun
{
    std::int32_t island;
    std::int32_t first;
    std::int32_t count;
    std::int32_t sorted_first = 0; ///< where they go when the list is sorted by island

    template <class Item>
    [[nodiscard]] std::span<const Item> of(const std::vector<Item>& items) const
    {
        return {items.data() + first, static_cast<std::size_t>(count)};
    }
};

/// A joint and the states of its bodies.
struct SolvedJoint
{
    std::int32_t joint;
    std::int32_t a;
    std::int32_t b;
};

/// A hinge among the wide ones.
struct JointLane
{
    std::int32_t bucket; ///< by color, and by whether it does something about its angle
    std::int32_t lane;   ///< group * lane_count + lane
    SolvedJoint place;
};

/// A body that flies in this step, or may take off.
struct FlierSeed
{
    std::int32_t state;
    std::int32_t body;
    std::int32_t kind; ///< none, or the hinge it turns on
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
    std::uint8_t cell; ///< of the plane
};

/// What the islands of the last step were made of, see cached_graph.cpp.
struct CachedGraph
{
    std::vector<CachedBody> bodies;
    std::vector<JointEdge> joints;
    std::vector<std::uint8_t> bound;        ///< of each state: constraints, limits or motors hold it
    bool are_plain = false;                 ///< nothing in them depends on anything else
    bool stay_plain = false;                ///< and no body or joint has changed, come or gone since
    bool edges_are_unchanged = false;       ///< those of contacts are what they were
    bool joints_are_unchanged = false;      ///< so that links of joints are what they were
    bool hinges_are_unchanged = false;      ///< and wide hinges stand where they stood
    bool has_hung = false;                  ///< as Scratch::has_hung when links of joints were gathered
    bool constraints_apart = false;         ///< islands have stayed: each has its wide contact constraints in a place of its own
    bool constraints_are_unchanged = false; ///< in this step wide contact constraints have been followed where they stand
    std::uint64_t constraints_unchanged_for = 0; ///< so many steps, this one among them
    std::uint64_t stamp = 0;            ///< of the constraints, as in SceneState::lanes_stamp; never the same twice in a scene
    std::vector<std::int32_t> contacts; ///< the awake ones, when the constraints were filled
    std::vector<std::int32_t> loose;    ///< of these, those without a lane
    int touching = 0;                   ///< of the report
};

struct LayoutWorkspace
{
    std::vector<StatePair> joint_states; ///< of each of the solved joints
    std::vector<std::int32_t> island_starts;
    std::vector<std::vector<IslandRun>> runs_of_task;
    std::vector<std::vector<CellOfIsland>> cells_of_task;
    std::vector<ContactEdge> solved_edges;      ///< those that get constraints, by island
    std::vector<std::int32_t> lane_edges;       ///< link in each lane; none: empty
    std::vector<std::int32_t> constraint_edges; ///< link of each constraint
    std::vector<SlotsOfTask> slots_of_task;
    std::vector<std::uint64_t> joint_colors;  ///< by state: a bit for each that its hinges in lanes have
    std::vector<std::uint8_t> bound_by_joint; ///< by state
    std::vector<SolvedJoint> joints_outside_lanes;
    std::vector<JointLane> joint_lanes;
    std::vector<JointLane> sorted_lanes;
    std::vector<FlierSeed> flier_seeds;
};

} // namespace carom::internal
