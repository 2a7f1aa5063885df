// A flipper in a round chamber: the bat turns about the chamber's middle, its tip leaves no gap for the ball, and a wall closes the
// chamber above. The ball starts between bat and wall and can never be anywhere else.

#include "property/arrangements.h"
#include "property/pieces.h"

#include <algorithm>

namespace carom::shots {

namespace {

constexpr double lower = -0.7;
constexpr double upper = 0.5;
constexpr double top = 2.3; // far enough above the upper stop for the ball

struct Chamber
{
    double length = 1; // of the bat
    double base_radius = 0;
    double tip_radius = 0;
    double ball_radius = 0;
    double around = 0; // radius of the chamber
    double turned = 0; // of everything
};

// Bat and walls pass through each other, the ball touches both.
constexpr Filter bat_filter{.category = 2, .mask = 4};
constexpr Filter wall_filter{.category = 1, .mask = 4};
constexpr Filter ball_filter{.category = 4};

ShapeDef with(ShapeDef material, Filter filter)
{
    material.filter = filter;
    return material;
}

Chamber pick_chamber(Random& random)
{
    Chamber c;
    c.length = log_uniform(random, 0.06, 1);
    c.ball_radius = c.length * random.range(0.08, 0.22);
    c.base_radius = c.length * random.range(0.05, 0.14);
    c.tip_radius = c.base_radius * random.range(0.4, 1);
    c.around = c.length + c.tip_radius + 0.3 * c.ball_radius;
    c.turned = random.range(-M_PI, M_PI);
    return c;
}

void build_walls(Trial& trial, const Chamber& c)
{
    const ShapeDef material = with(pick_material(trial.random), wall_filter);
    const BodyId walls = trial.scene().create_body({});
    trial.scene().create_shape(walls, Arc{.radius = f(c.around), .sweep = 2 * pi}, material);
    const Point end = c.around * direction(c.turned + top);
    trial.scene().create_shape(walls, Segment{{}, vec(end)}, material);
    trial.story << "chamber " << c.around << " turned " << c.turned << " e " << material.restitution << " mu "
                << material.friction << "; ";
}

// The bat's angle from the chamber's zero.
double bat_angle(Trial& trial, BodyId bat, const Chamber& c)
{
    const Rotation q = trial.scene().body(bat).rotation();
    const Point axis = turn(-c.turned, {static_cast<double>(q.c), static_cast<double>(q.s)});
    return std::atan2(axis.y, axis.x);
}

// The torque acts evenly through each step; its work follows from the angle, which stands in a rotation in floats: at the start and after every step both
// components are rounded to half of their last place, 2^-25.
void drive(Trial& trial, BodyId bat, const Chamber& c, double torque)
{
    const float applied = f(torque);
    const double start = bat_angle(trial, bat, c);
    trial.story << "torque " << torque << "; ";
    trial.drive(bat, applied);
    trial.account_work([&trial, bat, c, applied, start]
                       { return static_cast<double>(applied) * (bat_angle(trial, bat, c) - start); },
                       std::fabs(torque) * std::sqrt(2.0) * std::ldexp(1.0, -25));
}

BodyId build_bat(Trial& trial, const Chamber& c, double ball_mass)
{
    Random& random = trial.random;
    const double angle = random.range(lower, upper);
    const double w = random.chance(0.4) ? 0 : random.range(-100, 100);
    const BodyId bat = trial.scene().create_body({.type = BodyType::Dynamic,
                                                  .angle = f(c.turned + angle),
                                                  .angular_velocity = f(w),
                                                  .locks = {.linear_x = true, .linear_y = true},
                                                  .can_sleep = false});
    const ShapeDef material = with(pick_material(random), bat_filter);
    trial.scene().create_shape(bat, Capsule{{}, {f(c.length), 0}, f(c.base_radius), f(c.tip_radius)}, material);
    const double inertia = ball_mass * c.length * c.length * log_uniform(random, 0.1, 10);
    trial.scene().body(bat).set_mass({.mass = f(ball_mass), .center = {}, .inertia = f(inertia)});
    const float bounce = fraction(random);
    trial.scene().create_joint(RevoluteDef{.body_b = bat,
                                           .reference_angle = f(c.turned),
                                           .enable_limit = true,
                                           .lower_angle = f(lower),
                                           .upper_angle = f(upper),
                                           .limit_restitution = bounce});
    trial.story << "bat " << c.length << " radii " << c.base_radius << " " << c.tip_radius << " at " << angle << " w " << w
                << " inertia " << inertia << " e " << material.restitution << " mu " << material.friction << " stop e " << bounce
                << "; ";
    const double sign = random.chance(0.2) ? 0 : pick_sign(random, 0.7);
    const double acceleration = sign * log_uniform(random, 1, 5000);
    drive(trial, bat, c, inertia * acceleration);
    return bat;
}

// A place for the ball between bat and wall, at an angle and distance from the pivot.
Point pick_place(Random& random, const Chamber& c, double bat)
{
    const double margin = 1.02 * c.ball_radius;
    for (;;)
    {
        const double a = random.range(bat, top);
        const Point p = random.range(c.ball_radius, c.around) * direction(a);
        const double above_bat = norm(p - nearest_on_segment({}, c.length * direction(bat), p)) - c.base_radius;
        const double below_wall = norm(p - nearest_on_segment({}, c.around * direction(top), p));
        if (above_bat > margin && below_wall > margin && c.around - norm(p) > margin)
            return turn(c.turned, p);
    }
}

void expect_between(Trial& trial, const Chamber& c, BodyId bat, BodyId ball)
{
    trial.expect(
        [&trial, c, bat, ball]() -> std::string
        {
            const Point p = turn(-c.turned, point(trial.scene().body(ball).position()));
            if (norm(p) >= c.around)
                return say("the ball is ", norm(p) - c.around, " m outside the chamber");
            const double a = std::atan2(p.y, p.x);
            const double above = a - bat_angle(trial, bat, c);
            if (above <= 0)
                return say("the ball is ", -above, " rad below the bat");
            return a < top ? "" : say("the ball is ", a - top, " rad above the wall");
        });
}

} // namespace

void flipper_chamber(Trial& trial)
{
    Random& random = trial.random;
    const Chamber c = pick_chamber(random);
    const Point gravity = pick_gravity(random);
    Scene& scene = trial.open(c.ball_radius, gravity);
    build_walls(trial, c);
    const ShapeDef material = with(pick_material(random), ball_filter);
    const double mass = static_cast<double>(material.density) * M_PI * c.ball_radius * c.ball_radius;
    const BodyId bat = build_bat(trial, c, mass);
    const double speed = random.chance(0.2) ? 0 : pick_speed(random);
    trial.steps = 4 + random.below(20);
    const Point at = pick_place(random, c, bat_angle(trial, bat, c));
    const Point v = speed * pick_direction(random);
    const BodyId ball = test::add_dynamic(scene, position(at), Circle{.radius = f(c.ball_radius)}, material, vec(v)).body;
    trial.story << "ball " << c.ball_radius << " at " << at << " v " << v << " e " << material.restitution << " mu "
                << material.friction << "; ";
    expect_between(trial, c, bat, ball);
}

} // namespace carom::shots
