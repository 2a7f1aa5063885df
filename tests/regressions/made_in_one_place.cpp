// Symptom: 16 circles made in one place parted quietly, 17 at 4 m/s and 60 at 8.6, though overlap is pushed out at 3 m/s at the most.

#include "regressions/numbers.h"
#include "regressions/shapes.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

using namespace carom;
using namespace carom::test;

TEST(MadeInOnePlace, PartAtNoMoreThanTheSpeedOfPushingOut)
{
    const std::vector<NamedShape> shapes = {{"circle", Circle{.radius = 0.5f}},
                                            {"box", box(0.5f, 0.5f)},
                                            {"triangle", Polygon{.vertices = {{0, 0.6f}, {-0.5f, -0.4f}, {0.5f, -0.4f}}}}};
    for (const auto& [name, shape] : shapes)
    {
        for (const int count : {2, 10, 16, 17, 25, 40})
        {
            for (const float spread : {0.2f, 0.05f})
            {
                SCOPED_TRACE(std::to_string(count) + " of " + name + " within " + std::to_string(spread) + " m");
                Scene scene(weightless());
                Random random(1);
                for (int i = 0; i < count; ++i)
                {
                    const double x = random.range(-d(spread), d(spread));
                    const double y = random.range(-d(spread), d(spread));
                    add_dynamic(scene, {x, y}, shape);
                }
                steps(scene, 300);
                float fastest = 0;
                Vec2 momentum{};
                for (const BodyId body : scene.bodies())
                {
                    fastest = std::max(fastest, length(scene.body(body).velocity()));
                    momentum += scene.body(body).mass() * scene.body(body).velocity();
                }
                EXPECT_LT(fastest, scene.def().contact_push_speed);
                EXPECT_LT(length(momentum), 1e-3f * static_cast<float>(count));
            }
        }
    }
}
