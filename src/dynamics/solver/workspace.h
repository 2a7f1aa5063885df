#pragma once

// Islands, and all data that their solvers work on.

#include "carom/event.h"
#include "core/blank_array.h"
#include "dynamics/continuous/deflected.h"
#include "dynamics/continuous/flier.h"
#include "dynamics/continuous/impact/reflect.h"
#include "dynamics/continuous/path/body_path_piece.h"
#include "dynamics/islands/policy.h"
#include "dynamics/solver/body_state.h"
#include "dynamics/solver/contact/contact_constraint.h"
#include "dynamics/solver/contact/wide_contacts.h"
#include "dynamics/solver/joint/joint_rows.h"
#include "dynamics/solver/joint/wide_joints.h"
#include "dynamics/state/coloring.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace carom::internal {

class DirectSolve;
struct ContactBounce;
struct RawTouch;

/// Bodies, constraints and joints that are solved together through all sub-steps: an island, or several islands whose paths may meet.
struct Island
{
    std::int32_t first_body = 0;  ///< in solved_bodies
    std::int32_t first_state = 0; ///< states [first, first + count): all fixed bodies, dynamic ones, copies of kinematic ones
    std::int32_t state_count = 0;
    std::int32_t dynamic_count = 0; ///< after the first state
    std::int32_t first_edge = 0;
    std::int32_t edge_count = 0;
    std::int32_t first_constraint = 0; ///< contact constraints, sorted by color
    std::int32_t constraint_count = 0;
    /// Blocks of wide contact constraints, sorted by color, in large islands; `constraints` then hold what fits no lane.
    std::int32_t first_wide = 0;
    /// First block in wide_contacts: the small islands of a task use the same memory, one after the other.
    std::int32_t wide_store = 0;
    std::int32_t wide_count = 0;
    std::int32_t first_wide_joint = 0;
    std::int32_t wide_joint_count = 0;
    std::int32_t first_core = 0; ///< cores of its wide contact constraints
    std::int32_t core_count = 0;
    std::int32_t first_joint_edge = 0; ///< in solved_joints
    std::int32_t joint_edge_count = 0;
    std::int32_t first_joint = 0; ///< joints outside of lanes
    std::int32_t joint_count = 0;
    std::int32_t first_flier = 0;
    std::int32_t flier_count = 0;
    std::int32_t first_law = 0;
    std::int32_t law_count = 0;
    std::int32_t colors = 0;
    /// Buckets of its wide contact constraints, partition by partition, in bucket_starts; one more start marks the end.
    std::int32_t first_bucket = 0;
    std::int32_t bucket_count =
        0; ///< in each partition, and of boundary constraints: two to a color, twice where some contact has features
    std::int32_t partitions = 0; ///< of the plane; threads solve them side by side
    std::int32_t first_joint_lane = 0;
    std::int32_t joint_lane_count = 0;
    std::int32_t first_joint_bucket = 0;
    std::int32_t joint_bucket_count = 0; ///< two to a color
    IslandPolicy policy;
    bool traced = false;     ///< paths of some of its bodies are recorded
    bool all_direct = false; ///< all of its joints are solved at once by the direct solver
    bool drifts = false;     ///< only joints act within it: all bodies drift along parabolas
};

/// A lane of a contact between an immovable body and a ball, or a body that joints pull.
struct WideCore
{
    std::int32_t lane;   ///< index in the island: block * lane_count + lane
    std::int32_t points; ///< number of points of its contact
    float depth;         ///< the greatest depth allowed
};

inline constexpr int plain_buckets = 2 * color_limit;            ///< at most, in a partition
inline constexpr int buckets_to_a_partition = 2 * plain_buckets; ///< those of contacts with features come behind

/// An impulse on a body of another island, or on a sleeping one: it takes effect at the end of the step.
struct DeferredImpulse
{
    std::int32_t body;
    Vec2 impulse;
    Vec2 arm;
    double time; ///< within the step; the island that gave it sees the body move on from there
};

struct RecordedPose
{
    std::int32_t body;
    float time;
    Pose pose;
};

/// Energy of the rate at which a joint closed, lost when an impact stopped it.
struct StoppedJoint
{
    std::int32_t state;
    double energy;
};

/// A constraint outside of lanes that was struck in this sub-step, and how it is to bounce.
struct StruckConstraint
{
    ContactConstraint* constraint = nullptr;
    float restitution = 0;
    float kick_speed = 0;
    Vec2 pushed[2]{}; ///< impulses before the bounce, by point
};

/// A lane with a point that bears no load any more, in the lists of its bodies.
struct RelievedLane
{
    std::int32_t lane; ///< of the island
    std::int32_t state[2];
    std::int32_t next[2];
};

/// A copy of the constraint in a lane that a blow has relieved of a load.
struct RelievedContact
{
    ContactConstraint constraint;
    std::int32_t lane;
};

struct StateSpeeds
{
    std::int32_t state;
    BodySpeeds speeds;
};

/// A point as a blow has left it.
struct BeforeSettling
{
    enum class Role : std::uint8_t
    {
        Nothing,
        Bears,
        Relieved
    };
    Role role = Role::Nothing;
    bool may_be_struck = false; ///< its contact is one of a struck body
    float impulse = 0;
    float tangent = 0;
    float speed = 0;
    float slip = 0;
};

struct SettledContact
{
    ContactConstraint* constraint;
    bool is_of_struck; ///< one of its bodies was struck
    BeforeSettling before[2];
};

/// Memory for blows that take back loads, see StandingLoads.
struct SettledBlows
{
    std::vector<std::int32_t> struck; ///< states
    std::vector<RelievedContact> copies;
    std::vector<SettledContact> contacts;
    std::vector<StateSpeeds> speeds; ///< as the blows have left them

    void clear();
};

/// The report of one thread on an island's impacts.
struct ImpactReport
{
    std::vector<ImpactEvent> impacts;
    std::vector<RawTouch> begins; ///< contacts that first bore a load in this step
    std::vector<std::int32_t> kicked_shapes;
    SettledBlows settled;
    int bulk_impacts = 0;

    ImpactReport();
    ~ImpactReport();
    ImpactReport(ImpactReport&&) noexcept;
    ImpactReport& operator=(ImpactReport&&) noexcept;
    ImpactReport(const ImpactReport&) = delete;
    ImpactReport& operator=(const ImpactReport&) = delete;
};

/// The output of one island, so that islands are solved side by side; outputs are merged in the order of the islands.
struct IslandOutput : ImpactReport
{
    std::size_t reported_impacts = 0;       ///< the first so many have been reported to force laws
    std::vector<ImpactEvent> law_impacts{}; ///< impacts that one call of a law reports
    std::vector<ContactConstraint> late_constraints;
    std::vector<ContactConstraint> pulled_constraints; ///< see Walls
    std::vector<DeferredImpulse> deferred;
    std::vector<StoppedJoint> stopped_joints;         ///< in this sub-step
    std::vector<StruckConstraint> struck_constraints; ///< that are still to bounce
    std::vector<ContactBounce> contact_bounces;
    std::vector<BodySpeeds> stopped_speeds;     ///< by state of the island, before contacts bounce
    std::vector<RelievedLane> relieved_lanes;   ///< in this sub-step, if any lane was struck
    std::vector<std::int32_t> struck_lanes;     ///< lanes of the island that were struck in this sub-step
    std::vector<std::int32_t> struck_states;    ///< solver-owned bodies that fliers have struck in this sub-step
    std::vector<ImpactReport> reports_of_parts; ///< one per partition, empty except while threads report
    DeflectedFliers deflected;                  ///< fliers that have left their first path
    std::vector<RestingContacts> resting_sets;  ///< resting contacts of fliers
    std::vector<PathPiece> path;                ///< of traced bodies, each body's pieces in the order of time
    std::vector<std::int32_t> last_piece;       ///< by state of the island; empty before the first piece
    std::vector<RecordedPose> poses;            ///< after each sub-step, when asked for
    std::unique_ptr<DirectSolve> direct;        ///< solver of the joints, where an island of this index has had one
    int flight_impacts = 0;
    ImpactWork impact_work{};    ///< budget left in this sub-step
    std::int64_t looks_left = 0; ///< budget of searches for the next impact, likewise
    bool capped = false;
    /// Since velocities were integrated: a flier has struck a solver-owned body, or constraints came or went.
    bool disturbed = false;

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
    std::vector<std::int32_t> state_of;     ///< by awake index; dynamic bodies only
    std::vector<LawWork> laws;              ///< by island
    std::vector<ContactConstraint> constraints;
    BlankArray<WideContact> wide_contacts;
    BlankArray<WideContactNotes> wide_notes;  ///< one for each block
    BlankArray<WideFeatures> wide_features;   ///< likewise
    std::vector<std::uint8_t> struck;         ///< a byte for each block, see BlowBits
    std::vector<std::uint8_t> relieved;       ///< likewise
    std::vector<std::int32_t> first_relieved; ///< by state, see RelievedLane; between sub-steps: none
    std::vector<std::int32_t> bucket_starts;  ///< block indices, counted from the island's first block
    std::vector<std::int32_t> joint_bucket_starts;
    std::vector<std::uint16_t> partition_of; ///< by state, of islands that have partitions
    std::vector<WideJoint> wide_joints;
    std::vector<JointWork> joints;
    std::vector<WideCore> cores;
    std::vector<BodySpeeds> speeds;             ///< by state: at the start of the sub-step
    std::vector<BodySpeeds> speeds_before_pass; ///< by state, of islands with several passes
    std::vector<BodySpeeds>
        unpushed; ///< by state, of islands that may warm start by body: speeds without the constraints' impulses in the sub-step
    std::vector<IslandOutput> outputs;
};

} // namespace carom::internal
