#pragma once

/// @file
/// Drawing for developers: the scene calls, you draw.

#include "carom/body.h"
#include "carom/config.h"
#include "carom/id.h"
#include "carom/math.h"
#include "carom/shape.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace carom {

/// The meaning of a primitive; choose your own colours by it.
enum class DrawRole : std::uint8_t
{
    StaticShape,
    KinematicShape,
    AwakeShape,
    SleepingShape,
    DisabledShape,
    Trigger,
    Joint,
    Box,
    Contact,
    ContactNormal,
    Impulse,
    Friction,
    Velocity,
    CenterOfMass,
    Island,
};

/// Implement what you need; every function does nothing by default. Lengths in m, in the world.
class CAROM_API DebugDraw
{
public:
    virtual ~DebugDraw() = default;
    virtual void circle(DrawRole, Position /*center*/, float /*radius*/, Rotation /*rotation*/) {}
    /// The hull of two circles; also segments with a thickness.
    virtual void capsule(DrawRole, Position /*a*/, Position /*b*/, float /*radius_a*/, float /*radius_b*/) {}
    virtual void polygon(DrawRole, std::span<const Position> /*vertices*/, float /*radius*/) {}
    virtual void arc(DrawRole, Position /*center*/, float /*radius*/, float /*start_angle*/, float /*sweep*/,
                     float /*half_thickness*/)
    {}
    virtual void line(DrawRole, Position /*a*/, Position /*b*/) {}
    virtual void point(DrawRole, Position /*p*/) {}
    virtual void text(DrawRole, Position /*p*/, std::string_view /*utf8*/) {}
};

struct DebugDrawOptions
{
    bool shapes = true;
    bool joints = true;
    bool triggers = true;
    bool boxes = false; ///< fat boxes of the broad phase
    bool contacts = false;
    bool normals = false;
    bool impulses = false; ///< normal impulses as lines of impulse_scale m per N s
    bool friction = false;
    bool velocities = false; ///< lines of velocity_scale m per m/s
    bool centers = false;
    bool islands = false; ///< the box around each awake island
    float impulse_scale = 1;
    float velocity_scale = 0.1f;
    Box view{{-1e9, -1e9}, {1e9, 1e9}}; ///< only what overlaps it is drawn
};

} // namespace carom
