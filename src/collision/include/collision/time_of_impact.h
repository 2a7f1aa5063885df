#pragma once

// When does a ball in free flight meet a leaf that moves? Both paths are exact functions of time: the ball's a parabola, the leaf's body a
// straight line or parabola of its center with a steady turn about it. All in double; the target is zero distance.

#include "carom/math.h"
#include "geometry/leaf.h"

#include <optional>

namespace carom::internal {

/// x + v t + a t²/2 for each coordinate.
struct CenterPath
{
    double x = 0;
    double y = 0;
    double vx = 0;
    double vy = 0;
    double ax = 0;
    double ay = 0;
};

struct FramePath
{
    CenterPath center;   ///< of mass
    Vec2 local_center{}; ///< where that is in the body's frame
    double c = 1;        ///< rotation at t = 0
    double s = 0;
    double w = 0; ///< rad/s
};

struct BallHit
{
    double time;
    double nx; ///< world normal from the leaf to the ball
    double ny;
    double curvature; ///< of the surface there, see Surface
    int feature;
};

/// The first time in [0, duration] at which the ball touches the leaf and approaches it faster than least_approach. Balls that overlap and approach hit at 0; what
/// touches and separates does not hit until it comes back.
[[nodiscard]] std::optional<BallHit> ball_time_of_impact(const CenterPath& ball, double radius, const LeafView& leaf,
                                                         const FramePath& frame, double duration, double least_approach);

} // namespace carom::internal
