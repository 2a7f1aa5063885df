#include "speed/quality.h"

#include "speed/pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace speed {
namespace {

// The distance at which Box2D 3 makes contact points.
constexpr double near_distance = 0.02;

truth::Vec world_point(const truth::State& state, carom::Vec2 local)
{
    return state.position + truth::rotate(state.angle, {local.x, local.y});
}

double kinetic_energy(const carom::ConstBody& body, const truth::State& state)
{
    const double speed = length(state.velocity);
    return 0.5 *
           (static_cast<double>(body.mass()) * speed * speed + static_cast<double>(body.inertia()) * state.spin * state.spin);
}

std::vector<truth::Vec> positions(const std::vector<truth::State>& states)
{
    std::vector<truth::Vec> list;
    for (const truth::State& state : states)
        list.push_back(state.position);
    return list;
}

/// `visit` takes a dynamic body, its state and its place among all bodies.
template <typename Visit>
void for_each_dynamic(Contestant& contestant, const std::vector<truth::State>& states, const Visit& visit)
{
    const std::vector<carom::BodyId> bodies = contestant.scene().bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const carom::Body body = contestant.scene().body(bodies[i]);
        if (body.type() == carom::BodyType::Dynamic)
            visit(body, states[i], i);
    }
}

double mean_of(double sum, int count) { return count == 0 ? none : sum / count; }

Spread spread(std::vector<double> values)
{
    if (values.empty())
        return {};
    std::sort(values.begin(), values.end());
    return {std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()),
            values[values.size() * 99 / 100], values.back()};
}

} // namespace

void QualityMeter::start(Contestant& contestant)
{
    if (m_at_rest)
        m_built = positions(contestant.states());
}

void QualityMeter::sample(Contestant& contestant)
{
    const std::vector<truth::State> states = contestant.states();
    ++m_samples;
    sample_overlaps(contestant, states);
    sample_joints(contestant, states);
    sample_bodies(contestant, states);
}

std::size_t QualityMeter::bytes() const
{
    return m_built.capacity() * sizeof(truth::Vec) +
           (m_overlaps.capacity() + m_joints.capacity() + m_drifts.capacity() + m_speeds.capacity()) * sizeof(double);
}

void QualityMeter::sample_overlaps(Contestant& contestant, const std::vector<truth::State>& states)
try
{
    for_near_pairs(contestant.scene(), states, near_distance,
                   [this](double overlap)
                   {
                       m_near_pairs += 1;
                       if (overlap > 0)
                           m_overlaps.push_back(overlap);
                   });
}
catch (const truth::Missing&)
{
    m_near_pairs = none; // shapes that overlaps are not measured of
}

void QualityMeter::sample_joints(Contestant& contestant, const std::vector<truth::State>& states)
{
    carom::Scene& scene = contestant.scene();
    const std::vector<carom::JointId> joints = scene.joints();
    if (joints.empty())
        return;
    std::map<carom::BodyId, const truth::State*> by_body;
    for (const carom::BodyId id : scene.bodies())
        by_body.emplace(id, &states[by_body.size()]);
    for (const carom::JointId id : joints)
    {
        const carom::JointDef any = scene.joint(id).def();
        if (const carom::RevoluteDef* hinge = std::get_if<carom::RevoluteDef>(&any))
        {
            const truth::State world{};
            const auto anchor = [&](carom::BodyId body, carom::Vec2 local)
            { return world_point(body ? *by_body.at(body) : world, local); };
            m_joints.push_back(length(anchor(hinge->body_a, hinge->anchor_a) - anchor(hinge->body_b, hinge->anchor_b)));
        }
    }
}

void QualityMeter::sample_bodies(Contestant& contestant, const std::vector<truth::State>& states)
{
    for_each_dynamic(contestant, states,
                     [this](const carom::Body& body, const truth::State& state, std::size_t i)
                     {
                         m_energy += kinetic_energy(body, state);
                         if (!m_at_rest)
                             return;
                         m_speeds.push_back(length(state.velocity));
                         m_drifts.push_back(length(state.position - m_built[i]));
                     });
}

void QualityMeter::count(Contestant& contestant)
{
    ++m_counts;
    for_each_dynamic(contestant, contestant.states(),
                     [this](const carom::Body& body, const truth::State& state, std::size_t)
                     {
                         m_awake += state.awake ? 1 : 0;
                         m_moving += length(state.velocity) > static_cast<double>(body.sleep_speed()) ? 1 : 0;
                     });
}

Quality QualityMeter::result() const
{
    return {.overlap = spread(m_overlaps),
            .joint = spread(m_joints),
            .drift = spread(m_drifts),
            .speed = spread(m_speeds),
            .near_pairs = mean_of(m_near_pairs, m_samples),
            .awake = mean_of(m_awake, m_counts),
            .moving = mean_of(m_moving, m_counts),
            .energy = mean_of(m_energy, m_samples)};
}

} // namespace speed
