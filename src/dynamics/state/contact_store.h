#pragma once

// Contacts: creation, destruction, and the lists that hold them.

#include "dynamics/state/scene_data.h"

#include <cstddef>
#include <iterator>

namespace carom::internal {

/// Number of pairs, or of contacts, that stay near in the cache. A larger number comes from memory with their boxes, and is walked sequentially.
inline constexpr std::size_t most_near_pairs = 131'072;

/// Whether two shapes may have a contact at all, by types, filters, joints, ignored pairs and triggers.
[[nodiscard]] bool may_collide(const SceneState& state, int shape_a, int shape_b);

/// Compares groups, categories and masks alone.
[[nodiscard]] bool filters_agree(const Filter& a, const Filter& b);

/// The filter as trees of boxes apply it: shapes that share a positive group meet whatever their categories are.
[[nodiscard]] inline FilterBits filter_bits(const Filter& filter)
{
    return filter.group > 0 ? FilterBits{} : FilterBits{filter.category, filter.mask};
}

/// Creates the contact of a pair in SceneState::box_pairs. Its shapes must be allowed to collide and have no contact yet.
void create_contact(SceneData& scene, int shape_a, int shape_b, std::int32_t pair);

/// Such a contact in its initial state, in no list yet.
[[nodiscard]] Contact new_contact(const SceneData& scene, int shape_a, int shape_b, std::int32_t pair);

/// Makes room in the arrays beside the contacts (cached manifolds, impulses, lane marks) for as many contacts as there are slots.
void make_room_beside_contacts(SceneState& state);

/// Links a contact into the list of one of its bodies, or unlinks it: side 0 is that of body_a.
void link_side(SceneState& state, int contact, int side);
void unlink_side(SceneState& state, int contact, int side);

/// Detaches the contact from its pair, if it has one.
void leave_pair(SceneState& state, int contact);

/// Removes the contact from its pair and from the awake list, and frees its slot. The caller updates bodies' lists and colors.
void give_up_slot(SceneState& state, int contact);

/// Ends a touch that has begun: the event goes to `events` at `time`. Wakes nothing.
void destroy_contact(SceneData& scene, int contact, Events& events, float time);

/// Destroys the contacts of a shape or of a body; bodies that rested on it wake.
void destroy_contacts_of_shape(SceneData& scene, int shape);
void destroy_contacts_of_body(SceneData& scene, int body);

/// Mixes friction, rolling resistance and surface speed of the two shapes anew.
void mix_materials(const SceneData& scene, Contact& contact);

void add_awake_contact(SceneState& state, int contact);
void remove_awake_contact(SceneState& state, int contact);

/// Whether the two shapes have a contact.
[[nodiscard]] bool has_contact(const SceneState& state, int shape_a, int shape_b);

/// Puts the contact's pair back into SceneState::box_pairs, if it is not there.
void follow_again(SceneState& state, int contact);

[[nodiscard]] inline int edge_contact(int edge) { return edge >> 1; }

/// The contacts of a body, by index. None may be created or destroyed during the iteration.
class ContactsOf
{
public:
    class Iterator
    {
    public:
        Iterator(const SceneState& state, int edge) : m_state(state), m_edge(edge) {}
        [[nodiscard]] int operator*() const { return edge_contact(m_edge); }
        [[nodiscard]] bool operator==(std::default_sentinel_t) const { return m_edge == none; }
        Iterator& operator++()
        {
            m_edge = m_state.contacts[edge_contact(m_edge)].next[m_edge & 1];
            return *this;
        }

    private:
        const SceneState& m_state;
        int m_edge;
    };

    ContactsOf(const SceneState& state, int body) : m_state(state), m_first(state.bodies[body].first_contact) {}
    [[nodiscard]] Iterator begin() const { return {m_state, m_first}; }
    [[nodiscard]] static std::default_sentinel_t end() { return {}; }

private:
    const SceneState& m_state;
    int m_first;
};

[[nodiscard]] inline ContactsOf contacts_of(const SceneState& state, int body) { return {state, body}; }

/// Calls visit(contact index) for every contact of the body; the visit may destroy its contact.
template <class Visit>
void for_each_contact(SceneState& state, int body, Visit&& visit)
{
    for (int edge = state.bodies[body].first_contact; edge != none;)
    {
        const int contact = edge_contact(edge);
        edge = state.contacts[contact].next[edge & 1];
        visit(contact);
    }
}

/// For a contact that is no longer solved.
inline void forget_impulses(SceneState& state, int contact)
{
    state.contacts[contact].flags &= ~contact_flag::loaded;
    impulses_of(state, contact) = {};
}

[[nodiscard]] inline int other_body(const Contact& contact, int body)
{
    return contact.body_a == body ? contact.body_b : contact.body_a;
}

/// The other body of a joint; none for the world.
[[nodiscard]] inline int other_body(const JointRecord& joint, int body)
{
    return joint.body_a == body ? joint.body_b : joint.body_a;
}

/// Public ids of slots.
[[nodiscard]] BodyId body_id(const SceneState& state, int slot);
[[nodiscard]] ShapeId user_shape_id(const SceneState& state, int slot); ///< of a shape that is no piece
[[nodiscard]] ShapeId shape_id(const SceneState& state, int slot);      ///< of the owner, for pieces of chains
[[nodiscard]] JointId joint_id(const SceneState& state, int slot);

/// Slot of a public id; -1 for the null id.
template <class Kind>
[[nodiscard]] int slot_of(Id<Kind> id)
{
    return static_cast<int>(id.slot - 1u); // defined for any number, and so for an id that was never issued
}

/// An event of any kind between two shapes; `rest` are its other fields in order.
template <class Event, class... Rest>
[[nodiscard]] Event event_between(const SceneState& state, int shape_a, int shape_b, const Rest&... rest)
{
    return {shape_id(state, shape_a), shape_id(state, shape_b), body_id(state, state.shapes[shape_a].body),
            body_id(state, state.shapes[shape_b].body), rest...};
}

/// The same for a contact, without access to the shapes unless one is a piece.
template <class Event, class... Rest>
[[nodiscard]] Event event_of(const SceneState& state, const Contact& c, const Rest&... rest)
{
    if ((c.flags & contact_flag::piece) != 0)
        return event_between<Event>(state, c.shape_a, c.shape_b, rest...);
    return {user_shape_id(state, c.shape_a), user_shape_id(state, c.shape_b), body_id(state, c.body_a), body_id(state, c.body_b),
            rest...};
}

} // namespace carom::internal
