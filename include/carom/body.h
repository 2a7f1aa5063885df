#pragma once

/// @file
/// Bodies: what a body is made from (BodyDef), and the short-lived references that read and change one.

#include "carom/config.h"
#include "carom/id.h"
#include "carom/math.h"

#include <cstdint>
#include <vector>

namespace carom {

namespace internal {
struct SceneData;
}
class Scene;
struct ContactInfo;

enum class BodyType : std::uint8_t
{
    Static,    ///< never moves, infinite mass
    Kinematic, ///< moves as told, pushes and is never pushed
    Dynamic,   ///< moved by forces, contacts and joints
};

/// Directions in which a dynamic body does not move; its mass there is infinite, and a speed that it is given there is left out. World axes.
struct MotionLocks
{
    bool linear_x = false;
    bool linear_y = false;
    bool angular = false;
    friend constexpr bool operator==(MotionLocks, MotionLocks) = default;
};

/// Mass, centre of mass and inertia of a body.
struct MassData
{
    float mass = 0;    ///< kg, > 0
    Vec2 center{};     ///< centre of mass in the body's frame, m
    float inertia = 0; ///< about the centre of mass, kg m²; 0 means that the body does not turn
};

/// Parameters of a new body.
struct BodyDef
{
    BodyType type = BodyType::Static;
    Position position{};        ///< origin of the body's frame, m
    float angle = 0;            ///< radians
    Vec2 velocity{};            ///< of the centre of mass, m/s
    float angular_velocity = 0; ///< rad/s
    float gravity_scale = 1;    ///< multiplies the scene's gravity
    float linear_damping = 0;   ///< 1/s, >= 0: the velocity decays as exp(-damping t)
    float angular_damping = 0;  ///< 1/s, >= 0
    MotionLocks locks{};
    bool enabled = true; ///< a disabled body stays in the scene and takes no part
    /// A body made asleep stays so while it gets shapes, until something wakes it: what touches it, what is made or moved into it, or a verb.
    bool awake = true;
    bool can_sleep = true;
    /// Slower than this for half a second (the centre of mass, and the farthest point as the body turns) it may fall asleep, m/s, >= 0; 0: 0.05 for each m of
    /// SceneDef::length_scale. It must also stay where it is: what still gets away from there at a twentieth of this, drifting, rolling or slipping, stays awake.
    float sleep_speed = 0;
    std::uint64_t user_data = 0; ///< yours; never read by the engine
};

/// Reads a body. A short-lived reference: valid until the body is destroyed; every call checks that.
class CAROM_API ConstBody
{
public:
    [[nodiscard]] BodyId id() const { return m_id; }
    [[nodiscard]] BodyType type() const;
    [[nodiscard]] Pose pose() const;
    [[nodiscard]] Position position() const;
    [[nodiscard]] Rotation rotation() const;
    [[nodiscard]] float angle() const; ///< radians, -pi to pi
    /// The pose between the last two steps, for drawing: alpha 0 is the earlier one, 1 the present one.
    [[nodiscard]] Pose interpolated_pose(float alpha) const;
    [[nodiscard]] Position center_of_mass() const; ///< in the world
    [[nodiscard]] Vec2 local_center_of_mass() const;
    /// The centre of mass moves at this velocity, m/s. A kinematic body that has followed set_target_pose reads the velocity of the last step, and stands.
    [[nodiscard]] Vec2 velocity() const;
    [[nodiscard]] float angular_velocity() const;               ///< rad/s
    [[nodiscard]] Vec2 velocity_at(Position world_point) const; ///< of the body's material at that point, m/s
    [[nodiscard]] float mass() const;                           ///< kg; 0 for static and kinematic bodies
    [[nodiscard]] float inertia() const;                        ///< about the centre of mass, kg m²
    [[nodiscard]] float kinetic_energy() const;                 ///< J
    [[nodiscard]] float gravity_scale() const;
    [[nodiscard]] float linear_damping() const;
    [[nodiscard]] float angular_damping() const;
    [[nodiscard]] MotionLocks locks() const;
    [[nodiscard]] bool is_enabled() const;
    [[nodiscard]] bool is_awake() const;
    [[nodiscard]] bool can_sleep() const;
    [[nodiscard]] float sleep_speed() const; ///< m/s, > 0: the scene's where none was given
    [[nodiscard]] std::uint64_t user_data() const;
    [[nodiscard]] Position world_point(Vec2 local) const;
    [[nodiscard]] Vec2 local_point(Position world) const;
    /// The shapes, joints and touching contacts of the body, copied: the scene may change while you iterate. Contacts are those that the last step has
    /// solved, with its impulses; where the body has been moved since then, they are of where it was.
    [[nodiscard]] std::vector<ShapeId> shapes() const;
    [[nodiscard]] std::vector<JointId> joints() const;
    [[nodiscard]] std::vector<ContactInfo> contacts() const;
    /// The contacts of the body where all bodies stand now, to the slop (SceneDef::length_scale), after a step, a teleport or anything else: looked for anew at each
    /// call. The body's own shape is shape_a. No triggers, no impulses, and nothing that filters, joints or ignore_pair keep apart.
    [[nodiscard]] std::vector<ContactInfo> touches_now() const;

protected:
    friend class Scene;
    ConstBody(internal::SceneData* data, BodyId id) : m_data(data), m_id(id) {}
    internal::SceneData* m_data;
    BodyId m_id{};
};

/// Reads and changes a body. Verbs that give motion wake the body; non-finite arguments are refused.
class CAROM_API Body : public ConstBody
{
public:
    void set_type(BodyType type);
    /// Puts the body elsewhere without giving it a velocity. Contacts are found anew; the interpolated pose jumps too.
    void teleport(Position position, float angle);
    /// Kinematic bodies only: chooses the velocity that reaches this pose at the end of the next step, the shorter way
    /// round. After that step the body stops unless a new target is set. The surface speed during the step is right.
    void set_target_pose(Position position, float angle);
    void set_velocity(Vec2 velocity); ///< m/s
    void set_angular_velocity(float radians_per_second);
    /// Forces act through the next step, or for the time of the frame that Scene::update is next given, and are then cleared. Dynamic
    /// bodies only, others ignore them. N, N m.
    void apply_force(Vec2 force, Position world_point);
    void apply_force(Vec2 force); ///< at the centre of mass
    void apply_torque(float torque);
    void apply_impulse(Vec2 impulse, Position world_point); ///< N s, changes the velocity at once
    void apply_impulse(Vec2 impulse);                       ///< at the centre of mass
    void apply_angular_impulse(float impulse);              ///< N m s
    void set_gravity_scale(float scale);
    void set_linear_damping(float damping);
    void set_angular_damping(float damping);
    void set_locks(MotionLocks locks);
    /// Overrides what the shapes give; stays until reset_mass. Dynamic bodies only. The mass is from 1e-35 to 1e35 kg, the inertia
    /// 0 (it then never turns) or from 1e-35 to 1e35 kg m². A dynamic body without shapes, or whose shapes have no density, weighs 1 kg.
    void set_mass(const MassData& mass);
    /// Mass, centre and inertia from the shapes and their densities again.
    void reset_mass();
    void set_enabled(bool enabled);
    /// Waking or putting to sleep; sleep takes the bodies it touches along.
    void set_awake(bool awake);
    void set_can_sleep(bool can_sleep);
    void set_sleep_speed(float speed); ///< as BodyDef::sleep_speed; wakes nothing
    void set_user_data(std::uint64_t user_data);

private:
    friend class Scene;
    using ConstBody::ConstBody;
};

} // namespace carom
