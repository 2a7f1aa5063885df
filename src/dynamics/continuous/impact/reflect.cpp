// Simultaneous impacts, see reflect.h: rounds of reflections, each solved by projected Gauss-Seidel.

#include "dynamics/continuous/impact/reflect.h"

#include "dynamics/continuous/impact/impact_rows.h"
#include "dynamics/solver/contact/contact_equations.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace carom::internal {

namespace {

constexpr int passes_with_rising_friction = 20; // in a steep wedge normal force and friction would raise each other without end
constexpr int pass_limit = 100;
constexpr int least_passes = 4; // when the work is spent

// Demand on a row in a round: its rate is to grow by at least `wanted`; rows of joints by exactly that.
struct Demand
{
    int row = 0;
    double wanted = 0;
    double impulse = 0;
};

// Projected Gauss-Seidel to the rounding of a double: one row or two need one pass, a few rows some passes, and redundant rows do no harm.
// `change` holds the change of the velocities so far: bodies that start at rest.
class Passes
{
public:
    Passes(Bodies& change, const std::vector<ImpactRow>& rows) : m_change(change), m_rows(rows) {}

    /// Solves one row, or it and the next: the impulses bring their rates to `wanted` at least. Returns the number of rows.
    std::size_t take(std::vector<Demand>& demands, std::size_t i)
    {
        if (i + 1 < demands.size() && are_a_pair(m_rows, demands[i].row, demands[i + 1].row) &&
            take_two(demands[i], demands[i + 1]))
            return 2;
        take_one(demands[i]);
        return 1;
    }

    double worst = 0; ///< change of a rate in this pass

private:
    [[nodiscard]] const ImpactRow& row(const Demand& d) const { return m_rows[static_cast<std::size_t>(d.row)]; }

    void take_one(Demand& d)
    {
        const Direction n = normal_of(row(d));
        const double k = compliance(m_change, row(d), n);
        if (!(k > 0))
            return;
        double impulse = d.impulse - (rate_along(m_change, row(d), n) - d.wanted) / k;
        if (row(d).kind != ImpactRow::Kind::Bilateral)
            impulse = std::max(impulse, 0.0);
        set(d, impulse, k);
    }

    bool take_two(Demand& p, Demand& q)
    {
        const double k11 = compliance(m_change, row(p), normal_of(row(p)));
        const double k22 = compliance(m_change, row(q), normal_of(row(q)));
        const double k12 = couple(m_change, row(p), row(q));
        const double b1 = gap_rate(m_change, row(p)) - p.wanted - (k11 * p.impulse + k12 * q.impulse);
        const double b2 = gap_rate(m_change, row(q)) - q.wanted - (k12 * p.impulse + k22 * q.impulse);
        const std::optional<Two> both = solve_two(k11, k12, k22, b1, b2);
        if (!both)
            return false;
        set(p, both->x, k11);
        set(q, both->y, k22);
        return true;
    }

    void set(Demand& d, double impulse, double k)
    {
        push_along(m_change, row(d), normal_of(row(d)), impulse - d.impulse);
        worst = std::max(worst, std::fabs(impulse - d.impulse) * k);
        d.impulse = impulse;
    }

    Bodies& m_change;
    const std::vector<ImpactRow>& m_rows;
};

constexpr double agreed = 1e-6; // of what is demanded: rates that change by less from pass to pass add no energy to speak of

// False if the rows have not converged, or the work is spent before.
bool satisfy(Bodies& change, const std::vector<ImpactRow>& rows, std::vector<Demand>& demands, ImpactWork& work)
{
    double scale = 0;
    for (const Demand& d : demands)
        scale = std::max(scale, std::fabs(d.wanted));
    Passes passes(change, rows);
    for (int pass = 0; pass < pass_limit; ++pass)
    {
        passes.worst = 0;
        for (std::size_t i = 0; i < demands.size();)
            i += passes.take(demands, i);
        work.spend(demands.size());
        if (passes.worst <= 1e-12 * scale)
            return true;
        if (work.is_spent() && pass + 1 >= least_passes)
            return false;
    }
    return passes.worst <= agreed * scale;
}

// The product v M u.
double product(const Bodies& v, const Bodies& u)
{
    double sum = 0;
    const auto over = [](double value, double inverse_mass) { return inverse_mass > 0 ? value / inverse_mass : 0; };
    for (std::size_t i = 0; i < v.size(); ++i)
        sum += over(v[i].vx * u[i].vx, v[i].inverse_mass_x) + over(v[i].vy * u[i].vy, v[i].inverse_mass_y) +
               over(v[i].w * u[i].w, v[i].inverse_inertia);
    return sum;
}

// An inexact change is scaled down until it adds no energy: beyond twice the distance to the least energy it would add some. The full change
// is the reflection without loss.
double part_without_gain(const Bodies& bodies, const Bodies& change)
{
    const double square = product(change, change);
    return square > 0 ? std::clamp(-2 * product(bodies, change) / square, 0.0, 1.0) : 0;
}

Bodies at_rest(const Bodies& bodies)
{
    Bodies rest = bodies;
    for (ImpactBody& b : rest)
        b.vx = b.vy = b.w = 0;
    return rest;
}

void give(Bodies& bodies, std::vector<ImpactRow>& rows, const std::vector<Demand>& demands)
{
    const auto half_the_work = [&]
    {
        for (const Demand& d : demands)
        {
            ImpactRow& row = rows[static_cast<std::size_t>(d.row)];
            row.energy_lost -= 0.5 * d.impulse * gap_rate(bodies, row);
        }
    };
    half_the_work();
    for (const Demand& d : demands)
    {
        ImpactRow& row = rows[static_cast<std::size_t>(d.row)];
        row.normal += d.impulse;
        push_along(bodies, row, normal_of(row), d.impulse);
    }
    half_the_work();
}

// Applies the impulses that produce the demanded rates.
void answer(Bodies& bodies, std::vector<ImpactRow>& rows, std::vector<Demand>& demands, ImpactWork& work)
{
    Bodies change = at_rest(bodies);
    if (!satisfy(change, rows, demands, work))
    {
        const double part = part_without_gain(bodies, change);
        for (Demand& d : demands)
            d.impulse *= part;
    }
    give(bodies, rows, demands);
}

enum class Asked : std::uint8_t
{
    Approaching, ///< reflections: rows that approach, and no others
    All          ///< no other row may be made to approach
};

// The state of an impact that is being resolved, round after round.
struct Impact
{
    Bodies& bodies;
    std::vector<ImpactRow>& rows;
    double least;
    ImpactWork& work;
    std::vector<Blow>& blows;
    const std::function<void()>& grow;
    int round = 0;
    bool is_rubbing = false; ///< impulses during friction belong to the blows before it
};

ContactVelocities plus(const ContactVelocities& v, const ContactVelocities& u, double sign)
{
    return {v.ax + sign * u.ax, v.ay + sign * u.ay, v.bx + sign * u.bx, v.by + sign * u.by};
}

// Until it is closed, a blow collects all impulses of its row.
void open(const Impact& impact, const ImpactRow& row, Blow& blow)
{
    blow.normal -= row.normal;
    blow.tangent -= row.tangent;
    blow.after = plus(blow.after, contact_velocities(impact.bodies, row), -1);
}

void close(const Impact& impact, const ImpactRow& row, Blow& blow)
{
    blow.normal += row.normal;
    blow.tangent += row.tangent;
    blow.after = plus(blow.after, contact_velocities(impact.bodies, row), 1);
}

template <class Change>
void for_each_last_blow(const Impact& impact, const Change& change)
{
    for (const ImpactRow& row : impact.rows)
    {
        if (row.last_blow >= 0)
            change(impact, row, impact.blows[static_cast<std::size_t>(row.last_blow)]);
    }
}

void begin_blow(const Impact& impact, int index, double approach, const Bounce& bounce)
{
    ImpactRow& row = impact.rows[static_cast<std::size_t>(index)];
    if (impact.is_rubbing && row.last_blow >= 0)
        return;
    row.last_blow = static_cast<int>(impact.blows.size());
    const ContactVelocities before = contact_velocities(impact.bodies, row);
    impact.blows.push_back({.row = index,
                            .round = impact.round,
                            .approach = approach,
                            .restitution = bounce.restitution,
                            .kick = bounce.kick,
                            .before = before,
                            .after = before});
    open(impact, row, impact.blows.back());
}

double greatest_approach(const Bodies& bodies, const std::vector<ImpactRow>& rows)
{
    double greatest = 0;
    for (const ImpactRow& row : rows)
    {
        if (row.kind != ImpactRow::Kind::Bilateral)
            greatest = std::max(greatest, -gap_rate(bodies, row));
    }
    return greatest;
}

// Fraction of the fastest approach: a slower contact is at rest, and a later round reflects it after this one's impulses.
constexpr double slow = 1e-3;

// A round of reflections; false if no row approaches.
bool reflect_once(Impact& impact, const BounceLaw& law, Asked asked = Asked::Approaching)
{
    std::vector<Demand> demands;
    const std::size_t first_blow = impact.blows.size();
    ++impact.round;
    bool approaching = false;
    impact.grow();
    const double least = std::max(impact.least, slow * greatest_approach(impact.bodies, impact.rows));
    for (std::size_t i = 0; i < impact.rows.size(); ++i)
    {
        const ImpactRow& row = impact.rows[i];
        if (row.kind == ImpactRow::Kind::Bilateral)
        {
            demands.push_back({static_cast<int>(i)});
            continue;
        }
        const double u = -gap_rate(impact.bodies, row);
        if (u <= least)
        { // a limit that a body leans on is as hard as the world
            if (row.kind == ImpactRow::Kind::Limit && u > -impact.least)
                demands.push_back({static_cast<int>(i)});
            else if (asked == Asked::All)
                demands.push_back({static_cast<int>(i), u});
            continue;
        }
        approaching = true;
        const Bounce bounce = law(static_cast<int>(i), u);
        begin_blow(impact, static_cast<int>(i), u, bounce);
        demands.push_back({static_cast<int>(i), (1 + bounce.restitution) * u + bounce.kick});
    }
    if (!approaching)
        return false;
    answer(impact.bodies, impact.rows, demands, impact.work);
    if (!impact.is_rubbing)
    {
        for (std::size_t i = first_blow; i < impact.blows.size(); ++i)
            close(impact, impact.rows[static_cast<std::size_t>(impact.blows[i].row)], impact.blows[i]);
    }
    return true;
}

// Coulomb's law on the whole normal impulse, row after row: each row takes energy or none.
void rub(Bodies& bodies, std::vector<ImpactRow>& rows)
{
    for (int round = 0; round < 8; ++round)
    {
        for (ImpactRow& row : rows)
        {
            if (row.kind != ImpactRow::Kind::Contact || row.normal <= 0 || row.friction <= 0)
                continue;
            const Direction t = tangent_of(row);
            const double k = compliance(bodies, row, t);
            if (!(k > 0))
                continue;
            const double slip = rate_along(bodies, row, t);
            const double limit = row.friction * row.normal;
            const double wanted = friction_impulse(row.tangent, 1 / k, slip - row.surface_speed, limit);
            const double change = wanted - row.tangent;
            row.energy_lost -= change * (slip + 0.5 * k * change);
            row.tangent = wanted;
            push_along(bodies, row, t, change);
        }
    }
}

// Friction of pressing contacts, toward zero slip at the end of the time considered.
void rub_resting(Bodies& accelerations, const std::vector<ImpactRow>& rows, RestingForce& p)
{
    const ImpactRow& row = rows[static_cast<std::size_t>(p.row)];
    const Direction t = tangent_of(row);
    const double k = compliance(accelerations, row, t);
    const double along = k > 0 ? p.friction - (p.slip + rate_along(accelerations, row, t)) / k : 0;
    const double friction = p.limit > 0 ? std::clamp(along, -p.limit, p.limit) : 0;
    push_along(accelerations, row, t, friction - p.friction);
    p.friction = friction;
}

constexpr int round_limit = 64;
constexpr int one_by_one = 8; // rounds that solve approaching rows only: in more they pass the impulse to and fro

// Joints that the solver pulls together have a closing rate; kept through an impact, it would do work.
void stop_bilateral_rows(Bodies& bodies, std::vector<ImpactRow>& rows, ImpactWork& work)
{
    std::vector<Demand> demands;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        if (rows[i].kind == ImpactRow::Kind::Bilateral)
            demands.push_back({static_cast<int>(i), -gap_rate(bodies, rows[i])});
    }
    if (!demands.empty())
        answer(bodies, rows, demands, work);
}

} // namespace

double gap_rate(const Bodies& bodies, const ImpactRow& row) { return rate_along(bodies, row, normal_of(row)); }

double slip_rate(const Bodies& bodies, const ImpactRow& row)
{
    return rate_along(bodies, row, tangent_of(row)) - row.surface_speed;
}

ContactVelocities contact_velocities(const Bodies& bodies, const ImpactRow& row)
{
    const ImpactBody& a = bodies[static_cast<std::size_t>(row.a)];
    const ImpactBody& b = bodies[static_cast<std::size_t>(row.b)];
    return {a.vx - a.w * row.arm_a_y, a.vy + a.w * row.arm_a_x, b.vx - b.w * row.arm_b_y, b.vy + b.w * row.arm_b_x};
}

bool reflect(Bodies& bodies, std::vector<ImpactRow>& rows, double least, const BounceLaw& law, ImpactWork& work,
             std::vector<Blow>& blows, const std::function<void()>& grow)
{
    Impact impact{bodies, rows, least, work, blows, grow};
    grow();
    const BounceLaw still = [](int, double) { return Bounce{}; };
    stop_bilateral_rows(bodies, rows, work);
    int round = 0;
    while (round < round_limit && reflect_once(impact, law) && !work.is_spent())
        ++round;
    // A ball between two closing bodies bounces for ever: the rest is solved without restitution. A long row of bodies only takes its time; a jam
    // makes no progress.
    double half_way = 0;
    while (round < 2 * round_limit && !work.is_spent() && reflect_once(impact, still, Asked::All))
    {
        if (++round == round_limit + round_limit / 2)
            half_way = greatest_approach(bodies, rows);
    }
    if (work.is_spent())
        return false;
    if (round == 2 * round_limit && greatest_approach(bodies, rows) > 0.99 * half_way)
        return false;
    for_each_last_blow(impact, open);
    impact.is_rubbing = true;
    rub(bodies, rows);
    // Friction on an arm may press another point in.
    for (round = 0; round < round_limit; ++round)
    {
        if (!reflect_once(impact, still, round < one_by_one ? Asked::Approaching : Asked::All))
            break;
    }
    for_each_last_blow(impact, close);
    return !work.is_spent();
}

void press(Bodies& accelerations, const std::vector<ImpactRow>& rows, std::vector<RestingForce>& resting_forces)
{
    std::vector<Demand> demands;
    for (const RestingForce& p : resting_forces)
        demands.push_back({p.row, -p.gap});
    Passes passes(accelerations, rows);
    for (int pass = 0; pass < pass_limit; ++pass)
    {
        passes.worst = 0;
        for (std::size_t i = 0; i < demands.size();)
            i += passes.take(demands, i);
        for (std::size_t i = 0; i < resting_forces.size(); ++i)
        {
            RestingForce& p = resting_forces[i];
            p.force = demands[i].impulse;
            if (pass < passes_with_rising_friction)
                p.limit = rows[static_cast<std::size_t>(p.row)].friction * p.force;
            rub_resting(accelerations, rows, p);
        }
        if (passes.worst <= 1e-10)
            return;
    }
}

} // namespace carom::internal
