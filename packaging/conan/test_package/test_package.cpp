#include <carom/carom.h>
#include <cstdio>

// A ball falls to the ground and bounces.
int main()
{
    carom::Scene scene({.gravity = {0, -9.81f}});
    carom::BodyId ground = scene.create_body({});
    scene.create_shape(ground, carom::HalfSpace{.normal = {0, 1}});
    carom::BodyId ball = scene.create_body({.type = carom::BodyType::Dynamic, .position = {0, 4}});
    scene.create_shape(ball, carom::Circle{.radius = 0.5f}, {.restitution = 0.6f});
    int bounces = 0;
    for (int i = 0; i < 180; ++i)
    {
        scene.step(1.0f / 60);
        bounces += static_cast<int>(scene.impacts().size());
    }
    std::printf("carom %s: %d bounces in 3 s\n", CAROM_VERSION_STRING, bounces);
    return bounces > 0 ? 0 : 1;
}
