// Joints: creation, changes, destruction, and reading back.

#include "carom/scene.h"
#include "core/rounding.h"
#include "core/trigonometry.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/solver/joint/joint_rows.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/turns.h"
#include "scene/access.h"

namespace carom {

using namespace internal;

namespace {

// --- from the public parameters to the record ----------------------------------------------------------------------------------------

bool check_common(const Checker& check, Vec2 anchor_a, Vec2 anchor_b)
{
    return check.finite("anchor_a", anchor_a) && check.finite("anchor_b", anchor_b);
}

bool check_def(const Checker& check, const SpringDef& d)
{
    return check_common(check, d.anchor_a, d.anchor_b) && check.not_negative("SpringDef::stiffness", d.stiffness) &&
           check.not_negative("SpringDef::damping", d.damping) && check.finite("SpringDef::length", d.length);
}

bool check_def(const Checker& check, const DistanceDef& d)
{
    return check_common(check, d.anchor_a, d.anchor_b) && check.finite("DistanceDef::min_length", d.min_length) &&
           check.finite("DistanceDef::max_length", d.max_length) &&
           check.holds(d.min_length < 0 || d.max_length < 0 || d.min_length <= d.max_length, "DistanceDef::max_length",
                       internal::to_text(d.max_length), "must be at least min_length") &&
           check.not_negative("DistanceDef::hertz", d.hertz) && check.not_negative("DistanceDef::damping_ratio", d.damping_ratio);
}

bool check_def(const Checker& check, const RevoluteDef& d)
{
    return check_common(check, d.anchor_a, d.anchor_b) && check.finite("RevoluteDef::reference_angle", d.reference_angle) &&
           check.finite("RevoluteDef::lower_angle", d.lower_angle) && check.finite("RevoluteDef::upper_angle", d.upper_angle) &&
           check.holds(d.lower_angle <= d.upper_angle, "RevoluteDef::upper_angle", internal::to_text(d.upper_angle),
                       "must be at least lower_angle") &&
           check.in_range("RevoluteDef::limit_restitution", d.limit_restitution, 0, 1) &&
           check.finite("RevoluteDef::motor_speed", d.motor_speed) &&
           check.not_negative("RevoluteDef::max_motor_torque", d.max_motor_torque) &&
           check.not_negative("RevoluteDef::spring_hertz", d.spring_hertz) &&
           check.not_negative("RevoluteDef::spring_damping_ratio", d.spring_damping_ratio) &&
           check.finite("RevoluteDef::spring_angle", d.spring_angle);
}

bool check_def(const Checker& check, const PrismaticDef& d)
{
    return check_common(check, d.anchor_a, d.anchor_b) && check.finite("PrismaticDef::axis_a", d.axis_a) &&
           check.holds(length(normalize(d.axis_a)) > 0.5f, "PrismaticDef::axis_a", internal::to_text(d.axis_a),
                       "must not be zero") &&
           check.finite("PrismaticDef::reference_angle", d.reference_angle) &&
           check.finite("PrismaticDef::lower_translation", d.lower_translation) &&
           check.finite("PrismaticDef::upper_translation", d.upper_translation) &&
           check.holds(d.lower_translation <= d.upper_translation, "PrismaticDef::upper_translation",
                       internal::to_text(d.upper_translation), "must be at least lower_translation") &&
           check.in_range("PrismaticDef::limit_restitution", d.limit_restitution, 0, 1) &&
           check.finite("PrismaticDef::motor_speed", d.motor_speed) &&
           check.not_negative("PrismaticDef::max_motor_force", d.max_motor_force) &&
           check.not_negative("PrismaticDef::spring_hertz", d.spring_hertz) &&
           check.not_negative("PrismaticDef::spring_damping_ratio", d.spring_damping_ratio) &&
           check.finite("PrismaticDef::spring_translation", d.spring_translation);
}

bool check_def(const Checker& check, const WeldDef& d)
{
    return check_common(check, d.anchor_a, d.anchor_b) && check.finite("WeldDef::reference_angle", d.reference_angle);
}

void write(JointRecord& r, const SpringDef& d, float measured)
{
    r.kind = JointType::Spring;
    r.stiffness = d.stiffness;
    r.damping = d.damping;
    r.lower = r.upper = d.length < 0 ? measured : d.length;
}

void write(JointRecord& r, const DistanceDef& d, float measured)
{
    r.kind = JointType::Distance;
    r.lower = d.min_length < 0 ? measured : d.min_length;
    r.upper = d.max_length < 0 ? measured : d.max_length;
    r.lower = r.lower < r.upper ? r.lower : r.upper;
    r.hertz = d.hertz;
    r.damping_ratio = d.damping_ratio;
}

void write(JointRecord& r, const RevoluteDef& d, float)
{
    r.kind = JointType::Revolute;
    r.reference_angle = d.reference_angle;
    r.enable_limit = d.enable_limit;
    r.lower = d.lower_angle;
    r.upper = d.upper_angle;
    r.limit_restitution = d.limit_restitution;
    r.enable_motor = d.enable_motor;
    r.motor_speed = d.motor_speed;
    r.max_motor = d.max_motor_torque;
    r.hertz = d.spring_hertz;
    r.damping_ratio = d.spring_damping_ratio;
    r.spring_target = d.spring_angle;
}

void write(JointRecord& r, const PrismaticDef& d, float)
{
    r.kind = JointType::Prismatic;
    r.axis_a = normalize(d.axis_a);
    r.reference_angle = d.reference_angle;
    r.enable_limit = d.enable_limit;
    r.lower = d.lower_translation;
    r.upper = d.upper_translation;
    r.limit_restitution = d.limit_restitution;
    r.enable_motor = d.enable_motor;
    r.motor_speed = d.motor_speed;
    r.max_motor = d.max_motor_force;
    r.hertz = d.spring_hertz;
    r.damping_ratio = d.spring_damping_ratio;
    r.spring_target = d.spring_translation;
}

void write(JointRecord& r, const WeldDef& d, float)
{
    r.kind = JointType::Weld;
    r.reference_angle = d.reference_angle;
}

// --- from the record to the public parameters ----------------------------------------------------------------------------------------

template <class Def>
void read_common(const SceneData& data, const JointRecord& r, std::uint64_t user_data, Def& d)
{
    d.body_a = body_id(data.state, r.body_a);
    d.body_b = body_id(data.state, r.body_b);
    d.anchor_a = r.anchor_a;
    d.anchor_b = r.anchor_b;
    d.collide_connected = r.collide_connected;
    d.user_data = user_data;
}

SpringDef read_spring(const JointRecord& r)
{
    SpringDef d;
    d.stiffness = r.stiffness;
    d.damping = r.damping;
    d.length = r.upper;
    return d;
}

DistanceDef read_distance(const JointRecord& r)
{
    DistanceDef d;
    d.min_length = r.lower;
    d.max_length = r.upper;
    d.hertz = r.hertz;
    d.damping_ratio = r.damping_ratio;
    return d;
}

RevoluteDef read_revolute(const JointRecord& r)
{
    RevoluteDef d;
    d.reference_angle = r.reference_angle;
    d.enable_limit = r.enable_limit;
    d.lower_angle = r.lower;
    d.upper_angle = r.upper;
    d.limit_restitution = r.limit_restitution;
    d.enable_motor = r.enable_motor;
    d.motor_speed = r.motor_speed;
    d.max_motor_torque = r.max_motor;
    d.spring_hertz = r.hertz;
    d.spring_damping_ratio = r.damping_ratio;
    d.spring_angle = r.spring_target;
    return d;
}

PrismaticDef read_prismatic(const JointRecord& r)
{
    PrismaticDef d;
    d.axis_a = r.axis_a;
    d.reference_angle = r.reference_angle;
    d.enable_limit = r.enable_limit;
    d.lower_translation = r.lower;
    d.upper_translation = r.upper;
    d.limit_restitution = r.limit_restitution;
    d.enable_motor = r.enable_motor;
    d.motor_speed = r.motor_speed;
    d.max_motor_force = r.max_motor;
    d.spring_hertz = r.hertz;
    d.spring_damping_ratio = r.damping_ratio;
    d.spring_translation = r.spring_target;
    return d;
}

WeldDef read_weld(const JointRecord& r)
{
    WeldDef d;
    d.reference_angle = r.reference_angle;
    return d;
}

JointDef read_joint(const SceneData& data, const JointRecord& r, std::uint64_t user_data)
{
    const auto with_common = [&](auto d) -> JointDef
    {
        read_common(data, r, user_data, d);
        return d;
    };
    switch (r.kind)
    {
    case JointType::Spring: return with_common(read_spring(r));
    case JointType::Distance: return with_common(read_distance(r));
    case JointType::Revolute: return with_common(read_revolute(r));
    case JointType::Prismatic: return with_common(read_prismatic(r));
    case JointType::Weld: break;
    }
    return with_common(read_weld(r));
}

// --- lists ---------------------------------------------------------------------------------------------------------------------------

void add_joint_edge(SceneState& state, int index)
{
    JointRecord& joint = state.joints[index];
    for (int side = 0; side < 2; ++side)
    {
        const int body = side == 0 ? joint.body_a : joint.body_b;
        if (body == none)
            continue;
        std::int32_t& first = state.bodies[body].first_joint;
        ++state.bodies[body].joint_count;
        joint.next[side] = first;
        joint.previous[side] = none;
        if (first != none)
            state.joints[first >> 1].previous[first & 1] = index * 2 + side;
        first = index * 2 + side;
    }
}

void unlink_joint(SceneState& state, int index)
{
    const JointRecord joint = state.joints[index];
    for (int side = 0; side < 2; ++side)
    {
        const int body = side == 0 ? joint.body_a : joint.body_b;
        if (body == none)
            continue;
        const int next = joint.next[side];
        const int previous = joint.previous[side];
        --state.bodies[body].joint_count;
        if (next != none)
            state.joints[next >> 1].previous[next & 1] = previous;
        if (previous != none)
            state.joints[previous >> 1].next[previous & 1] = next;
        else
            state.bodies[body].first_joint = next;
    }
}

Position anchor_in_world(const SceneState& state, int body, Vec2 anchor)
{
    return body == none ? Position(anchor) : transform(state.sims[static_cast<std::size_t>(body)].pose(), anchor);
}

void wake_joined(SceneData& data, const JointRecord& joint)
{
    wake_body(data, joint.body_a);
    wake_body(data, joint.body_b);
}

void drop_contacts_between(SceneData& data, int a, int b)
{
    if (a == none || b == none)
        return;
    for_each_contact(data.state, a,
                     [&](int contact)
                     {
                         const bool trigger = (data.state.contacts[contact].flags & contact_flag::trigger) != 0;
                         if (!trigger && other_body(data.state.contacts[contact], a) == b)
                             destroy_contact(data, contact, data.pending, 0);
                     });
}

} // namespace

namespace internal {

void destroy_joint(SceneData& data, int index)
{
    SceneState& state = data.state;
    const JointRecord joint = state.joints[index];
    unlink_joint(state, index);
    state.joints.destroy(index);
    state.graph_dirty = true;
    wake_joined(data, joint);
    // The two bodies may touch from now on.
    if (!joint.collide_connected && joint.body_a != none && joint.body_b != none)
        for_each_leaf(state, joint.body_b, [&](int shape) { look_again(state, shape); });
}

} // namespace internal

JointId Scene::create_joint(const JointDef& def)
{
    const internal::RoundToNearest rounding;
    const Checker check{"Scene::create_joint"};
    SceneState& state = m_data->state;
    JointRecord record;
    std::uint64_t user_data = 0;
    const bool sound = std::visit(
        [&](const auto& d)
        {
            const bool live = (d.body_a.is_null() || check_live(*m_data, check.function, "body_a", d.body_a)) &&
                              (d.body_b.is_null() || check_live(*m_data, check.function, "body_b", d.body_b));
            if (!live || !check.holds(d.body_a != d.body_b, "body_b", internal::to_text(d.body_b), "must differ from body_a") ||
                !check_def(check, d))
                return false;
            record.body_a = slot_of(d.body_a);
            record.body_b = slot_of(d.body_b);
            record.anchor_a = d.anchor_a;
            record.anchor_b = d.anchor_b;
            record.collide_connected = d.collide_connected;
            user_data = d.user_data;
            const Vec2 gap =
                anchor_in_world(state, record.body_b, d.anchor_b) - anchor_in_world(state, record.body_a, d.anchor_a);
            write(record, d, length(gap));
            derive_traits(record);
            return true;
        },
        def);
    if (!sound)
        return {};
    begin_counting(state, record);
    const int slot = state.joints.create(record);
    add_joint_edge(state, slot);
    grow(m_data->joint_user_data, static_cast<std::size_t>(state.joints.capacity()));
    m_data->joint_user_data[static_cast<std::size_t>(slot)] = user_data;
    state.graph_dirty = true;
    if (!record.collide_connected)
        drop_contacts_between(*m_data, record.body_a, record.body_b);
    wake_joined(*m_data, record);
    return joint_id(state, slot);
}

void Scene::destroy(JointId id)
{
    if (check_live(*m_data, "Scene::destroy", "joint", id))
        destroy_joint(*m_data, slot_of(id));
}

Joint Scene::joint(JointId id)
{
    const bool live = check_live(*m_data, "Scene::joint", "joint", id);
    return Joint(m_data, live ? id : JointId{});
}

ConstJoint Scene::joint(JointId id) const
{
    const bool live = check_live(*m_data, "Scene::joint", "joint", id);
    return ConstJoint(m_data, live ? id : JointId{});
}

// ------------------------------------------------------------------------------------------------------------------------------------

namespace {

const JointRecord& record_of(const SceneData* data, JointId id, const char* function)
{
    static const JointRecord nothing{};
    return check_live(*data, function, "joint", id) ? data->state.joints[slot_of(id)] : nothing;
}

struct AnchorMotion
{
    Position point;
    Vec2 velocity{};
    float angular_velocity = 0;
    Rotation rotation{};
};

AnchorMotion motion_at(const SceneState& state, int body, Vec2 anchor)
{
    if (body == none)
        return {Position(anchor), {}, 0, {}};
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    const Position p = transform(sim.pose(), anchor);
    return {p, sim.velocity + cross(sim.angular_velocity, p - sim.center), sim.angular_velocity, sim.rotation};
}

} // namespace

JointDef ConstJoint::def() const
{
    const JointRecord& r = record_of(m_data, m_id, "Joint::def");
    return read_joint(*m_data, r, user_data());
}

BodyId ConstJoint::body_a() const { return body_id(m_data->state, record_of(m_data, m_id, "Joint::body_a").body_a); }
BodyId ConstJoint::body_b() const { return body_id(m_data->state, record_of(m_data, m_id, "Joint::body_b").body_b); }

Position ConstJoint::anchor_a() const
{
    const JointRecord& r = record_of(m_data, m_id, "Joint::anchor_a");
    return anchor_in_world(m_data->state, r.body_a, r.anchor_a);
}

Position ConstJoint::anchor_b() const
{
    const JointRecord& r = record_of(m_data, m_id, "Joint::anchor_b");
    return anchor_in_world(m_data->state, r.body_b, r.anchor_b);
}

float ConstJoint::coordinate() const
{
    const JointRecord& r = record_of(m_data, m_id, "Joint::coordinate");
    const AnchorMotion a = motion_at(m_data->state, r.body_a, r.anchor_a);
    const AnchorMotion b = motion_at(m_data->state, r.body_b, r.anchor_b);
    switch (r.kind)
    {
    case JointType::Spring:
    case JointType::Distance: return length(b.point - a.point);
    case JointType::Revolute: return hinge_angle(m_data->state, r);
    case JointType::Prismatic: return dot(rotate(a.rotation, r.axis_a), b.point - a.point);
    case JointType::Weld: break;
    }
    return 0;
}

float ConstJoint::speed() const
{
    const JointRecord& r = record_of(m_data, m_id, "Joint::speed");
    const AnchorMotion a = motion_at(m_data->state, r.body_a, r.anchor_a);
    const AnchorMotion b = motion_at(m_data->state, r.body_b, r.anchor_b);
    if (r.kind == JointType::Weld)
        return 0;
    if (r.kind == JointType::Revolute)
        return b.angular_velocity - a.angular_velocity;
    const Vec2 gap = b.point - a.point;
    const Vec2 axis = r.kind == JointType::Prismatic ? rotate(a.rotation, r.axis_a) : normalize(gap);
    // The slider's axis turns with body a.
    const Vec2 carried = r.kind == JointType::Prismatic ? cross(a.angular_velocity, gap) : Vec2{};
    return dot(axis, b.velocity - a.velocity - carried);
}

Vec2 ConstJoint::force() const { return record_of(m_data, m_id, "Joint::force").force; }
float ConstJoint::torque() const { return record_of(m_data, m_id, "Joint::torque").torque; }

std::uint64_t ConstJoint::user_data() const
{
    return check_live(*m_data, "Joint::user_data", "joint", m_id)
               ? m_data->joint_user_data[static_cast<std::size_t>(slot_of(m_id))]
               : 0;
}

void Joint::set_def(const JointDef& def)
{
    const internal::RoundToNearest rounding;
    const Checker check{"Joint::set_def"};
    if (!check_live(*m_data, check.function, "joint", m_id))
        return;
    JointRecord& record = m_data->state.joints[slot_of(m_id)];
    const JointDef old = read_joint(*m_data, record, 0);
    std::visit(
        [&](const auto& d)
        {
            const bool same = old.index() == def.index() && d.body_a == body_id(m_data->state, record.body_a) &&
                              d.body_b == body_id(m_data->state, record.body_b);
            if (!check.holds(same, "def", "another kind of joint or other bodies", "must be the same kind on the same bodies") ||
                !check_def(check, d))
                return;
            record.anchor_a = d.anchor_a;
            record.anchor_b = d.anchor_b;
            const bool forbids_now = record.collide_connected && !d.collide_connected;
            record.collide_connected = d.collide_connected;
            const Vec2 gap = anchor_in_world(m_data->state, record.body_b, d.anchor_b) -
                             anchor_in_world(m_data->state, record.body_a, d.anchor_a);
            write(record, d, length(gap));
            derive_traits(record);
            m_data->joint_user_data[static_cast<std::size_t>(slot_of(m_id))] = d.user_data;
            m_data->state.graph_dirty = true;
            if (forbids_now)
                drop_contacts_between(*m_data, record.body_a, record.body_b);
            wake_joined(*m_data, record);
        },
        def);
}

void Joint::set_user_data(std::uint64_t user_data)
{
    if (check_live(*m_data, "Joint::set_user_data", "joint", m_id))
        m_data->joint_user_data[static_cast<std::size_t>(slot_of(m_id))] = user_data;
}

} // namespace carom
