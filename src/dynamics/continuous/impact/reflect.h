#pragma once

// Simultaneous impacts: impulses at all contacts of several bodies that touch at the same moment. Bodies and contacts are numbers here;
// impact.cpp provides them.
//
// Generalized reflections (Smith, Kaufman, Vouga, Tamstorf, Grinspun 2012): the contacts that approach are reflected together, each with its
// own restitution. That may make others approach, which are reflected next, until none approaches. A row of touching balls passes the
// impulse on from ball to ball, and two corners that strike together bounce together. In every round the impulses x solve
//
//   w = A x + (1 + e) u - kick >= 0,   x >= 0,   x w = 0        A = J M^-1 J^T, u the approaching rates
//
// so that the energy changes by sum of x u (1 - e) / 2 <= 0: it never rises, whatever the e of each contact (apart from kicks).

#include "carom/math.h"
#include "dynamics/solver/effective_mass.h"

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

    [[nodiscard]] InverseMass<double> inverse() const { return {inverse_mass_x, inverse_mass_y, inverse_inertia}; }
};

/// d(gap)/dt = n · (vb - va) + turn_b wb - turn_a wa: n runs from a to b, turn = arm x n. The tangent is perp(n).
struct ImpactRow
{
    enum class Kind : std::uint8_t
    {
        Contact,
        Limit,     ///< of a joint: pushes and never pulls, no friction
        Bilateral, ///< bilateral row of a joint: its rate is kept
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

/// An impact of one row in one round: each approach is a blow of its own. Friction belongs to the last blow of its row, and so does the
/// impulse that stops a contact which friction presses in again.
struct Blow
{
    int row = 0;
    int round = 0;       ///< blows of one round act at once
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

/// Called for each row that approaches, with its speed.
using BounceLaw = std::function<Bounce(int row, double approach)>;

/// Budget of impacts, in solved rows.
struct ImpactWork
{
    std::int64_t left = std::int64_t{1} << 60;
    std::int64_t whole = left;

    void spend(std::size_t rows) { left -= static_cast<std::int64_t>(rows); }
    [[nodiscard]] bool is_whole() const { return left == whole; }
    [[nodiscard]] bool is_spent() const { return left <= 0; }
};

/// Changes the velocities of the bodies, fills in the rows and appends the blows. Approaches slower than `least` count as none. False if the
/// bodies are jammed, with no way to go between others that close in on them, or if the work is spent: energy has not risen, but some rows
/// still approach. `grow`, before each round, may add bodies and rows that the last one has reached.
[[nodiscard]] bool reflect(
    std::vector<ImpactBody>& bodies, std::vector<ImpactRow>& rows, double least, const BounceLaw& law, ImpactWork& work,
    std::vector<Blow>& blows, const std::function<void()>& grow = [] {});

/// A row that does not separate: its accelerations without the resting forces, and the forces.
struct RestingForce
{
    int row = 0;
    double gap = 0;      ///< acceleration of the gap
    double slip = 0;     ///< tangential acceleration that friction has to cancel so that the slip ends with the time considered
    double force = 0;    ///< result: > 0 holds
    double friction = 0; ///< along the tangent, on b
    double limit = 0;    ///< of the friction, N
};

/// Computes the forces of pressing contacts, with friction: fills in the forces and adds their effect to `accelerations` (bodies whose
/// velocities are accelerations; a body that must not yield has zero inverse mass).
void press(std::vector<ImpactBody>& accelerations, const std::vector<ImpactRow>& rows, std::vector<RestingForce>& resting_forces);

/// Rate of the gap; speed of b's surface against a's along the tangent.
[[nodiscard]] double gap_rate(const std::vector<ImpactBody>& bodies, const ImpactRow& row);
[[nodiscard]] double slip_rate(const std::vector<ImpactBody>& bodies, const ImpactRow& row);
[[nodiscard]] ContactVelocities contact_velocities(const std::vector<ImpactBody>& bodies, const ImpactRow& row);

} // namespace carom::internal
