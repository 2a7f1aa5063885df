// One of each joint: a motor turns a wheel, a rope holds a weight, a slider with limits carries a cart, a spring swings.
#include <carom/carom.h>
#include <cmath>
#include <cstdio>

namespace {

carom::BodyId add_disc(carom::Scene& scene, carom::Position position, float radius)
{
    const carom::BodyId body = scene.create_body({.type = carom::BodyType::Dynamic, .position = position});
    scene.create_shape(body, carom::Circle{.radius = radius});
    return body;
}

} // namespace

int main()
{
    carom::Scene scene;

    // A null body is the world: its anchor is a point of the world.
    const carom::BodyId wheel = add_disc(scene, {0, 5}, 0.5f);
    const carom::JointId motor = scene.create_joint(carom::RevoluteDef{
        .body_b = wheel, .anchor_a = {0, 5}, .enable_motor = true, .motor_speed = 2 * carom::pi, .max_motor_torque = 20});

    const carom::BodyId weight = add_disc(scene, {3, 4}, 0.2f);
    const carom::JointId rope =
        scene.create_joint(carom::DistanceDef{.body_b = weight, .anchor_a = {3, 5}, .min_length = 0, .max_length = 2});

    const carom::BodyId cart = add_disc(scene, {-3, 2}, 0.2f);
    const carom::JointId slider = scene.create_joint(carom::PrismaticDef{.body_b = cart,
                                                                         .anchor_a = {-3, 2},
                                                                         .axis_a = {1, -1},
                                                                         .enable_limit = true,
                                                                         .lower_translation = 0,
                                                                         .upper_translation = 1.5f});

    const carom::BodyId bob = add_disc(scene, {6, 3}, 0.2f);
    const carom::JointId spring =
        scene.create_joint(carom::SpringDef{.body_b = bob, .anchor_a = {6, 5}, .stiffness = 20, .damping = 0.5f, .length = 1});

    for (int i = 0; i < 20 * 60; ++i)
        scene.step(1.0f / 60);

    const float turns_per_second = scene.joint(motor).speed() / (2 * carom::pi);
    const float pull = scene.joint(rope).force().y;
    const float at_limit = scene.joint(slider).coordinate();
    const float stretched = scene.joint(spring).coordinate();
    std::printf("wheel: %.2f turns a second\n", turns_per_second);
    std::printf("rope: pulls with %.2f N, the weight weighs %.2f N\n", pull, scene.body(weight).mass() * 9.81f);
    std::printf("slider: %.3f m along, its limit is 1.5 m\n", at_limit);
    std::printf("spring: %.3f m long, Hooke says %.3f m\n", stretched, 1 + scene.body(bob).mass() * 9.81f / 20);

    const bool as_expected = std::abs(turns_per_second - 1) < 0.01f &&
                             std::abs(pull - scene.body(weight).mass() * 9.81f) < 0.05f && std::abs(at_limit - 1.5f) < 0.01f;
    return as_expected ? 0 : 1;
}
