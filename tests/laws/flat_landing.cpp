// Two points struck at once share the impulse: a box that lands flat bounces flat, at any step.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(Row05_ResolveCollision, ABoxThatLandsFlatBouncesFlat)
{
    for (const float h : {1.0f / 60, 1e-3f})
        for (const double gap : {0.0, 0.03})
            for (const float e : {0.0f, 0.3f, 0.5f, 1.0f})
            {
                SCOPED_TRACE("h " + std::to_string(h) + " gap " + std::to_string(gap) + " e " + std::to_string(e));
                Scene scene(weightless());
                add_static(scene, HalfSpace{}, {.friction = 0, .restitution = e});
                const Thing body =
                    add_dynamic(scene, {0, 0.5 + gap}, box(0.5f, 0.5f), {.friction = 0, .restitution = e}, {0, -10});
                steps(scene, static_cast<int>(0.02f / h) + 1, h);
                EXPECT_NEAR(scene.body(body.body).velocity().y, 10 * e, 1e-2);
                EXPECT_NEAR(scene.body(body.body).angular_velocity(), 0, 1e-2);
            }
}
