#pragma once

/// @file
/// The interface through which experiments and carom-bench use an engine: written once, run on every engine through a thin adapter. SI units, radians.

#include "truth/vec.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
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
    double damping = 0; ///< 1/s, of the linear velocity
    bool awake = true;
    bool can_sleep = true;
    double sleep_speed = 0.05; ///< m/s, where an engine has one for each body
};

struct Disc
{
    double radius = 1;
    Vec center{};
};

/// Convex, counter-clockwise; with a radius its corners are rounded outwards.
struct Polygon
{
    std::vector<Vec> vertices{};
    double radius = 0;
};

struct Segment
{
    Vec a{};
    Vec b{};
};

struct Capsule
{
    Vec a{};
    Vec b{};
    double radius = 1;
};

using Shape = std::variant<Disc, Polygon, Segment, Capsule>;

/// A rectangle of the given full size.
[[nodiscard]] Polygon box(double width, double height, Vec center = {});

/// Shapes of one group other than 0 do not touch; others do where each one's category is in the other one's mask.
struct Filter
{
    std::uint32_t category = 1;
    std::uint32_t mask = ~std::uint32_t{0};
    int group = 0;
};

/// Values of the pair: adapters set both shapes so that every engine's mixing rule gives these when both are equal.
struct Material
{
    double density = 1;
    double restitution = 0;
    double friction = 0;
    bool sensor = false;
    Filter filter{};
};
/// The filter of what touches nothing of its own kind.
inline constexpr Filter passes_its_own{.group = -1};

/// The two bodies do not collide with each other. The anchor is a point of the world; angles are of b against a.
struct Hinge
{
    Body a = ground;
    Body b = ground;
    Vec anchor{};
    double reference = 0; ///< what b's angle less a's is counted from
    bool limited = false;
    double lower = 0;
    double upper = 0;
    bool driven = false;
    double motor_speed = 0;
    double motor_torque = 0; ///< the most it gives
    double hertz = 0;        ///< of a spring towards the reference; 0: none
    double damping_ratio = 0;
};

/// Holds the angle between the bodies and the distance from a line. The translation is how far the anchor on b is ahead of that on a.
struct Slider
{
    Body a = ground;
    Body b = ground;
    Vec anchor{}; ///< a point of the world
    Vec axis{1, 0};
    bool limited = false;
    double lower = 0;
    double upper = 0;
    double restitution = 0; ///< of the limits, where an engine has it
};

struct State
{
    Vec position{};
    double angle = 0;
    Vec velocity{};
    double spin = 0;
    bool awake = true;
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

struct WorldDef
{
    Vec gravity{};
    bool sleeping = false;
    bool continuous = true; ///< where an engine has it
    int substeps = 4;       ///< where an engine has sub-steps
    int threads = 1;        ///< where an engine has threads
};

/// Features that an engine has not got.
class Missing : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

class World
{
public:
    virtual ~World() = default;
    virtual Body add_body(const BodyDef& def) = 0;
    virtual void add_shape(Body body, const Shape& shape, const Material& material) = 0;
    virtual void add_hinge(const Hinge& hinge) = 0;
    void add_hinge(Body a, Body b, Vec anchor) { add_hinge(Hinge{.a = a, .b = b, .anchor = anchor}); }
    virtual void add_slider(const Slider& slider) = 0;
    /// Holds the distance between two centers, which do not collide for it.
    virtual void add_rod(Body a, Body b, double length) = 0;
    /// Force stiffness · (distance − length) − damping · (its rate) between two centers.
    virtual void add_spring(Body a, Body b, double length, double stiffness, double damping) = 0;
    /// Velocity of a kinematic body, kept through the following steps.
    virtual void set_motion(Body body, Vec velocity, double spin) = 0;
    virtual void step(double dt) = 0;
    [[nodiscard]] virtual State state(Body body) const = 0;

    /// Optional: a closed row of straight walls on a static body, counter-clockwise, solid to what is inside.
    virtual void add_ring(Body, const std::vector<Vec>&, const Material&) { throw Missing("rings"); }
    /// Optional: the body goes, with its shapes and joints; its index is not used again.
    virtual void remove_body(Body) { throw Missing("bodies that go"); }
    /// Optional: pairs of shapes that the engine keeps as contacts, as it counts them itself.
    [[nodiscard]] virtual int contacts() const { return 0; }

    /// Optional: force of a hinge on its body b over the last step. Hinges are counted in the order of creation.
    [[nodiscard]] virtual Vec hinge_force(int) const { throw Missing("forces of hinges"); }

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
    std::function<std::unique_ptr<World>(const WorldDef&)> make_world{};
    bool peer = false;    ///< another engine than ours: fewer seeds where there are many
    std::string key{};    ///< how a command line names it
    int most_threads = 1; ///< that one world can use
};

/// With carom::SceneDef::most_subdivisions.
[[nodiscard]] Engine carom_engine(int most_subdivisions = 32);
/// Carom first, then the peers that were found when this was built.
[[nodiscard]] std::vector<Engine> engines();

} // namespace truth
