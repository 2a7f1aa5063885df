#include "dynamics/joint_forest.h"

#include "dynamics/scene_state.h"

#include <algorithm>

namespace carom::internal {

bool JointForest::build(std::span<const Link> links)
{
    number_bodies(links);
    gather_ends(links);
    m_reached.assign(m_bodies.size(), 0);
    m_taken.assign(links.size(), 0);
    m_joints.clear();
    for (int root = ground; root < static_cast<int>(m_bodies.size()); ++root)
    {
        if (m_reached[static_cast<std::size_t>(root)] == 0 && !grow(root))
            return false;
    }
    return true;
}

// The ground is `none`, which is less than any body, and always there.
void JointForest::number_bodies(std::span<const Link> links)
{
    m_bodies.assign(1, none);
    for (const Link& l : links)
        m_bodies.insert(m_bodies.end(), {l.a, l.b});
    std::sort(m_bodies.begin(), m_bodies.end());
    m_bodies.erase(std::unique(m_bodies.begin(), m_bodies.end()), m_bodies.end());
}

int JointForest::node_of(std::int32_t body) const
{
    return static_cast<int>(std::lower_bound(m_bodies.begin(), m_bodies.end(), body) - m_bodies.begin());
}

void JointForest::gather_ends(std::span<const Link> links)
{
    m_ends.clear();
    for (std::size_t i = 0; i < links.size(); ++i)
    {
        const int a = node_of(links[i].a);
        const int b = node_of(links[i].b);
        m_ends.push_back({a, static_cast<int>(i), b});
        m_ends.push_back({b, static_cast<int>(i), a});
    }
    std::sort(m_ends.begin(), m_ends.end());
}

bool JointForest::grow(int root)
{
    m_reached[static_cast<std::size_t>(root)] = 1;
    std::size_t next = m_joints.size();
    if (!add_children(root, none))
        return false;
    for (; next < m_joints.size(); ++next)
    {
        if (!add_children(m_joints[next].down, static_cast<int>(next)))
            return false;
    }
    return true;
}

// Reached a second time: a loop.
bool JointForest::add_children(int node, int parent)
{
    const auto first = static_cast<int>(m_joints.size());
    for (auto end = std::lower_bound(m_ends.begin(), m_ends.end(), End{node, 0, 0}); end != m_ends.end() && end->node == node;
         ++end)
    {
        if (m_taken[static_cast<std::size_t>(end->link)]++ != 0)
            continue;
        if (m_reached[static_cast<std::size_t>(end->other)]++ != 0)
            return false;
        const auto own = static_cast<int>(m_joints.size());
        m_joints.push_back({end->link, node, end->other, parent, node == ground ? own : first});
    }
    return true;
}

} // namespace carom::internal
