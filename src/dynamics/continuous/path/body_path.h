#pragma once

// The path of a body over this step, once poses are committed: pieces, each a parabola with constant angular acceleration.

#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/step_context.h"

#include <span>

namespace carom::internal {

/// Gathers the pieces recorded by the islands into Scratch::sensors.paths, body by body.
void gather_paths(StepContext& ctx);

/// Box around all that a body has covered since it was first deflected.
[[nodiscard]] FloatBox deflected_box(const StepContext& ctx, int body);

class BodyPath
{
public:
    BodyPath(const StepContext& ctx, int body);

    [[nodiscard]] const BodyPose& start() const { return m_start; }
    /// The committed pose; the last piece ends near it.
    [[nodiscard]] const BodyPose& end() const { return m_end; }
    /// No point of the body moves farther than this from its start, m.
    [[nodiscard]] double reach() const { return m_reach; }
    /// The path from a time of the step until next_curve, relative to the center at the start.
    [[nodiscard]] FramePath from(double time) const;
    /// Start of the first piece after a time; the end of the step if there is none.
    [[nodiscard]] double next_curve(double time) const;

private:
    void follow_chord(const StepContext& ctx, int body);
    void lead_to(const PathPiece& first);
    void measure(double extent);
    [[nodiscard]] bool ends_there(std::span<const PathPiece> pieces, double tolerance) const;

    double m_dt;
    double m_reach = 0;
    BodyPose m_start;
    BodyPose m_end;
    FramePath m_chord{}; ///< path until the first piece
    std::span<const PathPiece> m_pieces;
};

} // namespace carom::internal
