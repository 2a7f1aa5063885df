#pragma once

/// @file
/// Joints between two bodies, or a body and the world (a null body). Anchors are in each body's frame; the anchor of a
/// null body is a point of the world. A joint between two static bodies waits until Body::set_type lets one of them move.

#include "carom/config.h"
#include "carom/id.h"
#include "carom/math.h"

#include <cstdint>
#include <variant>

namespace carom {

namespace internal {
struct SceneData;
}
class Scene;

/// Force k (x - length) - c v along the line between two points: the differential equation, stable however stiff.
struct SpringDef
{
    BodyId body_a{};
    BodyId body_b{};
    Vec2 anchor_a{};
    Vec2 anchor_b{};
    float stiffness = 0; ///< k, N/m, >= 0
    float damping = 0;   ///< c, N s/m, >= 0
    float length = -1;   ///< m; negative: measured when the joint is made
    bool collide_connected = true;
    std::uint64_t user_data = 0;
};

/// Keeps the distance of two points between min_length and max_length: a rod where they are equal, a rope where
/// min_length is 0. With hertz > 0 the limits give like a spring, of stiffness m (2 pi hertz)²; m is the reduced mass of the
/// two bodies, 1 / (1 / m_a + 1 / m_b).
struct DistanceDef
{
    BodyId body_a{};
    BodyId body_b{};
    Vec2 anchor_a{};
    Vec2 anchor_b{};
    float min_length = -1;   ///< m; negative: measured when the joint is made
    float max_length = -1;   ///< m, >= min_length; negative: measured when the joint is made
    float hertz = 0;         ///< softness of the limits, 1/s; 0: rigid
    float damping_ratio = 1; ///< of the soft limits, >= 0
    bool collide_connected = true;
    std::uint64_t user_data = 0;
};

/// A hinge. The joint's angle is angle_b - angle_a - reference_angle: within -pi and pi when it is made, and from then on turns are counted. Limits may be
/// any number of turns away. A teleport and a target pose turn a body by the shortest way; Joint::set_def shifts the angle by the change of the reference.
///
/// The spring's stiffness is J (2 pi spring_hertz)² in N m/rad, its damping 2 spring_damping_ratio J (2 pi spring_hertz) in
/// N m s/rad. J is the inertia of the two bodies about the hinge: I + m r² of a body that hangs on the world, or
/// 1 / (1 / J_a + 1 / J_b). A bar that hangs on the world so swings at spring_hertz; under a torque it gives by torque / stiffness.
/// Springs, motors and limits are stable at any stiffness and step: beyond 16 / (2 pi h) hertz, h the sub-step, a spring is only as stiff as that
/// (611 Hz at 240 sub-steps/s); where more joints hang together than are solved all at once (128 rows), beyond 0.5 / (2 pi h) (19 Hz).
struct RevoluteDef
{
    BodyId body_a{};
    BodyId body_b{};
    Vec2 anchor_a{};
    Vec2 anchor_b{};
    float reference_angle = 0; ///< radians
    bool enable_limit = false;
    float lower_angle = 0;       ///< radians, <= upper_angle
    float upper_angle = 0;       ///< radians
    float limit_restitution = 0; ///< 0 to 1: how much of the speed comes back from a limit
    bool enable_motor = false;
    float motor_speed = 0;      ///< rad/s
    float max_motor_torque = 0; ///< N m, >= 0
    float spring_hertz = 0;     ///< towards spring_angle, 1/s; 0: no spring
    float spring_damping_ratio = 0;
    float spring_angle = 0; ///< radians
    bool collide_connected = false;
    std::uint64_t user_data = 0;
};

/// A slider along axis_a (in body a's frame). The joint's translation is how far anchor_b is ahead of anchor_a.
///
/// The spring's stiffness is m (2 pi spring_hertz)² in N/m, its damping 2 spring_damping_ratio m (2 pi spring_hertz) in N s/m. m is
/// the reduced mass of the two bodies, 1 / (1 / m_a + 1 / m_b): nearly that of the lighter one. The wheel of a car is much lighter than
/// what it carries; for a suspension that sags by d under a load F take spring_hertz = sqrt(F / (d m)) / (2 pi).
struct PrismaticDef
{
    BodyId body_a{};
    BodyId body_b{};
    Vec2 anchor_a{};
    Vec2 anchor_b{};
    Vec2 axis_a{1, 0};         ///< any length but 0
    float reference_angle = 0; ///< angle_b - angle_a that is held, radians
    bool enable_limit = false;
    float lower_translation = 0; ///< m, <= upper_translation
    float upper_translation = 0; ///< m
    float limit_restitution = 0; ///< 0 to 1
    bool enable_motor = false;
    float motor_speed = 0;     ///< m/s
    float max_motor_force = 0; ///< N, >= 0
    float spring_hertz = 0;    ///< towards spring_translation, 1/s; 0: no spring
    float spring_damping_ratio = 0;
    float spring_translation = 0; ///< m
    bool collide_connected = false;
    std::uint64_t user_data = 0;
};

/// Holds two bodies together as if they were one: neither the anchors nor the angle between the bodies move. Bodies welded to each other keep their own
/// shapes, sensors and contacts; `Joint::force` and `Joint::torque` tell the load of the seam.
struct WeldDef
{
    BodyId body_a{};
    BodyId body_b{};
    Vec2 anchor_a{};
    Vec2 anchor_b{};
    float reference_angle = 0; ///< angle_b - angle_a that is held, radians
    bool collide_connected = false;
    std::uint64_t user_data = 0;
};

using JointDef = std::variant<SpringDef, DistanceDef, RevoluteDef, PrismaticDef, WeldDef>;

/// Reads a joint. A short-lived reference; every call checks the id.
class CAROM_API ConstJoint
{
public:
    [[nodiscard]] JointId id() const { return m_id; }
    [[nodiscard]] JointDef def() const;  ///< with measured lengths filled in and the axis normalised
    [[nodiscard]] BodyId body_a() const; ///< null for the world
    [[nodiscard]] BodyId body_b() const;
    [[nodiscard]] Position anchor_a() const; ///< in the world
    [[nodiscard]] Position anchor_b() const;
    /// Length (spring, distance) in m, angle (revolute, with all turns) in radians, translation (prismatic) in m; 0 for a weld.
    [[nodiscard]] float coordinate() const;
    /// Rate of change of the coordinate, m/s or rad/s.
    [[nodiscard]] float speed() const;
    /// Force on body b at its anchor over the last step, N, without what a motor or limit gives as a torque.
    [[nodiscard]] Vec2 force() const;
    /// Torque on body b over the last step, N m (limits, motors and springs of a hinge; the angle held by a slider or a weld).
    [[nodiscard]] float torque() const;
    [[nodiscard]] std::uint64_t user_data() const;

protected:
    friend class Scene;
    ConstJoint(internal::SceneData* data, JointId id) : m_data(data), m_id(id) {}
    internal::SceneData* m_data;
    JointId m_id;
};

/// Reads and changes a joint.
class CAROM_API Joint : public ConstJoint
{
public:
    /// Replaces the parameters: the same kind of joint on the same bodies. Wakes the bodies. Meant to be cheap: motors,
    /// limits and springs are driven with it.
    void set_def(const JointDef& def);
    void set_user_data(std::uint64_t user_data);

private:
    friend class Scene;
    using ConstJoint::ConstJoint;
};

} // namespace carom
