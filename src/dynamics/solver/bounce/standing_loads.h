#pragma once

// Loads that a blow takes back. A constraint stops a body before it meets what it strikes, up to a sub-step early, and contacts that the blow relieves give back
// the loads that they have borne in this sub-step: a block that rocks from edge to edge would lose a tenth of its speed. But no blow undoes a load. So relieved
// contacts get back what they would have borne until the bodies meet.
//
// Speeds are those at the middle of a sub-step that is over, as symplectic Euler steps have them. Bodies that meet at the share t of the next sub-step have been
// under load for t + 1/2 of it, and that much is missing beside the load of this sub-step.
//
// A constraint often takes an approach in two parts: in the first sub-step so much that the bodies meet at the end of the second. The load that the first part
// takes is missing too, and comes back when the point is relieved.
//
// Outside of lanes, all blows of an island are settled at once. In lanes, each struck contact is settled with the contacts that it has relieved, as far as its
// thread may change them. Joints that are solved at once, and scenes of one sub-step, in which nothing tells a blow from a load, do without.

#include "dynamics/solver/bounce/pushes.h"
#include "dynamics/step_context.h"

#include <limits>
#include <span>

namespace carom::internal {

/// Blocks of lanes that one thread may change now.
struct OwnBlocks
{
    int first = 0;
    int end = 0;
};

class StandingLoads
{
public:
    StandingLoads(const StepContext& ctx, const Island& island, IslandOutput& output, const SolverView& view,
                  const Pushes& pushes)
        : m_ctx(ctx), m_island(island), m_output(output), m_view(view), m_pushes(pushes)
    {}

    /// For all lanes in a sub-step that have lost a load, before any bounces.
    void note_relieved(std::int32_t lane);
    void forget_relieved();

    /// Called before the lane `struck` bounces, in sub-step k. True if any load was given back: then no impulse of the blow may warm start the next sub-step.
    /// share: of the next sub-step that passes until the bodies meet. `blows` is scratch memory.
    bool give_back(ContactConstraint& struck, float share, int k, OwnBlocks own, SettledBlows& blows) const;
    /// The same for all constraints outside of lanes.
    bool give_back(std::span<ContactConstraint> constraints, SettledBlows& blows) const;

    /// The share of the next sub-step until bodies meet.
    [[nodiscard]] float share_of(float gap, float approach) const;

private:
    void settle(SettledBlows& blows, float share) const;
    [[nodiscard]] bool yields(const ContactConstraint& struck, std::int32_t state) const;
    void find_relieved(const ContactConstraint& struck, int k, OwnBlocks own, SettledBlows& blows) const;
    void find_relieved(const ContactConstraint& struck, std::int32_t state, int k, OwnBlocks own, SettledBlows& blows) const;

    const StepContext& m_ctx;
    const Island& m_island;
    IslandOutput& m_output;
    const SolverView& m_view;
    const Pushes& m_pushes;
};

/// The mean load that a point has borne in a step of `substeps` before the last of them, N s.
[[nodiscard]] float load_before_last(const PointImpulses& last, int substeps);
/// The same for the points of the constraint in a lane, in sub-step k.
void note_standing_loads(const StepContext& ctx, int k, std::int32_t lane, ContactConstraint& constraint);
/// Notes that points of a lane bear no load any more: no blow of a later sub-step has relieved them. One that is no farther apart than `far`, m, may
/// pause for a sub-step: the impulses of a load vary from sub-step to sub-step as the body turns.
void note_lost_loads(Scratch& scratch, std::int32_t lane, float far = -std::numeric_limits<float>::max());

} // namespace carom::internal
