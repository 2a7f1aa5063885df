// Creation and destruction of contacts, and the lists that hold them.

#include "dynamics/state/contact_store.h"

#include "collision/manifold.h"
#include "dynamics/narrowphase/material.h"
#include "dynamics/narrowphase/touch_tracker.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/state/coloring.h"
#include "geometry/leaf_traits.h"

namespace carom::internal {

BodyId body_id(const SceneState& state, int slot)
{
    if (slot < 0)
        return {};
    return {static_cast<std::uint32_t>(slot) + 1, state.bodies.generation(slot)};
}

ShapeId user_shape_id(const SceneState& state, int slot)
{
    return {static_cast<std::uint32_t>(slot) + 1, state.shapes.generation(slot)};
}

ShapeId shape_id(const SceneState& state, int slot)
{
    if (slot < 0)
        return {};
    return user_shape_id(state, state.shapes[slot].owner);
}

JointId joint_id(const SceneState& state, int slot)
{
    if (slot < 0)
        return {};
    return {static_cast<std::uint32_t>(slot) + 1, state.joints.generation(slot)};
}

bool filters_agree(const Filter& a, const Filter& b)
{
    if (a.group != 0 && a.group == b.group)
        return a.group > 0;
    return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

namespace {

bool joint_forbids(const SceneState& state, int body_a, int body_b)
{
    for (int edge = state.bodies[body_a].first_joint; edge != none;)
    {
        const JointRecord& joint = state.joints[edge >> 1];
        edge = joint.next[edge & 1];
        const bool joins =
            (joint.body_a == body_a && joint.body_b == body_b) || (joint.body_a == body_b && joint.body_b == body_a);
        if (joins && !joint.collide_connected)
            return true;
    }
    return false;
}

} // namespace

bool may_collide(const SceneState& state, int shape_a, int shape_b)
{
    const ShapeRecord& a = state.shapes[shape_a];
    const ShapeRecord& b = state.shapes[shape_b];
    if (a.body == b.body || (a.trigger && b.trigger) || !filters_agree(a.filter, b.filter))
        return false;
    if (collide_function(a.leaf.type, b.leaf.type) == nullptr)
        return false;
    const bool trigger = a.trigger || b.trigger;
    const BodyRecord& body_a = state.bodies[a.body];
    const BodyRecord& body_b = state.bodies[b.body];
    if (!trigger && body_a.type != BodyType::Dynamic && body_b.type != BodyType::Dynamic)
        return false;
    if (state.ignored.contains(pair_key(a.body, b.body)))
        return false;
    return trigger || !(joint_forbids(state, a.body, b.body));
}

void mix_materials(const SceneData& scene, Contact& contact)
{
    const ShapeRecord& a = scene.state.shapes[contact.shape_a];
    const ShapeRecord& b = scene.state.shapes[contact.shape_b];
    contact.friction = mixed_friction(scene, contact.shape_a, contact.shape_b);
    contact.rolling_resistance = a.rolling_resistance > b.rolling_resistance ? a.rolling_resistance : b.rolling_resistance;
    contact.surface_speed = a.surface_speed + b.surface_speed;
    contact.flags &= ~contact_flag::bounces;
    if (may_bounce(scene, contact.shape_a, contact.shape_b))
        contact.flags |= contact_flag::bounces;
}

void link_side(SceneState& state, int index, int side)
{
    Contact& contact = state.contacts[index];
    BodyRecord& body = state.bodies[side == 0 ? contact.body_a : contact.body_b];
    contact.next[side] = body.first_contact;
    contact.previous[side] = none;
    if (body.first_contact != none)
        state.contacts[body.first_contact >> 1].previous[body.first_contact & 1] = index * 2 + side;
    body.first_contact = index * 2 + side;
}

void unlink_side(SceneState& state, int index, int side)
{
    Contact& contact = state.contacts[index];
    BodyRecord& body = state.bodies[side == 0 ? contact.body_a : contact.body_b];
    const int next = contact.next[side];
    const int previous = contact.previous[side];
    if (next != none)
        state.contacts[next >> 1].previous[next & 1] = previous;
    if (previous != none)
        state.contacts[previous >> 1].next[previous & 1] = next;
    else
        body.first_contact = next;
}

void add_awake_contact(SceneState& state, int index)
{
    Contact& contact = state.contacts[index];
    if (contact.awake_index != none || (contact.flags & contact_flag::trigger) != 0)
        return;
    contact.awake_index = static_cast<std::int32_t>(state.awake_contacts.size());
    append(state.awake_contacts, index);
}

void remove_awake_contact(SceneState& state, int index)
{
    Contact& contact = state.contacts[index];
    if (contact.awake_index == none)
        return;
    leave_lane(state, index);
    const bool trigger = (contact.flags & contact_flag::trigger) != 0;
    std::vector<std::int32_t>& list = trigger ? state.trigger_contacts : state.awake_contacts;
    const auto place = static_cast<std::size_t>(contact.awake_index);
    list[place] = list.back();
    state.contacts[list[place]].awake_index = contact.awake_index;
    list.pop_back();
    contact.awake_index = none;
}

void follow_again(SceneState& state, int index)
{
    Contact& contact = state.contacts[index];
    if (contact.pair != none)
        return;
    contact.pair = static_cast<std::int32_t>(state.box_pairs.size());
    state.box_pairs.push_back({contact.shape_a, contact.shape_b, index});
}

// Walks both bodies' lists at once: one of them may be the long list of the ground.
bool has_contact(const SceneState& state, int shape_a, int shape_b)
{
    int edge_a = state.bodies[state.shapes[shape_a].body].first_contact;
    int edge_b = state.bodies[state.shapes[shape_b].body].first_contact;
    const auto is_it = [&](int edge)
    {
        const Contact& c = state.contacts[edge >> 1];
        return (c.shape_a == shape_a && c.shape_b == shape_b) || (c.shape_a == shape_b && c.shape_b == shape_a);
    };
    while (edge_a != none && edge_b != none)
    {
        if (is_it(edge_a) || is_it(edge_b))
            return true;
        edge_a = state.contacts[edge_a >> 1].next[edge_a & 1];
        edge_b = state.contacts[edge_b >> 1].next[edge_b & 1];
    }
    return false;
}

namespace {

bool is_plain(const Leaf& leaf) { return traits_of(leaf).faces_all && !is_of_chain(leaf); }

} // namespace

Contact new_contact(const SceneData& scene, int shape_a, int shape_b, std::int32_t pair)
{
    const SceneState& state = scene.state;
    // The first shape is the trigger, or the one whose type comes first in the table, so that every pair is computed in one order.
    const ShapeRecord* a = &state.shapes[shape_a];
    const ShapeRecord* b = &state.shapes[shape_b];
    const bool trigger = a->trigger || b->trigger;
    if (trigger ? b->trigger : a->leaf.type > b->leaf.type)
    {
        std::swap(shape_a, shape_b);
        std::swap(a, b);
    }
    Contact contact;
    contact.shape_a = shape_a;
    contact.shape_b = shape_b;
    contact.body_a = a->body;
    contact.body_b = b->body;
    contact.flags = contact_flag::fresh | (trigger ? contact_flag::trigger : 0u);
    if (a->leaf.type == LeafType::Circle || b->leaf.type == LeafType::Circle)
        contact.flags |= contact_flag::round;
    if (is_plain(a->leaf) && is_plain(b->leaf))
        contact.flags |= contact_flag::plain;
    if (rare_traits_of(state, *a).one_way != Vec2{} || rare_traits_of(state, *b).one_way != Vec2{})
        contact.flags |= contact_flag::one_way;
    if (a->owner != shape_a || b->owner != shape_b)
        contact.flags |= contact_flag::piece;
    contact.pair = pair;
    note_sleeper(state, contact);
    mix_materials(scene, contact);
    return contact;
}

void make_room_beside_contacts(SceneState& state)
{
    const auto capacity = static_cast<std::size_t>(state.contacts.capacity());
    grow<Growth::Third>(state.cached_manifolds, capacity);
    grow<Growth::Third>(state.impulses, capacity);
    grow<Growth::Third>(state.lane_marks, capacity);
}

void create_contact(SceneData& scene, int shape_a, int shape_b, std::int32_t pair)
{
    SceneState& state = scene.state;
    const Contact contact = new_contact(scene, shape_a, shape_b, pair);
    const int index = state.contacts.create(contact);
    make_room_beside_contacts(state);
    impulses_of(state, index) = {};
    state.box_pairs[static_cast<std::size_t>(pair)].contact = index;
    link_side(state, index, 0);
    link_side(state, index, 1);
    if ((contact.flags & contact_flag::trigger) != 0)
    {
        state.contacts[index].awake_index = static_cast<std::int32_t>(state.trigger_contacts.size());
        state.trigger_contacts.push_back(index);
    }
    else if (is_awake(state, contact.body_a) || is_awake(state, contact.body_b))
    {
        add_awake_contact(state, index);
    }
}

void leave_pair(SceneState& state, int index)
{
    const Contact& contact = state.contacts[index];
    if (contact.pair != none)
        state.box_pairs[static_cast<std::size_t>(contact.pair)].contact = none;
}

void give_up_slot(SceneState& state, int index)
{
    remove_awake_contact(state, index);
    leave_pair(state, index);
    state.contacts.destroy(index);
}

void destroy_contact(SceneData& scene, int index, Events& events, float time)
{
    SceneState& state = scene.state;
    end_touch(scene, index, events, time);
    leave_color(state, state.contacts[index]);
    unlink_side(state, index, 0);
    unlink_side(state, index, 1);
    give_up_slot(state, index);
}

namespace {

// A body that rested on this one wakes, for its support is gone.
void destroy_and_wake(SceneData& scene, int index, int body)
{
    const Contact contact = scene.state.contacts[index];
    const bool leaned = touches(contact) && (contact.flags & contact_flag::trigger) == 0;
    destroy_contact(scene, index, scene.pending, 0);
    if (leaned)
        wake_body(scene, other_body(contact, body));
}

} // namespace

void destroy_contacts_of_shape(SceneData& scene, int shape)
{
    const int body = scene.state.shapes[shape].body;
    for_each_contact(scene.state, body,
                     [&](int index)
                     {
                         const Contact& contact = scene.state.contacts[index];
                         if (contact.shape_a == shape || contact.shape_b == shape)
                             destroy_and_wake(scene, index, body);
                     });
}

void destroy_contacts_of_body(SceneData& scene, int body)
{
    for_each_contact(scene.state, body, [&](int index) { destroy_and_wake(scene, index, body); });
}

} // namespace carom::internal
