// 14. A thousand discs, boxes and polygons fall into a bin and come to rest: how deep they lie in each other, how still they lie.

#include "truth/box2d_3_2.h"
#include "truth/experiments/experiments.h"
#include "truth/measure.h"
#include "truth/overlap.h"
#include "truth/random.h"

#include <algorithm>

namespace truth {
namespace {

constexpr double bin_width = 12;
constexpr int columns = 25;
constexpr int rows = 40;
constexpr Material rubble{.friction = 0.5};
// Chaotic: two runs that differ in a last bit differ by some percent.
constexpr double tolerance = 1.05;

struct Piece
{
    Body body = 0;
    Shape shape{};
    double reach = 0;
};

struct Pile
{
    std::unique_ptr<World> world{};
    std::vector<Placed> walls{};
    std::vector<Piece> pieces{};
};

Polygon regular(int sides, double radius)
{
    Polygon polygon;
    for (int i = 0; i < sides; ++i)
    {
        polygon.vertices.push_back(radius * direction(2 * pi * i / sides));
    }
    return polygon;
}

Shape draw_shape(Random& random)
{
    switch (random.bits() % 3)
    {
    case 0: return Disc{random.in(0.1, 0.2)};
    case 1: return box(2 * random.in(0.08, 0.15), 2 * random.in(0.08, 0.15));
    default: return regular(3 + static_cast<int>(random.bits() % 4), random.in(0.12, 0.2));
    }
}

void add_bin(Pile& pile)
{
    const double height = 60;
    pile.walls = {{box(bin_width + 4, 2), {0, -1}},
                  {box(2, height), {-bin_width / 2 - 1, height / 2}},
                  {box(2, height), {bin_width / 2 + 1, height / 2}}};
    for (const Placed& wall : pile.walls)
    {
        const Body body = pile.world->add_body({.motion = Motion::Static, .position = wall.position});
        pile.world->add_shape(body, wall.shape, rubble);
    }
}

Pile build(const Setup& setup, std::uint64_t seed)
{
    Random random(seed);
    Pile pile{.world = setup.world(earth)};
    add_bin(pile);
    const double spacing = bin_width / columns;
    for (int i = 0; i < columns * rows; ++i)
    {
        const Vec at{(i % columns + 0.5) * spacing - bin_width / 2, (i / columns + 0.5) * spacing};
        const Shape shape = draw_shape(random);
        const Body body = pile.world->add_body({.position = at, .angle = random.in(0, 2 * pi)});
        pile.world->add_shape(body, shape, rubble);
        pile.pieces.push_back({body, shape, reach(shape)});
    }
    return pile;
}

/// A piece where it stands, with the interval of x that it can cover.
struct Interval
{
    Placed placed{};
    double reach = 0;
};

/// Overlaps of all pairs, by a sweep along x, and with the walls.
void add_overlaps(const Pile& pile, Errors& overlaps)
{
    const auto note = [&](double depth)
    {
        if (depth > 0)
        {
            overlaps.add(depth * 1000);
        }
    };
    std::vector<Interval> sorted;
    for (const Piece& piece : pile.pieces)
    {
        const State s = pile.world->state(piece.body);
        sorted.push_back({{piece.shape, s.position, s.angle}, piece.reach});
    }
    const auto low = [](const Interval& i) { return i.placed.position.x - i.reach; };
    std::sort(sorted.begin(), sorted.end(), [&](const Interval& a, const Interval& b) { return low(a) < low(b); });
    for (std::size_t i = 0; i < sorted.size(); ++i)
    {
        const Interval& a = sorted[i];
        for (std::size_t j = i + 1; j < sorted.size() && low(sorted[j]) < a.placed.position.x + a.reach; ++j)
        {
            const Interval& b = sorted[j];
            if (length(b.placed.position - a.placed.position) < a.reach + b.reach)
            {
                note(overlap(a.placed, b.placed));
            }
        }
        for (const Placed& wall : pile.walls)
        {
            note(overlap(a.placed, wall));
        }
    }
}

struct Rest
{
    Errors overlaps{}; ///< mm, over the last 5 s
    double rms_speed = 0;
    double fastest = 0;
};

/// Sum of squares; the fastest goes to `fastest`.
double speeds(const Pile& pile, double& fastest)
{
    double sum = 0;
    fastest = 0;
    for (const Piece& piece : pile.pieces)
    {
        const double speed = length(pile.world->state(piece.body).velocity);
        sum += speed * speed;
        fastest = std::max(fastest, speed);
    }
    return sum;
}

Rest settle(const Setup& setup, std::uint64_t seed)
{
    const Pile pile = build(setup, seed);
    const int last = setup.steps(20);
    const int every = setup.steps(0.1);
    Rest rest;
    double squares = 0;
    for (int step = 1; step <= last; ++step)
    {
        setup.tell("pile " + std::to_string(seed) + ", " + std::to_string(100 * step / last) + " %");
        pile.world->step(setup.dt());
        if (step > setup.steps(15) && step % every == 0)
        {
            add_overlaps(pile, rest.overlaps);
        }
        squares += step > setup.steps(19) ? speeds(pile, rest.fastest) : 0;
    }
    const double samples = static_cast<double>(last - setup.steps(19)) * static_cast<double>(pile.pieces.size());
    rest.rms_speed = std::sqrt(squares / samples) * 1000;
    rest.fastest *= 1000;
    return rest;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

} // namespace

Metrics pile(const Setup& setup)
{
    std::vector<double> mean;
    std::vector<double> worst;
    std::vector<double> rms;
    std::vector<double> fastest;
    const int seeds = setup.cases(setup.engine.peer ? 3 : 20);
    for (int seed = 1; seed <= seeds; ++seed)
    {
        const Rest rest = settle(setup, static_cast<std::uint64_t>(seed));
        mean.push_back(rest.overlaps.mean());
        worst.push_back(rest.overlaps.worst());
        rms.push_back(rest.rms_speed);
        fastest.push_back(rest.fastest);
    }
    return {{14, "overlap of overlapping pairs, mean, mm", 0, median(mean), tolerance * box2d_3_2::pile_mean_penetration_mm},
            {14, "overlap in the last 5 s, worst, mm", 0, median(worst), tolerance * box2d_3_2::pile_worst_penetration_mm},
            {14, "speed in the last second, rms, mm/s", 0, median(rms), tolerance * box2d_3_2::pile_rms_speed_mm},
            {14, "speed at the end, fastest, mm/s", 0, median(fastest), tolerance * box2d_3_2::pile_fastest_speed_mm}};
}

} // namespace truth
