#pragma once

// All simulation state of a scene, in trivially copyable records without pointers: a snapshot is a copy of this struct.
// A body has three records, by access: BodyRecord (identity and lists), BodySim (read and written once per step), and
// BodyState (the 32 bytes that the solver accesses in every pass, made anew each step, in solver/body_state.h).

#include "carom/scene.h"
#include "collision/broad_phase.h"
#include "core/pair_set.h"
#include "core/pool.h"
#include "geometry/leaf.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace carom::internal {

inline constexpr std::int32_t none = -1;

inline constexpr int plane_cells = 256;       ///< greatest number
inline constexpr int bodies_to_a_cell = 2048; ///< if there are more than 32 cells

struct BodyRecord
{
    BodyType type = BodyType::Static;
    MotionLocks locks{};
    bool enabled = true;
    bool can_sleep = true;
    bool mass_overridden = false;
    std::uint8_t plane_cell = 0;     ///< cell of the awake bodies in which reorder() last put it, by its position
    bool has_finite_mass = false;    ///< dynamic, with an inverse mass or inertia that is not 0
    bool has_target = false;         ///< kinematic: SceneState::targets has a pose to be reached in the next step
    bool had_target = false;         ///< it has reached such a pose in the last step
    bool ignores = false;            ///< is or was in a pair of SceneState::ignored
    std::int32_t awake_index = none; ///< index in SceneState::awake_bodies; none: static, asleep or disabled
    std::int32_t first_shape = none;
    std::int32_t last_shape = none;
    std::int32_t first_joint = none; ///< edge: joint * 2 + side
    std::int32_t joint_count = 0;
    std::int32_t first_contact = none; ///< edge: contact * 2 + side
    float sleep_speed = 0;             ///< m/s, > 0
};
static_assert(sizeof(BodyRecord) == 40);

/// The first half is one cache line: the part that neighbors read.
struct alignas(64) BodySim
{
    Position center{}; ///< of mass, in the world
    Rotation rotation{};
    Vec2 local_center{}; ///< of mass, in the body's frame
    Vec2 velocity{};
    float angular_velocity = 0;
    float extent = 0;   ///< farthest point of any shape from the center of mass
    float size = 1e30f; ///< least inner radius of its shapes
    float mass = 0;
    float inertia = 0;
    bool caches_manifolds = false; ///< solved in a large island in the last step, or not dynamic
    Position previous_center{};    ///< at the start of the last step
    Rotation previous_rotation{};
    float sleep_time = 0; ///< s below the sleep speed
    Vec2 inverse_mass{};  ///< per axis: 0 where locked
    float inverse_inertia = 0;
    float gravity_scale = 1;
    Vec2 force{};
    float torque = 0;
    float linear_damping = 0;
    float angular_damping = 0;

    [[nodiscard]] Pose pose() const { return {center - rotate(rotation, local_center), rotation}; }
};

static_assert(sizeof(BodySim) == 128);

/// The pose that a kinematic body is to reach at the end of the next step.
struct BodyTarget
{
    Position center{}; ///< of mass
    Rotation rotation{};
    Vec2 velocity{}; ///< mean velocity to it, for reading once it has been reached
    float angular_velocity = 0;
};

/// For Scene::update: impulses for the part of a frame that no step has covered yet, N s; and, while a frame runs, its forces.
struct WaitingForce
{
    Vec2 impulse{};
    float twist = 0;
    Vec2 force{};
    float torque = 0;

    friend constexpr bool operator==(const WaitingForce&, const WaitingForce&) = default;
};

/// Traits that few shapes have.
struct RareTraits
{
    RestitutionCurve restitution_curve{};
    Field field{};
    Vec2 one_way{};
    Kick kick{};
    double kick_ready = 0; ///< scene time from which the kick may fire again
};

/// A public shape, or a piece of a chain. A chain is a record without a leaf that owns pieces. Boxes and contacts read the first cache line
/// only, except for arcs.
struct alignas(64) ShapeRecord
{
    std::int32_t body = none;
    std::int32_t owner = none;      ///< the public shape: itself, or the chain
    std::int32_t next_piece = none; ///< of a chain: its first piece; of a piece: the next
    std::int32_t next_shape = none; ///< next public shape of the body
    bool has_leaf = false;
    bool trigger = false;
    bool yields_material = false;
    Leaf leaf{};
    float density = 0;
    float friction = 0;
    float restitution = 0;
    float rolling_resistance = 0;
    float surface_speed = 0;
    std::int32_t rare_traits = none; ///< index in SceneState::rare_traits; pieces share those of their chain
    Filter filter{};
};

static_assert(offsetof(ShapeRecord, leaf) + offsetof(Leaf, arc_radius) <= 64);
static_assert(sizeof(ShapeRecord) == 128);

struct ManifoldPoint
{
    Vec2 anchor_a{}; ///< from a's center of mass to a's surface, world axes
    Vec2 anchor_b{};
    float separation = 0;
    std::uint32_t feature = 0;
};

struct Manifold
{
    Vec2 normal{}; ///< from a to b, world axes
    float rolling_impulse = 0;
    std::int32_t count = 0;
    ManifoldPoint points[2];
};

namespace contact_flag {
inline constexpr std::uint32_t trigger = 1;      ///< b visits trigger a
inline constexpr std::uint32_t touching = 2;     ///< begun and not ended; for triggers: inside
inline constexpr std::uint32_t passing = 4;      ///< one-way: came through from behind, until it is free
inline constexpr std::uint32_t fresh = 8;        ///< never updated
inline constexpr std::uint32_t round = 16;       ///< one of the shapes is a circle
inline constexpr std::uint32_t loaded = 32;      ///< had an impulse at the end of the last step
inline constexpr std::uint32_t begun = 64;       ///< began to touch during the solve, not yet reported
inline constexpr std::uint32_t one_way = 128;    ///< one of the shapes is one-way
inline constexpr std::uint32_t plain = 512;      ///< no points means apart; pieces of chains and arcs may also face elsewhere
inline constexpr std::uint32_t cached = 256;     ///< its manifold is cached in SceneState::cached_manifolds, fixed to the bodies
inline constexpr std::uint32_t edge_of_b = 2048; ///< the cached manifold is relative to b
inline constexpr std::uint32_t nearest = 4096;   ///< cached are the two nearest corners, not an edge
inline constexpr std::uint32_t sleeper = 8192;   ///< one or both of the bodies sleep
inline constexpr std::uint32_t piece = 16384;    ///< of a chain or the like: other contacts may touch for the same public shapes
/// Flush neighbors have turned or emptied its manifold: no points does not mean apart.
inline constexpr std::uint32_t of_union = 32768;
inline constexpr std::uint32_t bounces = 65536; ///< bodies part from it with much of their energy, see may_bounce
inline constexpr std::uint32_t all_cached = cached | edge_of_b | nearest;
/// Its constraint alone is current: normal, anchors and separations here are older than the step, see settled_manifold.
inline constexpr std::uint32_t followed = 1024;
} // namespace contact_flag

/// Impulses of a manifold's point, for warm starting and for queries.
struct PointImpulses
{
    float normal = 0; ///< of the last sub-step
    float tangent = 0;
    float total_normal = 0; ///< over the last step
    float total_tangent = 0;
};

struct ContactImpulses
{
    PointImpulses points[2];
};

/// Two cache lines: identity, and manifold.
struct alignas(64) Contact
{
    std::int32_t shape_a = none;
    std::int32_t shape_b = none;
    std::int32_t body_a = none;
    std::int32_t body_b = none;
    std::int32_t next[2] = {none, none}; ///< edges in the bodies' lists
    std::int32_t previous[2] = {none, none};
    std::int32_t awake_index = none; ///< index in awake_contacts or trigger_contacts
    std::int32_t pair = none;        ///< index in box_pairs; none: both sleep
    std::uint32_t flags = 0;
    float friction = 0;
    float rolling_resistance = 0;
    float surface_speed = 0;   ///< of b against a along perp(normal)
    std::int32_t color = none; ///< color of its constraint, kept as long as it has one, see coloring.h
    std::int32_t wide = none;  ///< during a step: its wide contact constraint, block * lane_count + lane
    Manifold manifold{};
};
static_assert(sizeof(Contact) == 128);

/// Whether the shapes touch; for a trigger, whether the visitor is inside.
[[nodiscard]] inline bool touches(const Contact& contact) { return (contact.flags & contact_flag::touching) != 0; }

/// An edge of one body, and the two corners of the other that it faces, relative to their centers of mass and in their axes.
struct CachedEdge
{
    Vec2 edge[2];
    Vec2 corners[2];
    Vec2 normal{}; ///< from a to b, in the axes of the edge's body
};

/// The corners of a and b that are nearest to each other, likewise; see NearestCorners.
struct CachedCorners
{
    static constexpr float least_distance = 1e-6f; ///< nearer corners have no direction between them

    Vec2 corners[2];
    Vec2 cones[2];
    float radii[2] = {};
};

/// For two shapes without a contact point: the direction from one to the other along which they were apart, in the axes of the one; 0: unknown.
struct CachedParting
{
    Vec2 direction{};
    float arm = 0; ///< greatest, of the other's corners about its center of mass
};

/// Last result of the narrow phase for a contact in a crowd, fixed to the two bodies. Features are those of the manifold.
struct alignas(64) CachedManifold
{
    union Found
    {
        CachedEdge edge;
        CachedCorners nearest; ///< with contact_flag::nearest
        CachedParting parting; ///< without a contact point

        Found() : edge{} {}
    } found;
    Vec2 center{};       ///< former center of mass of the other body, relative to a, or to b with contact_flag::edge_of_b
    Rotation rotation{}; ///< of the other body, likewise
    float reach = 0;     ///< see LocalManifold::reach
    float radius = 0;    ///< of the corners that the edge faces
};

/// Whether a wide contact constraint of the last step still represents all of a contact. Valid as long as lanes_stamp is.
enum class LaneMark : std::uint8_t
{
    None,
    InLane
};

/// Two shapes whose fat boxes overlap, one of which is awake. They have a contact while they may meet in the step.
struct BoxPair
{
    std::int32_t a = none;
    std::int32_t b = none;
    std::int32_t contact = none;
};

enum class JointType : std::uint8_t
{
    Spring,
    Distance,
    Revolute,
    Prismatic,
    Weld,
};

/// Held rows and free axes together: two bodies move relative to each other in three ways.
inline constexpr int most_joint_rows = 3;
inline constexpr int most_joint_axes = 2; ///< free axes on which something acts

/// Index of a constraint in JointRecord::impulses: of the held rows, then what acts on the first free axis, and the same on the second.
enum JointSlot
{
    slot_held,
    slot_lower = slot_held + most_joint_rows, ///< limits
    slot_upper,
    slot_motor,
    slot_spring,
    slots_before_second_axis,
    joint_slots = slots_before_second_axis + (most_joint_axes - 1) * (slots_before_second_axis - slot_lower)
};

[[nodiscard]] constexpr int slot_of_axis(int axis, JointSlot slot)
{
    return slot + axis * (slots_before_second_axis - slot_lower);
}

/// Errors of a joint: of its held rows, then for each axis how far it has passed its lower and upper limit, as negative numbers.
inline constexpr int joint_errors = most_joint_rows + 2 * most_joint_axes;

[[nodiscard]] constexpr std::size_t error_of_limit(int axis, JointSlot limit)
{
    return static_cast<std::size_t>(most_joint_rows + 2 * axis + (limit - slot_lower));
}

/// The pose of a body some time ago, or when it became quiet. Valid while its sleep_time is not 0.
struct QuietStart
{
    Position center{};
    Rotation rotation{};
    float time = 0; ///< its sleep_time then
};

struct JointRecord
{
    JointType kind = JointType::Spring;
    bool collide_connected = true;
    bool enable_limit = false;
    bool enable_motor = false;
    bool yields = false;      ///< held open by a wall or by other bodies, see DirectSolve::yield
    bool knows_errors = true; ///< left_errors are valid for the current poses
    bool only_holds = false;  ///< it has held rows and nothing else; derived, like the next one, when the definition is written
    bool has_row =
        true; ///< set at the start of each step: the joint is solved by its rows; otherwise its spring acts by kicks, see springs.h
    bool loses_energy = false;  ///< it dissipates energy in motion: by a brake, or by a spring that is damped within a few swings
    std::int32_t body_a = none; ///< none: the world
    std::int32_t body_b = none;
    float torque = 0; ///< over the last step, for reading; force likewise
    Vec2 force{};
    float impulses[joint_slots] = {}; ///< of the last sub-step, by JointSlot, for warm starting
    float hertz = 0;                  ///< of the soft limits, or of the spring along the free axis
    float limit_restitution = 0;
    Vec2 anchor_a{};
    Vec2 anchor_b{};
    std::int32_t turns = 0; ///< counted by the bodies when the joint was made
    std::int32_t next[2] = {none, none};
    std::int32_t previous[2] = {none, none};
    Vec2 axis_a{1, 0};
    float reference_angle = 0;
    float stiffness = 0; ///< spring
    float damping = 0;
    float lower = 0; ///< limits: angle, translation, or length
    float upper = 0; ///< spring: its length
    float motor_speed = 0;
    float max_motor = 0;
    float damping_ratio = 0;
    float spring_target = 0;
    float left_errors[joint_errors] = {}; ///< errors left by the last step itself; a difference from them comes from elsewhere
};

inline void forget_impulses(JointRecord& joint) { std::fill(std::begin(joint.impulses), std::end(joint.impulses), 0.0f); }
inline void forget_loads(JointRecord& joint)
{
    forget_impulses(joint);
    joint.force = {};
    joint.torque = 0;
}

/// A body that has had many impacts in flight, in the last step or before.
struct RattlingBody
{
    std::int32_t body = none;
    std::int32_t impacts = 0; ///< as a multiple of those that it may have; halved in each step
};

struct SceneState
{
    Pool<BodyRecord> bodies;
    std::vector<BodySim> sims;            ///< by body slot
    std::vector<std::uint64_t> colors;    ///< by body slot: a bit for each color of its contacts, while it is dynamic and awake
    std::vector<std::int32_t> turns;      ///< by body slot: whole turns, see turns.h
    std::vector<QuietStart> quiet_starts; ///< by body slot
    std::vector<RattlingBody> rattling;   ///< by body
    std::vector<BodyTarget> targets;      ///< by body slot, up to the last body that has had one
    std::vector<WaitingForce> waiting_forces; ///< likewise
    Pool<ShapeRecord> shapes;
    Pool<RareTraits> rare_traits;
    LeafStore leaf_store;
    Pool<JointRecord> joints;
    Pool<Contact, Growth::Third> contacts;
    std::vector<ContactImpulses> impulses;        ///< by contact slot
    std::vector<CachedManifold> cached_manifolds; ///< by contact slot
    std::vector<LaneMark> lane_marks;             ///< by contact slot
    std::vector<BoxPair> box_pairs;
    std::vector<std::uint64_t> parted_pairs; ///< keys of those of these pairs whose boxes do not meet, sorted
    PairSet ignored;                         ///< body pairs that never touch
    BroadPhase broad_phase;
    std::vector<std::int32_t> awake_bodies;
    std::vector<std::int32_t> awake_contacts;
    std::vector<std::int32_t> trigger_contacts;
    std::vector<std::int32_t> fresh_shapes; ///< new or moved by the user: they search for pairs whatever their type
    /// Identifies the wide contact constraints in Scratch that hold the impulses of this state; 0: none do.
    std::uint64_t lanes_stamp = 0;
    float substep_of_impulses = 0; ///< s, length of the sub-step to which the impulses of contacts and joints belong
    float longest_substep = 0;     ///< s, longest recent sub-step
    bool graph_dirty = true;       ///< touches, joints, masses, types or sleep have changed since islands were built
    Vec2 gravity{};
    float slop = 0;                 ///< the scene's, see Tolerances
    float greatest_sleep_speed = 0; ///< greatest of any body so far, and at least the scene's
    double time = 0;
    std::uint64_t step_count = 0;
    double accumulator = 0;
};

/// For a contact that has been changed, or will be, by other means than its constraint.
inline void leave_lane(SceneState& state, int contact) { state.lane_marks[static_cast<std::size_t>(contact)] = LaneMark::None; }

[[nodiscard]] inline ContactImpulses& impulses_of(SceneState& state, int contact)
{
    return state.impulses[static_cast<std::size_t>(contact)];
}
[[nodiscard]] inline const ContactImpulses& impulses_of(const SceneState& state, int contact)
{
    return state.impulses[static_cast<std::size_t>(contact)];
}

/// The traits of a shape; neutral ones if it has none.
[[nodiscard]] inline const RareTraits& rare_traits_of(const SceneState& state, const ShapeRecord& shape)
{
    static constexpr RareTraits without{};
    return shape.rare_traits == none ? without : state.rare_traits[shape.rare_traits];
}

} // namespace carom::internal
