#pragma once

/// @file
/// From paths in the world to lines on the screen: what the canvas's files share.

#include "view/camera.h"
#include "view/mesher.h"

#include <span>
#include <vector>

namespace carom::view {

[[nodiscard]] inline ImVec2 to_imgui(Vec2 v) { return {v.x, v.y}; }

/// The path on the screen with the paint's colour at each point. Points too close to tell apart are dropped.
[[nodiscard]] std::vector<PathPoint> to_line(const Camera& camera, std::span<const Position> path, const Paint& paint,
                                             bool closed);

/// The same with every point kept: for triangles that refer to them.
[[nodiscard]] std::vector<PathPoint> to_points(const Camera& camera, std::span<const Position> path, const Paint& paint);

/// Lines with round ends; corners too sharp for a miter become round joints.
class LineMaker
{
public:
    /// sharp: the turn, in radians, from which a corner becomes a joint.
    LineMaker(Mesher& mesher, Profile profile, float sharp) : m_mesher(mesher), m_profile(profile), m_sharp(sharp) {}

    void open(std::span<const PathPoint> line);
    void closed(std::vector<PathPoint> line);

private:
    void run(std::span<const PathPoint> line);
    void joint(const PathPoint& at);
    void cap(const PathPoint& inside, const PathPoint& end);

    Mesher& m_mesher;
    Profile m_profile;
    float m_sharp;
};

} // namespace carom::view
