// A damped spring at rest carries its load at the length the law gives.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(Row09_Spring, ForceIsReadBack)
{
    Scene scene({.gravity = {0, -10}, .sleeping = false});
    const BodyId body = add_dynamic(scene, {0, -2}, Circle{}, {.density = 2}).body;
    const double weight = 10 * static_cast<double>(scene.body(body).mass());
    const JointId spring = scene.create_joint(SpringDef{.body_b = body, .stiffness = 100, .damping = 40, .length = 1});
    steps(scene, 1200);
    EXPECT_NEAR(scene.joint(spring).force().y, weight, 1e-3 * weight);
    EXPECT_NEAR(scene.joint(spring).force().x, 0, 1e-4 * weight);
    EXPECT_NEAR(scene.joint(spring).coordinate(), 1 + weight / 100, 1e-4);
    EXPECT_NEAR(scene.joint(spring).speed(), 0, 1e-4);
}
