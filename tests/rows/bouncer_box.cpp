// A box that hits a bouncer flat.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(Row13_Bouncer, KicksABoxAboveTheThresholdOnly)
{
    for (const Geometry& geometry : {Geometry{box(0.25f, 0.25f)}})
        for (const float v : {0.5f, 0.9f, 1.1f, 4.0f})
        {
            SCOPED_TRACE("v " + std::to_string(v) + " shape " + std::to_string(geometry.index()));
            Scene scene(weightless());
            add_static(scene, box(0.5f, 3), {.friction = 0, .restitution = 0.5f, .kick = {.speed = 3, .threshold = 1}});
            const Thing body = add_dynamic(scene, {-1, 0}, geometry, {.friction = 0, .restitution = 0.5f}, {v, 0});
            float kick = 0;
            for (int i = 0; i < 60; ++i)
            {
                scene.step(1.0f / 60);
                if (!scene.impacts().empty())
                {
                    kick = scene.impacts()[0].kick_speed;
                    EXPECT_EQ(scene.impacts()[0].energy_lost < 0, v > 1) << "a kick adds energy here";
                }
            }
            EXPECT_EQ(kick, v > 1 ? 3.0f : 0.0f);
            EXPECT_NEAR(scene.body(body.body).velocity().x,
                        v > 1 ? -0.5 * static_cast<double>(v) - 3 : -0.5 * static_cast<double>(v), 1e-3);
        }
}
