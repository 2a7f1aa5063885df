#pragma once

// What the stages of one step hand to each other. Vectors are cleared, not freed: a settled scene steps without allocating.

#include "carom/event.h"
#include "collision/hilbert_order.h"
#include "collision/time_of_impact.h"
#include "core/blank_array.h"
#include "core/union_find.h"
#include "dynamics/continuous/flier.h"
#include "dynamics/continuous/impact/reflect.h"
#include "dynamics/islands/policy.h"
#include "dynamics/solver/body_state.h"
#include "dynamics/solver/contact/coloring.h"
#include "dynamics/solver/contact/contact_constraint.h"
#include "dynamics/solver/contact/wide_contacts.h"
#include "dynamics/solver/joint/joint_rows.h"
#include "dynamics/solver/joint/wide_joints.h"
#include "dynamics/state/scene_state.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace carom::internal {

struct SceneData;
class DirectSolve;
struct RawTouch;

/// Bodies, constraints and joints that are solved together through all sub-steps: an island, or islands whose paths may meet.
struct Island
{
    std::int32_t first_state = 0; ///< states [first, first + count): dynamic bodies, then copies of the kinematic ones they meet
    std::int32_t state_count = 0;
    std::int32_t dynamic_count = 0; ///< of these, after the first one
    std::int32_t first_edge = 0;
    std::int32_t edge_count = 0;
    std::int32_t first_constraint = 0; ///< contact constraints, sorted by color
    std::int32_t constraint_count = 0;
    std::int32_t first_wide =
        0; ///< groups of wide contact constraints, sorted by color: of large islands; constraints are then what does not fit there
    std::int32_t wide_store =
        0; ///< where they are kept in Scratch::wide_contacts: small islands of a task, one after the other, in one place
    std::int32_t wide_count = 0;
    std::int32_t first_wide_joint = 0;
    std::int32_t wide_joint_count = 0;
    std::int32_t first_core = 0; ///< of its wide contact constraints
    std::int32_t core_count = 0;
    std::int32_t first_joint = 0;
    std::int32_t joint_count = 0;
    std::int32_t first_flier = 0;
    std::int32_t flier_count = 0;
    std::int32_t first_law = 0;
    std::int32_t law_count = 0;
    std::int32_t first_impact_constraint = 0; ///< constraints that bear nothing yet and may be hit
    std::int32_t impact_constraint_count = 0;
    std::int32_t colors = 0;
    std::int32_t first_bin =
        0; ///< of its wide contact constraints, part by part, in Scratch::bin_starts; and where the last ends
    std::int32_t bin_count = 0; ///< of each part, and of what crosses from one to another: two to a color
    std::int32_t parts = 0;     ///< of the plane, that all threads solve side by side
    std::int32_t first_joint_lane = 0;
    std::int32_t joint_lane_count = 0;
    std::int32_t first_joint_bin = 0;
    std::int32_t joint_bin_count = 0; ///< two to a color
    IslandPolicy policy;
    bool traced = false;     ///< paths of some of its bodies are recorded
    bool all_direct = false; ///< all of its joints are solved at once
    bool drifts = false;     ///< joints alone act within it: all bodies drift along parabolas
};

/// What the update of a contact found that others must hear of.
enum class TouchChange : std::uint8_t
{
    Nothing,
    Begins,
    Ends,
    MayHit ///< something fast may hit a sleeper
};
struct ContactChange
{
    std::int32_t contact;
    TouchChange what;
};

/// Of a task's contacts: of those whose news concern nobody else, who has begun or ended to touch; and the news of the others.
struct ContactChanges
{
    std::vector<std::int32_t> begins{};
    std::vector<std::int32_t> ends{};
    std::vector<ContactChange> others{};
    std::vector<std::int32_t> left_loads{}; ///< shapes that have left a piece of a chain which bore a load of theirs
    std::vector<std::int32_t> of_others{};  ///< contacts of whose news others may have more to say
};

/// What becomes of a pair of boxes, see pair_update.cpp.
namespace pair_update {
inline constexpr std::uint8_t gets_contact = 1;
inline constexpr std::uint8_t loses_contact = 2;
inline constexpr std::uint8_t goes = 4;
inline constexpr std::uint8_t parted = 8; ///< it stays, but its boxes do not meet
} // namespace pair_update

struct PairUpdate
{
    std::int32_t pair; ///< in SceneState::box_pairs
    std::uint8_t what;
};

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
    std::uint16_t flags = 0; ///< see packed_flags
    std::uint16_t bin = 0;   ///< where lanes are given out, by color, points and place; of constraints the color

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

/// A lane against what does not give way, of a ball or of what joints pull.
struct WideCore
{
    std::int32_t lane;   ///< of the island: group * lane_count + lane
    std::int32_t points; ///< of its contact
    float depth;         ///< to which it may go
};

inline constexpr int bins_to_a_part = 2 * color_limit;

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
        return l.has(edge_flag::in_lane) ? lanes[l.bin] : constraints[l.bin];
    }
};

/// What a task has found.
struct EdgesOfTask
{
    std::vector<ContactEdge> links; ///< room for more than there are
    std::size_t count = 0;
    std::size_t first = 0;      ///< where they go among all
    std::size_t to_compare = 0; ///< so many are of the last step, but for those that have been found
    int touching = 0;
    bool stay = false; ///< they are what they were
};

/// Where what may be deflected may come, and its leaves.
struct SomeReaches
{
    std::vector<TreeLeaf> reaches;
    std::vector<std::int32_t> shapes;
};

/// Where a contact should stand among the awake ones.
struct ContactPlace
{
    std::uint32_t color; ///< counted over all islands
    std::int32_t contact;
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

inline constexpr std::int32_t earthbound = -2; ///< in Scratch::flight

/// Joint of a dynamic body, or of two, that takes part in a step.
struct JointEdge
{
    std::int32_t joint = none;
    std::int32_t a = none; ///< as in Link: the place of the body, from copy_kinematic_bodies on its state
    std::int32_t b = none;
    bool hinge = false;  ///< of a kind that goes in lanes
    bool holds = false;  ///< and does nothing else
    bool damped = false; ///< it brakes or damps
    bool binds = false;  ///< it does something about an angle or a length beside
    bool flies = false;  ///< one of its bodies may fly about it

    [[nodiscard]] bool operator==(const JointEdge&) const = default;
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

/// An island has a link with a kinematic body.
struct KinematicMeeting
{
    std::int32_t island;
    std::int32_t link;
    std::int32_t place; ///< of the body, in awake_bodies
};

/// A joint and the states of its bodies.
struct JointPlace
{
    std::int32_t joint;
    std::int32_t a;
    std::int32_t b;
};

/// A hinge among the wide ones.
struct JointLane
{
    std::int32_t bin;  ///< by color, and by whether it does something about its angle
    std::int32_t lane; ///< group * lane_count + lane
    JointPlace place;
};

/// A body that flies in this step, or may take off.
struct FlierSeed
{
    std::int32_t state;
    std::int32_t body;
    std::int32_t kind; ///< none, or the hinge it turns on
    bool landed;
};

/// An impulse on a body of another island, or one asleep: it takes effect at the end of the step.
struct DeferredImpulse
{
    std::int32_t body;
    Vec2 impulse;
    Vec2 arm;
    double time; ///< within the step; the island that gave it sees the body go on from there
};

/// A body's path from a time of the step on, until its next piece.
struct PathPiece
{
    std::int32_t body = none;
    std::int32_t order = 0; ///< among all of the step
    double start = 0;
    FramePath path{}; ///< relative to the center of mass at the start of the step
};

/// A leaf came into or went out of a leaf of a trigger.
struct Crossing
{
    std::int32_t contact = none;
    std::int32_t trigger = none; ///< the shapes that own the leaves
    std::int32_t visitor = none;
    std::int32_t order = 0; ///< among all of the step
    double time = 0;
    bool enters = false;
};

struct RecordedPose
{
    std::int32_t body;
    float time;
    Pose pose;
};

/// A circle that moves evenly, in the world: from `time` to the end of the sub-step the body stays inside.
struct Reach
{
    double x = 0; ///< at `time`
    double y = 0;
    double vx = 0;
    double vy = 0;
    double time = 0;
    double radius = 1e300;
};

/// Energy of the rate at which a joint was being closed, lost when an impact stopped it.
struct StoppedJoint
{
    std::int32_t state;
    double energy;
};

/// What a thread tells of an island's impacts.
struct ImpactReport
{
    std::vector<ImpactEvent> impacts;
    std::vector<RawTouch> begins; ///< contacts that first bore a load in this step
    std::vector<std::int32_t> kicked_shapes;
    int bulk_impacts = 0;

    ImpactReport();
    ~ImpactReport();
    ImpactReport(ImpactReport&&) noexcept;
    ImpactReport& operator=(ImpactReport&&) noexcept;
    ImpactReport(const ImpactReport&) = delete;
    ImpactReport& operator=(const ImpactReport&) = delete;
};

/// Per island, so that islands may run side by side; merged in the order of the islands.
struct IslandOutput : ImpactReport
{
    std::size_t reported_impacts = 0;       ///< the first so many are known to force laws
    std::vector<ImpactEvent> law_impacts{}; ///< what one call of a law tells
    std::vector<ContactConstraint> late_constraints;
    std::vector<ContactConstraint> pulled_constraints; ///< see Walls
    std::vector<DeferredImpulse> deferred;
    std::vector<StoppedJoint> stopped_joints;   ///< in this sub-step
    std::vector<std::int32_t> struck_lanes;     ///< of the island, in this sub-step
    std::vector<std::int32_t> struck_states;    ///< that constraints move and what flies has struck, in this sub-step
    std::vector<ImpactReport> reports_of_parts; ///< of the plane, empty but for while threads tell
    std::vector<std::int32_t> deflected;        ///< fliers off the way they set out on, in order
    std::vector<Reach> reaches;                 ///< of each of these
    std::vector<HoldSet> hold_sets;             ///< of fliers that something has held
    std::vector<PathPiece> path;                ///< of traced bodies, of each in the order of time
    std::vector<std::int32_t> last_piece;       ///< of each state of the island; empty before the first
    std::vector<RecordedPose> poses;            ///< after each sub-step, when asked for
    std::unique_ptr<DirectSolve> direct;        ///< of what joints hold, where an island of this place in the order has had any
    int flight_impacts = 0;
    ImpactWork impact_work{};    ///< left in this sub-step
    std::int64_t looks_left = 0; ///< at who may be met next, likewise
    bool capped = false;
    bool disturbed =
        false; ///< since velocities were integrated: flight has struck what constraints move, or constraints came or went

    void clear();
    IslandOutput();
    ~IslandOutput();
    IslandOutput(IslandOutput&&) noexcept;
    IslandOutput& operator=(IslandOutput&&) noexcept;
    IslandOutput(const IslandOutput&) = delete;
    IslandOutput& operator=(const IslandOutput&) = delete;
};

/// Shapes whose fat box changed, and what it is now.
struct MovedBoxes
{
    std::vector<std::int32_t> items;
    std::vector<FloatBox> boxes;
    std::vector<std::int32_t> unsound; ///< bodies that would leave all numbers
};

/// What rests around eight neighbours and their ways, see safety_sweep.cpp.
enum class Surroundings : std::uint8_t
{
    Unknown,
    Clear,
    Taken
};

struct Scratch
{
    std::vector<float> motion;         ///< how far any point of an awake body may move in this step, by place in awake_bodies
    std::vector<std::int32_t> unsound; ///< bodies whose state is no longer finite
    MovedBoxes moved;
    std::vector<MovedBoxes> moved_of_task;
    bool all_fitted = false; ///< the moving layer, in this step
    std::vector<std::uint64_t> new_pairs;
    std::vector<std::vector<std::uint64_t>> pairs_of_task;
    std::vector<std::vector<PairUpdate>> pair_updates_of_task;
    std::vector<ContactImpulses> impulses_before; ///< see uneven_steps.h
    std::vector<std::array<float, joint_slots>> joint_impulses_before;
    std::vector<std::int32_t> made_contacts; ///< see ContactBatch
    std::vector<std::int32_t> destroyed_contacts;
    std::vector<std::int32_t> pairs_of_triggers; ///< that get a contact
    std::vector<std::int32_t> places;            ///< by body slot, as in Link
    std::vector<std::int32_t> placed;            ///< bodies that have one
    std::vector<float> swings;                   ///< of joint_edges, see IslandTally::swing
    UnionFind sets;                              ///< of what hangs together, by place in awake_bodies; then of islands that meet
    std::vector<UnionFind> more_sets;            ///< of parts of the links
    std::vector<std::int32_t> island_of;         ///< by place in awake_bodies
    std::vector<std::int32_t> state_of;          ///< by place in awake_bodies; dynamic bodies only
    std::vector<ContactChange> changes;
    std::vector<std::int32_t> left_loads; ///< in order
    std::vector<std::int32_t> of_others;  ///< contacts, of all tasks
    std::vector<ContactChanges> changes_of_task;
    std::vector<std::int32_t> flight;        ///< by place in awake_bodies: earthbound, none (free), or the hinge it turns on
    std::vector<std::int32_t> flying;        ///< places where that is not earthbound
    std::vector<std::int32_t> grounded;      ///< the same of what could fly but bears or is borne by something
    std::vector<std::uint8_t> is_loaded;     ///< by a contact, by place in awake_bodies; the last is nobody's
    std::vector<std::uint8_t> may_meet;      ///< of what flies far: something that it touches or comes near
    bool has_kinematic = false;              ///< a kinematic body is awake
    bool has_hung = false;                   ///< of what may fly, something hangs on a hinge
    std::vector<std::uint8_t> may_be_struck; ///< by what flies, by place in awake_bodies
    std::vector<EdgesOfTask> edges_of_task;
    std::vector<ContactEdge> links;
    std::vector<std::uint8_t> is_deflected; ///< what flies may be, by place in awake_bodies
    std::vector<TreeLeaf> reaches;          ///< of these
    std::vector<SomeReaches> reaches_of_task;
    std::vector<std::uint8_t> is_isolated; ///< of what flies, by place in awake_bodies: nothing is near
    BoxTree reach_tree;
    std::vector<std::uint8_t> keeps_its_way; ///< what is not deflected, in the blocks of the moving layer
    std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> meetings_of_task; ///< islands that meet
    std::vector<IslandTally> tallies;
    std::vector<std::int32_t> island_starts;
    std::vector<std::vector<IslandRun>> runs_of_task;
    std::vector<std::vector<CellOfIsland>> cells_of_task;
    std::vector<std::int32_t> island_of_edge; ///< none: it gets no constraint
    std::vector<std::uint8_t> bounced;        ///< of an island's begins, see commit.cpp
    std::vector<std::int32_t> in_plane;       ///< places in awake_bodies, in the order of the plane
    std::size_t fullest_cell = 0; ///< bodies in the plane cell that has most, of what moves in this step; 0 where nobody asked
    std::vector<ContactEdge> solved_edges; ///< those that get constraints, by island
    std::vector<std::vector<JointEdge>> joints_of_task;
    std::vector<JointEdge> joint_edges;
    CachedGraph cached_graph;
    std::vector<std::uint8_t> borne;            ///< by state: a contact bears it
    std::vector<std::uint8_t> is_looked_at;     ///< by contact slot, in this step; empty: none
    bool has_uneven = false;                    ///< a body that moves more easily along one axis is awake
    std::vector<JointEdge> solved_joints;       ///< by island
    std::vector<std::int32_t> solved_bodies;    ///< places in awake_bodies, by island
    std::vector<std::int32_t> lane_edges;       ///< link in each lane; none: empty
    std::vector<std::int32_t> constraint_edges; ///< link of each constraint
    std::vector<Island> islands;
    std::vector<BodyState> states; ///< [0] stands for every static body
    std::vector<StateConstants> constants;
    std::vector<std::int32_t> state_bodies; ///< body slot of each state
    std::vector<LawWork> laws;              ///< by island
    std::vector<ContactConstraint> constraints;
    std::vector<std::int32_t> impact_constraints;
    BlankArray<WideContact> wide_contacts;
    BlankArray<WideContactNotes> wide_notes; ///< of each
    std::vector<std::uint8_t> struck;        ///< lanes of each of these, as the kernels find them
    std::vector<std::int32_t> bin_starts;    ///< groups of wide contact constraints, from the island's first on
    std::vector<std::int32_t> joint_bin_starts;
    std::vector<WideJoint> wide_joints;
    std::vector<WideCore> cores;
    std::vector<BodySpeeds> speeds; ///< by state: when the sub-step began
    std::vector<BodySpeeds>
        unpushed; ///< by state, of islands that may warm start by body: without what constraints gave in the sub-step
    std::vector<JointWork> joints;
    std::vector<Flier> fliers;
    std::vector<double> event_times; ///< of each flier, side by side: the search for the earliest looks at nothing else
    std::vector<std::int32_t> flier_of_state;
    std::vector<std::int32_t> versions; ///< of states: counts changes of their paths within a sub-step
    std::vector<IslandOutput> outputs;
    std::size_t impacts_lender = 0; ///< whose array of impacts the events have
    std::vector<PathPiece> paths;   ///< of all islands, by body
    std::vector<Crossing> crossings;
    std::vector<SlotsOfTask> slots_of_task;
    std::vector<std::vector<KinematicMeeting>> meetings_with_kinematic_of_task;
    std::vector<KinematicMeeting> meetings_with_kinematic; ///< by island, then by link
    std::vector<std::uint64_t> joint_colors;               ///< by state: a bit for each that its hinges in lanes have
    std::vector<std::uint8_t> bound_by_joint;              ///< by state
    std::vector<std::uint16_t> parts;                      ///< of the states of islands that have some
    std::vector<JointPlace> joint_places;
    std::vector<JointLane> joint_lanes;
    std::vector<JointLane> sorted_lanes;
    std::vector<FlierSeed> flier_seeds;
    std::vector<Surroundings> surroundings;  ///< of each block of the moving layer
    std::vector<std::uint8_t> is_tired;      ///< has been quiet for long enough, by place in awake_bodies
    std::vector<std::uint8_t> is_kept_awake; ///< of these, by a neighbour
    std::vector<std::int32_t> order;
    std::vector<ContactPlace> contact_order; ///< what tidy() makes of them
    std::vector<ContactPlace> sorted_contacts;
    std::vector<std::int32_t> moved_to;    ///< by contact slot
    std::vector<std::int32_t> move_cycles; ///< see reorder.cpp
    HilbertOrder plane_order;              ///< of the awake bodies

    Scratch();
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
};

/// Those of an island, in flight or landed.
[[nodiscard]] inline std::span<Flier> fliers_of(Scratch& scratch, const Island& island)
{
    return {scratch.fliers.data() + island.first_flier, static_cast<std::size_t>(island.flier_count)};
}

/// Those of an island that are in no lane; what has come since the step began is in IslandOutput::late_constraints.
[[nodiscard]] inline std::span<ContactConstraint> constraints_of(Scratch& scratch, const Island& island)
{
    return {scratch.constraints.data() + island.first_constraint, static_cast<std::size_t>(island.constraint_count)};
}

struct StepContext
{
    SceneData& scene;
    SceneState& state;
    Scratch& scratch;
    StepReport& report;
    float dt; ///< of the step
    float h;  ///< of a sub-step
    int substeps;
    int subdivisions = 1; ///< of each of the scene's sub-steps, in islands whose contacts turn fast
    Softness contact_softness{};
    Softness static_softness{}; ///< against bodies of infinite mass: twice as stiff
    float joint_hertz = 0;
    float rest_speed = 0; ///< approach below it is rest, not an impact: what gravity gives in two sub-steps
};

/// The same step with each sub-step subdivided.
[[nodiscard]] StepContext subdivided(const StepContext& ctx, int subdivisions);

/// How far any point of a body may move in this step, if nothing strikes it; 0 for what rests.
[[nodiscard]] inline float motion_of(const StepContext& ctx, int body)
{
    const int place = ctx.state.bodies[body].awake_index;
    return place == none ? 0 : ctx.scratch.motion[static_cast<std::size_t>(place)];
}

/// Displacement of a body's center of mass over the step, if nothing stops it.
[[nodiscard]] inline Vec2 predicted_shift(const StepContext& ctx, const BodyRecord& record, const BodySim& sim)
{
    if (record.type != BodyType::Dynamic)
        return ctx.dt * sim.velocity;
    const Vec2 a = {sim.gravity_scale * ctx.state.gravity.x + sim.inverse_mass.x * sim.force.x,
                    sim.gravity_scale * ctx.state.gravity.y + sim.inverse_mass.y * sim.force.y};
    return ctx.dt * sim.velocity + ctx.dt * ctx.dt * a;
}

} // namespace carom::internal
