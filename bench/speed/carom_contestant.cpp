#include "speed/contestant.h"
#include "speed/memory.h"

namespace speed {
namespace {

truth::State state_of(const carom::ConstBody& body)
{
    const carom::Position at = body.position();
    const carom::Vec2 velocity = body.velocity();
    return {{at.x, at.y}, body.angle(), {velocity.x, velocity.y}, body.angular_velocity(), body.is_awake()};
}

class CaromContestant final : public Contestant
{
public:
    CaromContestant(const SceneMaker& build, const carom::SceneDef& def) : m_built(build(def)) {}

    void step(float h) override { m_built.step(h); }
    carom::Scene& scene() override { return m_built.scene; }
    std::vector<truth::State> states() override
    {
        std::vector<truth::State> list;
        for (const carom::BodyId id : m_built.scene.bodies())
            list.push_back(state_of(m_built.scene.body(id)));
        return list;
    }
    int contacts() override { return m_built.scene.report().pairs; }
    std::uint64_t hash() override { return m_built.scene.state_hash(); }
    Stages stages() const override { return stages_of(m_built.scene.report().ms); }
    std::size_t bytes() const override { return heap_bytes() - m_bytes_before; }

private:
    std::size_t m_bytes_before = heap_bytes();
    carom::scenes::BuiltScene m_built;
};

} // namespace

Stages stages_of(const carom::StageTimes& ms)
{
    return {ms.sweep, ms.pairs, ms.contacts, ms.islands, ms.solve, ms.commit, ms.events};
}

void add(Stages& sum, const Stages& more)
{
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += more[i];
}

std::unique_ptr<Contestant> enter_carom(const SceneMaker& build, const carom::SceneDef& def)
{
    return std::make_unique<CaromContestant>(build, def);
}

} // namespace speed
