// Fields: forces of trigger shapes on the dynamic bodies inside them, constant over a step.

#include "dynamics/forces/fields.h"
#include "core/trigonometry.h"

namespace carom::internal {

namespace {

void act(const Field& field, float dt, BodySim& sim)
{
    const Vec2 force = field.force + sim.mass * field.acceleration;
    if (!field.only_if_moving_along || dot(sim.velocity, force) > 0)
        sim.force += force;
    if (field.drag > 0)
        sim.velocity *= static_cast<float>(exponential(-static_cast<double>(field.drag) * static_cast<double>(dt)));
}

} // namespace

void apply_fields(StepContext& ctx)
{
    SceneState& state = ctx.state;
    for (const std::int32_t index : state.trigger_contacts)
    {
        const Contact& contact = state.contacts[index];
        const ShapeRecord& trigger = state.shapes[contact.shape_a];
        const BodyRecord& visitor = state.bodies[contact.body_b];
        if (trigger.rare_traits != none && touches(contact) && visitor.type == BodyType::Dynamic && visitor.awake_index != none)
            act(rare_traits_of(state, trigger).field, ctx.dt, state.sims[static_cast<std::size_t>(contact.body_b)]);
    }
}

} // namespace carom::internal
