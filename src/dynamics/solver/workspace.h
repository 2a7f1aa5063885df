#pragma once

// Islands, and all that their solvers run over.

#include "carom/event.h"
#include "core/blank_array.h"
#include "dynamics/continuous/body_path_piece.h"
#include "dynamics/continuous/flier.h"
#include "dynamics/continuous/impact/reflect.h"
#include "dynamics/islands/policy.h"
#include "dynamics/solver/body_state.h"
#include "dynamics/solver/contact/coloring.h"
#include "dynamics/solver/contact/contact_constraint.h"
#include "dynamics/solver/contact/wide_contacts.h"
#include "dynamics/solver/joint/joint_rows.h"
#include "dynamics/solver/joint/wide_joints.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace carom::internal {

class DirectSolve;
struct RawTouch;

/// Bodies, constraints and joints that are solved together through all sub-steps: an island, or islands whose paths may meet.
struct Island
{
    std::int32_t first_body = 0;  ///< in solved_bodies
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
    std::int32_t first_joint_edge = 0; ///< in solved_joints
    std::int32_t joint_edge_count = 0;
    std::int32_t first_joint = 0; ///< of those outside of lanes
    std::int32_t joint_count = 0;
    std::int32_t first_flier = 0;
    std::int32_t flier_count = 0;
    std::int32_t first_law = 0;
    std::int32_t law_count = 0;
    std::int32_t first_impact_constraint = 0; ///< constraints that bear nothing yet and may be hit
    std::int32_t impact_constraint_count = 0;
    std::int32_t colors = 0;
    std::int32_t first_bucket =
        0; ///< of its wide contact constraints, part by part, in Scratch::bucket_starts; and where the last ends
    std::int32_t bucket_count = 0; ///< of each part, and of what crosses from one to another: two to a color
    std::int32_t partitions = 0;        ///< of the plane, that all threads solve side by side
    std::int32_t first_joint_lane = 0;
    std::int32_t joint_lane_count = 0;
    std::int32_t first_joint_bucket = 0;
    std::int32_t joint_bucket_count = 0; ///< two to a color
    IslandPolicy policy;
    bool traced = false;     ///< paths of some of its bodies are recorded
    bool all_direct = false; ///< all of its joints are solved at once
    bool drifts = false;     ///< joints alone act within it: all bodies drift along parabolas
};

/// A lane against what does not give way, of a ball or of what joints pull.
struct WideCore
{
    std::int32_t lane;   ///< of the island: group * lane_count + lane
    std::int32_t points; ///< of its contact
    float depth;         ///< to which it may go
};

inline constexpr int buckets_to_a_partition = 2 * color_limit;

/// An impulse on a body of another island, or one asleep: it takes effect at the end of the step.
struct DeferredImpulse
{
    std::int32_t body;
    Vec2 impulse;
    Vec2 arm;
    double time; ///< within the step; the island that gave it sees the body go on from there
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
    std::vector<RestingContacts> resting_sets;  ///< of fliers that something has held
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

struct SolverWorkspace
{
    std::vector<Island> islands;
    std::vector<BodyState> states; ///< [0] stands for every static body
    std::vector<StateConstants> constants;
    std::vector<std::int32_t> state_bodies; ///< body slot of each state
    std::vector<std::int32_t> state_of;     ///< by place in awake_bodies; dynamic bodies only
    std::vector<LawWork> laws;              ///< by island
    std::vector<ContactConstraint> constraints;
    std::vector<std::int32_t> impact_constraints;
    BlankArray<WideContact> wide_contacts;
    BlankArray<WideContactNotes> wide_notes; ///< of each
    std::vector<std::uint8_t> struck;        ///< lanes of each of these, as the kernels find them
    std::vector<std::int32_t> bucket_starts; ///< groups of wide contact constraints, from the island's first on
    std::vector<std::int32_t> joint_bucket_starts;
    std::vector<std::uint16_t> partition_of; ///< of the states of islands that have some
    std::vector<WideJoint> wide_joints;
    std::vector<JointWork> joints;
    std::vector<WideCore> cores;
    std::vector<BodySpeeds> speeds; ///< by state: when the sub-step began
    std::vector<BodySpeeds>
        unpushed; ///< by state, of islands that may warm start by body: without what constraints gave in the sub-step
    std::vector<IslandOutput> outputs;
    std::size_t impacts_lender = 0; ///< whose array of impacts the events have
};

} // namespace carom::internal
