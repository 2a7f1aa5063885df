#pragma once

// The force law along a joint's free axis: a spring, a motor and two stops as one monotone function from the axis' rate to its impulse. Monotone
// means that the impulse and the rate have exactly one solution together, found from scratch each time: nothing winds up. See joint_axis.cpp.

#include <limits>

namespace carom::internal {

/// A spring along an axis over a sub-step h, as (rest - rate) / compliance.
struct SpringLine
{
    double rest = 0;       ///< rate at which it gives nothing
    double compliance = 0; ///< rate per impulse; 0: no spring

    [[nodiscard]] bool is_there() const { return compliance > 0; }
    [[nodiscard]] double impulse(double rate) const { return is_there() ? (rest - rate) / compliance : 0; }
};

/// Constants of a joint's spring, once a step.
struct AxisSpring
{
    float stiffness = 0; ///< N/m or N m/rad
    float damping = 0;   ///< N s/m or N m s/rad
    float theta =
        1; ///< the time within the sub-step at which the force is taken: 1/2 keeps energy, 1 damps what a sub-step cannot follow

    [[nodiscard]] bool is_there() const { return stiffness > 0 || damping > 0; }
    /// The impulse before the bodies move, for a stretch at the start of the sub-step.
    [[nodiscard]] SpringLine line(float stretch, float h) const;
    /// The part of the impulse before the bodies move that follows again after they have.
    [[nodiscard]] float share_after() const { return (1 - theta) / theta; }
};

/// hertz and damping ratio of a mass on the spring. Beyond `most_turn` of omega h it is as stiff as that.
[[nodiscard]] AxisSpring make_spring(float hertz, float damping_ratio, float mass, float h, float most_turn);

/// The theta that an oscillation of this omega h asks for.
[[nodiscard]] float least_theta(float turn);

constexpr float way_back = 0.2f;         ///< of what a body is beyond a stop, per sub-step
constexpr float direct_spring_turn = 16; ///< in the direct solve, where that is as good as rigid
constexpr float soft_spring_turn = 0.5f; ///< where rows are solved one after the other

/// The part of the law that holds at the solution: a rate that is kept at any impulse, or an impulse that a spring may change with the rate.
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
    double rate = 0;     ///< the solution; where the rate is kept, exactly that
    double constant = 0; ///< impulse of a motor that does all it can
    SpringLine spring;

    [[nodiscard]] bool keeps_rate() const { return kind != Kind::Free; }
    [[nodiscard]] bool is_at_stop() const { return kind == Kind::AtLower || kind == Kind::AtUpper; }
    [[nodiscard]] double impulse(double at) const { return constant + spring.impulse(at); }
};

/// Along the axis, in a sub-step.
struct AxisImpulses
{
    double spring = 0;
    double motor = 0;
    double lower = 0; ///< >= 0
    double upper = 0; ///< >= 0, against the axis

    [[nodiscard]] double sum() const { return spring + motor + lower - upper; }
};

/// Which of them a law decides; the others stay as they are.
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
    double target = 0;         ///< of the motor
    double most = 0;           ///< its greatest impulse; 0: none
    double lower = -unbounded; ///< rates at which the stops are reached
    double upper = unbounded;

    /// The solution of rate = free_rate + inverse_mass * impulse(rate).
    [[nodiscard]] AxisPiece solve(double free_rate, double inverse_mass) const;
    /// The piece next to one, in the order of their rates, on the way to another.
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
    bool soft_limits = false; ///< that give as the joint's spring does
    float stretch = 0;        ///< of the spring
    float lower_error = 0;    ///< coordinate - lower limit
    float upper_error = 0;    ///< upper limit - coordinate
    float motor_speed = 0;
    float most = 0; ///< impulse of the motor in a sub-step; 0: none

    [[nodiscard]] bool any() const { return has_spring || has_lower || has_upper || most > 0; }
    /// How far a way along the axis leads beyond a rigid stop, or farther beyond it.
    [[nodiscard]] double comes_beyond(double displacement) const;
    /// For the mean rate over the sub-step to come: all of it.
    [[nodiscard]] AxisLaw law_ahead(const AxisSpring& own, float h) const;
    /// For the rate at the pose reached: motor and rigid stops, which are left at the speeds `bounce`. A stop that bears is reached.
    [[nodiscard]] AxisLaw law_now(const AxisImpulses& borne, const float (&bounce)[2], float h) const;
};

} // namespace carom::internal
