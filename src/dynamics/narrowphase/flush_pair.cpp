// Finds the neighbors that lie flush with the shapes of a contact.

#include "dynamics/narrowphase/flush_pair.h"

#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "geometry/leaf_traits.h"

#include <algorithm>

namespace carom::internal {

namespace {

// Fraction of the smaller shape's size: a gap below it is no step, neither of a small shape nor for one.
constexpr double share_of_size = 0.02;

class Neighbourhood
{
public:
    Neighbourhood(const SceneState& state, int touched, int visitor, FlushNeighbours& found)
        : m_state(state), m_touched(touched), m_visitor(visitor), m_found(found)
    {}

    [[nodiscard]] bool may_have_some() const
    {
        const int body = m_state.shapes[m_touched].body;
        return may_be_flush(m_state.shapes[m_touched].leaf) && !(is_dynamic(body) && has_one_leaf(body));
    }

    // May a neighbor be at the touched points? False only where none is.
    [[nodiscard]] bool may_be_near(const LocalManifold& m, bool of_a, const RelativePose& pose) const
    {
        const int body = m_state.shapes[m_touched].body;
        if (!is_dynamic(body))
            return true;
        bool found = false;
        for_each_leaf(m_state, body,
                      [&](int other)
                      {
                          for (int i = 0; i < m.count && !found && other != m_touched; ++i)
                              found = may_be_flush(m_state.shapes[other].leaf) &&
                                      !is_farther(leaf_view(m_state, other), touched_point(m, i, of_a, pose),
                                                  static_cast<double>(m_state.slop));
                      });
        return found;
    }

    void find() const
    {
        const int body = m_state.shapes[m_touched].body;
        if (is_dynamic(body))
            find_in(body);
        else
            find_by(m_state.shapes[m_visitor].body);
    }

private:
    [[nodiscard]] bool is_dynamic(int body) const { return m_state.bodies[body].type == BodyType::Dynamic; }

    [[nodiscard]] bool has_one_leaf(int body) const
    {
        const BodyRecord& record = m_state.bodies[body];
        return record.first_shape == record.last_shape;
    }

    // Only leaves of the same body do not move against a leaf of a dynamic body.
    void find_in(int body) const
    {
        for_each_leaf(m_state, body,
                      [&](int other)
                      {
                          if (meets_visitor(other))
                              look_at(other);
                      });
    }

    [[nodiscard]] bool meets_visitor(int other) const
    {
        return filters_agree(m_state.shapes[other].filter, m_state.shapes[m_visitor].filter) &&
               overlaps(m_state.broad_phase.box(other), m_state.broad_phase.box(m_visitor));
    }

    // Searches the contacts of the visitor, because the list of a wall is long.
    void find_by(int visitor_body) const
    {
        for (const int index : contacts_of(m_state, visitor_body))
        {
            const Contact& contact = m_state.contacts[index];
            if (contact.shape_a == m_visitor)
                look_at(contact.shape_b);
            else if (contact.shape_b == m_visitor)
                look_at(contact.shape_a);
        }
    }

    void look_at(int other) const
    {
        if (other != m_touched && is_still_beside(other) && is_solid(other) && are_boxes_near(other))
            add(other);
    }

    [[nodiscard]] bool is_still_beside(int other) const
    {
        const ShapeRecord& own = m_state.shapes[m_touched];
        const ShapeRecord& shape = m_state.shapes[other];
        const bool in_one_chain = own.owner == shape.owner; // the seams of the chain cover this case
        return !in_one_chain && (shape.body == own.body || (!is_dynamic(shape.body) && !is_dynamic(own.body)));
    }

    [[nodiscard]] bool is_solid(int other) const
    {
        const ShapeRecord& shape = m_state.shapes[other];
        return !shape.trigger && may_be_flush(shape.leaf) && rare_traits_of(m_state, shape).one_way == Vec2{};
    }

    [[nodiscard]] bool are_boxes_near(int other) const
    {
        return !traits_of(m_state.shapes[other].leaf).is_bounded || !traits_of(m_state.shapes[m_touched].leaf).is_bounded ||
               overlaps(grow(m_state.broad_phase.box(m_touched), m_state.slop), m_state.broad_phase.box(other));
    }

    void add(int other) const
    {
        const BodyPose own = pose_at_start(m_state, m_state.shapes[m_touched].body);
        const BodyPose pose = pose_at_start(m_state, m_state.shapes[other].body);
        if (m_found.count == 0)
            m_found.tolerance = tolerance();
        m_found.add(leaf_view(m_state, other), relative_pose(own.frame(), pose.frame()));
    }

    [[nodiscard]] double tolerance() const
    {
        const double size = std::min(probe_size(leaf_view(m_state, m_touched)), probe_size(leaf_view(m_state, m_visitor)));
        return std::min(static_cast<double>(m_state.slop), share_of_size * size);
    }

    const SceneState& m_state;
    int m_touched;
    int m_visitor;
    FlushNeighbours& m_found;
};

} // namespace

FlushPair::FlushPair(const SceneState& state, const Contact& contact, const RelativePose& pose, const LocalManifold& m)
{
    const auto ask = [&](int touched, int visitor, bool of_contact_a, FlushNeighbours& found)
    {
        const Neighbourhood neighbourhood(state, touched, visitor, found);
        if (neighbourhood.may_have_some() &&
            may_be_hidden(leaf_view(state, touched), pose, of_contact_a, static_cast<double>(state.slop), m) &&
            neighbourhood.may_be_near(m, of_contact_a, pose))
            neighbourhood.find();
    };
    ask(contact.shape_a, contact.shape_b, true, of_a);
    ask(contact.shape_b, contact.shape_a, false, of_b);
}

void find_flush_neighbours(const SceneState& state, int touched, int visitor, FlushNeighbours& found)
{
    const Neighbourhood neighbourhood(state, touched, visitor, found);
    if (neighbourhood.may_have_some())
        neighbourhood.find();
}

} // namespace carom::internal
