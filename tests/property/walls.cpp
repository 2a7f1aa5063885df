// One static target and a shot that meets it.
//
// A ball that flies without gravity and bounces off something convex stays on the outer side of the tangent at the meeting: what
// comes after the bounce is a straight line away from it. That line is known from our own geometry before the first step.

#include "property/arrangements.h"
#include "property/rooms.h"

#include <algorithm>

namespace carom::shots {

namespace {

double step(const Trial& trial) { return static_cast<double>(trial.dt); }

// A direction that goes down onto the x axis.
Point downwards(Random& random, double widest) { return direction(-M_PI / 2 + random.range(-widest, widest)); }

void at_wall(Trial& trial, const Piece& piece, double widest)
{
    Random& random = trial.random;
    const Point gravity = pick_gravity(random);
    Scene& scene = trial.open(piece.reach, gravity);
    const double speed = pick_speed(random);
    const Point along = downwards(random, widest);
    const double gap = pick_gap(trial, speed, 100 * piece.reach);
    pick_steps(trial, gap, speed, 4);
    const double time = trial.steps * step(trial);
    const BodyId wall = scene.create_body({});
    build_lane(trial, wall, 4 * piece.reach + speed * time + 10 * time * time, true);
    const BodyId body = shoot(trial, piece, Point{0, 1.001 * piece.reach} - gap * along, speed * along);
    trial.expect(
        [&scene, body]() -> std::string
        {
            const double above = scene.body(body).center_of_mass().y;
            return above > 0 ? "" : say("the center is ", -above, " m behind the wall");
        });
}

// Shoots a ball so that it meets the outline, and expects it to stay outside of the tangent there.
void shoot_at(Trial& trial, double radius, const Outline& target, Point aim, Point along, double speed)
{
    const Piece ball = make_ball(radius);
    double far = radius;
    for (const Point p : target.core)
        far = std::max(far, norm(p - aim) + target.radius + radius);
    const Meeting meeting = first_meeting(moved(ball.outline, aim - 2 * far * along, 0), along, target, 4 * far);
    const Point met = aim + (meeting.time - 2 * far) * along;
    const double gap = pick_gap(trial, speed, 100 * radius);
    pick_steps(trial, gap, speed, 6);
    const BodyId body = shoot(trial, ball, met - gap * along, speed * along);
    trial.story << "meets at " << met << " n " << meeting.n << " after " << gap / speed << " s; ";
    expect_outside(trial, meeting.n, std::min(trial.slop(), 0.1 * radius),
                   [&trial, body, met] { return point(trial.scene().body(body).center_of_mass()) - met; });
}

Point within(Random& random, double radius)
{
    const double r = radius * std::sqrt(random.unit());
    return r * pick_direction(random);
}

} // namespace

void ball_at_wall(Trial& trial) { at_wall(trial, make_ball(pick_size(trial.random)), 1.3); }
void piece_at_wall(Trial& trial) { at_wall(trial, pick_long_piece(trial.random, pick_size(trial.random)), 1); }

void ball_at_body(Trial& trial)
{
    Random& random = trial.random;
    const double radius = pick_size(random);
    trial.open(radius, {});
    const double reach = pick_size(random);
    Piece target = pick_piece(random, reach);
    if (random.chance(0.15))
        target = {Segment{vec({-reach, 0}), vec({reach, 0})}, {{{-reach, 0}, {reach, 0}}, 0}, 0, reach};
    const double angle = random.range(-M_PI, M_PI);
    const Point at{random.range(-20, 20), random.range(-20, 20)};
    add_piece(trial, target, BodyType::Static, at, angle, {}, 0);
    const Point aim =
        target.inner > 0 ? at + within(random, 0.9 * target.inner) : at + random.range(-0.9, 0.9) * reach * direction(angle);
    const double speed = pick_speed(random);
    const Point along = pick_direction(random);
    shoot_at(trial, radius, moved(target.outline, at, angle), aim, along, speed);
}

void ball_at_arc(Trial& trial)
{
    Random& random = trial.random;
    const double radius = pick_size(random);
    Scene& scene = trial.open(radius, {});
    const double half = random.chance(0.5) ? 0 : radius * random.range(0.05, 0.5);
    const double arc_radius = half + radius * log_uniform(random, 1.5, 30);
    const double sweep = random.range(0.5, 6);
    const double start = random.range(-M_PI, M_PI);
    const ShapeDef material = pick_material(random);
    scene.create_shape(scene.create_body({}),
                       Arc{.radius = static_cast<float>(arc_radius),
                           .start_angle = static_cast<float>(start),
                           .sweep = static_cast<float>(sweep),
                           .half_thickness = static_cast<float>(half)},
                       material);
    trial.story << "arc radius " << arc_radius << " half thickness " << half << " from " << start << " by " << sweep << " e "
                << material.restitution << " mu " << material.friction << "; ";
    // From outside onto the arc itself, not its ends: the disc that the arc is a part of is the target.
    const Point out = direction(start + sweep * random.range(0.15, 0.85));
    const Point along = turn(random.range(-1.3, 1.3), -out);
    const double speed = pick_speed(random);
    const Outline disc{{{0, 0}}, arc_radius + half};
    shoot_at(trial, radius, disc, (arc_radius + half + radius) * out + 1e-6 * radius * along, along, speed);
}

void ball_at_closed_chain(Trial& trial)
{
    Random& random = trial.random;
    const double radius = pick_size(random);
    Scene& scene = trial.open(radius, {});
    const double inner = pick_size(random);
    const Room room = pick_polygon_room(random, inner);
    const double half = random.chance(0.5) ? 0 : inner * random.range(0.02, 0.2);
    Chain chain{.start = vec(room.corners[0]), .pieces = {}, .closed = true, .half_thickness = static_cast<float>(half)};
    for (std::size_t i = 0; i < room.corners.size(); ++i)
    {
        const Point a = room.corners[i];
        const Point b = room.corners[(i + 1) % room.corners.size()];
        if (random.chance(0.5))
            chain.pieces.push_back({.end = vec(0.5 * (a + b))});
        chain.pieces.push_back({.end = vec(b)});
    }
    chain.sides = random.chance(0.4) ? Sides::Right : Sides::Both;
    const ShapeDef material = pick_material(random);
    scene.create_shape(scene.create_body({}), chain, material);
    trial.story << "closed chain around " << inner << " half thickness " << half << " sides " << static_cast<int>(chain.sides)
                << " e " << material.restitution << " mu " << material.friction << "; ";
    const double speed = pick_speed(random);
    const Point along = pick_direction(random);
    shoot_at(trial, radius, {room.corners, half}, within(random, 0.9 * inner), along, speed);
}

} // namespace carom::shots
