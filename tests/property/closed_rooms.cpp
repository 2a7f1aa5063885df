// Things in closed rooms stay in them, beads on a string keep their order.

#include "property/arrangements.h"
#include "property/rooms.h"

#include <algorithm>

namespace carom::shots {

namespace {

// A shot from inside of the room towards its walls, and a few bounces.
void shoot_inside(Trial& trial, const Room& room, const Piece& piece, double spin = 0)
{
    Random& random = trial.random;
    const double speed = pick_speed(random);
    const Point along = pick_direction(random);
    const double off = random.chance(0.2) ? 0 : 0.95 * std::max(room.depth({}) - 1.02 * piece.reach, 0.0) * random.unit();
    const Point from = off * pick_direction(random);
    const double way = way_to_walls(room, from, along, 1.01 * piece.reach);
    const double gap = pick_gap(trial, speed, way);
    pick_steps(trial, gap, speed, 10);
    const BodyId body = shoot(trial, piece, from + (way - gap) * along, speed * along);
    expect_inside(trial, room, body, spin);
}

void in_room(Trial& trial, const Piece& piece, const Room& room)
{
    const Point gravity = pick_gravity(trial.random);
    trial.open(piece.reach, gravity);
    build_walls(trial, room);
    shoot_inside(trial, room, piece);
}

double room_for(Random& random, const Piece& piece) { return piece.reach * log_uniform(random, 1.1, 20); }

// Beads that can never pass each other in a corridor as wide as the largest.
std::vector<Piece> pick_beads(Random& random, double size)
{
    const int count = 2 + random.below(3);
    std::vector<Piece> beads;
    double narrowest = 1e9;
    while (static_cast<int>(beads.size()) < count)
    {
        const Piece bead = pick_piece(random, size * random.range(0.85, 1));
        if (bead.inner < 0.6 * size)
            continue;
        narrowest = std::min(narrowest, bead.inner);
        beads.push_back(bead);
    }
    return beads;
}

double widest_corridor(const std::vector<Piece>& beads)
{
    // Centers are within the half width less the inner radius; neighbors whose inner discs cannot stand side by side keep order.
    double least = 1e9;
    for (std::size_t i = 1; i < beads.size(); ++i)
        least = std::min(least, beads[i - 1].inner + beads[i].inner);
    return 0.98 * least;
}

void expect_order(Trial& trial, std::vector<BodyId> beads)
{
    trial.expect(
        [&trial, beads]() -> std::string
        {
            for (std::size_t i = 1; i < beads.size(); ++i)
            {
                const double ahead = trial.scene().body(beads[i]).position().x - trial.scene().body(beads[i - 1]).position().x;
                if (ahead <= 0)
                    return say("body ", beads[i - 1].slot, " has passed body ", beads[i].slot, " by ", -ahead, " m");
            }
            return "";
        });
}

// Rows of equal balls with small random gaps, in a box that leaves room around them.
std::vector<Point> grid(Random& random, int count, double spacing)
{
    const int columns = 1 + random.below(4);
    std::vector<Point> places;
    for (int i = 0; i < count; ++i)
        places.push_back({spacing * (i % columns), spacing * (i / columns)});
    Point middle;
    for (const Point p : places)
        middle = middle + (1.0 / count) * p;
    for (Point& p : places)
        p = p - middle;
    return places;
}

// A row of pieces standing on the floor and touching, one more row on top of it.
void build_pile(Trial& trial, double size, double floor, const std::function<void(BodyId)>& keep)
{
    Random& random = trial.random;
    const int below = 2 + random.below(3);
    const bool boxes = random.chance(0.5);
    const double pitch = 2 * size;
    const double rise = boxes ? 2 * size : std::sqrt(3) * size;
    for (int row = 0; row < 2; ++row)
        for (int i = 0; i < below - row; ++i)
        {
            const Point at{pitch * (i + 0.5 * row - 0.5 * (below - 1)), floor + size + rise * row};
            Piece piece = make_ball(size);
            if (boxes)
                piece.geometry = box(static_cast<float>(size), static_cast<float>(size));
            keep(add_piece(trial, piece, BodyType::Dynamic, at, 0, {}, 0));
        }
}

void in_room(Trial& trial, const Piece& piece, Room (*pick)(Random&, double))
{
    const double inner = room_for(trial.random, piece);
    in_room(trial, piece, pick(trial.random, inner));
}

Piece any_ball(Trial& trial) { return make_ball(pick_size(trial.random)); }
Piece any_long_piece(Trial& trial) { return pick_long_piece(trial.random, pick_size(trial.random)); }

} // namespace

void ball_in_room(Trial& trial) { in_room(trial, any_ball(trial), pick_polygon_room); }
void ball_in_round_room(Trial& trial) { in_room(trial, any_ball(trial), pick_round_room); }
void ball_in_wedge(Trial& trial) { in_room(trial, any_ball(trial), pick_wedge_room); }
void piece_in_room(Trial& trial) { in_room(trial, any_long_piece(trial), pick_polygon_room); }
void piece_in_round_room(Trial& trial) { in_room(trial, any_long_piece(trial), pick_round_room); }
void piece_in_wedge(Trial& trial) { in_room(trial, any_long_piece(trial), pick_wedge_room); }

void drum(Trial& trial)
{
    Random& random = trial.random;
    const Piece piece = pick_piece(random, pick_size(random));
    const double inner = room_for(random, piece);
    const Room room = random.chance(0.5) ? pick_polygon_room(random, inner) : pick_round_room(random, inner);
    const Point gravity = pick_gravity(random);
    trial.open(piece.reach, gravity);
    const double spin = as_float(random.range(-50, 50));
    build_walls(trial, room, BodyType::Kinematic, spin);
    if (norm(gravity) > 0)
        trial.skip_energy();
    else
        trial.energy_in({{}, spin, {}});
    shoot_inside(trial, room, piece, spin);
}

void tube(Trial& trial)
{
    Random& random = trial.random;
    const double size = pick_size(random);
    const std::vector<Piece> beads = pick_beads(random, size);
    const Point gravity = pick_gravity(random);
    trial.open(size, gravity);
    const double speed = pick_speed(random);
    const double gap = pick_gap(trial, speed, 20 * size);
    pick_steps(trial, gap, speed, 10);
    const double pitch = 2.01 * size + gap;
    const Room room = corridor(0.5 * pitch * static_cast<double>(beads.size()) + size,
                               random.range(1.005 * size, std::max(1.01 * size, widest_corridor(beads))));
    build_walls(trial, room);
    std::vector<BodyId> bodies;
    for (std::size_t i = 0; i < beads.size(); ++i)
    {
        const double x = pitch * (static_cast<double>(i) - 0.5 * static_cast<double>(beads.size() - 1));
        const bool first = i == 0;
        const double v = first ? speed : random.chance(0.5) ? 0 : -speed * random.unit();
        bodies.push_back(shoot(trial, beads[i], {x, 0}, v * direction(random.range(-0.2, 0.2))));
        expect_inside(trial, room, bodies.back());
    }
    expect_order(trial, bodies);
}

namespace {

// One ball among others at rest.
void shot_in_crowd(Trial& trial, int least, int most)
{
    Random& random = trial.random;
    const double size = pick_size(random);
    const Point gravity = pick_gravity(random);
    trial.open(size, gravity);
    const int count = least + random.below(most - least + 1);
    const std::vector<Point> places = grid(random, count, 2 * size * random.range(1.001, 1.5));
    double reach = 0;
    for (const Point p : places)
        reach = std::max(reach, norm(p) + size);
    const Room room = pick_polygon_room(random, 1.05 * reach);
    build_walls(trial, room);
    const double speed = pick_speed(random);
    pick_steps(trial, size, speed, 10);
    const int shot = random.below(count);
    for (int i = 0; i < count; ++i)
        expect_inside(trial, room,
                      add_piece(trial, make_ball(size), BodyType::Dynamic, places[static_cast<std::size_t>(i)], 0,
                                i == shot ? speed * pick_direction(random) : Point{}, 0));
}

} // namespace

void crowd(Trial& trial) { shot_in_crowd(trial, 3, 12); }
void company(Trial& trial) { shot_in_crowd(trial, 17, 200); }

void pile(Trial& trial)
{
    Random& random = trial.random;
    const double size = pick_size(random);
    trial.open(size, {0, -9.81});
    const double half_length = size * random.range(6, 9);
    const Room room = corridor(half_length, size * random.range(3, 6));
    build_walls(trial, room);
    const double floor = room.corners[0].y;
    const auto keep = [&](BodyId body) { expect_inside(trial, room, body); };
    build_pile(trial, size, floor, keep);
    const double speed = pick_speed(random);
    const double shot_size = size * random.range(0.3, 0.9);
    const double way = way_to_walls(room, {}, {-1, 0}, shot_size) - 5 * size;
    const double gap = pick_gap(trial, speed, way);
    pick_steps(trial, gap, speed, 10);
    const Point from{room.corners[0].x + 1.05 * shot_size + way - gap, floor + size * random.range(1, 3)};
    const Piece shot = pick_piece(random, shot_size);
    keep(shoot(trial, shot, from, speed * direction(random.range(-0.2, 0.2))));
}

} // namespace carom::shots
