// Kinematic targets: plates that travel, bars that turn.

#include "property/arrangements.h"
#include "property/rooms.h"

#include <algorithm>

namespace carom::shots {

namespace {

void at_plate(Trial& trial, const Piece& piece, double widest)
{
    Random& random = trial.random;
    const Point gravity = pick_gravity(random);
    Scene& scene = trial.open(piece.reach, gravity);
    const Point u = as_floats(pick_velocity(random, 0.01, 100));
    const double speed = pick_speed(random);
    const Point along = direction(-M_PI / 2 + random.range(-widest, widest));
    const double gap = pick_gap(trial, speed, 100 * piece.reach);
    pick_steps(trial, gap, speed, 4);
    const double time = trial.steps * d(trial.dt);
    const BodyId plate = scene.create_body({.type = BodyType::Kinematic, .velocity = vec(u)});
    trial.story << "plate moves with " << u << " ";
    build_lane(trial, plate, 4 * piece.reach + speed * time + 10 * time * time, false);
    const BodyId body = shoot(trial, piece, Point{0, 1.001 * piece.reach} - gap * along, u + speed * along);
    trial.energy_in({u, 0, {}});
    trial.expect(
        [&trial, body, u]() -> std::string
        {
            const double above = trial.scene().body(body).center_of_mass().y - u.y * trial.time();
            return above > 0 ? "" : say("the center is ", -above, " m behind the plate");
        });
}

// A bar from the pivot at the origin that turns evenly, and a ball that flies straight.
struct Bar
{
    double length = 1;
    double radius = 0.01;
    double start = 0;
    double w = 0;

    [[nodiscard]] double angle(double t) const { return start + w * t; }
    [[nodiscard]] Point offset(double t, Point c) const // from the bar's axis to c
    {
        return c - nearest_on_segment({}, length * direction(angle(t)), c);
    }
};

struct Flight
{
    Point at{};
    Point v{};
    double from = 0;
    [[nodiscard]] Point place(double t) const { return at + (t - from) * v; }
};

// The time at which the ball meets the bar after it has been apart from it, or the end.
double next_meeting(const Bar& bar, const Flight& flight, double reach, double begin, double end)
{
    const double closing = norm(flight.v) + std::fabs(bar.w) * (bar.length + bar.radius);
    double t = begin;
    while (t < end)
    {
        const double gap = norm(bar.offset(t, flight.place(t))) - reach;
        if (gap < 1e-9 * reach)
            return t;
        t += std::max(gap / closing, 1e-12 * (1 + t));
    }
    return end;
}

// The bounce at the meeting, worked out beforehand.
struct Bounce
{
    Bar bar{};
    double radius = 0;
    double time = 0;
    double next = 0; // when they meet again, or the end of the trial
    Flight before{};
    Flight after{};
    Point n{};
    double side = 1; // of the bar's axis, on which the ball is
};

std::optional<Bounce> pick_bounce(Trial& trial, double radius, double restitution)
{
    Random& random = trial.random;
    Bounce b;
    b.radius = radius;
    b.bar.length = std::clamp(radius * log_uniform(random, 2, 20), 0.005, 1.0);
    b.bar.radius = as_float(b.bar.length * random.range(0.005, 0.1));
    const double sign = pick_sign(random, 0.5);
    b.bar.w = as_float(sign * random.range(1, 50));
    b.bar.start = as_float(random.range(-M_PI, M_PI));
    b.time = random.range(0.02, 3) * d(trial.dt);
    b.side = random.chance(0.7) == (b.bar.w > 0) ? 1 : -1;
    const double reach = radius + b.bar.radius;
    const Point axis = direction(b.bar.angle(b.time));
    b.n = b.side * turned_left(axis);
    const Point met = random.range(0.15, 0.95) * b.bar.length * axis + reach * b.n;
    const Point surface = b.bar.w * turned_left(met - reach * b.n);
    const Point v = random.chance(0.2) ? Point{} : as_floats(pick_velocity(random, 0.001, 1000));
    const double approach = -dot(v - surface, b.n);
    if (approach < 1e-3 * norm(v - surface) || approach < 1e-3)
        return std::nullopt;
    b.before = {met, v, b.time};
    b.after = {met, v + (1 + restitution) * approach * b.n, b.time};
    if (next_meeting(b.bar, b.before, reach * (1 + 1e-6), 0, b.time) < b.time * (1 - 1e-6))
        return std::nullopt;
    const double end = trial.steps * d(trial.dt);
    const double departed = b.time + 1e-6 * reach / approach + 1e-9; // by then e > 0 has opened a gap
    b.next = restitution > 0.05 ? next_meeting(b.bar, b.after, reach, departed, end) : b.time;
    return b;
}

// Thrown the right way: most of the exact change of speed, as long as they do not meet again.
std::string thrown(Trial& trial, BodyId body, const Bounce& b)
{
    const double t = trial.time();
    if (t <= b.time || t >= b.next)
        return "";
    const Point change = point(trial.scene().body(body).velocity()) - b.before.v;
    const double part = dot(change, b.n) / norm(b.after.v - b.before.v);
    return part > 0.3 ? "" : say("thrown with ", part, " of the exact change of velocity");
}

// Ahead of the bar: within a quarter of a turn a ball inside its circle can only be on the side where it was hit.
std::string ahead(Trial& trial, BodyId body, const Bounce& b)
{
    const double t = trial.time();
    const Point c = turn(-b.bar.angle(t), point(trial.scene().body(body).position()));
    const bool tells = t > b.time && std::fabs(b.bar.w) * (t - b.time) < M_PI / 2 && norm(c) < b.bar.length && c.x > 0;
    const bool leading = b.side * b.bar.w > 0;
    return !tells || !leading || b.side * c.y > 0 ? "" : say("the ball is ", -b.side * c.y, " m behind the bar's axis");
}

} // namespace

void ball_at_plate(Trial& trial) { at_plate(trial, make_ball(pick_size(trial.random)), 1.3); }
void piece_at_plate(Trial& trial) { at_plate(trial, pick_long_piece(trial.random, pick_size(trial.random)), 1); }

void ball_at_turning_bar(Trial& trial)
{
    Random& random = trial.random;
    const double radius = log_uniform(random, 0.005, 0.3);
    Scene& scene = trial.open(radius, {});
    trial.steps = 4 + random.below(6);
    const float restitution = fraction(random);
    std::optional<Bounce> bounce;
    while (!bounce)
        bounce = pick_bounce(trial, radius, d(restitution));
    const Bounce b = *bounce;
    const ShapeDef material{.density = 10, .friction = 0, .restitution = restitution};
    const BodyId bar = scene.create_body(
        {.type = BodyType::Kinematic, .angle = static_cast<float>(b.bar.start), .angular_velocity = static_cast<float>(b.bar.w)});
    scene.create_shape(
        bar,
        Capsule{{}, {static_cast<float>(b.bar.length), 0}, static_cast<float>(b.bar.radius), static_cast<float>(b.bar.radius)},
        material);
    const BodyId ball = test::add_dynamic(scene, position(b.before.place(0)), Circle{.radius = static_cast<float>(radius)},
                                          material, vec(b.before.v))
                            .body;
    trial.story << "bar length " << b.bar.length << " radius " << b.bar.radius << " turns " << b.bar.w << " from " << b.bar.start
                << "; ball radius " << radius << " at " << b.before.place(0) << " v " << b.before.v << " e " << restitution
                << "; meet at " << b.time << " s, n " << b.n << ", exact v after " << b.after.v << ", next at " << b.next << "; ";
    trial.energy_in({{}, b.bar.w, {}});
    trial.expect([&trial, ball, b] { return thrown(trial, ball, b); });
    trial.expect([&trial, ball, b] { return ahead(trial, ball, b); });
}

} // namespace carom::shots
