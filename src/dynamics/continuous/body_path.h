#pragma once

// The way a body went in this step, once poses are committed: pieces, each a parabola and an even turn.

#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/step_context.h"

#include <span>

namespace carom::internal {

/// Gathers what the islands recorded into Scratch::sensors.paths, body by body.
void gather_paths(StepContext& ctx);

/// Around all that a body has covered since something first threw it off its way.
[[nodiscard]] FloatBox deflected_box(const StepContext& ctx, int body);

class BodyPath
{
public:
    BodyPath(const StepContext& ctx, int body);

    [[nodiscard]] const BodyPose& start() const { return m_start; }
    /// As committed; the last piece ends near it.
    [[nodiscard]] const BodyPose& end() const { return m_end; }
    /// No point of the body comes farther from where it set out, m.
    [[nodiscard]] double reach() const { return m_reach; }
    /// From a time of the step on, until next_curve; relative to the center at the start.
    [[nodiscard]] FramePath from(double time) const;
    /// The first bend after a time; the end of the step, where none comes.
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
    FramePath m_chord{}; ///< until the first piece
    std::span<const PathPiece> m_pieces;
};

} // namespace carom::internal
