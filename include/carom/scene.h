#pragma once

/// @file
/// The scene: one object that holds bodies, shapes and joints and steps them through time.

#include "carom/body.h"
#include "carom/config.h"
#include "carom/debug_draw.h"
#include "carom/error.h"
#include "carom/event.h"
#include "carom/force_law.h"
#include "carom/function.h"
#include "carom/id.h"
#include "carom/joint.h"
#include "carom/math.h"
#include "carom/query.h"
#include "carom/shape.h"
#include "carom/step_report.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom {

/// How the values of two touching shapes become one.
enum class MixRule : std::uint8_t
{
    Average,
    GeometricMean,
    Minimum,
    Maximum,
    Product,
    OtherDecides, ///< the value of the shape that does not yield (ShapeDef::yields_material); the average of two equals
    Function,     ///< SceneDef::mix_function
};

enum class MixedValue : std::uint8_t
{
    Friction,
    Restitution,
};

/// Your own rule; called while contacts are prepared, from any thread: it must depend on its arguments alone, and must not throw.
/// The two values come with the user data of their shapes. What is negative or no number counts as 0; friction is at most 1e6, restitution 1.
using MixFunction = float (*)(MixedValue what, float a, std::uint64_t user_data_a, float b, std::uint64_t user_data_b);

/// Your own job system. The engine calls run() with a number of tasks; it must have run task(context, 0 ... count - 1),
/// in any order, on any threads, before it returns. Results do not depend on the threads. Tasks of one call may work together: one that
/// starts while another runs may stay until that one ends; none waits for one that has not started.
struct TaskHooks
{
    int worker_count = 1; ///< 1 to 64
    void (*run)(void* user, int count, void (*task)(void* context, int index), void* context) = nullptr;
    void* user = nullptr;
};

/// The instruction set that the engine's kernels use on this machine: "sse2", "avx2" or "avx512" on x86-64 (the environment variable
/// CAROM_ISA may ask for a lesser one before the first step), "neon" on AArch64, "wasm" in WebAssembly with
/// 128-bit lanes, "baseline" elsewhere. The results are the same bits with all.
[[nodiscard]] CAROM_API const char* instruction_set();

/// Parameters of a new scene.
struct SceneDef
{
    Vec2 gravity{0, -9.81f}; ///< m/s²
    /// Size of a typical moving object, m, > 0. Sets every tolerance: a tenth to ten times this size simulates well.
    /// The slop is 0.005 of it, 5 mm at 1: shapes nearer than that touch (and part at twice that), and what flies freely may overlap
    /// by that much. Overlap of what rests does not come from it but from the load on soft contacts (contact_hertz): with boxes of 1 m,
    /// 0.015 mm under one and 1.1 mm under nine. It grows with the load's acceleration, not with length_scale.
    float length_scale = 1;
    int substeps = 4; ///< per step, 1 to 64; a step of more than 1/30 s has as many for each 1/30 s of it
    /// Bodies whose joints, springs or driven surfaces turn or swing too fast for a sub-step get shorter ones for themselves: it is divided into as many parts as
    /// they need, but no more than this, 1 to 64. 1 is fastest; what is not followed is damped or, on joints, loses phase and some energy (docs/accuracy.md).
    int most_subdivisions = 32;
    /// Contacts of small islands are solved so many times in a sub-step, 1 to 16, but no more than 512 times over the number of bodies, and are as many times
    /// as stiff: with 4, islands of up to 128 bodies; up to 170 three times, up to 256 twice. It costs little where bodies rest, since passes end that would
    /// change nothing. Once only: crowds of jointed figures and large structures whose joints are solved one by one.
    int most_passes = 4;
    float fixed_step = 1.0f / 60; ///< what update() steps by, s, 1e-5 to 10
    float max_frame_time = 0.25f; ///< most that update() catches up in one call, s
    MixRule friction_rule = MixRule::GeometricMean;
    MixRule restitution_rule = MixRule::Average;
    MixFunction mix_function = nullptr;
    // At 1/60 s and 4 sub-steps the cap of 0.15 of the sub-step rate (the longest sub-step of the last second counts) makes 36 of 60: a pile of a thousand mixed
    // bodies rests with 5.9 mm of mean overlap, a column of a hundred boxes stands, and a pyramid of a hundred rows comes to rest. Stiffer it swings on, softer
    // it sags by half as much again. Damped by half as much, what a blow presses together is shot apart and heaps that move overlap by up to a tenth more; one
    // at rest overlaps a little less.
    float contact_hertz = 60;        ///< frequency of contacts that are solved in one pass, 1/s, > 0
    float contact_damping_ratio = 9; ///< > 0
    float contact_push_speed = 3;    ///< overlap is removed no faster than this times length_scale, 1/s, >= 0
    bool sleeping = true;
    bool continuous = true;       ///< balls cannot pass through anything; off only to see what it is good for
    bool record_substeps = false; ///< fill StepReport::substep_poses
    TaskHooks tasks{};
};

class Scene;

/// Called by Scene::update before each of its steps.
using BeforeStep = Function<void(Scene&)>;

/// The result of Scene::update.
struct UpdateResult
{
    int steps = 0;   ///< steps taken
    float alpha = 0; ///< 0 to 1, how far the frame is past the last step; give it to Body::interpolated_pose
};

/// A world of its own. No globals: any number of scenes, on any threads, need no lock between them. Const functions of
/// one scene may run together; anything else on it needs the scene to itself.
///
/// Every function refuses bad input (carom::Error) and leaves the scene as it was: numbers that are not finite or
/// out of range, stale ids, a step of 0.
class CAROM_API Scene
{
public:
    explicit Scene(const SceneDef& def = {});
    ~Scene();
    Scene(Scene&&) noexcept; ///< the one that is moved from is empty afterwards
    Scene& operator=(Scene&&) noexcept;

    [[nodiscard]] BodyId create_body(const BodyDef& def);
    ShapeId create_shape(BodyId body, const Geometry& geometry, const ShapeDef& def = {});
    JointId create_joint(const JointDef& def);
    /// Destroys the body, its shapes and its joints.
    void destroy(BodyId body);
    void destroy(ShapeId shape);
    void destroy(JointId joint);

    [[nodiscard]] bool is_valid(BodyId body) const;
    [[nodiscard]] bool is_valid(ShapeId shape) const;
    [[nodiscard]] bool is_valid(JointId joint) const;

    [[nodiscard]] Body body(BodyId body);
    [[nodiscard]] ConstBody body(BodyId body) const;
    [[nodiscard]] Shape shape(ShapeId shape);
    [[nodiscard]] ConstShape shape(ShapeId shape) const;
    [[nodiscard]] Joint joint(JointId joint);
    [[nodiscard]] ConstJoint joint(JointId joint) const;

    /// Everything there is, in slot order, copied: the scene may change while you iterate.
    [[nodiscard]] std::vector<BodyId> bodies() const;
    [[nodiscard]] std::vector<JointId> joints() const;
    /// Pairs with contact points as the last step has solved them, asleep ones included.
    [[nodiscard]] std::vector<ContactInfo> contacts() const;

    /// Callbacks live beside the state: they are not in the hash. Default-constructed ones remove them.
    void set_callbacks(ShapeId shape, ShapeCallbacks callbacks);

    /// Gives a body a force law, in place of the one it had; a default-constructed one removes it. Force laws live beside the
    /// state: they are not in the hash.
    void set_force_law(BodyId body, const ForceLaw& law);

    /// Bodies that never touch each other, whatever their filters say.
    void ignore_pair(BodyId a, BodyId b);
    void restore_pair(BodyId a, BodyId b);

    /// Advances the scene by h seconds, 1e-9 to 10. Not from inside a callback.
    const StepReport& step(float h);
    /// Adds a frame's time to the scene's own accumulator and takes as many fixed steps as fit. Events are those of all its steps, one step after the other, and
    /// none where it takes no step. Forces applied since the last call act for the frame's time, at any frame rate; what of it no step covers yet acts in the next.
    /// `before_step` is called before each step and may change the scene; forces that it applies act in that step.
    UpdateResult update(float frame_time, const BeforeStep& before_step = {});
    [[nodiscard]] const StepReport& report() const;
    [[nodiscard]] std::uint64_t step_count() const;
    [[nodiscard]] double time() const; ///< s since the scene was made

    [[nodiscard]] std::span<const ContactBeginEvent> contact_begins() const;
    [[nodiscard]] std::span<const ContactEndEvent> contact_ends() const;
    [[nodiscard]] std::span<const ImpactEvent> impacts() const;
    [[nodiscard]] std::span<const TriggerEvent> trigger_enters() const;
    [[nodiscard]] std::span<const TriggerEvent> trigger_exits() const;
    /// The shapes inside a trigger now, in slot order.
    [[nodiscard]] std::vector<ShapeId> inside(ShapeId trigger) const;

    /// The nearest surface the ray from origin to origin + translation meets.
    [[nodiscard]] std::optional<RayHit> raycast_closest(Position origin, Vec2 translation, const QueryFilter& filter = {}) const;
    /// Every shape the ray meets, nearest first.
    [[nodiscard]] std::vector<RayHit> raycast_all(Position origin, Vec2 translation, const QueryFilter& filter = {}) const;
    [[nodiscard]] bool raycast_any(Position origin, Vec2 translation, const QueryFilter& filter = {}) const;
    /// The first surface that a shape meets on its way, exact in time with rotation too. Shapes that it leaves or slides along do not stop it; those that it
    /// overlaps at the start do, the deepest first. geometry: all but half-spaces.
    [[nodiscard]] std::optional<CastHit> shapecast_closest(const Geometry& geometry, const CastWay& way,
                                                           const QueryFilter& filter = {}) const;
    /// Every shape that it would meet if none of them stopped it, first to last.
    [[nodiscard]] std::vector<CastHit> shapecast_all(const Geometry& geometry, const CastWay& way,
                                                     const QueryFilter& filter = {}) const;
    [[nodiscard]] bool shapecast_any(const Geometry& geometry, const CastWay& way, const QueryFilter& filter = {}) const;
    [[nodiscard]] std::vector<ShapeId> overlap_point(Position point, const QueryFilter& filter = {}) const;
    /// Shapes that overlap the box (the shapes themselves, not their bounds).
    [[nodiscard]] std::vector<ShapeId> overlap_box(const Box& box, const QueryFilter& filter = {}) const;
    [[nodiscard]] std::vector<ShapeId> overlap_shape(const Geometry& geometry, const Pose& pose,
                                                     const QueryFilter& filter = {}) const;
    /// The nearest point on any shape within max_distance.
    [[nodiscard]] std::optional<PointHit> closest_point(Position point, float max_distance, const QueryFilter& filter = {}) const;

    [[nodiscard]] Vec2 gravity() const;
    void set_gravity(Vec2 gravity); ///< m/s²; wakes everything
    [[nodiscard]] const SceneDef& def() const;
    void set_record_substeps(bool record);

    void debug_draw(DebugDraw& draw, const DebugDrawOptions& options = {}) const;

    /// A hash over all simulation state: equal hashes mean equal futures. User data, callbacks and times are not in it.
    [[nodiscard]] std::uint64_t state_hash() const;

    /// For the engine's own tests.
    [[nodiscard]] internal::SceneData& data() { return *m_data; }

private:
    internal::SceneData* m_data; ///< owned
};

} // namespace carom
