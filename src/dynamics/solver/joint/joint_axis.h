#pragma once

// The force law along a joint's free axis: a spring, a motor and two stops as one monotone function from the axis' rate to its impulse. Because the law is
// monotone, rate and impulse have exactly one common solution. It is found from scratch each time, so nothing winds up. See joint_axis.cpp.

#include <limits>

namespace carom::internal {

/// A spring along an axis over a sub-step h: impulse = (rest - rate) / compliance.
struct SpringLine
{
    double rest = 0;       ///< rate at which the spring gives no impulse
    double compliance = 0; ///< rate per impulse; 0: no spring

    [[nodiscard]] bool is_there() const { return compliance > 0; }
    [[nodiscard]] double impulse(double rate) const { return is_there() ? (rest - rate) / compliance : 0; }
};

/// Constants of a joint's spring, computed once per step.
struct AxisSpring
{
    float stiffness = 0; ///< N/m or N m/rad
    float damping = 0;   ///< N s/m or N m s/rad
    /// Time within the sub-step at which the force is taken: 1/2 keeps energy, 1 damps what a sub-step cannot follow.
    float theta = 1;

    [[nodiscard]] bool is_there() const { return stiffness > 0 || damping > 0; }
    [[nodiscard]] bool acts_after() const { return is_there() && theta < 1; }
    /// The impulse before the bodies move, for a given stretch at the start of the sub-step.
    [[nodiscard]] SpringLine line(float stretch, float h) const;
    /// The impulse after the bodies have moved, as a share of the impulse before they move.
    [[nodiscard]] float share_after() const { return (1 - theta) / theta; }
};

/// The spring with this frequency in hertz and this damping ratio under a mass. omega h is at most `most_turn`: a stiffer spring is softened to that.
[[nodiscard]] AxisSpring make_spring(float hertz, float damping_ratio, float mass, float h, float most_turn);

/// The least theta for an oscillation of this omega h.
[[nodiscard]] float least_theta(float turn);

constexpr float way_back = 0.2f;         ///< share of a stop's error that is corrected per sub-step
constexpr float direct_spring_turn = 16; ///< greatest omega h in the direct solve, where it is as good as rigid
constexpr float soft_spring_turn = 0.5f; ///< greatest omega h where rows are solved one after the other

/// The piece of the law that holds at the solution. It keeps a rate at any impulse, or it gives an impulse that a spring may change with the rate.
struct AxisPiece
{
    enum class Kind
    {
        Free,   ///< impulse = constant + spring
        Driven, ///< the motor keeps the rate
        AtLower,
        AtUpper
    };
    Kind kind = Kind::Free;
    double rate = 0;     ///< the solution; exact where the rate is kept
    double constant = 0; ///< impulse of a motor that is at its maximum
    SpringLine spring;

    [[nodiscard]] bool keeps_its_rate() const { return kind != Kind::Free; }
    [[nodiscard]] bool is_at_stop() const { return kind == Kind::AtLower || kind == Kind::AtUpper; }
    [[nodiscard]] double impulse(double at) const { return constant + spring.impulse(at); }
};

/// Impulses along the axis in a sub-step.
struct AxisImpulses
{
    double spring = 0;
    double motor = 0;
    double lower = 0; ///< >= 0
    double upper = 0; ///< >= 0, against the axis

    [[nodiscard]] double sum() const { return spring + motor + lower - upper; }
};

/// The impulses that a law determines; the others are unchanged.
struct AxisScope
{
    bool spring = false;
    bool motor = false;
    bool limits = false;

    [[nodiscard]] double sum(const AxisImpulses& of) const
    {
        return (spring ? of.spring : 0) + (motor ? of.motor : 0) + (limits ? of.lower - of.upper : 0);
    }
    [[nodiscard]] AxisImpulses merge(const AxisImpulses& old, const AxisImpulses& decided) const
    {
        const AxisImpulses& of_limits = limits ? decided : old;
        return {spring ? decided.spring : old.spring, motor ? decided.motor : old.motor, of_limits.lower, of_limits.upper};
    }
};

struct AxisLaw
{
    static constexpr double unbounded = std::numeric_limits<double>::infinity();

    AxisScope scope;
    SpringLine spring;
    SpringLine soft_lower; ///< springs that only push away from a limit
    SpringLine soft_upper;
    double target = 0;         ///< rate of the motor
    double most = 0;           ///< greatest impulse of the motor; 0: no motor
    double lower = -unbounded; ///< rates at which the stops are reached
    double upper = unbounded;

    /// The solution of rate = free_rate + inverse_mass * impulse(rate).
    [[nodiscard]] AxisPiece solve(double free_rate, double inverse_mass) const;
    /// The piece next to `piece`, in the order of the rates, in the direction of `towards`.
    [[nodiscard]] AxisPiece neighbour(const AxisPiece& piece, const AxisPiece& towards) const;
    /// Splits an impulse among the spring, the motor and the stops.
    [[nodiscard]] AxisImpulses split(const AxisPiece& piece, double impulse, double rate) const;

private:
    [[nodiscard]] int place_of(const AxisPiece& piece) const;
    [[nodiscard]] bool has_piece_at(int place) const;
    [[nodiscard]] AxisPiece piece_at(int place, SpringLine with) const;
};

/// The spring, motor and stops along a joint's free axis, and how far the bodies are from them.
struct AxisActs
{
    bool has_spring = false;
    bool has_lower = false;
    bool has_upper = false;
    bool soft_limits = false; ///< limits are as soft as the joint's spring
    float stretch = 0;        ///< extension of the spring
    float lower_error = 0;    ///< coordinate - lower limit
    float upper_error = 0;    ///< upper limit - coordinate
    float motor_speed = 0;
    float most = 0; ///< greatest force or torque of the motor; 0: no motor

    [[nodiscard]] bool any() const { return has_spring || has_lower || has_upper || most > 0; }
    /// How far a displacement along the axis leads beyond a rigid stop; for an axis that is beyond it already, how much farther.
    [[nodiscard]] double comes_beyond(double displacement) const;
    /// The law for the mean rate over the next sub-step, with spring, motor and stops.
    [[nodiscard]] AxisLaw law_ahead(const AxisSpring& own, float h) const;
    /// The law for the rate at the pose reached, with the motor and rigid stops only. Bodies leave a stop at the speed `bounce`. A stop that bears an impulse
    /// counts as reached.
    [[nodiscard]] AxisLaw law_now(const AxisImpulses& borne, const float (&bounce)[2], float h) const;
};

} // namespace carom::internal
