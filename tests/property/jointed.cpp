// Shots at what hangs on joints.

#include "property/arrangements.h"
#include "property/rooms.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom::shots {

namespace {

enum class Link
{
    Hinge,
    Rod,
    Slider,
    Rope,
    Spring,
};

// A joint between two bodies at the middle between them; a null one is the world.
JointId link(Trial& trial, Link kind, BodyId a, Point at_a, BodyId b, Point at_b, double mass)
{
    const Point middle = 0.5 * (at_a + at_b);
    Scene& scene = trial.scene();
    const auto local = [&](BodyId id, Point p) { return id.is_null() ? vec(p) : scene.body(id).local_point(position(p)); };
    const Vec2 middle_a = local(a, middle);
    const Vec2 middle_b = local(b, middle);
    const Vec2 own_a = local(a, at_a);
    const Vec2 own_b = local(b, at_b);
    switch (kind)
    {
    case Link::Hinge:
        return scene.create_joint(RevoluteDef{.body_a = a, .body_b = b, .anchor_a = middle_a, .anchor_b = middle_b});
    case Link::Rod: return scene.create_joint(DistanceDef{.body_a = a, .body_b = b, .anchor_a = own_a, .anchor_b = own_b});
    case Link::Rope:
        return scene.create_joint(DistanceDef{.body_a = a, .body_b = b, .anchor_a = own_a, .anchor_b = own_b, .min_length = 0});
    case Link::Slider:
        return scene.create_joint(
            PrismaticDef{.body_a = a, .body_b = b, .anchor_a = middle_a, .anchor_b = middle_b, .axis_a = vec(at_b - at_a)});
    default:
        return scene.create_joint(SpringDef{.body_a = a,
                                            .body_b = b,
                                            .anchor_a = own_a,
                                            .anchor_b = own_b,
                                            .stiffness = f(mass * log_uniform(trial.random, 1, 1000))});
    }
}

// Two to four balls in a row, each linked to the next one and sometimes the first one to the world; a shot comes from the side.
void linked_row(Trial& trial, bool springs)
{
    Random& random = trial.random;
    const double size = log_uniform(random, 0.005, 0.3);
    const Point gravity = pick_gravity(random);
    Scene& scene = trial.open(size, gravity);
    const int count = 2 + random.below(3);
    const double pitch = 2 * size * random.range(1.05, 1.5);
    const Room room = pick_polygon_room(random, 1.1 * (pitch * count + 4 * size));
    build_walls(trial, room);
    BodyId last{};
    Point last_at{-0.5 * pitch * (count + 1), 0};
    bool linked = random.chance(0.5); // to the world
    for (int i = 0; i < count; ++i)
    {
        const Point at = last_at + Point{pitch, 0};
        const Piece piece = pick_piece(random, size);
        const BodyId body = add_piece(trial, piece, BodyType::Dynamic, at, 0, {}, 0);
        expect_inside(trial, room, body);
        const auto kind = springs ? Link::Spring : static_cast<Link>(random.below(4));
        if (linked)
        {
            link(trial, kind, last, last_at, body, at, static_cast<double>(scene.body(body).mass()));
            trial.story << "linked before by kind " << static_cast<int>(kind) << "; ";
        }
        linked = true;
        last = body;
        last_at = at;
    }
    const double speed = pick_speed(random);
    const double gap = pick_gap(trial, speed, 0.5 * size);
    pick_steps(trial, gap, speed, 12);
    const double x = random.range(-0.5, 0.5) * pitch * (count - 1);
    const BodyId shot = shoot(trial, make_ball(0.5 * size), {x, 1.51 * size + gap}, {0, -speed});
    expect_inside(trial, room, shot);
}

// Balls in a ring, each hinged to the next one halfway; a shot comes from the side.
void hinged_ring(Trial& trial)
{
    Random& random = trial.random;
    const double size = log_uniform(random, 0.005, 0.3);
    Scene& scene = trial.open(size, pick_gravity(random));
    const int count = 4 + random.below(9);
    const double pitch = 2 * size * random.range(1.05, 1.5);
    const double radius = 0.5 * pitch / std::sin(d(pi) / count);
    const Room room = pick_polygon_room(random, 1.5 * (radius + 4 * size));
    build_walls(trial, room);
    std::vector<BodyId> bodies;
    std::vector<Point> places;
    for (int i = 0; i < count; ++i)
    {
        places.push_back(radius * direction(2 * d(pi) * i / count));
        bodies.push_back(add_piece(trial, pick_piece(random, size), BodyType::Dynamic, places.back(), 0, {}, 0));
        expect_inside(trial, room, bodies.back());
    }
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const std::size_t next = (i + 1) % bodies.size();
        link(trial, Link::Hinge, bodies[i], places[i], bodies[next], places[next],
             static_cast<double>(scene.body(bodies[i]).mass()));
    }
    const double speed = pick_speed(random);
    const double gap = pick_gap(trial, speed, 0.5 * size);
    pick_steps(trial, gap, speed, 12);
    const double x = random.range(-0.5, 0.5) * radius;
    expect_inside(trial, room, shoot(trial, make_ball(0.5 * size), {x, radius + 1.51 * size + gap}, {0, -speed}));
}

} // namespace

void pendulum_struck(Trial& trial)
{
    Random& random = trial.random;
    const double rb = pick_size(random);
    const double rs = pick_size_near(random, rb);
    const bool weightless = random.chance(0.5);
    Scene& scene = trial.open(std::sqrt(rb * rs), weightless ? Point{} : Point{0, -9.81});
    const double rod = rb * random.range(1.2, 8);
    const BodyId bob = add_piece(trial, make_ball(rb), BodyType::Dynamic, {0, -rod}, 0, {}, 0);
    scene.create_joint(RevoluteDef{.body_b = bob, .anchor_b = {0, f(rod)}});
    trial.story << "hinged " << rod << " m above its center; ";
    const double speed = pick_speed(random);
    // From the side, or nearly: what comes along the rod meets an immovable body.
    const double aslant = random.range(-0.8, 0.8);
    const Point along = pick_sign(random, 0.5) * direction(aslant);
    const Point n = turn(random.range(-0.9, 0.9), -along);
    const double gap = pick_gap(trial, speed, 20 * (rb + rs));
    pick_steps(trial, gap, speed, 8);
    const Point met = Point{0, -rod} + 1.0001 * (rb + rs) * n;
    const BodyId shot = add_piece(trial, make_ball(rs), BodyType::Dynamic, met - gap * along, 0, speed * along, 0);
    trial.expect(
        [&scene, bob, shot, rb, rs]() -> std::string
        {
            const double apart = norm(point(scene.body(bob).position()) - point(scene.body(shot).position()));
            return apart > 0.8 * (rb + rs) || apart > rb + rs - 0.5 * std::min(rb, rs)
                       ? ""
                       : say("the shot is ", rb + rs - apart, " m deep in the bob");
        });
    if (weightless)
        trial.expect(
            [&trial, shot, v = speed * along, latest = (1.01 * gap + 0.001 * (rb + rs)) / speed]() -> std::string
            {
                const double change = norm(point(trial.scene().body(shot).velocity()) - v) / norm(v);
                return change > 1e-3 || trial.time() <= latest ? "" : "the shot went through the bob unhindered";
            });
}

void joints_in_room(Trial& trial) { linked_row(trial, false); }
void springs_in_room(Trial& trial) { linked_row(trial, true); }
void linkage_in_room(Trial& trial) { hinged_ring(trial); }

} // namespace carom::shots
