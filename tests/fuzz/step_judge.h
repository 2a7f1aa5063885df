#pragma once

// Invariants after every step, whatever was done before it: all that the scene tells is finite, every touch that begins ends once, blows agree with
// themselves, the work is bounded, nobody's momentum comes from nowhere, and where nothing does work no energy does either.

#include "carom/carom.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carom::test {

inline void require(bool holds, const std::string& sentence)
{
    if (holds)
        return;
    std::fprintf(stderr, "%s\n", sentence.c_str());
    std::abort();
}

class StepJudge
{
public:
    /// Before a step or an update.
    void begin(const Scene& scene)
    {
        m_meddled = false;
        m_is_calm = m_is_passive && !m_is_disturbed && length(scene.gravity()) < most_gravity && is_closed(scene);
        m_energy = energy(scene);
        m_bodies = momenta(scene);
    }

    /// After it, where it was not refused.
    void end(const Scene& scene, float time)
    {
        all_is_finite(scene);
        touches_are_paired(scene);
        for (const ImpactEvent& e : scene.impacts())
            blow_agrees(e);
        work_is_bounded(scene, time);
        if (!scene.report().quarantined.empty() || scene.report().has(StepFlag::TimeDropped))
            return;
        m_is_calm &= !m_meddled && time < longest_judged;
        if (time > 0)
            m_is_disturbed = m_meddled;
        if (!m_is_calm)
            return;
        if (!scene.report().has(StepFlag::ImpactsCapped)) // what stops in its way misses forces
            momentum_is_kept(scene, time);
        no_energy_comes(scene);
    }

    /// Something in the scene may do work from now on: motors, kicks, fields, laws, what moves as told.
    void allow_work() { m_is_passive = false; }
    /// The user has changed something since the last step.
    void disturb() { m_is_disturbed = true; }
    /// A callback has changed something in this step.
    void meddle() { m_meddled = m_is_disturbed = true; }

private:
    static constexpr float longest_judged = 0.05f; ///< s; in longer steps joints and orbits are not followed
    static constexpr float most_gravity = 100;     ///< m/s²; likewise

    using Pair = std::pair<ShapeId, ShapeId>;

    struct BySlot
    {
        bool operator()(const Pair& a, const Pair& b) const { return key(a) < key(b); }
        static std::vector<std::uint64_t> key(const Pair& p)
        {
            return {p.first.slot, p.first.generation, p.second.slot, p.second.generation};
        }
    };

    struct Energy
    {
        double kinetic = 0;
        double potential = 0;
        double stored = 0; ///< of it, in springs
        double weight = 0; ///< of all, N
        double mass = 0;
    };

    struct Momentum
    {
        BodyId body{};
        double x = 0, y = 0, mass = 0;
    };

    // --- all numbers -------------------------------------------------------------------------------------------------------------------

    static bool finite(double x) { return std::isfinite(x); }
    static bool finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }
    static bool finite(Position p) { return std::isfinite(p.x) && std::isfinite(p.y); }

    static void all_is_finite(const Scene& scene)
    {
        for (const BodyId id : scene.bodies())
        {
            require(scene.is_valid(id), "a listed body is not valid");
            const ConstBody body = scene.body(id);
            require(finite(body.position()), "a position is not finite");
            require(finite(Vec2{body.rotation().c, body.rotation().s}), "a rotation is not finite");
            require(finite(body.velocity()), "a velocity is not finite");
            require(finite(body.angular_velocity()), "an angular velocity is not finite");
            for (const ShapeId shape : body.shapes())
                require(scene.is_valid(shape), "a listed shape is not valid");
        }
        for (const JointId id : scene.joints())
        {
            const ConstJoint joint = scene.joint(id);
            require(finite(joint.force()), "a joint's force is not finite");
            require(finite(joint.torque()) && finite(joint.coordinate()) && finite(joint.speed()),
                    "a joint's reading is not finite");
        }
        for (const ContactInfo& c : scene.contacts())
        {
            require(finite(c.normal), "a contact's normal is not finite");
            for (int i = 0; i < c.point_count; ++i)
                require(finite(c.points[i].separation) && finite(c.points[i].normal_impulse) &&
                            finite(c.points[i].friction_impulse) && finite(c.points[i].position),
                        "a contact's point is not finite");
        }
        for (const ContactBeginEvent& e : scene.contact_begins())
            require(finite(e.point) && finite(e.normal) && finite(e.time), "the begin of a contact is not finite");
        for (const ContactEndEvent& e : scene.contact_ends())
            require(finite(e.time), "the end of a contact is not finite");
        for (const auto& events : {scene.trigger_enters(), scene.trigger_exits()})
        {
            for (const TriggerEvent& e : events)
                require(finite(e.time), "a trigger's event is not finite");
        }
        for (const ImpactEvent& e : scene.impacts())
        {
            require(finite(e.point) && finite(e.normal) && finite(e.velocity_a) && finite(e.velocity_b) &&
                        finite(e.velocity_after_a) && finite(e.velocity_after_b),
                    "an impact's vectors are not finite");
            for (const float x : {e.approach_speed, e.impulse, e.friction_impulse, e.energy_lost, e.time, e.speed_a, e.speed_b,
                                  e.effective_mass_a, e.effective_mass_b, e.restitution, e.friction, e.kick_speed})
                require(finite(x), "an impact is not finite");
        }
    }

    // --- events ------------------------------------------------------------------------------------------------------------------------

    template <class Begins, class Ends, class PairOf>
    static void count(std::map<Pair, int, BySlot>& open, const Begins& begins, const Ends& ends, const PairOf& pair_of,
                      const std::string& name)
    {
        for (const auto& e : begins)
            ++open[pair_of(e)];
        for (const auto& e : ends)
            --open[pair_of(e)];
        for (const auto& [pair, times] : open)
        {
            require(times >= 0, name + " ended that had not begun");
            require(times <= 1, name + " began that had not ended");
        }
        std::erase_if(open, [](const auto& entry) { return entry.second == 0; });
    }

    static Pair in_order(ShapeId a, ShapeId b) { return BySlot{}({a, b}, {b, a}) ? Pair{a, b} : Pair{b, a}; }

    void touches_are_paired(const Scene& scene)
    {
        count(
            m_touching, scene.contact_begins(), scene.contact_ends(),
            [](const auto& e) { return in_order(e.shape_a, e.shape_b); }, "a touch");
        count(
            m_inside, scene.trigger_enters(), scene.trigger_exits(),
            [](const TriggerEvent& e) { return Pair{e.trigger, e.visitor}; }, "a visit");
        for (const ContactInfo& c : scene.contacts())
        {
            if (c.touching && !m_meddled)
                require(m_touching.contains(in_order(c.shape_a, c.shape_b)), "a contact touches whose begin was not told");
        }
    }

    static double along(Vec2 p, Vec2 v)
    {
        return static_cast<double>(p.x) * static_cast<double>(v.x) + static_cast<double>(p.y) * static_cast<double>(v.y);
    }

    static void blow_agrees(const ImpactEvent& e)
    {
        const float rounding =
            1e-5f * (length(e.velocity_a) + length(e.velocity_b) + length(e.velocity_after_a) + length(e.velocity_after_b));
        require(e.impulse >= 0 && e.approach_speed >= -rounding,
                "an impact of " + std::to_string(e.impulse) + " N s at " + std::to_string(e.approach_speed) + " m/s");
        const Vec2 p = e.impulse * e.normal + e.friction_impulse * perp(e.normal);
        const Vec2 before = e.velocity_b - e.velocity_a;
        const Vec2 after = e.velocity_after_b - e.velocity_after_a;
        const double lost = -0.5 * along(p, before + after);
        const double scale =
            static_cast<double>(length(p)) * static_cast<double>(length(e.velocity_a) + length(e.velocity_b) +
                                                                 length(e.velocity_after_a) + length(e.velocity_after_b));
        require(std::fabs(lost - static_cast<double>(e.energy_lost)) <= 1e-3 * scale + 1e-12,
                "an impact's energy is not that of its impulse");
    }

    // In so many steps of a game.
    static void work_is_bounded(const Scene& scene, float time)
    {
        const StepReport& report = scene.report();
        const int bound = static_cast<int>(std::max(1.0f, 60 * time)) * (4000 + 1000 * report.bodies);
        require(report.flight_impacts <= bound && report.bulk_impacts <= bound,
                "a step resolved " + std::to_string(report.flight_impacts) + " impacts of " + std::to_string(report.bodies) +
                    " bodies");
    }

    // --- momentum ----------------------------------------------------------------------------------------------------------------------

    static bool moves_freely(const ConstBody& body)
    {
        return body.type() == BodyType::Dynamic && body.is_enabled() && body.locks() == MotionLocks{};
    }

    // Free bodies as they are.
    static std::vector<Momentum> momenta(const Scene& scene)
    {
        std::vector<Momentum> bodies;
        for (const BodyId id : scene.bodies())
        {
            const ConstBody body = scene.body(id);
            const double mass = moves_freely(body) ? static_cast<double>(body.mass()) : 0;
            bodies.push_back(
                {id, mass * static_cast<double>(body.velocity().x), mass * static_cast<double>(body.velocity().y), mass});
        }
        return bodies;
    }

    // Bodies that joints and blows and touches connect, by union-find.
    class Groups
    {
    public:
        Groups(const Scene& scene, const std::vector<Momentum>& bodies) : m_bodies(bodies), m_parents(bodies.size())
        {
            std::iota(m_parents.begin(), m_parents.end(), std::size_t{0});
            m_held.resize(bodies.size());
            for (const JointId id : scene.joints())
                connect(scene.joint(id).body_a(), scene.joint(id).body_b());
            connect_all(scene.impacts());
            connect_all(scene.contact_begins());
            connect_all(scene.contact_ends());
            connect_contacts(scene, scene.contacts());
            for (const Momentum& body : bodies) // some touch for less than the step
                connect_contacts(scene, scene.body(body.body).touches_now());
        }

        [[nodiscard]] std::size_t of(std::size_t i) const
        {
            while (m_parents[i] != i)
                i = m_parents[i];
            return i;
        }
        /// By the world, or by what is gone.
        [[nodiscard]] bool is_held(std::size_t i) const { return m_held[i]; }

    private:
        [[nodiscard]] std::size_t index(BodyId id) const
        {
            return static_cast<std::size_t>(std::ranges::find(m_bodies, id, &Momentum::body) - m_bodies.begin());
        }

        void connect(BodyId a, BodyId b)
        {
            const std::size_t i = index(a);
            const std::size_t j = index(b);
            if (i < m_bodies.size() && j < m_bodies.size())
                m_parents[of(i)] = of(j);
            else if (i < m_bodies.size())
                m_held[i] = true;
            else if (j < m_bodies.size())
                m_held[j] = true;
        }

        template <class Events>
        void connect_all(const Events& events)
        {
            for (const auto& e : events)
                connect(e.body_a, e.body_b);
        }

        template <class Contacts>
        void connect_contacts(const Scene& scene, const Contacts& contacts)
        {
            for (const ContactInfo& c : contacts)
                connect(scene.shape(c.shape_a).body(), scene.shape(c.shape_b).body());
        }

        const std::vector<Momentum>& m_bodies;
        std::vector<std::size_t> m_parents;
        std::vector<bool> m_held;
    };

    // For groups that nothing holds from outside.
    void momentum_is_kept(const Scene& scene, float time)
    {
        const std::vector<Momentum> now = momenta(scene);
        if (now.size() != m_bodies.size())
            return;
        const Groups groups(scene, now);
        for (std::size_t g = 0; g < now.size(); ++g)
        {
            if (groups.of(g) == g)
                group_keeps_momentum(scene, now, groups, g, time);
        }
    }

    void group_keeps_momentum(const Scene& scene, const std::vector<Momentum>& now, const Groups& groups, std::size_t group,
                              float time) const
    {
        double x = 0;
        double y = 0;
        double scale = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
        {
            if (groups.of(i) != group)
                continue;
            const ConstBody body = scene.body(now[i].body);
            const Momentum& before = m_bodies[i];
            if (groups.is_held(i) || !(now[i].mass > 0) || before.mass != now[i].mass || body.linear_damping() > 0)
                return;
            const double weight = now[i].mass * static_cast<double>(body.gravity_scale()) * static_cast<double>(time);
            const double gx = body.is_awake() ? weight * static_cast<double>(scene.gravity().x) : 0;
            const double gy = body.is_awake() ? weight * static_cast<double>(scene.gravity().y) : 0;
            x += now[i].x - before.x - gx;
            y += now[i].y - before.y - gy;
            scale += std::hypot(now[i].x, now[i].y) + std::hypot(before.x, before.y) + std::hypot(gx, gy);
            if (!body.is_awake())
                return;
        }
        require(std::hypot(x, y) <= 2e-3 * scale + 1e-9,
                "a free group's momentum changed by " + std::to_string(std::hypot(x, y)) + " N s of " + std::to_string(scale));
    }

    // --- energy ------------------------------------------------------------------------------------------------------------------------

    static double number(float x) { return static_cast<double>(x); }

    static Energy energy(const Scene& scene)
    {
        Energy sum;
        const Vec2 g = scene.gravity();
        for (const BodyId id : scene.bodies())
        {
            const ConstBody body = scene.body(id);
            if (body.type() != BodyType::Dynamic || !body.is_enabled())
                continue;
            const double weight = number(body.mass()) * number(body.gravity_scale());
            const Position at = body.center_of_mass();
            sum.kinetic += number(body.kinetic_energy());
            sum.potential -= weight * (number(g.x) * at.x + number(g.y) * at.y);
            sum.weight += std::fabs(weight) * number(length(g));
            sum.mass += number(body.mass());
        }
        for (const JointId id : scene.joints())
        {
            const JointDef def = scene.joint(id).def();
            const auto* spring = std::get_if<SpringDef>(&def);
            if (spring != nullptr && acts(scene, spring->body_a) && acts(scene, spring->body_b))
            {
                const double stretch = number(scene.joint(id).coordinate()) - number(spring->length);
                const double stored = 0.5 * number(spring->stiffness) * stretch * stretch;
                sum.potential += stored;
                sum.stored += stored;
            }
        }
        return sum;
    }

    static bool acts(const Scene& scene, BodyId body) { return body.is_null() || scene.body(body).is_enabled(); }

    // It turns, and no torque changes that: its turning does work.
    static bool is_driven(const ConstBody& body)
    {
        return body.type() == BodyType::Dynamic && body.is_enabled() && (body.inertia() == 0 || body.locks().angular) &&
               body.angular_velocity() != 0;
    }

    // No overlap is to be pushed out, no joint to be closed, and nothing drives.
    static bool is_closed(const Scene& scene)
    {
        if (std::ranges::any_of(scene.bodies(), [&](BodyId id) { return is_driven(scene.body(id)); }))
            return false;
        const double slop = 0.01 * number(scene.def().length_scale);
        if (!std::ranges::all_of(scene.joints(), [&](JointId id) { return is_followed(scene, scene.joint(id)); }))
            return false;
        for (const BodyId id : scene.bodies()) // contacts() are those of the last step
        {
            if (!std::ranges::all_of(scene.body(id).touches_now(), [&](const ContactInfo& c) { return is_shallow(c, slop); }))
                return false;
        }
        return std::ranges::all_of(scene.joints(), [&](JointId id) { return is_closed(scene.joint(id), slop); });
    }

    static bool is_shallow(const ContactInfo& c, double slop)
    {
        return std::ranges::all_of(std::span(c.points).first(static_cast<std::size_t>(c.point_count)),
                                   [&](const auto& p) { return number(p.separation) >= -slop; });
    }

    // Neither do its bodies turn far in a sub-step, nor would its spring swing by much.
    static bool is_followed(const Scene& scene, const ConstJoint& joint)
    {
        const double h = 1.0 / 60 / scene.def().substeps;
        const JointDef def = joint.def();
        const auto* spring = std::get_if<SpringDef>(&def);
        double rate = 0; // omega² of the spring
        for (const auto& [id, anchor] :
             {std::pair{joint.body_a(), joint.anchor_a()}, std::pair{joint.body_b(), joint.anchor_b()}})
        {
            if (id.is_null() || scene.body(id).type() != BodyType::Dynamic)
                continue;
            const ConstBody body = scene.body(id);
            const double arm = number(length(anchor - body.center_of_mass()));
            rate += 1 / number(body.mass()) + (body.inertia() > 0 ? arm * arm / number(body.inertia()) : 0);
            if (std::fabs(number(body.angular_velocity())) * h > 0.25)
                return false;
        }
        return spring == nullptr || number(spring->stiffness) * rate * h * h < 0.25;
    }

    static bool is_closed(const ConstJoint& joint, double slop)
    {
        const JointDef def = joint.def();
        const double at = number(joint.coordinate());
        if (const auto* rod = std::get_if<DistanceDef>(&def))
            return at > number(rod->min_length) - slop && at < number(rod->max_length) + slop;
        const Vec2 gap = joint.anchor_b() - joint.anchor_a();
        if (std::holds_alternative<RevoluteDef>(def))
            return number(length(gap)) < slop;
        return std::holds_alternative<SpringDef>(def);
    }

    void no_energy_comes(const Scene& scene) const
    {
        const Energy now = energy(scene);
        const double before = m_energy.kinetic + m_energy.potential;
        const double rise = now.kinetic + now.potential - before;
        const double slop = 0.01 * number(scene.def().length_scale);
        const double push = number(scene.def().contact_push_speed) * number(scene.def().length_scale);
        const double allowed = 0.3 * (m_energy.kinetic + m_energy.stored) + 8 * slop * m_energy.weight +
                               1e-6 * std::fabs(m_energy.potential) + 0.01 * m_energy.mass * push * push;
        require(rise <= allowed, "energy rose by " + std::to_string(rise) + " J from " + std::to_string(m_energy.kinetic) + " J");
    }

    bool m_is_passive = true;
    bool m_is_disturbed = true;
    bool m_is_calm = false;
    bool m_meddled = false;
    Energy m_energy;
    std::vector<Momentum> m_bodies;
    std::map<Pair, int, BySlot> m_touching;
    std::map<Pair, int, BySlot> m_inside;
};

} // namespace carom::test
