#include "dynamics/flush_pair.h"

#include "dynamics/body_store.h"
#include "dynamics/contact_update.h"

#include <algorithm>

namespace carom::internal {

namespace {

constexpr double share_of_size = 0.02; // no step of a small shape, or for one

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

    // In the list of a body that moves: that of a wall is long.
    void find() const
    {
        const int body = m_state.shapes[m_touched].body;
        const int listed = is_dynamic(body) ? body : m_state.shapes[m_visitor].body;
        for (int edge = m_state.bodies[listed].first_contact; edge != none; edge = m_state.contacts[edge >> 1].next[edge & 1])
            look_at(m_state.contacts[edge >> 1]);
    }

private:
    [[nodiscard]] bool is_dynamic(int body) const { return m_state.bodies[body].type == BodyType::Dynamic; }

    [[nodiscard]] bool has_one_leaf(int body) const
    {
        const BodyRecord& record = m_state.bodies[body];
        return record.first_shape == record.last_shape;
    }

    void look_at(const Contact& contact) const
    {
        const bool visits_b = contact.shape_a == m_visitor;
        if (!visits_b && contact.shape_b != m_visitor)
            return;
        const int other = visits_b ? contact.shape_b : contact.shape_a;
        if (other != m_touched && is_still_beside(other) && is_solid(other) && are_boxes_near(other))
            add(other);
    }

    [[nodiscard]] bool is_still_beside(int other) const
    {
        const ShapeRecord& own = m_state.shapes[m_touched];
        const ShapeRecord& shape = m_state.shapes[other];
        const bool in_one_chain = own.owner == shape.owner; // whose seams say the same
        return !in_one_chain && (shape.body == own.body || (!is_dynamic(shape.body) && !is_dynamic(own.body)));
    }

    [[nodiscard]] bool is_solid(int other) const
    {
        const ShapeRecord& shape = m_state.shapes[other];
        return !shape.trigger && may_be_flush(shape.leaf) && rare_traits_of(m_state, shape).one_way == Vec2{};
    }

    [[nodiscard]] bool are_boxes_near(int other) const
    {
        return m_state.shapes[other].leaf.type == LeafType::HalfSpace ||
               m_state.shapes[m_touched].leaf.type == LeafType::HalfSpace ||
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
            may_be_hidden(leaf_view(state, touched), pose, of_contact_a, static_cast<double>(state.slop), m))
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
