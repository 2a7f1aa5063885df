#pragma once

/// @file
/// Shapes: geometry in the body's frame, material, filter, and what makes a shape a trigger or a field.

#include "carom/config.h"
#include "carom/id.h"
#include "carom/math.h"

#include <array>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace carom {

namespace internal {
struct SceneData;
}
class Scene;

/// Which side of a line, arc or chain is solid to touch, looking along its direction (from a to b, along the sweep,
/// along the chain). Closed chains always run counter-clockwise, so Left is their inside and Right their outside.
enum class Sides : std::uint8_t
{
    Both,
    Left,
    Right,
};

// Coordinates, radii and the bend of chains are at most 1e8 m; mass and moment of inertia of a shape are 0 or from 1e-35 to 1e35.
// A scene refuses what goes beyond.

struct Circle
{
    Vec2 center{};       ///< m
    float radius = 0.5f; ///< m, > 0
};

/// A convex polygon with any number of vertices, at least 3, in either winding. Points on the line between their neighbours are
/// dropped, to a hundred-thousandth of the polygon's size and at least 1e-6 m: a circle keeps some 500. A concave outline is refused
/// (see split_concave).
struct Polygon
{
    std::vector<Vec2> vertices{}; ///< m
    float radius = 0;             ///< corners rounded outwards by this much, m, >= 0
};

/// A rectangle as a polygon. Half sizes in m, > 0; angle in radians about the centre.
[[nodiscard]] CAROM_API Polygon box(float half_width, float half_height, Vec2 center = {}, float angle = 0, float radius = 0);

/// Splits any simple outline into convex polygons that cover it without overlap (ear clipping, then merging).
/// An outline that crosses itself is refused.
[[nodiscard]] CAROM_API std::vector<Polygon> split_concave(std::span<const Vec2> outline);

/// The convex hull of two circles. Equal radii give the usual capsule, different ones a pinball flipper.
struct Capsule
{
    Vec2 a{-0.5f, 0};       ///< m
    Vec2 b{0.5f, 0};        ///< m, not equal to a
    float radius_a = 0.25f; ///< m, > 0
    float radius_b = 0.25f; ///< m, > 0
};

/// A straight wall. With a half thickness it has the mass of the capsule it is.
struct Segment
{
    Vec2 a{-0.5f, 0};
    Vec2 b{0.5f, 0};
    float half_thickness = 0; ///< m, >= 0
    Sides sides = Sides::Both;
};

/// A true circular arc: exact normals everywhere, not a string of facets. No mass: static and kinematic bodies only.
struct Arc
{
    Vec2 center{};            ///< m
    float radius = 1;         ///< m, > half_thickness
    float start_angle = 0;    ///< radians
    float sweep = pi;         ///< radians, -2 pi to 2 pi, not 0; positive turns counter-clockwise (its left is the inside)
    float half_thickness = 0; ///< m, >= 0
    Sides sides = Sides::Both;
};

/// A piece of a chain, from where the piece before it ended.
struct ChainPiece
{
    Vec2 end{};      ///< m
    float sweep = 0; ///< 0: a straight line; else an arc that turns by this angle, radians, -2 pi to 2 pi (exclusive)
};

/// Lines and arcs joined end to end, without bumps at the seams. No mass: static and kinematic bodies only.
/// A closed chain gets a straight last piece to its start where its pieces do not end there.
struct Chain
{
    Vec2 start{};
    std::vector<ChainPiece> pieces{};
    bool closed = false;
    float half_thickness = 0; ///< m, >= 0
    Sides sides = Sides::Both;
};

/// Everything with dot(normal, p) < offset is solid: an infinite one-sided plane. Static bodies only.
struct HalfSpace
{
    Vec2 normal{0, 1}; ///< any length but 0; normalised
    float offset = 0;  ///< along the unit normal, m
};

using Geometry = std::variant<Circle, Polygon, Capsule, Segment, Arc, Chain, HalfSpace>;

/// Restitution that depends on the approach speed: straight lines between the points, constant outside them.
struct RestitutionCurve
{
    struct Point
    {
        float speed = 0;       ///< m/s, >= 0, ascending
        float restitution = 0; ///< 0 to 1
    };
    std::array<Point, 8> points{};
    std::uint32_t count = 0; ///< 0: no curve, ShapeDef::restitution holds
};

/// Which pairs of shapes may touch. A pair in the same non-zero group touches if the group is positive and never if it
/// is negative; every other pair touches if each one's category is in the other one's mask.
struct Filter
{
    std::uint64_t category = 1;
    std::uint64_t mask = ~std::uint64_t{0};
    std::int32_t group = 0;
    friend constexpr bool operator==(const Filter&, const Filter&) = default;
};

/// A bumper: adds speed along the contact normal when something hits it fast enough.
struct Kick
{
    float speed = 0;     ///< added to the separating speed, m/s; 0: no kick
    float threshold = 0; ///< approach speed above which it fires, m/s
    float cooldown = 0;  ///< s during which it does not fire again, with any piece of a chain
    friend constexpr bool operator==(const Kick&, const Kick&) = default;
};

/// A force field: acts on dynamic bodies while they are inside a trigger shape.
struct Field
{
    Vec2 force{};                      ///< N, world axes
    Vec2 acceleration{};               ///< m/s², world axes
    float drag = 0;                    ///< 1/s: slows the velocity as exp(-drag t)
    bool only_if_moving_along = false; ///< force and acceleration act only on what moves along their direction
    friend constexpr bool operator==(const Field&, const Field&) = default;
};

/// Parameters of a new shape besides its geometry.
struct ShapeDef
{
    float density = 1;     ///< kg/m², >= 0
    float friction = 0.6f; ///< Coulomb coefficient, >= 0
    float restitution = 0; ///< 0 to 1: separating speed over approach speed
    RestitutionCurve restitution_curve{};
    float rolling_resistance = 0; ///< times radius and normal force: a torque against rolling; >= 0
    float surface_speed = 0;      ///< m/s: a conveyor; moves what lies on it to the left of the outward normal when positive
    /// Blocks only what approaches against this direction (body frame); what comes from behind passes whole. Zero: both.
    Vec2 one_way{};
    Kick kick{};
    /// With MixRule::OtherDecides the other shape's values hold where this is set; ignored by the other rules.
    bool yields_material = false;
    Filter filter{};
    bool trigger = false; ///< passes through everything and reports enter, inside, exit; gives the body no mass
    Field field{};        ///< triggers only: refused on other shapes
    std::uint64_t user_data = 0;
};

/// Reads a shape. A short-lived reference; every call checks the id.
class CAROM_API ConstShape
{
public:
    [[nodiscard]] ShapeId id() const { return m_id; }
    [[nodiscard]] BodyId body() const;
    [[nodiscard]] Geometry geometry() const; ///< as it was given, normalised
    [[nodiscard]] ShapeDef def() const;
    [[nodiscard]] bool is_trigger() const;
    [[nodiscard]] std::uint64_t user_data() const;
    [[nodiscard]] Box bounds() const; ///< tight box in the world; a half-space gives an infinite one
    [[nodiscard]] bool contains(Position point) const;

protected:
    friend class Scene;
    ConstShape(internal::SceneData* data, ShapeId id) : m_data(data), m_id(id) {}
    internal::SceneData* m_data;
    ShapeId m_id{};
};

/// Reads and changes a shape.
class CAROM_API Shape : public ConstShape
{
public:
    /// Replaces everything but the geometry. The body's mass follows a changed density.
    void set_def(const ShapeDef& def);
    /// Replaces the geometry; the body's mass follows.
    void set_geometry(const Geometry& geometry);
    void set_user_data(std::uint64_t user_data);

private:
    friend class Scene;
    using ConstShape::ConstShape;
};

} // namespace carom
