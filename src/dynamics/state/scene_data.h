#pragma once

// A scene: its state, what is stored beside the state (user data, callbacks, force laws), the events of the last step, and
// scratch memory that keeps its capacity from step to step.

#include "carom/scene.h"
#include "dynamics/state/scene_state.h"
#include "dynamics/step_context.h"

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

namespace carom::internal {

/// Lengths and speeds below which values count as equal, from SceneDef::length_scale.
struct Tolerances
{
    float slop = 0;        ///< shapes this near touch; bodies that overlap by no more may fly
    float speculation = 0; ///< gap within which quiet pairs get speculative contacts
    float keep = 0;        ///< in crowds, cached manifolds are followed until bodies have moved this far relative to each other
    float box_margin = 0;  ///< margin of fat boxes
    float push_speed = 0;  ///< overlap is removed no faster
    float sleep_speed = 0; ///< for bodies without a sleep speed of their own
    float rest_speed = 0;  ///< slower approach is not an impact
};

/// A touch that begins, stored until the events stage.
struct RawTouch
{
    std::int32_t contact = none; ///< none: the pair has no contact, and the touch ends in the step it began
    std::int32_t shape_a = none;
    std::int32_t shape_b = none;
    Position point{};
    Vec2 normal{};
    float time = 0;
};

struct Events
{
    std::vector<ContactBeginEvent> begins;
    std::vector<ContactEndEvent> ends;
    std::vector<ImpactEvent> impacts;
    std::vector<TriggerEvent> enters;
    std::vector<TriggerEvent> exits;

    void clear()
    {
        begins.clear();
        ends.clear();
        impacts.clear();
        enters.clear();
        exits.clear();
    }
};

/// Sort key of an event: its time and shapes, then its index, so that events of one pair at one time keep the order in which they happened.
struct EventKey
{
    std::uint64_t time_and_first;
    std::uint64_t second_and_place;
    friend auto operator<=>(const EventKey&, const EventKey&) = default;
};

/// An impact that is passed to a body's force law in the next step.
struct PendingImpact
{
    std::int32_t body = none;
    ImpactEvent event{};
};

struct SceneData
{
    SceneDef def{};
    Tolerances tolerances{};
    SceneState state{};
    // Beside the state, by slot: restoring a snapshot keeps it.
    std::vector<std::uint64_t> body_user_data;
    std::vector<std::uint64_t> shape_user_data;
    std::vector<std::uint64_t> joint_user_data;
    std::vector<ForceLaw> laws; ///< by body slot, up to the last body that has had one
    std::vector<std::shared_ptr<const ShapeCallbacks>>
        callbacks; ///< by shape slot, likewise; a running callback may replace or destroy them
    Events events{};
    std::array<std::vector<EventKey>, 2> event_keys{}; ///< scratch memory: for impacts, and for other events
    Events pending{}; ///< ends and exits that user calls cause between steps; delivered with the next step
    std::vector<PendingImpact> pending_impacts;
    StepReport report{};
    Scratch scratch{};
    ForcedPolicy forced_policy{}; ///< set by tests alone
    int callback_count = 0;       ///< number of shapes with callbacks
    int law_count = 0;            ///< number of bodies with a force law
    bool stepping = false;
    int frame_step = 0; ///< index of the step within update()
};

} // namespace carom::internal
