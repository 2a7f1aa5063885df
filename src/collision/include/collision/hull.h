#pragma once

// Every convex leaf with corners is one kind of object to the manifold code: points with radii and the outward normals of the edges between
// them. A capsule or segment is a hull of two points and two edges.

#include "collision/manifold.h"
#include "geometry/leaf.h"
#include "geometry/surface.h"

#include <cstddef>
#include <vector>

namespace carom::internal {

class Hull
{
public:
    explicit Hull(const LeafView& v)
    {
        if (v.leaf->type == LeafType::Polygon)
        {
            m_points = v.points;
            m_normals = v.normals;
            m_count = v.leaf->count;
            m_radii[0] = m_radii[1] = v.leaf->r0;
            return;
        }
        const CapsuleSides sides = capsule_sides(*v.leaf);
        for (int i = 0; i < 2; ++i)
        {
            m_sides[i] = sides.points[i];
            m_sides[2 + i] = sides.normals[i];
            m_radii[i] = sides.radii[i];
        }
        m_points = m_sides;
        m_normals = m_sides + 2;
        m_count = 2;
    }

    Hull(const Hull&) = delete;
    Hull& operator=(const Hull&) = delete;

    [[nodiscard]] int count() const { return m_count; }
    [[nodiscard]] int next(int i) const { return i + 1 < m_count ? i + 1 : 0; }
    [[nodiscard]] const Vec2* points() const { return m_points; }
    [[nodiscard]] const Vec2* normals() const { return m_normals; }
    [[nodiscard]] Vec2 point(int i) const { return m_points[i]; }
    [[nodiscard]] Vec2 normal(int i) const { return m_normals[i]; }
    [[nodiscard]] float radius(int i) const { return m_radii[i & (m_count == 2)]; }
    [[nodiscard]] float offset(int edge) const { return dot(m_normals[edge], m_points[edge]) + radius(edge); }
    [[nodiscard]] Vec2 cone(int i) const
    {
        return m_count == 2 ? end_cone(m_points[1 - i], m_points[i], m_radii[1 - i], m_radii[i])
                            : corner_cone(m_normals, m_count, i);
    }
    [[nodiscard]] Surface<float> surface_at(Vec2 p) const
    {
        return surface_of_hull<float>(m_points, m_normals, m_radii, m_count, p.x, p.y);
    }
    [[nodiscard]] Vec2 center() const
    {
        Vec2 sum{};
        for (int i = 0; i < m_count; ++i)
            sum += m_points[i];
        return (1.0f / static_cast<float>(m_count)) * sum;
    }

protected:
    const Vec2* m_points = nullptr;
    const Vec2* m_normals = nullptr;
    int m_count = 0;

private:
    Vec2 m_sides[4]; ///< points and normals of a capsule or segment
    float m_radii[2] = {};
};

/// The same hull seen from another frame.
class HullSeen : public Hull
{
public:
    HullSeen(const LeafView& v, const RelativePose& pose) : Hull(v)
    {
        Vec2* points = m_buffer;
        if (2 * m_count > buffer_size)
        {
            m_large.resize(static_cast<std::size_t>(2 * m_count));
            points = m_large.data();
        }
        Vec2* normals = points + m_count;
        for (int i = 0; i < m_count; ++i)
        {
            points[i] = pose.to_a(m_points[i]);
            normals[i] = rotate(pose.rotation, m_normals[i]);
        }
        m_points = points;
        m_normals = normals;
    }

private:
    static constexpr int buffer_size = 16; // boxes to octagons without an allocation

    Vec2 m_buffer[buffer_size];
    std::vector<Vec2> m_large;
};

} // namespace carom::internal
