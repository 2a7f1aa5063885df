// Bodies: creation, destruction, and the methods of carom::Body.

#include "carom/scene.h"
#include "core/rounding.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/turns.h"
#include "geometry/leaf_traits.h"
#include "scene/access.h"

#include <cmath>

namespace carom {

using namespace internal;

namespace {

bool check_body_def(const BodyDef& def)
{
    const Checker check{"Scene::create_body"};
    return check.one_of("BodyDef::type", def.type, BodyType::Dynamic) && check.finite("BodyDef::position", def.position) &&
           check.finite("BodyDef::angle", def.angle) && check.finite("BodyDef::velocity", def.velocity) &&
           check.finite("BodyDef::angular_velocity", def.angular_velocity) &&
           check.finite("BodyDef::gravity_scale", def.gravity_scale) &&
           check.not_negative("BodyDef::linear_damping", def.linear_damping) &&
           check.not_negative("BodyDef::angular_damping", def.angular_damping) &&
           check.not_negative("BodyDef::sleep_speed", def.sleep_speed);
}

BodySim make_sim(const BodyDef& def)
{
    BodySim sim;
    sim.center = sim.previous_center = def.position;
    sim.rotation = sim.previous_rotation = Rotation::from_angle(def.angle);
    if (def.type != BodyType::Static)
    {
        sim.velocity = def.velocity;
        sim.angular_velocity = def.angular_velocity;
    }
    sim.gravity_scale = def.gravity_scale;
    sim.caches_manifolds = def.type != BodyType::Dynamic;
    sim.linear_damping = def.linear_damping;
    sim.angular_damping = def.angular_damping;
    return sim;
}

// A speed of 0 stands for the scene's.
void give_sleep_speed(SceneData& data, BodyRecord& record, float speed)
{
    record.sleep_speed = speed > 0 ? speed : data.tolerances.sleep_speed;
    data.state.greatest_sleep_speed = std::max(data.state.greatest_sleep_speed, record.sleep_speed);
}

void remove_from_broad_phase(SceneData& data, int body)
{
    for_each_leaf(data.state, body, [&](int shape) { data.state.broad_phase.remove(shape); });
}

} // namespace

BodyId Scene::create_body(const BodyDef& def)
{
    const internal::RoundToNearest rounding;
    if (!check_body_def(def))
        return {};
    SceneState& state = m_data->state;
    BodyRecord record;
    record.type = def.type;
    record.locks = def.locks;
    record.enabled = def.enabled;
    record.can_sleep = def.can_sleep;
    give_sleep_speed(*m_data, record, def.sleep_speed);
    const int slot = state.bodies.create(record);
    const auto index = static_cast<std::size_t>(slot);
    grow(state.sims, index + 1);
    grow(state.colors, index + 1);
    grow(state.turns, index + 1);
    state.turns[index] = 0;
    grow(state.quiet_starts, index + 1);
    state.sims[index] = make_sim(def);
    grow(m_data->body_user_data, index + 1);
    m_data->body_user_data[index] = def.user_data;
    update_mass(state, slot);
    if (def.awake && def.enabled && def.type != BodyType::Static)
        enter_awake(*m_data, slot);
    return body_id(state, slot);
}

void Scene::destroy(BodyId id)
{
    if (!check_live(*m_data, "Scene::destroy", "body", id))
        return;
    SceneState& state = m_data->state;
    const int slot = slot_of(id);
    set_force_law(id, {});
    destroy_contacts_of_body(*m_data, slot);
    while (state.bodies[slot].first_joint != none)
        destroy_joint(*m_data, state.bodies[slot].first_joint >> 1);
    while (state.bodies[slot].first_shape != none)
        destroy_shape(*m_data, state.bodies[slot].first_shape);
    leave_awake(*m_data, slot);
    if (const auto index = static_cast<std::size_t>(slot); index < state.waiting_forces.size())
        state.waiting_forces[index] = {};
    if (state.bodies[slot].ignores)
        state.ignored.erase_if([slot](std::uint64_t key) { return is_in_pair(key, slot); });
    std::erase_if(state.rattling, [slot](const RattlingBody& r) { return r.body == slot; });
    state.bodies.destroy(slot);
    state.graph_dirty = true;
}

void Scene::set_force_law(BodyId id, const ForceLaw& law)
{
    const Checker check{"Scene::set_force_law"};
    if (!check_live(*m_data, "Scene::set_force_law", "body", id) ||
        !check.not_negative("ForceLaw::greatest_force", law.greatest_force) ||
        !check.not_negative("ForceLaw::greatest_torque", law.greatest_torque))
        return;
    const auto index = static_cast<std::size_t>(slot_of(id));
    if (law.function == nullptr && index >= m_data->laws.size())
        return;
    grow(m_data->laws, index + 1);
    ForceLaw& slot = m_data->laws[index];
    m_data->law_count += static_cast<int>(law.function != nullptr) - static_cast<int>(slot.function != nullptr);
    slot = law.function != nullptr ? law : ForceLaw{};
}

Body Scene::body(BodyId id)
{
    const bool live = check_live(*m_data, "Scene::body", "body", id);
    return Body(m_data, live ? id : BodyId{});
}

ConstBody Scene::body(BodyId id) const
{
    const bool live = check_live(*m_data, "Scene::body", "body", id);
    return ConstBody(m_data, live ? id : BodyId{});
}

namespace {

// Handles check their id at every call: the body may have been destroyed meanwhile.
const BodyRecord* record_of(const SceneData* data, BodyId id, const char* function)
{
    return check_live(*data, function, "body", id) ? &data->state.bodies[slot_of(id)] : nullptr;
}

const BodySim& sim_of(const SceneData* data, BodyId id, const char* function)
{
    static const BodySim nothing{};
    return check_live(*data, function, "body", id) ? data->state.sims[static_cast<std::size_t>(slot_of(id))] : nothing;
}

} // namespace

BodyType ConstBody::type() const
{
    const BodyRecord* r = record_of(m_data, m_id, "Body::type");
    return r != nullptr ? r->type : BodyType::Static;
}
Pose ConstBody::pose() const { return sim_of(m_data, m_id, "Body::pose").pose(); }
Position ConstBody::position() const { return sim_of(m_data, m_id, "Body::position").pose().position; }
Rotation ConstBody::rotation() const { return sim_of(m_data, m_id, "Body::rotation").rotation; }
float ConstBody::angle() const { return sim_of(m_data, m_id, "Body::angle").rotation.angle(); }

Pose ConstBody::interpolated_pose(float alpha) const
{
    const BodySim& sim = sim_of(m_data, m_id, "Body::interpolated_pose");
    if (!Checker{"Body::interpolated_pose"}.in_range("alpha", alpha, 0, 1))
        return sim.pose();
    const float turn = (sim.rotation * inverse(sim.previous_rotation)).angle();
    BodySim between = sim;
    between.center = sim.previous_center + alpha * (sim.center - sim.previous_center);
    between.rotation = Rotation::from_angle(alpha * turn) * sim.previous_rotation;
    return between.pose();
}

Position ConstBody::center_of_mass() const { return sim_of(m_data, m_id, "Body::center_of_mass").center; }
Vec2 ConstBody::local_center_of_mass() const { return sim_of(m_data, m_id, "Body::local_center_of_mass").local_center; }
namespace {

// The target that the body has reached in the last step; null if it had none.
const BodyTarget* target_reached(const SceneData* data, BodyId id)
{
    const bool reached = is_live(data->state, id) && data->state.bodies[slot_of(id)].had_target;
    return reached ? &data->state.targets[static_cast<std::size_t>(slot_of(id))] : nullptr;
}

} // namespace

Vec2 ConstBody::velocity() const
{
    const BodySim& sim = sim_of(m_data, m_id, "Body::velocity");
    const BodyTarget* target = target_reached(m_data, m_id);
    return target != nullptr ? target->velocity : sim.velocity;
}

float ConstBody::angular_velocity() const
{
    const BodySim& sim = sim_of(m_data, m_id, "Body::angular_velocity");
    const BodyTarget* target = target_reached(m_data, m_id);
    return target != nullptr ? target->angular_velocity : sim.angular_velocity;
}

Vec2 ConstBody::velocity_at(Position point) const
{
    const BodySim& sim = sim_of(m_data, m_id, "Body::velocity_at");
    if (!Checker{"Body::velocity_at"}.finite("world_point", point))
        return {};
    return velocity() + cross(angular_velocity(), point - sim.center);
}

float ConstBody::mass() const { return sim_of(m_data, m_id, "Body::mass").mass; }
float ConstBody::inertia() const { return sim_of(m_data, m_id, "Body::inertia").inertia; }

float ConstBody::kinetic_energy() const
{
    const BodySim& sim = sim_of(m_data, m_id, "Body::kinetic_energy");
    return 0.5f * sim.mass * dot(sim.velocity, sim.velocity) + 0.5f * sim.inertia * sim.angular_velocity * sim.angular_velocity;
}

float ConstBody::gravity_scale() const { return sim_of(m_data, m_id, "Body::gravity_scale").gravity_scale; }
float ConstBody::linear_damping() const { return sim_of(m_data, m_id, "Body::linear_damping").linear_damping; }
float ConstBody::angular_damping() const { return sim_of(m_data, m_id, "Body::angular_damping").angular_damping; }

MotionLocks ConstBody::locks() const
{
    const BodyRecord* r = record_of(m_data, m_id, "Body::locks");
    return r != nullptr ? r->locks : MotionLocks{};
}
bool ConstBody::is_enabled() const
{
    const BodyRecord* r = record_of(m_data, m_id, "Body::is_enabled");
    return r != nullptr && r->enabled;
}
bool ConstBody::is_awake() const
{
    const BodyRecord* r = record_of(m_data, m_id, "Body::is_awake");
    return r != nullptr && r->awake_index != none;
}
bool ConstBody::can_sleep() const
{
    const BodyRecord* r = record_of(m_data, m_id, "Body::can_sleep");
    return r != nullptr && r->can_sleep;
}

float ConstBody::sleep_speed() const
{
    const BodyRecord* r = record_of(m_data, m_id, "Body::sleep_speed");
    return r == nullptr ? 0 : r->sleep_speed;
}

std::uint64_t ConstBody::user_data() const
{
    return record_of(m_data, m_id, "Body::user_data") != nullptr ? m_data->body_user_data[static_cast<std::size_t>(slot_of(m_id))]
                                                                 : 0;
}

Position ConstBody::world_point(Vec2 local) const
{
    const BodySim& sim = sim_of(m_data, m_id, "Body::world_point");
    return Checker{"Body::world_point"}.finite("local", local) ? transform(sim.pose(), local) : Position{};
}

Vec2 ConstBody::local_point(Position world) const
{
    const BodySim& sim = sim_of(m_data, m_id, "Body::local_point");
    return Checker{"Body::local_point"}.finite("world", world) ? inverse_transform(sim.pose(), world) : Vec2{};
}

std::vector<ShapeId> ConstBody::shapes() const
{
    std::vector<ShapeId> ids;
    if (const BodyRecord* r = record_of(m_data, m_id, "Body::shapes"))
    {
        for (int shape = r->first_shape; shape != none; shape = m_data->state.shapes[shape].next_shape)
            ids.push_back(shape_id(m_data->state, shape));
    }
    return ids;
}

std::vector<JointId> ConstBody::joints() const
{
    std::vector<JointId> ids;
    if (const BodyRecord* r = record_of(m_data, m_id, "Body::joints"))
    {
        for (int edge = r->first_joint; edge != none; edge = m_data->state.joints[edge >> 1].next[edge & 1])
            ids.push_back(joint_id(m_data->state, edge >> 1));
    }
    return ids;
}

// ------------------------------------------------------------------------------------------------------------------------------------
// Methods that change a body

namespace {

// The body that a method changes: its record and sim, if the id is live.
struct Target
{
    RoundToNearest rounding;
    SceneData& data;
    int slot;

    Target(SceneData* d, BodyId id, const char* function)
        : data(*d), slot(check_live(*d, function, "body", id) ? slot_of(id) : none)
    {}
    [[nodiscard]] explicit operator bool() const { return slot != none; }
    [[nodiscard]] BodyRecord& record() const { return data.state.bodies[slot]; }
    [[nodiscard]] BodySim& sim() const { return data.state.sims[static_cast<std::size_t>(slot)]; }

    // Wakes the body for motion given by the user, also a kinematic one.
    void wake() const
    {
        if (record().type == BodyType::Kinematic && record().enabled)
            enter_awake(data, slot);
        wake_body(data, slot);
    }
    // Wakes bodies that touch it or may, and bodies that joints hold to it: static and kinematic bodies wake them only this way.
    void wake_neighbours() const
    {
        for_each_contact(data.state, slot, [&](int contact) { wake_body(data, other_body(data.state.contacts[contact], slot)); });
        for_each_joint(data.state, slot, [&](int joint) { wake_body(data, other_body(data.state.joints[joint], slot)); });
    }
};

} // namespace

void Body::set_type(BodyType type)
{
    const Target t(m_data, m_id, "Body::set_type");
    if (!t || !Checker{"Body::set_type"}.one_of("type", type, BodyType::Dynamic) || t.record().type == type)
        return;
    if (type != BodyType::Static && type != BodyType::Kinematic)
    {
        for (int s = t.record().first_shape; s != none; s = m_data->state.shapes[s].next_shape)
        {
            const ShapeRecord& shape = m_data->state.shapes[s];
            const bool massless = !shape.has_leaf || !traits_of(shape.leaf).may_be_dynamic;
            if (!Checker{"Body::set_type"}.holds(!massless, "type", "Dynamic",
                                                 "the body has an arc, chain or half-space, which carry no mass"))
                return;
        }
    }
    if (type == BodyType::Kinematic)
    {
        for (int s = t.record().first_shape; s != none; s = m_data->state.shapes[s].next_shape)
        {
            if (!Checker{"Body::set_type"}.holds(!m_data->state.shapes[s].has_leaf ||
                                                     traits_of(m_data->state.shapes[s].leaf).is_bounded,
                                                 "type", "Kinematic", "the body has a half-space, which never moves"))
                return;
        }
    }
    destroy_contacts_of_body(*m_data, t.slot);
    leave_awake(*m_data, t.slot);
    m_data->state.graph_dirty = true;
    t.record().type = type;
    t.record().has_target = t.record().had_target = false;
    t.sim().caches_manifolds = type != BodyType::Dynamic;
    if (type == BodyType::Static)
    {
        t.sim().velocity = {};
        t.sim().angular_velocity = 0;
    }
    update_mass(m_data->state, t.slot);
    if (type != BodyType::Static && t.record().enabled)
        enter_awake(*m_data, t.slot);
    t.wake_neighbours();
    refresh_boxes(*m_data, t.slot);
}

void Body::teleport(Position position, float angle)
{
    const Target t(m_data, m_id, "Body::teleport");
    const Checker check{"Body::teleport"};
    if (!t || !check.finite("position", position) || !check.finite("angle", angle))
        return;
    t.wake_neighbours();
    BodySim& sim = t.sim();
    const Rotation rotation = Rotation::from_angle(angle);
    count_turns(m_data->state.turns[static_cast<std::size_t>(t.slot)], sim.rotation, rotation);
    sim.rotation = sim.previous_rotation = rotation;
    sim.center = sim.previous_center = position + rotate(sim.rotation, sim.local_center);
    t.record().has_target = t.record().had_target = false;
    // Contacts whose boxes no longer meet end in the next step; the others are updated anew, without the impulses of the old pose.
    for_each_contact(m_data->state, t.slot,
                     [&](int index)
                     {
                         Contact& contact = m_data->state.contacts[index];
                         contact.flags |= contact_flag::fresh;
                         contact.flags &= ~contact_flag::passing;
                         contact.manifold = {};
                         forget_impulses(m_data->state, index);
                         leave_lane(m_data->state, index);
                     });
    refresh_boxes(*m_data, t.slot);
    t.wake();
    if (t.record().type == BodyType::Static)
        t.wake_neighbours();
}

void Body::set_target_pose(Position position, float angle)
{
    const Target t(m_data, m_id, "Body::set_target_pose");
    const Checker check{"Body::set_target_pose"};
    if (!t || !check.finite("position", position) || !check.finite("angle", angle) ||
        !check.holds(t.record().type == BodyType::Kinematic, "the body", "not kinematic", "only kinematic bodies follow targets"))
        return;
    std::vector<BodyTarget>& targets = m_data->state.targets;
    if (const auto index = static_cast<std::size_t>(t.slot); targets.size() <= index)
        targets.resize(index + 1);
    const Rotation rotation = Rotation::from_angle(angle);
    targets[static_cast<std::size_t>(t.slot)] = {position + rotate(rotation, t.sim().local_center), rotation};
    t.record().has_target = true;
    t.wake();
    t.wake_neighbours();
}

void Body::set_velocity(Vec2 velocity)
{
    const Target t(m_data, m_id, "Body::set_velocity");
    if (!t || !Checker{"Body::set_velocity"}.finite("velocity", velocity) || t.record().type == BodyType::Static)
        return;
    t.record().had_target = false;
    if (t.sim().velocity == velocity)
        return;
    t.sim().velocity = velocity;
    obey_locks(t.record(), t.sim());
    t.wake();
    if (t.record().type == BodyType::Kinematic)
        t.wake_neighbours();
}

void Body::set_angular_velocity(float w)
{
    const Target t(m_data, m_id, "Body::set_angular_velocity");
    if (!t || !Checker{"Body::set_angular_velocity"}.finite("radians_per_second", w) || t.record().type == BodyType::Static)
        return;
    t.record().had_target = false;
    if (t.sim().angular_velocity == w)
        return;
    t.sim().angular_velocity = w;
    obey_locks(t.record(), t.sim());
    t.wake();
    if (t.record().type == BodyType::Kinematic)
        t.wake_neighbours();
}

void Body::apply_force(Vec2 force, Position point)
{
    const Target t(m_data, m_id, "Body::apply_force");
    const Checker check{"Body::apply_force"};
    if (!t || !check.finite("force", force) || !check.finite("world_point", point) || t.record().type != BodyType::Dynamic)
        return;
    t.sim().force += force;
    t.sim().torque += cross(point - t.sim().center, force);
    t.wake();
}

void Body::apply_force(Vec2 force)
{
    const Target t(m_data, m_id, "Body::apply_force");
    if (!t || !Checker{"Body::apply_force"}.finite("force", force) || t.record().type != BodyType::Dynamic)
        return;
    t.sim().force += force;
    t.wake();
}

void Body::apply_torque(float torque)
{
    const Target t(m_data, m_id, "Body::apply_torque");
    if (!t || !Checker{"Body::apply_torque"}.finite("torque", torque) || t.record().type != BodyType::Dynamic)
        return;
    t.sim().torque += torque;
    t.wake();
}

void Body::apply_impulse(Vec2 impulse, Position point)
{
    const Target t(m_data, m_id, "Body::apply_impulse");
    const Checker check{"Body::apply_impulse"};
    if (!t || !check.finite("impulse", impulse) || !check.finite("world_point", point))
        return;
    BodySim& sim = t.sim();
    sim.velocity += Vec2{sim.inverse_mass.x * impulse.x, sim.inverse_mass.y * impulse.y};
    sim.angular_velocity += sim.inverse_inertia * cross(point - sim.center, impulse);
    t.wake();
}

void Body::apply_impulse(Vec2 impulse)
{
    const Target t(m_data, m_id, "Body::apply_impulse");
    if (!t || !Checker{"Body::apply_impulse"}.finite("impulse", impulse))
        return;
    BodySim& sim = t.sim();
    sim.velocity += Vec2{sim.inverse_mass.x * impulse.x, sim.inverse_mass.y * impulse.y};
    t.wake();
}

void Body::apply_angular_impulse(float impulse)
{
    const Target t(m_data, m_id, "Body::apply_angular_impulse");
    if (!t || !Checker{"Body::apply_angular_impulse"}.finite("impulse", impulse))
        return;
    t.sim().angular_velocity += t.sim().inverse_inertia * impulse;
    t.wake();
}

void Body::set_gravity_scale(float scale)
{
    const Target t(m_data, m_id, "Body::set_gravity_scale");
    if (!t || !Checker{"Body::set_gravity_scale"}.finite("scale", scale))
        return;
    t.sim().gravity_scale = scale;
    t.wake();
}

void Body::set_linear_damping(float damping)
{
    const Target t(m_data, m_id, "Body::set_linear_damping");
    if (t && Checker{"Body::set_linear_damping"}.not_negative("damping", damping))
        t.sim().linear_damping = damping;
}

void Body::set_angular_damping(float damping)
{
    const Target t(m_data, m_id, "Body::set_angular_damping");
    if (t && Checker{"Body::set_angular_damping"}.not_negative("damping", damping))
        t.sim().angular_damping = damping;
}

void Body::set_locks(MotionLocks locks)
{
    const Target t(m_data, m_id, "Body::set_locks");
    if (!t)
        return;
    t.record().locks = locks;
    update_inverse_mass(m_data->state, t.slot);
    obey_locks(t.record(), t.sim());
    t.wake();
}

void Body::set_mass(const MassData& mass)
{
    const Target t(m_data, m_id, "Body::set_mass");
    const Checker check{"Body::set_mass"};
    if (!t || !check.in_range("MassData::mass", mass.mass, 1e-35f, 1e35f) || !check.finite("MassData::center", mass.center) ||
        !check.holds(mass.inertia == 0 || (mass.inertia >= 1e-35f && mass.inertia <= 1e35f), "MassData::inertia",
                     internal::to_text(mass.inertia), "must be 0 or from 1e-35 to 1e35") ||
        !check.holds(t.record().type == BodyType::Dynamic, "the body", "not dynamic", "only dynamic bodies have mass"))
        return;
    // The center moves as it does when shapes determine it: the velocity of the material is kept.
    move_center(m_data->state, t.slot, mass.center);
    BodySim& sim = t.sim();
    sim.mass = mass.mass;
    sim.inertia = mass.inertia;
    t.record().mass_overridden = true;
    update_mass(m_data->state, t.slot);
    t.wake();
}

void Body::reset_mass()
{
    const Target t(m_data, m_id, "Body::reset_mass");
    if (!t)
        return;
    t.record().mass_overridden = false;
    update_mass(m_data->state, t.slot);
    t.wake();
}

void Body::set_enabled(bool enabled)
{
    const Target t(m_data, m_id, "Body::set_enabled");
    if (!t || t.record().enabled == enabled)
        return;
    m_data->state.graph_dirty = true;
    if (!enabled)
    {
        destroy_contacts_of_body(*m_data, t.slot);
        t.wake_neighbours();
        leave_awake(*m_data, t.slot);
        remove_from_broad_phase(*m_data, t.slot);
        t.record().enabled = false;
        return;
    }
    t.record().enabled = true;
    t.sim().previous_center = t.sim().center;
    t.sim().previous_rotation = t.sim().rotation;
    for_each_leaf(m_data->state, t.slot, [&](int shape) { add_to_broad_phase(*m_data, shape); });
    if (t.record().type != BodyType::Static)
        enter_awake(*m_data, t.slot);
    t.wake_neighbours();
}

void Body::set_awake(bool awake)
{
    const Target t(m_data, m_id, "Body::set_awake");
    if (!t || !t.record().enabled || t.record().type == BodyType::Static)
        return;
    if (awake)
    {
        t.wake();
        return;
    }
    const internal::SceneState& state = m_data->state;
    std::vector<std::uint8_t> seen(static_cast<std::size_t>(state.bodies.capacity()));
    std::vector<std::int32_t> island;
    gather_island(state, t.slot, seen, island, [](int) { return true; });
    for (const std::int32_t body : island)
    {
        if (internal::is_awake(m_data->state, body))
            sleep_body(*m_data, body);
    }
}

void Body::set_can_sleep(bool can_sleep)
{
    const Target t(m_data, m_id, "Body::set_can_sleep");
    if (!t)
        return;
    t.record().can_sleep = can_sleep;
    if (!can_sleep)
        t.wake();
}

void Body::set_sleep_speed(float speed)
{
    const Target t(m_data, m_id, "Body::set_sleep_speed");
    if (!t || !Checker{"Body::set_sleep_speed"}.not_negative("speed", speed))
        return;
    give_sleep_speed(*m_data, t.record(), speed);
}

void Body::set_user_data(std::uint64_t user_data)
{
    if (const Target t(m_data, m_id, "Body::set_user_data"); t)
        m_data->body_user_data[static_cast<std::size_t>(t.slot)] = user_data;
}

} // namespace carom
