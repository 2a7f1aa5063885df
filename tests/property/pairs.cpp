// Two free bodies, mass ratios of about 0.01 to 100, without gravity: momentum stays, and they do not pass through each other.

#include "property/arrangements.h"
#include "property/pieces.h"

#include <algorithm>

namespace carom::shots {

namespace {

struct Pair
{
    BodyId a{};
    BodyId b{};
    Point apart{};    // of b from a at the start
    Point velocity{}; // of b seen from a
};

// Two pieces of like size, and how b comes towards a.
struct Couple
{
    Piece a;
    Piece b;
    double speed = 0;
    Point along{};
};

Couple open_couple(Trial& trial, Piece (*pick)(Random&, double))
{
    Random& random = trial.random;
    const double reach = pick_size(random);
    Couple c{pick(random, reach), {}};
    c.b = pick_piece(random, pick_size_near(random, reach));
    trial.open(std::sqrt(c.a.reach * c.b.reach), {});
    c.speed = pick_speed(random);
    c.along = pick_direction(random);
    return c;
}

// Places b so that it comes towards a with the velocity; both drift along with something of their own.
Pair send(Trial& trial, const Piece& a, double angle_a, const Piece& b, double angle_b, Point apart, Point velocity, bool turning)
{
    Random& random = trial.random;
    const Point at{random.range(-20, 20), random.range(-20, 20)};
    const double share = random.chance(0.3) ? 0 : random.unit();
    const double drift = random.chance(0.3) ? 0 : 0.3 * norm(velocity) * random.unit();
    const Point common = drift * pick_direction(random) - share * velocity;
    const double wa = turning ? random.range(-50, 50) : 0;
    const double wb = turning ? random.range(-50, 50) : 0;
    const MotionLocks locks{.angular = !turning};
    Pair pair{{}, {}, apart, velocity};
    pair.a = add_piece(trial, a, BodyType::Dynamic, at, angle_a, common, wa, locks);
    pair.b = add_piece(trial, b, BodyType::Dynamic, at + apart, angle_b, common + velocity, wb, locks);
    trial.expect_momentum(turning);
    return pair;
}

Point apart_now(Trial& trial, const Pair& pair)
{
    return point(trial.scene().body(pair.b).position()) - point(trial.scene().body(pair.a).position());
}

// After the bounce the two part along n for good.
void expect_outside_tangent(Trial& trial, const Pair& pair, Point met, Point n, double size)
{
    trial.story << "meet when apart by " << met << " n " << n << "; ";
    expect_outside(trial, n, std::min(trial.slop(), 0.1 * size), [&trial, pair, met] { return apart_now(trial, pair) - met; });
}

void expect_apart(Trial& trial, const Pair& pair, const Piece& a, const Piece& b)
{
    const double allowed = 0.5 * std::min(a.inner, b.inner);
    trial.expect(
        [&trial, pair, a, b, allowed]() -> std::string
        {
            const double gap = separation(moved(a.outline, trial.scene().body(pair.a).pose()),
                                          moved(b.outline, trial.scene().body(pair.b).pose()));
            return gap > -allowed ? "" : say("the pair overlaps by ", -gap, " m");
        });
}

// Discs within the two meet at that time at the latest: from then on the velocities have changed.
void expect_exchange(Trial& trial, const Pair& pair, double latest)
{
    trial.story << "meet before " << latest << " s; ";
    trial.expect(
        [&trial, pair, latest]() -> std::string
        {
            const Point v = point(trial.scene().body(pair.b).velocity()) - point(trial.scene().body(pair.a).velocity());
            const bool changed = norm(v - pair.velocity) > 1e-3 * norm(pair.velocity);
            return changed || trial.time() <= latest ? "" : say("the pair went through each other unhindered");
        });
}

} // namespace

void ball_pair(Trial& trial)
{
    Random& random = trial.random;
    const double ra = pick_size(random);
    const double rb = pick_size_near(random, ra);
    trial.open(std::sqrt(ra * rb), {});
    const double speed = pick_speed(random);
    const Point along = pick_direction(random);
    const Point n = turn(random.range(-1.25, 1.25), -along);
    const double gap = pick_gap(trial, speed, 100 * (ra + rb));
    pick_steps(trial, gap, speed, 6);
    const Point met = (ra + rb) * n;
    const Pair pair = send(trial, make_ball(ra), 0, make_ball(rb), 0, met - gap * along, speed * along, random.chance(0.5));
    expect_outside_tangent(trial, pair, met, n, std::min(ra, rb));
}

void straight_pair(Trial& trial)
{
    Random& random = trial.random;
    const auto [a, b, speed, along] = open_couple(trial, pick_piece);
    const double angle_a = random.range(-M_PI, M_PI);
    const double angle_b = random.range(-M_PI, M_PI);
    const Point aside = random.range(-0.8, 0.8) * (a.inner + b.inner) * turned_left(along);
    const double far = 2 * (a.reach + b.reach);
    const Point from = aside - far * along;
    const Meeting meeting = first_meeting(moved(b.outline, from, angle_b), along, moved(a.outline, {}, angle_a), 2 * far);
    const Point met = from + meeting.time * along;
    const double gap = pick_gap(trial, speed, 50 * (a.reach + b.reach));
    pick_steps(trial, gap, speed, 6);
    const Pair pair = send(trial, a, angle_a, b, angle_b, met - gap * along, speed * along, false);
    expect_outside_tangent(trial, pair, met, meeting.n, std::min(a.inner, b.inner));
}

void spinning_pair(Trial& trial)
{
    Random& random = trial.random;
    const auto [a, b, speed, along] = open_couple(trial, pick_long_piece);
    const double inner = a.inner + b.inner;
    const double outer = 1.001 * (a.reach + b.reach);
    const double aside = random.range(-0.5, 0.5) * inner;
    const double gap = pick_gap(trial, speed, 50 * outer);
    const double behind = gap + std::sqrt(outer * outer - aside * aside);
    pick_steps(trial, behind, speed, 6);
    const double angle_a = random.range(-M_PI, M_PI);
    const double angle_b = random.range(-M_PI, M_PI);
    const Pair pair = send(trial, a, angle_a, b, angle_b, aside * turned_left(along) - behind * along, speed * along, true);
    expect_apart(trial, pair, a, b);
    expect_exchange(trial, pair, (behind - std::sqrt(inner * inner - aside * aside)) / speed);
}

} // namespace carom::shots
