#pragma once

/// @file
/// What an experiment may ask of an engine: written once, run on every engine through a thin adapter. SI units, radians.

#include "truth/vec.h"

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace truth {

enum class Motion
{
    Static,
    Kinematic,
    Dynamic,
};

/// Index of a body in the order of creation.
using Body = int;
inline constexpr Body ground = -1; ///< the world itself, as a party of a joint

struct BodyDef
{
    Motion motion = Motion::Dynamic;
    Vec position{};
    double angle = 0;
    Vec velocity{};
    double spin = 0;
};

/// Centered at its body's origin, so that a dynamic body's origin is its centre of mass.
struct Disc
{
    double radius = 1;
};

/// Convex, counter-clockwise.
struct Polygon
{
    std::vector<Vec> vertices{};
};

struct Segment
{
    Vec a{};
    Vec b{};
};

using Shape = std::variant<Disc, Polygon, Segment>;

/// A rectangle of the given full size.
[[nodiscard]] Polygon box(double width, double height, Vec center = {});

/// Values of the pair: adapters set both shapes so that every engine's mixing rule gives these when both are equal.
struct Material
{
    double density = 1;
    double restitution = 0;
    double friction = 0;
    bool sensor = false;
    bool collides = true; ///< false: with nothing that does not collide either
};

struct State
{
    Vec position{};
    double angle = 0;
    Vec velocity{};
    double spin = 0;
};

struct Impact
{
    Body a = ground;
    Body b = ground;
    double time = 0; ///< within the step
    double approach_speed = 0;
};

/// A body came into or went out of a sensor in the last step.
struct Crossing
{
    bool enter = false;
    double time = 0; ///< within the step; only where World::crossing_times holds
};

class World
{
public:
    virtual ~World() = default;
    virtual Body add_body(const BodyDef& def) = 0;
    virtual void add_shape(Body body, const Shape& shape, const Material& material) = 0;
    /// The two bodies do not collide with each other.
    virtual void add_hinge(Body a, Body b, Vec anchor) = 0;
    /// Force stiffness · (distance − length) − damping · (its rate) between two centers.
    virtual void add_spring(Body a, Body b, double length, double stiffness, double damping) = 0;
    /// Of a kinematic body, kept through the following steps.
    virtual void set_motion(Body body, Vec velocity, double spin) = 0;
    virtual void step(double dt) = 0;
    [[nodiscard]] virtual State state(Body body) const = 0;

    /// Optional: impacts of the last step, in order.
    [[nodiscard]] virtual bool reports_impacts() const { return false; }
    [[nodiscard]] virtual std::vector<Impact> impacts() const { return {}; }
    /// Sensor events of the last step; without times where the engine gives none.
    [[nodiscard]] virtual bool crossing_times() const { return false; }
    [[nodiscard]] virtual std::vector<Crossing> crossings() const { return {}; }
};

/// An engine, at its default settings.
struct Engine
{
    std::string name{};
    std::function<std::unique_ptr<World>(Vec gravity)> make_world{};
    bool peer = false; ///< another engine than ours: fewer seeds where there are many
};

[[nodiscard]] Engine carom_engine();
/// Carom first, then the peers that were found when this was built.
[[nodiscard]] std::vector<Engine> engines();

} // namespace truth
