#include "property/pieces.h"

#include <algorithm>

namespace carom::shots {

namespace {

Piece make_box(double half_width, double half_height, double radius)
{
    const Geometry geometry = box(f(half_width), f(half_height), {}, 0, f(radius));
    const Outline outline{
        {{-half_width, -half_height}, {half_width, -half_height}, {half_width, half_height}, {-half_width, half_height}}, radius};
    return {geometry, outline, std::min(half_width, half_height) + radius, std::hypot(half_width, half_height) + radius};
}

Piece make_capsule(double half_length, double radius, bool as_segment)
{
    const Vec2 tip{f(half_length), 0};
    Geometry geometry = Capsule{-tip, tip, f(radius), f(radius)};
    if (as_segment)
        geometry = Segment{-tip, tip, f(radius)};
    return {geometry, {{{-half_length, 0}, {half_length, 0}}, radius}, radius, half_length + radius};
}

Piece make_regular(int corners, double reach)
{
    Polygon polygon;
    Outline outline;
    for (int i = 0; i < corners; ++i)
    {
        const Point p = reach * direction(2 * M_PI * i / corners);
        polygon.vertices.push_back(vec(p));
        outline.core.push_back(p);
    }
    return {polygon, outline, reach * std::cos(M_PI / corners), reach};
}

const char* name(const Geometry& geometry)
{
    constexpr const char* names[] = {"ball", "polygon", "capsule", "segment", "arc", "chain", "half-space"};
    return names[geometry.index()];
}

const char* name(BodyType type)
{
    constexpr const char* names[] = {"static", "kinematic", "dynamic"};
    return names[static_cast<int>(type)];
}

} // namespace

double log_uniform(Random& random, double low, double high) { return low * std::pow(high / low, random.unit()); }

float fraction(Random& random)
{
    const int i = random.below(7);
    return i == 0 ? 0.0f : i == 1 ? 1.0f : f(random.unit());
}

double pick_size(Random& random) { return log_uniform(random, 0.005, 1); }
double pick_size_near(Random& random, double size) { return std::clamp(size * log_uniform(random, 0.4, 2.5), 0.005, 1.0); }
double pick_speed(Random& random) { return log_uniform(random, 0.001, 1000); }
Point pick_direction(Random& random) { return direction(random.range(-M_PI, M_PI)); }
double pick_sign(Random& random, double positive) { return random.chance(positive) ? 1 : -1; }
Point pick_velocity(Random& random, double slowest, double fastest)
{
    const double speed = log_uniform(random, slowest, fastest);
    return speed * pick_direction(random);
}
Point pick_gravity(Random& random)
{
    const Point d = pick_direction(random);
    return random.chance(0.5) ? Point{} : 9.81 * d;
}

ShapeDef pick_material(Random& random)
{
    ShapeDef def;
    def.density = f(log_uniform(random, 1, 30));
    def.friction = fraction(random);
    def.restitution = fraction(random);
    return def;
}

Piece make_ball(double radius) { return {Circle{.radius = f(radius)}, {{{0, 0}}, radius}, radius, radius}; }

Piece pick_long_piece(Random& random, double reach)
{
    const int kind = random.below(5);
    if (kind <= 1)
    {
        const double rounding = kind == 1 ? random.range(0.05, 0.3) * reach : 0;
        const double angle = random.range(0.2, M_PI / 4);
        return make_box((reach - rounding) * std::cos(angle), (reach - rounding) * std::sin(angle), rounding);
    }
    if (kind == 2)
        return make_regular(3 + random.below(6), reach);
    const double radius = reach * random.range(kind == 3 ? 0.15 : 0.05, kind == 3 ? 0.6 : 0.2);
    return make_capsule(reach - radius, radius, kind == 4);
}

Piece pick_piece(Random& random, double reach) { return random.chance(0.4) ? make_ball(reach) : pick_long_piece(random, reach); }

BodyId add_piece(Trial& trial, const Piece& piece, BodyType type, Point at, double angle, Point velocity, double spin,
                 MotionLocks locks)
{
    const ShapeDef material = pick_material(trial.random);
    const BodyId body = trial.scene().create_body({.type = type,
                                                   .position = position(at),
                                                   .angle = f(angle),
                                                   .velocity = vec(velocity),
                                                   .angular_velocity = f(spin),
                                                   .locks = locks});
    trial.scene().create_shape(body, piece.geometry, material);
    trial.story << name(type) << " " << name(piece.geometry) << " (body " << body.slot << ") reach " << piece.reach << " inner "
                << piece.inner << " at " << at << " v " << velocity << " w " << spin << " e " << material.restitution << " mu "
                << material.friction << "; ";
    return body;
}

BodyId shoot(Trial& trial, const Piece& piece, Point at, Point velocity)
{
    const double angle = trial.random.range(-M_PI, M_PI);
    const double spin = trial.random.chance(0.3) ? 0 : trial.random.range(-50, 50);
    return add_piece(trial, piece, BodyType::Dynamic, at, angle, velocity, spin);
}

void expect_outside(Trial& trial, Point n, double allowed, std::function<Point()> since_meeting)
{
    const auto beyond = [n, allowed, since_meeting](double part) -> std::string
    {
        const Point way = since_meeting();
        const double outside = dot(n, way);
        return outside > -allowed - part * norm(way) ? "" : say("the shot is ", -outside, " m beyond the tangent of its bounce");
    };
    trial.expect([beyond] { return beyond(0.05); });
    trial.expect("strayed", [beyond] { return beyond(1e-3); });
}

void pick_steps(Trial& trial, double gap, double speed, int further)
{
    const double needed = gap / (speed * static_cast<double>(trial.dt));
    trial.steps = std::clamp(static_cast<int>(std::min(needed, 50.0)) + 2 + trial.random.below(further), 2, 60);
}

double pick_gap(Trial& trial, double speed, double limit)
{
    return std::min(limit, speed * static_cast<double>(trial.dt) * trial.random.range(0.02, 4));
}

} // namespace carom::shots
