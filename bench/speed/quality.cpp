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

std::vector<truth::Vec> positions(const std::vector<truth::State>& states)
{
    std::vector<truth::Vec> list;
    for (const truth::State& state : states)
        list.push_back(state.position);
    return list;
}

} // namespace

QualityMeter::QualityMeter(Contestant& contestant, bool at_rest) : m_at_rest(at_rest)
{
    if (at_rest)
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
    m_near_pairs = Quality::none; // shapes that overlaps are not measured of
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
            const double apart = length(anchor(hinge->body_a, hinge->anchor_a) - anchor(hinge->body_b, hinge->anchor_b));
            m_worst_joint = m_worst_joint > apart ? m_worst_joint : apart;
        }
    }
}

void QualityMeter::sample_bodies(Contestant& contestant, const std::vector<truth::State>& states)
{
    const std::vector<carom::BodyId> bodies = contestant.scene().bodies();
    double speeds = 0;
    int count = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        if (contestant.scene().body(bodies[i]).type() != carom::BodyType::Dynamic)
            continue;
        speeds += length(states[i].velocity);
        m_awake += states[i].awake ? 1 : 0;
        ++count;
        if (m_at_rest)
            m_drift = std::max(m_drift, length(states[i].position - m_built[i]));
    }
    m_speeds += count > 0 ? speeds / count : 0;
}

Quality QualityMeter::result() const
{
    Quality quality;
    if (m_samples == 0)
        return quality;
    if (!m_overlaps.empty())
    {
        std::vector<double> sorted = m_overlaps;
        std::sort(sorted.begin(), sorted.end());
        quality.mean_overlap = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
        quality.p99_overlap = sorted[sorted.size() * 99 / 100];
        quality.worst_overlap = sorted.back();
    }
    quality.worst_joint = m_worst_joint;
    quality.near_pairs = m_near_pairs / m_samples;
    quality.awake = m_awake / m_samples;
    if (m_at_rest)
    {
        quality.drift = m_drift;
        quality.residual_speed = m_speeds / m_samples;
    }
    return quality;
}

} // namespace speed
