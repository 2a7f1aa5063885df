#include "property/rooms.h"

#include <algorithm>
#include <limits>

namespace carom::shots {

namespace {

double depth_in_polygon(const std::vector<Point>& corners, Point p)
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        const Point a = corners[i];
        const Point in = turned_left(unit(corners[(i + 1) % corners.size()] - a));
        least = std::min(least, dot(in, p - a));
    }
    return least;
}

// Scales the corners so that a disc of the radius about the origin just fits.
Room fitted(std::vector<Point> corners, double inner)
{
    const double depth = depth_in_polygon(corners, {});
    for (Point& p : corners)
        p = (inner / depth) * p;
    return {std::move(corners), 0};
}

struct Wall
{
    Point a{};
    Point b{};
    Point out{};
};

std::vector<Wall> walls_of(const Room& room)
{
    std::vector<Wall> walls;
    for (std::size_t i = 0; i < room.corners.size(); ++i)
    {
        const Point a = room.corners[i];
        const Point b = room.corners[(i + 1) % room.corners.size()];
        walls.push_back({a, b, -turned_left(unit(b - a))});
    }
    return walls;
}

// A wall in up to four pieces, so that there are seams.
std::vector<Point> cuts(Random& random, Point a, Point b)
{
    std::vector<Point> points{a};
    const int pieces = 1 + random.below(4);
    for (int i = 1; i < pieces; ++i)
        points.push_back(a + (static_cast<double>(i) / pieces) * (b - a));
    points.push_back(b);
    return points;
}

enum class Kind
{
    Segments,
    OneSided,
    Thick,
    Boxes,
    Capsules,
    HalfSpaces,
    Count,
};

// Thin enough to be flown over in a step: from a millimeter-like sheet to a fifth of the wall.
double pick_thickness(Random& random, const Wall& wall)
{
    return std::min(norm(wall.b - wall.a), 1.0) * log_uniform(random, 0.002, 0.2);
}

void add_segments(Trial& trial, BodyId body, const Wall& wall, const ShapeDef& material, double half_thickness, Sides sides)
{
    const Point shift = half_thickness * wall.out;
    const std::vector<Point> points = cuts(trial.random, wall.a + shift, wall.b + shift);
    for (std::size_t i = 1; i < points.size(); ++i)
        trial.scene().create_shape(body, Segment{vec(points[i - 1]), vec(points[i]), f(half_thickness), sides}, material);
}

void add_box(Trial& trial, BodyId body, const Wall& wall, const ShapeDef& material)
{
    const double thickness = pick_thickness(trial.random, wall);
    const Point along = wall.b - wall.a;
    const Point middle = 0.5 * (wall.a + wall.b) + 0.5 * thickness * wall.out;
    trial.scene().create_shape(
        body, box(f(0.5 * norm(along) + thickness), f(0.5 * thickness), vec(middle), f(std::atan2(along.y, along.x))), material);
}

void add_capsule(Trial& trial, BodyId body, const Wall& wall, const ShapeDef& material)
{
    const double radius = 0.5 * pick_thickness(trial.random, wall);
    const Point shift = radius * wall.out;
    trial.scene().create_shape(body, Capsule{vec(wall.a + shift), vec(wall.b + shift), f(radius), f(radius)}, material);
}

void add_wall(Trial& trial, BodyId body, const Wall& wall, const ShapeDef& material, Kind kind)
{
    switch (kind)
    {
    case Kind::Segments: return add_segments(trial, body, wall, material, 0, Sides::Both);
    case Kind::OneSided: return add_segments(trial, body, wall, material, 0, Sides::Left);
    case Kind::Thick: return add_segments(trial, body, wall, material, 0.5 * pick_thickness(trial.random, wall), Sides::Both);
    case Kind::Boxes: return add_box(trial, body, wall, material);
    case Kind::Capsules: return add_capsule(trial, body, wall, material);
    default: trial.scene().create_shape(body, HalfSpace{vec(-wall.out), f(-dot(wall.out, wall.a))}, material);
    }
}

void add_closed_chain(Trial& trial, BodyId body, const Room& room, const ShapeDef& material)
{
    Chain chain{.start = vec(room.corners[0]), .pieces = {}, .closed = true};
    chain.sides = trial.random.chance(0.5) ? Sides::Left : Sides::Both;
    for (const Wall& wall : walls_of(room))
    {
        const std::vector<Point> points = cuts(trial.random, wall.a, wall.b);
        for (std::size_t i = 1; i < points.size(); ++i)
            chain.pieces.push_back({.end = vec(points[i])});
    }
    chain.pieces.back().end = chain.start;
    trial.story << "closed chain" << (chain.sides == Sides::Left ? ", one-sided; " : "; ");
    trial.scene().create_shape(body, chain, material);
}

void add_open_chain(Trial& trial, BodyId body, const Wall& wall, const ShapeDef& material)
{
    Chain chain{.start = vec(wall.a)};
    const std::vector<Point> points = cuts(trial.random, wall.a, wall.b);
    for (std::size_t i = 1; i < points.size(); ++i)
        chain.pieces.push_back({.end = vec(points[i])});
    chain.sides = trial.random.chance(0.4) ? Sides::Left : Sides::Both;
    trial.scene().create_shape(body, chain, material);
}

void build_polygon_walls(Trial& trial, BodyId body, const Room& room, const ShapeDef& material, bool may_be_infinite)
{
    Random& random = trial.random;
    if (random.chance(0.25))
        return add_closed_chain(trial, body, room, material);
    const int kinds = static_cast<int>(Kind::Count) - (may_be_infinite ? 0 : 1);
    const bool mixed = random.chance(0.3);
    int kind = random.below(kinds);
    trial.story << "walls of kinds";
    for (const Wall& wall : walls_of(room))
    {
        trial.story << " " << kind;
        add_wall(trial, body, wall, material, static_cast<Kind>(kind));
        kind = mixed ? random.below(kinds) : kind;
    }
    trial.story << "; ";
}

void add_arcs(Trial& trial, BodyId body, const Room& room, const ShapeDef& material)
{
    const int pieces = 1 + trial.random.below(4);
    const double half = trial.random.chance(0.5) ? 0 : 0.5 * room.radius * log_uniform(trial.random, 0.002, 0.2);
    const Sides sides = half == 0 && trial.random.chance(0.3) ? Sides::Left : Sides::Both;
    const double start = trial.random.range(-M_PI, M_PI);
    for (int i = 0; i < pieces; ++i)
        trial.scene().create_shape(body,
                                   Arc{.radius = f(room.radius + half),
                                       .start_angle = f(start + 2 * M_PI * i / pieces),
                                       .sweep = pieces == 1 ? 2 * pi : f(2 * M_PI / pieces),
                                       .half_thickness = f(half),
                                       .sides = sides},
                                   material);
    trial.story << pieces << " arcs, half thickness " << half << (sides == Sides::Left ? ", one-sided; " : "; ");
}

// Two straight lines and two half circles, or four quarters of a circle.
void add_stadium(Trial& trial, BodyId body, const Room& room, const ShapeDef& material)
{
    const double half = room.corners[1].x;
    const double r = room.radius;
    Chain chain{.start = vec({-half, -r}), .pieces = {}, .closed = true};
    if (half > 0)
        chain.pieces.push_back({.end = vec({half, -r})});
    chain.pieces.push_back({.end = vec({half + r, 0}), .sweep = 0.5f * pi});
    chain.pieces.push_back({.end = vec({half, r}), .sweep = 0.5f * pi});
    if (half > 0)
        chain.pieces.push_back({.end = vec({-half, r})});
    chain.pieces.push_back({.end = vec({-half - r, 0}), .sweep = 0.5f * pi});
    chain.pieces.push_back({.end = chain.start, .sweep = 0.5f * pi});
    chain.sides = trial.random.chance(0.4) ? Sides::Left : Sides::Both;
    trial.story << "chain of arcs, half length " << half << (chain.sides == Sides::Left ? ", one-sided; " : "; ");
    trial.scene().create_shape(body, chain, material);
}

} // namespace

double Room::depth(Point p) const
{
    if (!round())
        return depth_in_polygon(corners, p);
    return radius - norm(p - nearest_on_segment(corners[0], corners[1], p));
}

Room pick_polygon_room(Random& random, double inner)
{
    const int n = 3 + random.below(5);
    const double start = random.range(-M_PI, M_PI);
    std::vector<Point> corners;
    for (int i = 0; i < n; ++i)
        corners.push_back(direction(start + 2 * M_PI * (i + random.range(-0.2, 0.2)) / n));
    return fitted(std::move(corners), inner);
}

Room pick_wedge_room(Random& random, double inner)
{
    const double half_angle = random.range(0.08, 0.6);
    const double start = random.range(-M_PI, M_PI);
    // The corner looks to the right, the third wall stands as far behind the origin as the disc needs.
    const double tip = 1 / std::sin(half_angle);
    const double half_wall = (tip + 1) * std::tan(half_angle);
    return fitted({turn(start, {tip, 0}), turn(start, {-1, half_wall}), turn(start, {-1, -half_wall})}, inner);
}

Room pick_round_room(Random& random, double inner)
{
    const double half = random.chance(0.6) ? 0 : inner * random.range(0.2, 3);
    return {{{-half, 0}, {half, 0}}, inner};
}

Room corridor(double half_length, double half_width)
{
    return {{{-half_length, -half_width}, {half_length, -half_width}, {half_length, half_width}, {-half_length, half_width}}, 0};
}

void build_lane(Trial& trial, BodyId body, double half_length, bool may_be_infinite)
{
    const ShapeDef material = pick_material(trial.random);
    const Wall wall{{-half_length, 0}, {half_length, 0}, {0, -1}};
    const int kinds = static_cast<int>(Kind::Count) + (may_be_infinite ? 1 : 0);
    const int kind = trial.random.below(kinds);
    trial.story << "wall of kind " << kind << " half length " << half_length << " e " << material.restitution << " mu "
                << material.friction << "; ";
    if (kind != static_cast<int>(Kind::HalfSpaces) || may_be_infinite)
        if (kind < static_cast<int>(Kind::Count))
            return add_wall(trial, body, wall, material, static_cast<Kind>(kind));
    add_open_chain(trial, body, wall, material);
}

BodyId build_walls(Trial& trial, const Room& room, BodyType type, double spin)
{
    ShapeDef material = pick_material(trial.random);
    trial.story << "room e " << material.restitution << " mu " << material.friction << " turns " << spin << " radius "
                << room.radius << " corners";
    for (const Point p : room.corners)
        trial.story << " " << p;
    trial.story << " ";
    const BodyId body = trial.scene().create_body({.type = type, .angular_velocity = f(spin)});
    if (!room.round())
        build_polygon_walls(trial, body, room, material, type == BodyType::Static);
    else if (room.corners[1].x == 0 && trial.random.chance(0.7))
        add_arcs(trial, body, room, material);
    else
        add_stadium(trial, body, room, material);
    return body;
}

void expect_inside(Trial& trial, const Room& room, BodyId body, double spin)
{
    trial.expect(
        [&trial, room, body, spin]() -> std::string
        {
            const Point p = turn(-spin * trial.time(), point(trial.scene().body(body).center_of_mass()));
            const double depth = room.depth(p);
            return depth > 0 ? "" : say("body ", body.slot, " is ", -depth, " m beyond the walls");
        });
}

double way_to_walls(const Room& room, Point from, Point along, double radius)
{
    // The depth falls no faster than the way: conservative advancement, to a thousandth of the disc.
    double way = 0;
    for (int i = 0; i < 1000; ++i)
    {
        const double left = room.depth(from + way * along) - radius;
        if (left <= 1e-3 * radius)
            break;
        way += left;
    }
    return way;
}

} // namespace carom::shots
