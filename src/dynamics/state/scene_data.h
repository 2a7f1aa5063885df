#pragma once

// A scene: its state, what lives beside the state (user data, callbacks, force laws), the events of the last step, and
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

/// Lengths and speeds below which things count as equal, from SceneDef::length_scale.
struct Tolerances
{
    float slop = 0;        ///< shapes this near touch; what overlaps by no more may fly
    float speculation = 0; ///< gap within which quiet pairs get constraints
    float keep = 0;        ///< in crowds manifolds are followed until bodies have moved so far against each other
    float box_margin = 0;  ///< how fat boxes are
    float push_speed = 0;  ///< overlap is removed no faster
    float sleep_speed = 0; ///< of bodies that are given none of their own
    float rest_speed = 0;  ///< approach slower than this is not an impact
};

/// A touch that begins, until the events stage.
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

/// What an event is sorted by: its time and its shapes; then where it stood, so that events of one pair at one time keep the order in which they happened.
struct EventKey
{
    std::uint64_t time_and_first;
    std::uint64_t second_and_place;
    friend auto operator<=>(const EventKey&, const EventKey&) = default;
};

/// An impact that a body's force law is to be told in the next step.
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
    // Beside the state, by slot: restored snapshots keep it.
    std::vector<std::uint64_t> body_user_data;
    std::vector<std::uint64_t> shape_user_data;
    std::vector<std::uint64_t> joint_user_data;
    std::vector<ForceLaw> laws; ///< of bodies, as far as any has had one
    std::vector<std::shared_ptr<const ShapeCallbacks>>
        callbacks; ///< of shapes, likewise; one that runs may replace or destroy them
    Events events{};
    std::array<std::vector<EventKey>, 2> event_keys{}; ///< memory: of impacts, and of the others
    Events pending{}; ///< ends and exits that user verbs cause between steps; delivered with the next step
    std::vector<PendingImpact> pending_impacts;
    StepReport report{};
    Scratch scratch{};
    ForcedPolicy forced_policy{}; ///< by tests alone
    int callback_count = 0;       ///< shapes that have callbacks
    int law_count = 0;            ///< bodies that have a force law
    bool stepping = false;
    int frame_step = 0; ///< inside update(): which of its steps
};

} // namespace carom::internal
