#pragma once

// Strikes: points that are met in a sub-step by bodies under load, as when a rocking block changes its edge. A constraint that stops a body on its way changes
// its momentum too early, and loads of the sub-step that end with the blow would have no part in it. So motion and momentum are solved apart: struck points
// lead the motion, so that it ends where they meet, but momentum is that of bodies that do not meet, carried to the time of the meeting. There, the impact
// changes it, and from there it goes on to the end of the sub-step.
//
// Speeds are those at the middle of a sub-step that is over, as symplectic Euler steps have them: an impact at the share t of the next sub-step finds bodies
// that have been accelerated for t + 1/2 of it, and leaves them 1/2 - t of it until the next middle.

#include "dynamics/solver/solved_island.h"

namespace carom::internal {

class Strikes
{
public:
    explicit Strikes(SolvedIsland& work) : m_work(work) {}

    /// Lets those unloaded points wait that present speeds, faster than at rest, bring together within the next sub-step.
    void expect();
    /// Called once the other points are solved, without bias: finds out whether the bodies meet indeed, and notes their momentum then.
    void meet();
    /// Called when the bodies have moved: gives them their momentum at the time of the meeting.
    void go_back();
    /// Sets the loads aside: impacts start without impulses.
    void begin_impacts();
    /// Called after the impacts: accelerates the bodies for a sub-step. Contacts start without impulses again.
    void begin_next();
    /// Called once contacts are solved: keeps as much of that acceleration as belongs to this sub-step, and the loads.
    void finish();
    void end_waiting();

    [[nodiscard]] bool are_expected() const { return m_are_expected; }
    [[nodiscard]] bool are_met() const { return m_are_met; }

private:
    [[nodiscard]] bool is_met(const ContactConstraint& constraint, const ConstraintPoint& p) const;
    template <class Visit>
    void for_each_point(const Visit& visit) const;
    template <class Visit>
    void for_each_body(const Visit& visit);
    void take_arms_of_meeting(ConstraintPoint& p) const;
    void note_arms();
    void note_impulses();
    void lay_impulses_aside();
    static void set_impulses(ContactConstraint& constraint, const ConstraintImpulses& impulses);
    static void add_to_sums(ContactConstraint& constraint, float sign);

    SolvedIsland& m_work;
    float m_time = 0; ///< of the fastest strike, as a share of the sub-step
    bool m_are_expected = false;
    bool m_are_met = false;
};

} // namespace carom::internal
