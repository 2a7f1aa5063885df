// Something flies straight through a trigger that rests or travels: a ball comes in and goes out once, at the times that geometry
// says; anything else at least once.

#include "property/arrangements.h"
#include "property/pieces.h"

#include <algorithm>

namespace carom::shots {

namespace {

struct Passage
{
    double enter = 0;
    double exit = 0;
    double speed = 0;   // of the visitor seen from the trigger
    double allowed = 0; // m, along the path
};

struct Seen
{
    std::vector<double> enters{};
    std::vector<double> exits{};
};

template <class Events>
void note(std::vector<double>& times, const Events& events, double begin)
{
    for (const TriggerEvent& e : events)
        times.push_back(begin + static_cast<double>(e.time));
}

std::string seen_once(const char* what, const std::vector<double>& seen, double exact, const Passage& passage, double now)
{
    if (seen.empty())
        return now > exact + passage.allowed / passage.speed ? say("no ", what, " until ", now, " s, due at ", exact, " s") : "";
    return seen.size() > 1 ? say(seen.size(), " times ", what) : "";
}

std::string seen_in_time(const char* what, const std::vector<double>& seen, double exact, const Passage& passage)
{
    if (seen.empty())
        return "";
    const double off = std::fabs(seen[0] - exact);
    return off * passage.speed <= passage.allowed ? "" : say(what, " off by ", off, " s, ", off * passage.speed, " m of path");
}

// Both ways through the outline: the exit is the meeting of the way back.
Passage passage_through(const Outline& trigger, const Outline& visitor, Point along, double speed, double far)
{
    const Meeting in = first_meeting(moved(visitor, -far * along, 0), along, trigger, 2 * far);
    const Meeting out = first_meeting(moved(visitor, far * along, 0), -along, trigger, 2 * far);
    return {(in.time - far) / speed, (far - out.time) / speed, speed, 0};
}

ShapeId add_trigger(Trial& trial, const Piece& piece, Point at, double angle, Point u)
{
    const BodyType type = norm(u) > 0 ? BodyType::Kinematic : BodyType::Static;
    const BodyId body = add_piece(trial, piece, type, at, angle, u, 0);
    const ShapeId shape = trial.scene().body(body).shapes().front();
    trial.scene().shape(shape).set_def({.trigger = true});
    return shape;
}

void expect_passage(Trial& trial, const Passage& passage, bool exact)
{
    const auto seen = std::make_shared<Seen>();
    trial.expect(
        [&trial, passage, exact, seen]() -> std::string
        {
            const double now = trial.time();
            const double begin = now - static_cast<double>(trial.dt);
            note(seen->enters, trial.scene().trigger_enters(), begin);
            note(seen->exits, trial.scene().trigger_exits(), begin);
            if (!exact)
                return seen->enters.empty() && now > passage.exit ? say("never entered, due before ", passage.exit, " s") : "";
            const std::string wrong = seen_once("enter", seen->enters, passage.enter, passage, now);
            return wrong.empty() ? seen_once("exit", seen->exits, passage.exit, passage, now) : wrong;
        });
    if (exact)
        trial.expect("time",
                     [passage, seen]() -> std::string
                     {
                         const std::string wrong = seen_in_time("enter", seen->enters, passage.enter, passage);
                         return wrong.empty() ? seen_in_time("exit", seen->exits, passage.exit, passage) : wrong;
                     });
}

} // namespace

void ball_through_trigger(Trial& trial)
{
    Random& random = trial.random;
    const bool is_ball = random.chance(0.7);
    const double reach = pick_size(random);
    const Piece visitor = is_ball ? make_ball(reach) : pick_long_piece(random, reach);
    trial.open(reach, {});
    const Piece trigger = pick_piece(random, pick_size(random));
    const double speed = pick_speed(random);
    const Point along = pick_direction(random);
    const double angle = random.range(-M_PI, M_PI);
    const Point u = random.chance(0.5) ? Point{} : as_floats(pick_velocity(random, 0.01, 300));
    add_trigger(trial, trigger, {}, angle, u);
    // Through the inner disc of the trigger; the visitor's own inner disc is what a spinning one surely brings through.
    const Point aside = random.range(-0.8, 0.8) * trigger.inner * turned_left(along);
    const Outline passing{{aside}, visitor.inner};
    const double far = 3 * (trigger.reach + visitor.reach);
    Passage passage = passage_through(moved(trigger.outline, {}, angle), passing, along, speed, far);
    const double gap =
        pick_gap(trial, speed, 50 * (trigger.reach + visitor.reach)) + (is_ball ? 0 : visitor.reach - visitor.inner);
    const Point at = aside + (passage.enter * speed - gap) * along;
    const double length = (passage.exit - passage.enter) * speed;
    passage = {gap / speed, (gap + length) / speed, speed, trial.slop()};
    pick_steps(trial, gap + (random.chance(0.7) ? length : 0), speed, 6);
    const BodyId shot = shoot(trial, visitor, at, u + speed * along);
    trial.scene().body(shot).set_can_sleep(false); // a slow one would stop on its way
    trial.story << "enters at " << passage.enter << " s, exits at " << passage.exit << " s; ";
    expect_passage(trial, passage, is_ball);
}

} // namespace carom::shots
