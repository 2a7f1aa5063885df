#pragma once

/// @file
/// The cost of a step and its numbers of bodies, pairs, islands and impacts: read it after Scene::step.

#include "carom/id.h"
#include "carom/math.h"

#include <cstdint>
#include <vector>

namespace carom {

/// Wall time of each stage, ms, in the order in which they run.
struct StageTimes
{
    float sweep = 0;    ///< paths and boxes of what moves
    float pairs = 0;    ///< broad phase
    float contacts = 0; ///< narrow phase
    float islands = 0;  ///< islands, colours, constraint rows
    float solve = 0;    ///< all sub-steps: rows, flight, relaxation
    float commit = 0;   ///< poses, boxes, sleep
    float events = 0;   ///< events and callbacks
    float total = 0;
};

/// Conditions that a shipped game can meet; each says the cure.
enum class StepFlag : std::uint32_t
{
    /// A body's state became non-finite. It was put back and disabled; see StepReport::quarantined. Look for huge forces,
    /// impulses or masses near zero.
    BodyQuarantined = 1u << 0,
    /// A body hit things more often in one sub-step than is resolved exactly (64 times, 16 in a crowd); it stopped at the last impact,
    /// or went on as one with what it was jammed with. Use a smaller step, or check for a ball locked between two moving walls.
    ImpactsCapped = 1u << 1,
    /// More colours than the constraint graph has: some contacts are solved serially. Check for one dynamic body
    /// that touches very many others; make it kinematic or static, or split it.
    ColorsExhausted = 1u << 2,
    /// Scene::update had more time to catch up than its cap; the rest was dropped. Step less or raise SceneDef::max_frame_time.
    TimeDropped = 1u << 3,
};

/// A body's pose at the end of a sub-step.
struct SubstepPose
{
    BodyId body{};
    float time = 0; ///< within the step, s
    Pose pose{};
};

struct StepReport
{
    StageTimes ms;
    std::uint32_t flags = 0; ///< bits of StepFlag
    int bodies = 0;          ///< all in the scene
    int awake_bodies = 0;    ///< dynamic and kinematic ones that were simulated
    int shapes = 0;
    int joints = 0;
    int pairs = 0;    ///< pairs of shapes that may meet in the step, one awake, touching or not
    int touching = 0; ///< awake pairs that touch
    int islands = 0;  ///< groups solved on their own
    int colors = 0;   ///< of the largest island
    int substeps = 0;
    int flight_bodies = 0;  ///< balls that flew free in this step
    int flight_impacts = 0; ///< impacts resolved at their own time
    int bulk_impacts = 0;   ///< impacts resolved at the end of a sub-step
    int slept = 0;          ///< bodies put to sleep
    int woken = 0;
    std::vector<BodyId> quarantined{};
    std::vector<SubstepPose> substep_poses{}; ///< awake bodies, when SceneDef::record_substeps is set

    [[nodiscard]] bool has(StepFlag flag) const { return (flags & static_cast<std::uint32_t>(flag)) != 0; }
};

} // namespace carom
