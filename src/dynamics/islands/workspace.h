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

/// Of a link; the first three as in contact_flag.
namespace edge_flag {
inline constexpr std::uint32_t touching = contact_flag::touching; ///< else it may touch within the step
inline constexpr std::uint32_t round = contact_flag::round;
inline constexpr std::uint32_t bears = contact_flag::loaded; ///< bore a load in the last step
inline constexpr std::uint32_t solved = 1;                   ///< gets a constraint, unless a body flies
inline constexpr std::uint32_t plain = 4;                    ///< neither rolling resistance nor surface speed
inline constexpr std::uint32_t in_lane = 8;
inline constexpr std::uint32_t all = 63;
} // namespace edge_flag

/// Contact of a dynamic body, or of two, that takes part in a step. Four to a cache line.
struct ContactEdge
{
    std::int32_t contact = none;
    std::int32_t a = none; ///< place in awake_bodies of the body, if it is dynamic; none: it rests; -2 - place: kinematic
    std::int32_t b = none;
    // Not bytes: to a compiler what is written as bytes may be anything, and all is read again after it.
    std::uint16_t flags = 0;  ///< see packed_flags
    std::uint16_t bucket = 0; ///< where lanes are given out, by color, points and place; of constraints the color

    [[nodiscard]] bool has(std::uint32_t flag) const { return (flags & flag) != 0; }
    [[nodiscard]] int points() const { return flags >> 6 & 3; }
    [[nodiscard]] int color() const { return (flags >> 8) - 1; } ///< that it has from the last step, then of its constraint
};
static_assert(sizeof(ContactEdge) == 16);

/// Flags, the number of points and the color in one number.
[[nodiscard]] inline std::uint16_t packed_flags(std::uint32_t flags, int points, int color)
{
    return static_cast<std::uint16_t>(flags | static_cast<std::uint32_t>(points) << 6 |
                                      static_cast<std::uint32_t>(color + 1) << 8);
}

/// What a task has found.
struct EdgesOfTask
{
    std::vector<ContactEdge> edges; ///< room for more than there are
    std::size_t count = 0;
    std::size_t first = 0;      ///< where they go among all
    std::size_t to_compare = 0; ///< so many are of the last step, but for those that have been found
    int touching = 0;
    bool stay = false; ///< they are what they were
};

inline constexpr std::int32_t solver_owned = -2; ///< in Scratch::flight

/// Joint of a dynamic body, or of two, that takes part in a step.
struct JointEdge
{
    std::int32_t joint = none;
    std::int32_t a = none; ///< as in ContactEdge
    std::int32_t b = none;
    bool hinge = false;  ///< of a kind that goes in lanes
    bool holds = false;  ///< and does nothing else
    bool damped = false; ///< it brakes or damps
    bool binds = false;  ///< it does something about an angle or a length beside
    bool flies = false;  ///< one of its bodies may fly about it

    [[nodiscard]] bool operator==(const JointEdge&) const = default;
};

/// An island has a link with a kinematic body.
struct KinematicMeeting
{
    std::int32_t island;
    std::int32_t edge;
    std::int32_t place; ///< of the body, in awake_bodies
};

/// Where what may be deflected may come, and its leaves.
struct SomeReaches
{
    std::vector<TreeLeaf> reaches;
    std::vector<std::int32_t> shapes;
};

/// Of flight_meetings.cpp.
struct MeetingsWorkspace
{
    std::vector<std::uint8_t> may_meet;     ///< of what flies far: something that it touches or comes near
    std::vector<std::uint8_t> is_deflected; ///< what flies may be, by place in awake_bodies
    std::vector<TreeLeaf> reaches;          ///< of these
    std::vector<SomeReaches> reaches_of_task;
    BoxTree reach_tree;
    std::vector<std::uint8_t> keeps_its_way; ///< what is not deflected, in the blocks of the moving layer
    std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> meetings_of_task; ///< islands that meet
};

struct GraphWorkspace
{
    std::vector<std::int32_t> places;         ///< by body slot, as in Link
    std::vector<std::int32_t> placed;         ///< bodies that have one
    std::vector<float> swings;                ///< of joint_edges, see IslandTally::swing
    UnionFind sets;                           ///< of what hangs together, by place in awake_bodies; then of islands that meet
    std::vector<UnionFind> more_sets;         ///< of parts of the links
    std::vector<std::int32_t> island_of;      ///< by place in awake_bodies
    std::vector<std::int32_t> island_of_edge; ///< none: it gets no constraint
    std::vector<std::int32_t> flight;         ///< by place in awake_bodies: earthbound, none (free), or the hinge it turns on
    std::vector<std::int32_t> flying;         ///< places where that is not earthbound
    std::vector<std::int32_t> could_fly;      ///< the same of what could fly but bears or is borne by something
    std::vector<std::uint8_t> is_loaded;      ///< by a contact, by place in awake_bodies; the last is nobody's
    std::vector<std::uint8_t> is_isolated;    ///< of what flies, by place in awake_bodies: nothing is near
    std::vector<std::uint8_t> may_be_struck;  ///< by what flies, by place in awake_bodies
    bool has_kinematic = false;               ///< a kinematic body is awake
    bool has_hung = false;                    ///< of what may fly, something hangs on a hinge
    bool has_uneven = false;                  ///< a body that moves more easily along one axis is awake
    std::vector<EdgesOfTask> edges_of_task;
    std::vector<ContactEdge> edges;
    std::vector<std::vector<JointEdge>> joints_of_task;
    std::vector<JointEdge> joint_edges;
    std::vector<IslandTally> tallies;
    std::vector<std::int32_t> in_plane; ///< places in awake_bodies, in the order of the plane
    std::size_t fullest_cell = 0; ///< bodies in the plane cell that has most, of what moves in this step; 0 where nobody asked
    std::vector<JointEdge> solved_joints;    ///< by island
    std::vector<std::int32_t> solved_bodies; ///< places in awake_bodies, by island
    std::vector<std::vector<KinematicMeeting>> meetings_with_kinematic_of_task;
    std::vector<KinematicMeeting> meetings_with_kinematic; ///< by island, then by link
};

} // namespace carom::internal
