// The scene: construction, stepping, and what concerns all of its bodies.

#include "carom/scene.h"

#include "core/clock.h"
#include "core/rounding.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/stages.h"
#include "dynamics/state/body_store.h"
#include "scene/access.h"

#include <algorithm>
#include <utility>

namespace carom {

using namespace internal;

namespace {

constexpr float shortest_step = 1e-9f; // s
constexpr float longest_step = 10;

bool check_def(const SceneDef& def)
{
    const Checker check{"Scene::Scene"};
    return check.finite("SceneDef::gravity", def.gravity) && check.positive("SceneDef::length_scale", def.length_scale) &&
           check.holds(def.substeps >= 1 && def.substeps <= 64, "SceneDef::substeps", std::to_string(def.substeps),
                       "must be from 1 to 64") &&
           check.holds(def.most_passes >= 1 && def.most_passes <= 16, "SceneDef::most_passes", std::to_string(def.most_passes),
                       "must be from 1 to 16") &&
           check.holds(def.most_subdivisions >= 1 && def.most_subdivisions <= 64, "SceneDef::most_subdivisions",
                       std::to_string(def.most_subdivisions), "must be from 1 to 64") &&
           check.in_range("SceneDef::fixed_step", def.fixed_step, 1e-5f, longest_step) &&
           check.positive("SceneDef::max_frame_time", def.max_frame_time) &&
           check.positive("SceneDef::contact_hertz", def.contact_hertz) &&
           check.positive("SceneDef::contact_damping_ratio", def.contact_damping_ratio) &&
           check.not_negative("SceneDef::contact_push_speed", def.contact_push_speed) &&
           check.one_of("SceneDef::friction_rule", def.friction_rule, MixRule::Function) &&
           check.one_of("SceneDef::restitution_rule", def.restitution_rule, MixRule::Function) &&
           check.holds((def.friction_rule != MixRule::Function && def.restitution_rule != MixRule::Function) ||
                           def.mix_function != nullptr,
                       "SceneDef::mix_function", "null", "must be set where a rule is MixRule::Function") &&
           check.holds(def.tasks.worker_count >= 1 && def.tasks.worker_count <= 64, "SceneDef::tasks.worker_count",
                       std::to_string(def.tasks.worker_count), "must be from 1 to 64");
}

// In lengths of the typical object. 0.005: overlap too small to see; 0.02: far enough ahead for quiet contacts; 0.1: features that face each
// other are likely to stay so, and points and separations are exact as long as they do; 0.05: wide enough that a resting pile never leaves
// its boxes.
Tolerances tolerances_of(const SceneDef& def)
{
    const float l = def.length_scale;
    return {.slop = 0.005f * l,
            .speculation = 0.02f * l,
            .keep = 0.1f * l,
            .box_margin = 0.05f * l,
            .push_speed = def.contact_push_speed * l,
            .sleep_speed = 0.05f * l,
            .rest_speed = 0.001f * l};
}

} // namespace

Scene::Scene(const SceneDef& def) : m_data(nullptr)
{
    const SceneDef sound = check_def(def) ? def : SceneDef{};
    m_data = new SceneData;
    m_data->def = sound;
    m_data->tolerances = tolerances_of(sound);
    m_data->state.gravity = sound.gravity;
    m_data->state.slop = m_data->tolerances.slop;
    m_data->state.greatest_sleep_speed = m_data->tolerances.sleep_speed;
}

Scene::~Scene() { delete m_data; }

// A moved-from scene is empty.
Scene::Scene(Scene&& other) noexcept : Scene(other.m_data->def) { std::swap(m_data, other.m_data); }

Scene& Scene::operator=(Scene&& other) noexcept
{
    if (this != &other)
    {
        Scene empty(other.m_data->def);
        std::swap(m_data, other.m_data);
        std::swap(other.m_data, empty.m_data);
    }
    return *this;
}

bool Scene::is_valid(BodyId id) const { return is_live(m_data->state, id); }
bool Scene::is_valid(ShapeId id) const { return is_live(m_data->state, id); }
bool Scene::is_valid(JointId id) const { return is_live(m_data->state, id); }

namespace {

void number_events(Events& events, int step)
{
    const auto number = [step](auto& list)
    {
        for (auto& e : list)
            e.step = step;
    };
    number(events.begins);
    number(events.ends);
    number(events.impacts);
    number(events.enters);
    number(events.exits);
}

// Sets a flag while a step runs, also if a callback throws out of it.
class InStep
{
public:
    explicit InStep(bool& flag) : m_flag(flag) { m_flag = true; }
    ~InStep() { m_flag = false; }
    InStep(const InStep&) = delete;
    InStep& operator=(const InStep&) = delete;

private:
    bool& m_flag;
};

} // namespace

const StepReport& Scene::step(float h)
{
    const Checker check{"Scene::step"};
    if (!check.in_range("h", h, shortest_step, longest_step) ||
        !check.holds(!m_data->stepping, "the scene", "in a step", "callbacks must not step it"))
        return m_data->report;
    const InStep in_step(m_data->stepping);
    const RoundToNearest rounding;
    internal::step(*m_data, h);
    if (m_data->frame_step > 0)
        number_events(m_data->events, m_data->frame_step);
    Stopwatch().time(m_data->report.ms.events, [&] { run_callbacks(*m_data, *this); });
    return m_data->report;
}

const StepReport& Scene::report() const { return m_data->report; }
std::uint64_t Scene::step_count() const { return m_data->state.step_count; }
double Scene::time() const { return m_data->state.time; }

std::span<const ContactBeginEvent> Scene::contact_begins() const { return m_data->events.begins; }
std::span<const ContactEndEvent> Scene::contact_ends() const { return m_data->events.ends; }
std::span<const ImpactEvent> Scene::impacts() const { return m_data->events.impacts; }
std::span<const TriggerEvent> Scene::trigger_enters() const { return m_data->events.enters; }
std::span<const TriggerEvent> Scene::trigger_exits() const { return m_data->events.exits; }

Vec2 Scene::gravity() const { return m_data->state.gravity; }

void Scene::set_gravity(Vec2 gravity)
{
    if (!Checker{"Scene::set_gravity"}.finite("gravity", gravity))
        return;
    m_data->state.gravity = gravity;
    m_data->def.gravity = gravity;
    for (int i = 0; i < m_data->state.bodies.capacity(); ++i)
    {
        if (m_data->state.bodies.is_live(i) && m_data->state.bodies[i].type == BodyType::Dynamic)
            wake_body(*m_data, i);
    }
}

const SceneDef& Scene::def() const { return m_data->def; }
void Scene::set_record_substeps(bool record) { m_data->def.record_substeps = record; }

std::vector<BodyId> Scene::bodies() const
{
    std::vector<BodyId> ids;
    for (int i = 0; i < m_data->state.bodies.capacity(); ++i)
    {
        if (m_data->state.bodies.is_live(i))
            ids.push_back(body_id(m_data->state, i));
    }
    return ids;
}

std::vector<JointId> Scene::joints() const
{
    std::vector<JointId> ids;
    for (int i = 0; i < m_data->state.joints.capacity(); ++i)
    {
        if (m_data->state.joints.is_live(i))
            ids.push_back(joint_id(m_data->state, i));
    }
    return ids;
}

void Scene::ignore_pair(BodyId a, BodyId b)
{
    if (!check_live(*m_data, "Scene::ignore_pair", "a", a) || !check_live(*m_data, "Scene::ignore_pair", "b", b))
        return;
    SceneState& state = m_data->state;
    if (!state.ignored.insert(pair_key(slot_of(a), slot_of(b))))
        return;
    state.bodies[slot_of(a)].ignores = state.bodies[slot_of(b)].ignores = true;
    for_each_contact(state, slot_of(a),
                     [&](int contact)
                     {
                         if (other_body(state.contacts[contact], slot_of(a)) == slot_of(b))
                             destroy_contact(*m_data, contact, m_data->pending, 0);
                     });
    wake_body(*m_data, slot_of(a));
    wake_body(*m_data, slot_of(b));
}

void Scene::restore_pair(BodyId a, BodyId b)
{
    if (!check_live(*m_data, "Scene::restore_pair", "a", a) || !check_live(*m_data, "Scene::restore_pair", "b", b))
        return;
    const std::uint64_t key = pair_key(slot_of(a), slot_of(b));
    if (!m_data->state.ignored.contains(key))
        return;
    m_data->state.ignored.erase(key);
    refresh_boxes(*m_data, slot_of(a));
    wake_body(*m_data, slot_of(a));
    wake_body(*m_data, slot_of(b));
}

} // namespace carom
