#pragma once

// The constraint graph of a step, and memory for building it.

#include "collision/broad_phase.h"
#include "core/union_find.h"
#include "dynamics/islands/policy.h"
#include "dynamics/state/scene_state.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom::internal {

/// Flags of a contact edge; the first three are as in contact_flag.
namespace edge_flag {
inline constexpr std::uint32_t touching = contact_flag::touching; ///< otherwise it may touch within the step
inline constexpr std::uint32_t round = contact_flag::round;
inline constexpr std::uint32_t bears = contact_flag::loaded; ///< bore a load in the last step
inline constexpr std::uint32_t solved = 1;                   ///< gets a constraint unless one of its bodies flies
inline constexpr std::uint32_t plain = 4;                    ///< neither rolling resistance nor surface speed
inline constexpr std::uint32_t in_lane = 8;
inline constexpr std::uint32_t all = 63;
} // namespace edge_flag

/// Flags, number of points and color of a contact edge.
struct EdgeTraits
{
    // Not a byte: a store through a byte type may alias anything, and the compiler would reload everything after it.
    std::uint16_t flags = 0; ///< see packed_flags

    [[nodiscard]] bool has(std::uint32_t flag) const { return (flags & flag) != 0; }
    [[nodiscard]] int points() const { return flags >> 6 & 3; }
    [[nodiscard]] int color() const { return (flags >> 8) - 1; } ///< color from the last step, then that of its constraint
};

/// Contact that takes part in a step, between two bodies of which at least one is dynamic. Four to a cache line.
struct ContactEdge : EdgeTraits
{
    std::int32_t contact = none;
    std::int32_t a = none; ///< index in awake_bodies if the body is dynamic; none: it rests; -2 - index: kinematic
    std::int32_t b = none;
};
static_assert(sizeof(ContactEdge) == 16);

/// Flags, the number of points and the color in one number.
[[nodiscard]] inline std::uint16_t packed_flags(std::uint32_t flags, int points, int color)
{
    return static_cast<std::uint16_t>(flags | static_cast<std::uint32_t>(points) << 6 |
                                      static_cast<std::uint32_t>(color + 1) << 8);
}

/// Contact edges that a task has found.
struct EdgesOfTask
{
    std::vector<ContactEdge> edges; ///< size may exceed count
    std::size_t count = 0;
    std::size_t first = 0;      ///< index of its first edge among all
    std::size_t to_compare = 0; ///< the first so many entries are of the last step, until they are overwritten
    int touching = 0;
    bool stay = false; ///< its edges are those of the last step
};

/// Modes of flight of a body, beside the hinge to the world about which it turns.
inline constexpr std::int32_t free_flight = none; ///< it flies freely
inline constexpr std::int32_t solver_owned = -2;  ///< it does not fly

/// Joint that takes part in a step, between two bodies of which at least one is dynamic.
struct JointEdge
{
    std::int32_t joint = none;
    std::int32_t a = none; ///< as in ContactEdge
    std::int32_t b = none;
    bool hinge = false;  ///< of a kind that can be solved in lanes
    bool holds = false;  ///< holds its bodies and has no other effect
    bool damped = false; ///< it has a brake or damping
    bool binds = false;  ///< it also acts on an angle or a length
    bool flies = false;  ///< one of its bodies may fly about its hinge

    [[nodiscard]] bool operator==(const JointEdge&) const = default;
};

/// Contact edge between an island and a kinematic body.
struct KinematicMeeting
{
    std::int32_t island;
    std::int32_t edge;
    std::int32_t place; ///< index of the body in awake_bodies
};

/// Boxes that bodies may reach if they are deflected, and the leaves of these bodies.
struct SomeReaches
{
    std::vector<TreeLeaf> reaches;
    std::vector<std::int32_t> shapes;
};

/// Memory of flight_meetings.cpp.
struct MeetingsWorkspace
{
    std::vector<std::uint8_t> may_meet;     ///< whether a flier with a long path touches or comes near something, by awake index
    std::vector<std::uint8_t> is_deflected; ///< whether a flier may be deflected, by awake index
    std::vector<TreeLeaf> reaches;          ///< boxes that these may reach
    std::vector<SomeReaches> reaches_of_task;
    BoxTree reach_tree;
    std::vector<std::uint8_t> keeps_its_path; ///< items that are not deflected, in the blocks of the moving layer
    std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> meetings_of_task; ///< pairs of islands that meet
};

struct GraphWorkspace
{
    std::vector<std::int32_t> places;         ///< awake indices as in ContactEdge, by body slot
    std::vector<std::int32_t> placed;         ///< bodies that have an index in places
    std::vector<float> swings;                ///< by index in joint_edges, see IslandTally::swing
    std::vector<std::uint8_t> is_jointed;     ///< to another dynamic body, by awake index
    UnionFind sets;                           ///< connected bodies, by awake index; then islands that meet
    std::vector<UnionFind> more_sets;         ///< for further parts of the edges
    std::vector<std::int32_t> island_of;      ///< by awake index
    std::vector<std::int32_t> island_of_edge; ///< by contact edge; none: it gets no constraint
    std::vector<std::int32_t> flight_mode;    ///< by awake index: free_flight, solver_owned, or the hinge about which it turns
    std::vector<std::int32_t> flying;         ///< awake indices of the bodies that are not solver_owned
    std::vector<std::int32_t> could_fly;      ///< the same for a body that could fly but bears a load or is borne
    std::vector<std::uint8_t>
        may_bounce;                      ///< whether the body may meet something in this step that it bounces off, by awake index
    std::vector<std::uint8_t> is_loaded; ///< whether a contact loads the body, by awake index; the last element is a dummy
    std::vector<std::uint8_t> is_isolated;   ///< whether a flier has nothing near, by awake index
    std::vector<std::uint8_t> may_be_struck; ///< whether a flier may strike the body, by awake index
    bool has_kinematic = false;              ///< a kinematic body is awake
    bool has_hinged_fliers = false;          ///< a body that may fly about a hinge is awake
    bool has_uneven = false;                 ///< an awake body is locked along one axis of the plane only
    std::vector<EdgesOfTask> edges_of_task;
    std::vector<ContactEdge> edges;
    std::vector<std::vector<JointEdge>> joints_of_task;
    std::vector<JointEdge> joint_edges;
    std::vector<IslandTally> tallies;
    std::vector<std::int32_t> in_plane;   ///< awake indices, sorted by plane cell
    std::size_t fullest_cell = 0;         ///< bodies in the fullest plane cell, of those awake in this step; 0 where not counted
    std::vector<JointEdge> solved_joints; ///< by island
    std::vector<std::int32_t> solved_bodies; ///< awake indices, by island
    std::vector<std::vector<KinematicMeeting>> meetings_with_kinematic_of_task;
    std::vector<KinematicMeeting> meetings_with_kinematic; ///< by island, then by edge
};

} // namespace carom::internal
