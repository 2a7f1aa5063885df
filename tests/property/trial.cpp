#include "property/trial.h"

#include <algorithm>
#include <iostream>

namespace carom::shots {

namespace {

bool finite(const ConstBody& body)
{
    const Pose p = body.pose();
    const Vec2 v = body.velocity();
    return std::isfinite(p.position.x) && std::isfinite(p.position.y) && std::isfinite(p.rotation.c) &&
           std::isfinite(p.rotation.s) && std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(body.angular_velocity());
}

double log_range(Random& random, double low, double high) { return low * std::pow(high / low, random.unit()); }

float pick_dt(Random& random)
{
    constexpr float common[] = {1.0f / 30, 1.0f / 60, 1.0f / 120, 1.0f / 240, 1.0f / 1000};
    const int i = random.below(10);
    return i < 5 ? common[i] : static_cast<float>(log_range(random, 1.0 / 1000, 1.0 / 30));
}

// Mostly the size of what moves. Where nothing rests, the default must do for any size; else within the documented tenth to ten times.
float pick_length_scale(Random& random, double size, bool weightless)
{
    const int i = random.below(4);
    if (i == 0 && (weightless || size >= 0.1))
        return 1;
    return static_cast<float>(i == 1 ? size * log_range(random, 0.3, 3) : size);
}

} // namespace

std::ostream& operator<<(std::ostream& out, Point p) { return out << "(" << p.x << ", " << p.y << ")"; }

Scene& Trial::open(double size, Point gravity)
{
    SceneDef def;
    def.gravity = vec(gravity);
    def.length_scale = pick_length_scale(random, size, norm(gravity) == 0);
    def.sleeping = random.chance(0.5);
    dt = pick_dt(random);
    m_scene = std::make_unique<Scene>(def);
    story << "dt 1/" << 1 / d(dt) << ", length_scale " << def.length_scale << ", gravity " << gravity << "; ";
    return *m_scene;
}

// 0.005 of the length scale: the overlap that the engine leaves alone.
double Trial::slop() const { return 0.005 * d(m_scene->def().length_scale); }

void Trial::add_body(ConstBody body, Sums& sums) const
{
    const double m = d(body.mass());
    const double inertia = d(body.inertia());
    const Point x = point(body.center_of_mass());
    const Point v = point(body.velocity());
    const double w = d(body.angular_velocity());
    const Point g = point(m_scene->gravity());
    const double along = m * dot(m_frame.u, v);
    const double around = m_frame.w * (m * cross(x - m_frame.pivot, v) + inertia * w);
    const double kinetic = 0.5 * m * dot(v, v) + 0.5 * inertia * w * w;
    sums.energy += kinetic - m * dot(g, x - m_time * m_frame.u) - along - around;
    sums.scale += kinetic + std::fabs(along) + std::fabs(around);
    sums.weight += m * norm(g);
    sums.momentum = sums.momentum + m * v;
    sums.momentum_scale += m * norm(v);
    sums.angular += m * cross(x, v) + inertia * w;
    sums.angular_scale += m * norm(x) * norm(v) + inertia * std::fabs(w);
}

void Trial::add_springs(Sums& sums)
{
    for (const JointId id : m_scene->joints())
    {
        const ConstJoint joint = m_scene->joint(id);
        const JointDef def = joint.def();
        const SpringDef* spring = std::get_if<SpringDef>(&def);
        if (!spring)
            continue;
        const double x = norm(point(joint.anchor_b()) - point(joint.anchor_a())) - d(spring->length);
        sums.energy += 0.5 * d(spring->stiffness) * x * x;
        sums.scale += 0.5 * d(spring->stiffness) * x * x;
    }
}

Trial::Sums Trial::sums()
{
    Sums sums;
    for (const BodyId id : m_scene->bodies())
        if (m_scene->body(id).type() == BodyType::Dynamic)
            add_body(m_scene->body(id), sums);
    add_springs(sums);
    sums.scale += std::fabs(m_work()); // it follows from an angle in floats
    return sums;
}

void Trial::print_state(int step)
{
    const Sums now = sums();
    std::cout << "step " << step << " t " << m_time << " energy " << now.energy - m_work() << " momentum " << now.momentum << " "
              << now.angular << "\n";
    const StepReport& report = m_scene->report();
    std::cout << "  flags " << report.flags << " flying " << report.flight_bodies << " impacts at their time "
              << report.flight_impacts << " others " << report.bulk_impacts << "\n";
    for (const BodyId id : m_scene->bodies())
    {
        const ConstBody body = m_scene->body(id);
        if (body.type() != BodyType::Static)
            std::cout << "  body " << id.slot << " at " << point(body.position()) << " angle " << body.angle() << " v "
                      << point(body.velocity()) << " w " << body.angular_velocity() << "\n";
    }
    for (const ImpactEvent& e : m_scene->impacts())
        std::cout << "  impact t " << e.time << " bodies " << e.body_a.slot << " " << e.body_b.slot << " at " << point(e.point)
                  << " n " << point(e.normal) << " approach " << e.approach_speed << " impulse " << e.impulse << " e "
                  << e.restitution << " lost " << e.energy_lost << "\n";
    for (const ContactBeginEvent& e : m_scene->contact_begins())
        std::cout << "  begin t " << e.time << " shapes " << e.shape_a.slot << " " << e.shape_b.slot << "\n";
    for (const ContactEndEvent& e : m_scene->contact_ends())
        std::cout << "  end t " << e.time << " shapes " << e.shape_a.slot << " " << e.shape_b.slot << "\n";
    for (const TriggerEvent& e : m_scene->trigger_enters())
        std::cout << "  enter t " << e.time << " trigger " << e.trigger.slot << " visitor " << e.visitor.slot << "\n";
    for (const TriggerEvent& e : m_scene->trigger_exits())
        std::cout << "  exit t " << e.time << " trigger " << e.trigger.slot << " visitor " << e.visitor.slot << "\n";
}

std::optional<Failure> Trial::check_finite(int step)
{
    if (!m_scene->report().quarantined.empty() || m_scene->report().has(StepFlag::BodyQuarantined))
        return Failure{"quarantine", step, "a body was quarantined"};
    for (const BodyId id : m_scene->bodies())
        if (!finite(m_scene->body(id)))
            return Failure{"finite", step, say("body ", id.slot, " is not finite")};
    return std::nullopt;
}

// The energy that it takes to push out the overlaps that there were when the last step began, against the forces that press bodies into each other.
double Trial::pressed_work(const Sums& now) const
{
    double sum = 0;
    for (const ContactInfo& c : m_scene->contacts())
    {
        double deepest = 0;
        double impulse = 0;
        for (int i = 0; i < c.point_count; ++i)
        {
            deepest = std::max(deepest, -d(c.points[i].separation));
            impulse += d(c.points[i].normal_impulse);
        }
        sum += deepest * std::max(now.weight, impulse / d(dt));
    }
    return sum;
}

// Against the least energy so far, not against the start: what an impact has lost must not come back. What was pressed together then comes apart again.
std::optional<Failure> Trial::check_energy(int step)
{
    const Sums now = sums();
    m_pressed = std::max(std::exchange(m_is_least, false) ? 0 : m_pressed, pressed_work(now));
    const double net = now.energy - m_work();
    constexpr double rounding = 1e-14; // what is left of speeds that floats took from each other
    const double allowed = 1e-4 * std::max(now.scale, m_least.scale) + rounding * m_start.scale + now.weight * slop() +
                           (step + 1) * m_work_resolution + 2 * m_pressed; // within a step they may be deeper than at its ends
    const double rise = net - m_least_net;
    if (m_check_energy && rise > allowed)
        return Failure{"energy", step, say("energy rose by ", rise, " J from ", m_least_net, " J, allowed ", allowed, " J")};
    if (rise < 0)
    {
        m_least = now;
        m_least_net = net;
        m_is_least = true;
    }
    return std::nullopt;
}

// Rounding is of the momenta that were there: a pair that spins in place and strikes flies apart with far more than it came with. What falls
// asleep stops.
std::optional<Failure> Trial::check_momentum(int step)
{
    if (!m_check_momentum || m_scene->report().awake_bodies < m_scene->report().bodies)
    {
        m_check_momentum = false;
        return std::nullopt;
    }
    const Sums now = sums();
    const double off = norm(now.momentum - m_start.momentum);
    m_start.momentum_scale = std::max(m_start.momentum_scale, now.momentum_scale);
    if (off > 1e-5 * m_start.momentum_scale)
        return Failure{"momentum", step, say("momentum off by ", off / m_start.momentum_scale, " of the sum of magnitudes")};
    if (!m_check_angular)
        return std::nullopt;
    const double twist = std::fabs(now.angular - m_start.angular);
    const double scale = std::max(now.angular_scale, m_start.angular_scale);
    if (twist > 1e-5 * scale)
        return Failure{"momentum", step, say("angular momentum off by ", twist / scale, " of the sum of magnitudes")};
    return std::nullopt;
}

// Every pair is inside or outside, and no pair enters twice.
template <class Key, class Events>
static void count(std::map<std::pair<ShapeId, ShapeId>, std::pair<int, int>>& counts, const Events& events, Key&& key, bool begin)
{
    for (const auto& e : events)
        ++(begin ? counts[key(e)].first : counts[key(e)].second);
}

static std::string settle(const std::map<std::pair<ShapeId, ShapeId>, std::pair<int, int>>& counts,
                          std::map<std::pair<ShapeId, ShapeId>, int>& open)
{
    for (const auto& [pair, n] : counts)
    {
        int& state = open[pair];
        state += n.first - n.second;
        if (state != 0 && state != 1)
            return say("shapes ", pair.first.slot, " and ", pair.second.slot, ": ", n.first, " begins and ", n.second,
                       " ends leave ", state, " open");
    }
    return {};
}

std::optional<Failure> Trial::check_pairs(int step)
{
    Pairs triggers;
    const auto trigger_key = [](const TriggerEvent& e) { return std::pair{e.trigger, e.visitor}; };
    count(triggers, m_scene->trigger_enters(), trigger_key, true);
    count(triggers, m_scene->trigger_exits(), trigger_key, false);
    if (const std::string wrong = settle(triggers, m_inside); !wrong.empty())
        return Failure{"triggers", step, wrong};
    Pairs contacts;
    const auto contact_key = [](const auto& e) { return std::minmax(e.shape_a, e.shape_b); };
    count(contacts, m_scene->contact_begins(), contact_key, true);
    count(contacts, m_scene->contact_ends(), contact_key, false);
    if (const std::string wrong = settle(contacts, m_touching); !wrong.empty())
        return Failure{"contacts", step, wrong};
    return std::nullopt;
}

std::optional<Failure> Trial::check_sides(int step)
{
    for (const Expectation& expectation : m_expectations)
        if (const std::string wrong = expectation.holds(); !wrong.empty())
            return Failure{expectation.law, step, wrong};
    return std::nullopt;
}

std::optional<Failure> Trial::step_once(int step)
{
    for (const auto& [body, torque] : m_torques)
        m_scene->body(body).apply_torque(torque);
    m_scene->step(dt);
    m_time += d(dt);
    m_met = m_met || !m_scene->impacts().empty() || !m_scene->trigger_enters().empty();
    // All of them look at every step: some remember.
    const std::optional<Failure> found[] = {check_finite(step), check_sides(step), check_energy(step), check_momentum(step),
                                            check_pairs(step)};
    for (const auto& failure : found)
        if (failure)
            return failure;
    return std::nullopt;
}

// Whatever is inside a trigger or touches must come out when its body is destroyed.
std::optional<Failure> Trial::take_apart()
{
    for (const BodyId id : m_scene->bodies())
        if (m_scene->body(id).type() != BodyType::Static || random.chance(0.5))
            m_scene->destroy(id);
    m_scene->step(dt);
    if (auto failure = check_pairs(steps + 1))
        return failure;
    for (const auto& [pair, open] : m_inside)
        if (open != 0)
            return Failure{"triggers", steps + 1, say("visitor ", pair.second.slot, " never left trigger ", pair.first.slot)};
    for (const auto& [pair, open] : m_touching)
        if (open != 0)
            return Failure{"contacts", steps + 1, say("shapes ", pair.first.slot, " and ", pair.second.slot, " never ended")};
    return std::nullopt;
}

std::optional<Failure> Trial::run(bool trace)
{
    m_start = m_least = sums();
    m_least_net = m_least.energy;
    if (trace)
        print_state(0);
    std::optional<Failure> first;
    for (int i = 1; i <= steps && (!first || trace); ++i)
    {
        auto failure = step_once(i);
        if (trace)
            print_state(i);
        if (failure && trace)
            std::cout << "  *** " << failure->law << ": " << failure->sentence << "\n";
        if (failure && !first)
            first = failure;
    }
    return first ? first : take_apart();
}

} // namespace carom::shots
