#pragma once

// What happens when several bodies touch at the same moment: impulses at all their contacts. Bodies and contacts here are numbers; where
// they come from is the business of impact.cpp.
//
// Generalised reflections (Smith, Kaufman, Vouga, Tamstorf, Grinspun 2012): the contacts that approach are reflected together, each to its
// own restitution; that may make others approach, which are reflected next, until none approaches. A row of touching balls passes the
// impulse on from ball to ball, and two corners that strike together bounce together. In every round the impulses x solve
//
//   w = A x + (1 + e) u - kick >= 0,   x >= 0,   x w = 0        A = J M^-1 J^T, u the approaching rates
//
// so that the energy changes by sum of x u (1 - e) / 2 <= 0: it never rises, whatever the e of each contact (kicks apart).

#include "carom/math.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace carom::internal {

struct ImpactBody
{
    double vx = 0;
    double vy = 0;
    double w = 0;
    double inverse_mass_x = 0;
    double inverse_mass_y = 0;
    double inverse_inertia = 0;
};

/// d(gap)/dt = n · (vb - va) + turn_b wb - turn_a wa: n runs from a to b, turn = arm x n. The tangent is perp(n).
struct ImpactRow
{
    enum class Kind : std::uint8_t
    {
        Contact,
        Limit,          ///< of a joint: pushes and never pulls, no friction
        RestingContact, ///< of a joint: its rate stays what it is
    } kind = Kind::Contact;
    int a = 0;
    int b = 0;
    double nx = 0;
    double ny = 0;
    double turn_a = 0;
    double turn_b = 0;
    double arm_a_x = 0; ///< contacts: from the body's reference point to the contact
    double arm_a_y = 0;
    double arm_b_x = 0;
    double arm_b_y = 0;
    double friction = 0;
    double surface_speed = 0; ///< of b against a along the tangent
    // The result, summed over all rounds.
    int last_blow = -1; ///< -1: it never approached
    double normal = 0;  ///< impulse
    double tangent = 0; ///< along perp(n), on b
    double energy_lost = 0;
};

/// Velocities of the two bodies of a row at its contact.
struct ContactVelocities
{
    double ax = 0;
    double ay = 0;
    double bx = 0;
    double by = 0;
};

/// One row in one round: each approach is a blow of its own. Friction goes to the last blow of its row, and so does the impulse that stops a contact
/// which friction presses in again.
struct Blow
{
    int row = 0;
    int round = 0;       ///< those of a round strike at once
    double approach = 0; ///< m/s, > 0
    double restitution = 0;
    double kick = 0;    ///< m/s
    double normal = 0;  ///< impulse
    double tangent = 0; ///< along perp(n), on b
    ContactVelocities before{};
    ContactVelocities after{};
};

struct Bounce
{
    double restitution = 0;
    double kick = 0;
};

/// Asked for each row when it approaches, with its speed.
using BounceLaw = std::function<Bounce(int row, double approach)>;

/// What impacts may cost, in rows that are solved.
struct ImpactWork
{
    std::int64_t left = std::int64_t{1} << 60;
    std::int64_t whole = left;

    void spend(std::size_t rows) { left -= static_cast<std::int64_t>(rows); }
    [[nodiscard]] bool is_whole() const { return left == whole; }
    [[nodiscard]] bool is_spent() const { return left <= 0; }
};

/// Changes the velocities of the bodies, fills in the rows and appends the blows. Approaches slower than `least` count as none. False where they are
/// jammed, for between what closes in on them there is no way to go, or the work is spent: energy has not risen, but some still approach.
[[nodiscard]] bool reflect(std::vector<ImpactBody>& bodies, std::vector<ImpactRow>& rows, double least, const BounceLaw& law,
                           ImpactWork& work, std::vector<Blow>& blows);

/// How a row that no longer parts would accelerate without the forces asked for.
struct RestingForce
{
    int row = 0;
    double gap = 0; ///< acceleration of the gap
    double slip =
        0; ///< acceleration along the tangent that would stop the slip by the end of the time looked at, less the one there is
    double force = 0;    ///< comes out: > 0 holds
    double friction = 0; ///< along the tangent, on b
    double limit = 0;    ///< of the friction, N
};

/// Contact forces of what presses, with friction: fills in the forces and adds what they do to `accelerations` (bodies whose velocities are
/// accelerations; those that are not to give way have no inverse mass).
void press(std::vector<ImpactBody>& accelerations, const std::vector<ImpactRow>& rows, std::vector<RestingForce>& resting_forces);

/// Rate of the gap, and of b's surface against a's along the tangent.
[[nodiscard]] double gap_rate(const std::vector<ImpactBody>& bodies, const ImpactRow& row);
[[nodiscard]] double slip_rate(const std::vector<ImpactBody>& bodies, const ImpactRow& row);
[[nodiscard]] ContactVelocities contact_velocities(const std::vector<ImpactBody>& bodies, const ImpactRow& row);

} // namespace carom::internal
