// The ten lines of the README: a ball falls on the ground and bounces.
#include <carom/carom.h>
#include <cstdio>

int main()
{
    carom::Scene scene({.gravity = {0, -9.81f}});
    carom::BodyId ground = scene.create_body({});
    scene.create_shape(ground, carom::HalfSpace{.normal = {0, 1}});
    carom::BodyId ball = scene.create_body({.type = carom::BodyType::Dynamic, .position = {0, 4}});
    scene.create_shape(ball, carom::Circle{.radius = 0.5f}, {.restitution = 0.6f});
    for (int i = 0; i < 180; ++i)
    {
        scene.step(1.0f / 60);
        for (const carom::ImpactEvent& hit : scene.impacts())
            std::printf("bounce at %.2f m/s\n", hit.approach_speed);
    }
    std::printf("after 3 s at height %.2f m\n", scene.body(ball).position().y);
}
