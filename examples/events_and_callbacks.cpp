// The events of a step: spans of events to read after it, and callbacks on a shape, which may change the scene freely.
// A ball rolls through a gate that counts it, falls off an edge onto a pad, and the pad replaces it by a new one.
#include <carom/carom.h>
#include <cstdio>

namespace {

constexpr std::uint64_t ball_tag = 7; // user data are yours: here they tell what a shape is

carom::ShapeId add_ball(carom::Scene& scene)
{
    const carom::BodyId body = scene.create_body({.type = carom::BodyType::Dynamic, .position = {-2, 1.25}, .velocity = {2, 0}});
    return scene.create_shape(body, carom::Circle{.radius = 0.25f}, {.friction = 0.3f, .user_data = ball_tag});
}

} // namespace

int main()
{
    carom::Scene scene;
    const carom::BodyId world = scene.create_body({});
    scene.create_shape(world, carom::Segment{.a = {-3, 1}, .b = {1, 1}});
    const carom::ShapeId pad = scene.create_shape(world, carom::HalfSpace{.normal = {0, 1}});
    const carom::ShapeId gate = scene.create_shape(world, carom::box(0.1f, 0.5f, {0, 1.5f}), {.trigger = true});

    // A callback runs at the end of the step. Destroying both parties inside it is fine.
    int replaced = 0;
    carom::ShapeCallbacks callbacks;
    callbacks.on_impact = [&replaced](carom::Scene& s, const carom::ImpactEvent& hit)
    {
        // shape_a is the pad that owns the callback. Its ball may be gone since an earlier impact of the same step.
        if (!s.is_valid(hit.body_b))
            return;
        std::printf("pad hit at %.1f m/s, impulse %.2f N s\n", hit.approach_speed, hit.impulse);
        s.destroy(hit.body_b);
        add_ball(s);
        ++replaced;
    };
    scene.set_callbacks(pad, callbacks);

    add_ball(scene);
    int passed = 0;
    for (int i = 0; i < 600; ++i)
    {
        scene.step(1.0f / 120);
        for (const carom::TriggerEvent& enter : scene.trigger_enters())
        {
            if (enter.trigger == gate && scene.shape(enter.visitor).user_data() == ball_tag)
                ++passed;
        }
    }
    std::printf("%d balls passed the gate, %d were replaced\n", passed, replaced);
    return passed > 0 && replaced > 0 ? 0 : 1;
}
