// The force law along a joint's free axis and its solution. With k the inverse mass along the axis and x0 the rate without impulse, the solution of
// x = x0 + k p(x) is:
//
//   spring alone   x1 = (c x0 + k r) / (c + k), from p = (r - x) / c; with the spring, the inverse mass of the axis is k1 = k c / (c + k)
//   with a motor   x2 = target, but no farther from x1 than k1 * most
//   with stops     x  = x2 within [lower, upper]
//
// The impulse of a spring over a sub-step is h F, with F taken at the fraction theta of the sub-step: F = -k_s (e + theta h x) - c_s x. The part theta
// of the impulse acts before the bodies move, so that x is the mean rate of the drift, and the rest acts after. theta = 1/2 is the midpoint rule, which
// keeps the energy of a free oscillation at any stiffness; theta = 1 is implicit Euler, which damps it. Both are stable at any stiffness and damping.

#include "dynamics/solver/joint/joint_axis.h"

#include "carom/math.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

// The greatest omega h of an oscillation that the midpoint rule follows. A sub-step sees only every other swing of a faster one.
constexpr float followed = 1;

double stop_rate(float error, float h) { return static_cast<double>(-(error > 0 ? error : way_back * error) / h); }

} // namespace

float least_theta(float turn) { return turn > followed ? 1 - 0.5f * followed / turn : 0.5f; }

AxisSpring make_spring(float hertz, float damping_ratio, float mass, float h, float most_turn)
{
    const float turn = 2 * pi * hertz * h;
    const float followed_turn = std::min(turn, most_turn);
    const float drag = std::min(2 * damping_ratio * turn, most_turn);
    return {mass * followed_turn * followed_turn / (h * h), mass * drag / h, least_theta(followed_turn)};
}

SpringLine AxisSpring::line(float stretch, float h) const
{
    if (!is_there())
        return {};
    const auto k = static_cast<double>(stiffness);
    const auto t = static_cast<double>(theta);
    const auto step = static_cast<double>(h);
    const double drag = k * t * step + static_cast<double>(damping);
    return {-k * static_cast<double>(stretch) / drag, 1 / (t * step * drag)};
}

AxisPiece AxisLaw::solve(double free_rate, double inverse_mass) const
{
    AxisPiece piece;
    piece.spring = spring;
    if (soft_lower.is_there() && free_rate < soft_lower.rest)
        piece.spring = soft_lower;
    else if (soft_upper.is_there() && free_rate > soft_upper.rest)
        piece.spring = soft_upper;
    const double c = piece.spring.compliance;
    const double sprung = c > 0 ? (c * free_rate + inverse_mass * piece.spring.rest) / (c + inverse_mass) : free_rate;
    const double reach = most * (c > 0 ? inverse_mass * c / (c + inverse_mass) : inverse_mass);
    piece.rate = sprung;
    if (most > 0)
    {
        const double wanted = target - sprung;
        piece.kind = std::fabs(wanted) < reach ? AxisPiece::Kind::Driven : AxisPiece::Kind::Free;
        piece.constant = wanted < 0 ? -most : most;
        piece.rate = sprung + std::clamp(wanted, -reach, reach);
    }
    if (piece.rate <= lower)
        piece.kind = AxisPiece::Kind::AtLower;
    else if (piece.rate >= upper)
        piece.kind = AxisPiece::Kind::AtUpper;
    piece.rate = std::min(std::max(piece.rate, lower), std::max(lower, upper));
    return piece;
}

AxisPiece AxisLaw::neighbour(const AxisPiece& piece, const AxisPiece& towards) const
{
    const int from = place_of(piece);
    const int to = place_of(towards);
    const int displacement = from < to ? 1 : -1;
    int place = from;
    while (place != to)
    {
        place += displacement;
        if (place != to && has_piece_at(place))
            return piece_at(place, towards.spring);
    }
    return towards;
}

// Positions in the order of the rate: the lower stop is at -2, the motor's greatest impulse at -1, the motor that keeps its rate at 0, and so on. Without a
// motor, 0 is the free piece.
int AxisLaw::place_of(const AxisPiece& piece) const
{
    using Kind = AxisPiece::Kind;
    if (piece.is_at_stop())
        return piece.kind == Kind::AtLower ? -2 : 2;
    return piece.kind == Kind::Driven || most == 0 ? 0 : piece.constant > 0 ? -1 : 1;
}

// Whether the law has a piece at this position between the stops.
bool AxisLaw::has_piece_at(int place) const
{
    if (most == 0)
        return place == 0;
    return (place > 0 || target > lower) && (place < 0 || target < upper);
}

AxisPiece AxisLaw::piece_at(int place, SpringLine with) const
{
    AxisPiece piece;
    piece.spring = with;
    piece.kind = place == 0 && most > 0 ? AxisPiece::Kind::Driven : AxisPiece::Kind::Free;
    piece.rate = target;
    piece.constant = place < 0 ? most : -most;
    return piece;
}

AxisImpulses AxisLaw::split(const AxisPiece& piece, double impulse, double rate) const
{
    using Kind = AxisPiece::Kind;
    AxisImpulses of;
    const double sprung = piece.spring.impulse(rate);
    if (soft_lower.is_there() || soft_upper.is_there())
    {
        of.lower = std::max(sprung, 0.0);
        of.upper = std::max(-sprung, 0.0);
        return of;
    }
    of.spring = sprung;
    const double rest = impulse - sprung;
    if (piece.kind == Kind::Free || piece.kind == Kind::Driven)
    {
        of.motor = std::clamp(rest, -most, most);
        return of;
    }
    const double wanted = target - piece.rate;
    of.motor = wanted == 0 ? std::clamp(rest, -most, most) : std::copysign(most, wanted);
    of.lower = std::max(rest - of.motor, 0.0);
    of.upper = std::max(of.motor - rest, 0.0);
    return of;
}

double AxisActs::comes_beyond(double displacement) const
{
    const auto beyond = [](float error, double towards) { return towards - std::max(static_cast<double>(error), 0.0); };
    const double lower = has_lower && !soft_limits ? beyond(lower_error, -displacement) : 0;
    const double upper = has_upper && !soft_limits ? beyond(upper_error, displacement) : 0;
    return std::max({lower, upper, 0.0});
}

AxisLaw AxisActs::law_ahead(const AxisSpring& own, float h) const
{
    AxisLaw law;
    law.scope = {true, true, true};
    law.target = static_cast<double>(motor_speed);
    law.most = static_cast<double>(h * most);
    if (has_spring)
        law.spring = own.line(stretch, h);
    if (has_lower && soft_limits)
        law.soft_lower = own.line(lower_error, h);
    else if (has_lower)
        law.lower = stop_rate(lower_error, h);
    if (has_upper && soft_limits)
        law.soft_upper = own.line(-upper_error, h);
    else if (has_upper)
        law.upper = -stop_rate(upper_error, h);
    return law;
}

AxisLaw AxisActs::law_now(const AxisImpulses& borne, const float (&bounce)[2], float h) const
{
    AxisLaw law;
    law.scope = {.motor = true, .limits = !soft_limits};
    law.target = static_cast<double>(motor_speed);
    law.most = static_cast<double>(h * most);
    const auto leave = [&](float error, double impulse, float speed)
    { return static_cast<double>(speed > 0 || impulse > 0 ? speed : -std::max(error, 0.0f) / h); };
    if (has_lower && !soft_limits)
        law.lower = leave(lower_error, borne.lower, bounce[0]);
    if (has_upper && !soft_limits)
        law.upper = -leave(upper_error, borne.upper, bounce[1]);
    return law;
}

} // namespace carom::internal
