// Constructors and destructors of a step's containers are defined here alone: otherwise every file that includes them would compile them again.

#include "dynamics/step_context.h"

#include "dynamics/solver/joint/direct/direct_solver.h"

namespace carom::internal {

Scratch::Scratch() = default;
Scratch::~Scratch() = default;

void SettledBlows::clear()
{
    struck.clear();
    copies.clear();
    contacts.clear();
    speeds.clear();
}

ImpactReport::ImpactReport() = default;
ImpactReport::~ImpactReport() = default;
ImpactReport::ImpactReport(ImpactReport&&) noexcept = default;
ImpactReport& ImpactReport::operator=(ImpactReport&&) noexcept = default;

IslandOutput::IslandOutput() = default;
IslandOutput::~IslandOutput() = default;
IslandOutput::IslandOutput(IslandOutput&&) noexcept = default;
IslandOutput& IslandOutput::operator=(IslandOutput&&) noexcept = default;

void IslandOutput::clear()
{
    impacts.clear();
    reported_impacts = 0;
    begins.clear();
    late_constraints.clear();
    deferred.clear();
    stopped_joints.clear();
    kicked_shapes.clear();
    struck_states.clear();
    deflected.clear();
    resting_sets.clear();
    path.clear();
    last_piece.clear();
    poses.clear();
    flight_impacts = 0;
    bulk_impacts = 0;
    capped = false;
    disturbed = false;
}

} // namespace carom::internal
