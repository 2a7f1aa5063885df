// A fast body crosses a thin trigger: one enter, one exit.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(Row07_Trigger, AFastBodyNeverMissesOne)
{
    for (const float v : {5.0f, 50.0f, 300.0f, 1000.0f})
        for (const Geometry& thin :
             {Geometry{box(0.001f, 5)}, Geometry{Segment{{0, -5}, {0, 5}}}, Geometry{Circle{.radius = 0.02f}},
              Geometry{Arc{.center = {-5, 0}, .radius = 5, .start_angle = -0.5f, .sweep = 1}}})
            for (const double start : {-3.0, -2.77, -0.4})
            {
                SCOPED_TRACE("v " + std::to_string(v) + " shape " + std::to_string(thin.index()) + " from " +
                             std::to_string(start));
                Scene scene(weightless());
                add_static(scene, thin, {.trigger = true});
                const Thing ball = add_dynamic(scene, {start, 0}, Circle{.radius = 0.1f}, {}, {v, 0});
                int enters = 0;
                int exits = 0;
                double enter_time = 0;
                double exit_time = 0;
                for (int i = 0; i < 120; ++i)
                {
                    scene.step(1.0f / 60);
                    for (const TriggerEvent& e : scene.trigger_enters())
                    {
                        ++enters;
                        enter_time = i / 60.0 + static_cast<double>(e.time);
                        EXPECT_GE(e.time, 0);
                        EXPECT_LE(e.time, 1.001f / 60);
                    }
                    for (const TriggerEvent& e : scene.trigger_exits())
                    {
                        ++exits;
                        exit_time = i / 60.0 + static_cast<double>(e.time);
                    }
                    if (scene.body(ball.body).position().x > 3)
                        break;
                }
                EXPECT_EQ(enters, 1);
                EXPECT_EQ(exits, 1);
                EXPECT_LE(enter_time, exit_time);
                // In at contact of the surfaces: not before, and at most a step late.
                const double reach = std::holds_alternative<Circle>(thin) ? 0.12 : 0.101;
                const double first = (-start - reach) / static_cast<double>(v);
                EXPECT_GE(enter_time, first - 1e-3);
                EXPECT_LE(enter_time, first + 1.0 / 60 + 1e-3);
            }
}
