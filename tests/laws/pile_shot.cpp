// A heavy, fast ball shot into a settled pile: nothing leaves the closed box around it.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(Row16_NoTunnelling, AHardShotIntoAPileStaysInItsBox)
{
    Scene scene({.gravity = {0, -10}});
    add_static(scene, Chain{.start = {-2, 0}, .pieces = {{.end = {2, 0}}, {.end = {2, 6}}, {.end = {-2, 6}}}, .closed = true});
    Random random(3);
    std::vector<BodyId> balls;
    for (int i = 0; i < 60; ++i)
        balls.push_back(
            add_dynamic(scene, {random.range(-1.7, 1.7), random.range(0.2, 3)}, Circle{.radius = 0.12f}, {.restitution = 0.3f})
                .body);
    steps(scene, 120);
    const BodyId shot = add_dynamic(scene, {0, 5}, Circle{.radius = 0.12f}, {.density = 5, .restitution = 0.3f}, {30, -800}).body;
    balls.push_back(shot);
    for (int i = 0; i < 120; ++i)
    {
        scene.step(1.0f / 60);
        for (const BodyId id : balls)
        {
            const Position p = scene.body(id).position();
            ASSERT_TRUE(std::fabs(p.x) < 2 && p.y > 0 && p.y < 6) << "step " << i << " at " << p.x << ", " << p.y;
        }
    }
}
