#pragma once

// Begins and ends of touches, and their events. No other code writes contact_flag::touching. Pieces of a chain are one shape to the user: the first piece that
// touches begins the touch for all, the last one that leaves ends it.

#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

#include <cstdint>
#include <span>

namespace carom::internal {

/// Does another contact of the same two user shapes touch or, for a trigger, report the visitor inside?
[[nodiscard]] bool touches_elsewhere(const SceneState& state, int contact);

// --- when the step begins -------------------------------------------------------------------------------------------------------------

/// The event's point is that of the contact's manifold.
void begin_touch(SceneData& scene, int contact);
/// `time`: within the step, s. Nothing ends for a contact that does not touch.
void end_touch(SceneData& scene, int contact, Events& events, float time);

/// In two halves, for contacts that concern only two awake bodies: first flags, on any thread; then all events, in the order of the contacts.
inline void note_begin(Contact& contact) { contact.flags |= contact_flag::touching; }
inline void note_end(Contact& contact) { contact.flags &= ~contact_flag::touching; }
void report_noted_begins(StepContext& ctx, std::span<const std::int32_t> contacts);
void report_noted_ends(StepContext& ctx, std::span<const std::int32_t> contacts);

// --- within the step ------------------------------------------------------------------------------------------------------------------

/// Islands begin touches in parallel; commit reports them. A touch without a contact begins and ends at once.
void begin_touch_within_step(SceneState& state, ImpactReport& report, const RawTouch& touch);
/// Reports the begun touches, in the order of the islands.
void report_begins(StepContext& ctx, const IslandOutput& output);
/// Ends touches that neither bear a load nor touch when the step ends.
void end_bounces(StepContext& ctx, const IslandOutput& output);

/// A leaf has entered or left a trigger.
inline void cross(Contact& contact) { contact.flags ^= contact_flag::touching; }

} // namespace carom::internal
