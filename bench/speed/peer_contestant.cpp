#include "speed/contestant.h"
#include "speed/memory.h"
#include "speed/plan.h"

#include <bit>
#include <cmath>

namespace speed {
namespace {

/// FNV-1a over eight bytes at a time.
class Hash
{
public:
    void add(double value) { m_value = (m_value ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u; }
    [[nodiscard]] std::uint64_t value() const { return m_value; }

private:
    std::uint64_t m_value = 0xcbf29ce484222325u;
};

/// The motion of a kinematic body in the last step.
struct Motion
{
    truth::Body body;
    truth::Vec velocity;
    double spin;
};

/// A peer's world, and the Carom scene that it was made from. A scene with a schedule goes on beside the peer as its script: its
/// dynamic bodies are disabled, so that stepping it does no more than to keep time and to move what is kinematic.
class PeerContestant final : public Contestant
{
public:
    PeerContestant(const truth::Engine& engine, const SceneMaker& build, const carom::SceneDef& base) : m_script(build(base))
    {
        const Changes all = m_translator.look(m_script.scene);
        m_bytes_before = heap_bytes();
        const carom::SceneDef& def = m_script.scene.def();
        m_world = engine.make_world({.gravity = widen(def.gravity),
                                     .sleeping = def.sleeping,
                                     .continuous = def.continuous,
                                     .substeps = def.substeps,
                                     .threads = base.tasks.worker_count});
        all.make(*m_world);
    }

    void prepare(float h) override
    {
        if (!m_script.before_step)
            return;
        m_script.before_step(m_script.scene, h);
        m_changes = m_translator.look(m_script.scene);
        move_script(h);
    }

    void step(float h) override
    {
        m_changes.make(*m_world);
        for (const Motion& motion : m_motions)
            m_world->set_motion(motion.body, motion.velocity, motion.spin);
        m_world->step(static_cast<double>(h));
    }

    carom::Scene& scene() override { return m_script.scene; }

    std::vector<truth::State> states() override
    {
        std::vector<truth::State> list;
        for (const carom::BodyId id : m_script.scene.bodies())
            list.push_back(m_world->state(m_translator.number(id)));
        return list;
    }

    int contacts() override { return m_world->contacts(); }

    std::uint64_t hash() override
    {
        Hash hash;
        for (const truth::State& s : states())
            for (const double value : {s.position.x, s.position.y, s.angle, s.velocity.x, s.velocity.y, s.spin})
                hash.add(value);
        return hash.value();
    }

    std::size_t bytes() const override { return heap_bytes() - m_bytes_before; }

private:
    void move_script(float h)
    {
        std::vector<std::pair<carom::BodyId, carom::Pose>> before;
        for (const carom::BodyId id : m_script.scene.bodies())
        {
            carom::Body body = m_script.scene.body(id);
            if (body.type() == carom::BodyType::Dynamic)
                body.set_enabled(false);
            else if (body.type() == carom::BodyType::Kinematic)
                before.emplace_back(id, body.pose());
        }
        m_script.scene.step(h);
        m_motions.clear();
        for (const auto& [id, pose] : before)
        {
            const carom::Pose after = m_script.scene.body(id).pose();
            const double rate = 1 / static_cast<double>(h);
            const truth::Vec moved{after.position.x - pose.position.x, after.position.y - pose.position.y};
            const float turned = (after.rotation * carom::inverse(pose.rotation)).angle();
            m_motions.push_back({m_translator.number(id), rate * moved, rate * static_cast<double>(turned)});
        }
    }

    carom::scenes::BuiltScene m_script;
    Translator m_translator{};
    Changes m_changes{};
    std::vector<Motion> m_motions{};
    std::size_t m_bytes_before = 0;
    std::unique_ptr<truth::World> m_world{};
};

} // namespace

std::unique_ptr<Contestant> enter_peer(const truth::Engine& engine, const SceneMaker& build, const carom::SceneDef& def)
{
    return std::make_unique<PeerContestant>(engine, build, def);
}

} // namespace speed
