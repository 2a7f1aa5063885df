// A hinge between two free bodies at its stop made one of them as hard to turn as if the stop were fixed to the world: what struck it lost angular momentum to nothing.
#include "support/test_scene.h"

#include <cmath>

using namespace carom;
using namespace carom::test;

namespace {

double angular_momentum(Scene& scene)
{
    double sum = 0;
    for (const BodyId id : scene.bodies())
    {
        const Body body = scene.body(id);
        const Position c = body.center_of_mass();
        const auto m = static_cast<double>(body.mass());
        sum += m * (c.x * static_cast<double>(body.velocity().y) - c.y * static_cast<double>(body.velocity().x)) +
               static_cast<double>(body.inertia()) * static_cast<double>(body.angular_velocity());
    }
    return sum;
}

// Two boxes side by side whose hinge is at a stop, and a ball that strikes one of them from above or from below, at either end.
void strike(float lower, float upper, bool first, double at, double from)
{
    Scene scene(weightless());
    const BodyId a = add_dynamic(scene, {-0.5, 0}, box(0.45f, 0.1f), {.friction = 0}).body;
    const BodyId b = add_dynamic(scene, {0.5, 0}, box(0.45f, 0.1f), {.friction = 0}).body;
    scene.create_joint(RevoluteDef{.body_a = a,
                                   .body_b = b,
                                   .anchor_a = {0.5f, 0},
                                   .anchor_b = {-0.5f, 0},
                                   .enable_limit = true,
                                   .lower_angle = lower,
                                   .upper_angle = upper});
    add_dynamic(scene, {(first ? -0.5 : 0.5) + at, from}, Circle{.radius = 0.1f}, {.friction = 0, .restitution = 0.5f},
                {0, from > 0 ? -5.0f : 5.0f});
    const double before = angular_momentum(scene);
    double energy = 0;
    for (const BodyId id : scene.bodies())
        energy += kinetic(scene, id);
    steps(scene, 60);
    double after = 0;
    for (const BodyId id : scene.bodies())
        after += kinetic(scene, id);
    const std::string which = "limits " + std::to_string(lower) + " to " + std::to_string(upper) +
                              (first ? ", first" : ", second") + " body, at " + std::to_string(at) + ", from " +
                              std::to_string(from);
    EXPECT_NEAR(angular_momentum(scene), before, 2e-3 * std::fabs(before)) << which;
    EXPECT_LE(after, energy * 1.001) << which;
    EXPECT_LT(after, energy * 0.999) << which << ": it has not struck";
}

TEST(Regression, AStopBetweenTwoBodiesIsNoWall)
{
    for (const bool first : {false, true})
    {
        for (const double at : {-0.35, 0.3})
        {
            for (const double from : {-1.5, 1.5})
            {
                strike(0, 0.5f, first, at, from);
                strike(-0.5f, 0, first, at, from);
                strike(0, 0, first, at, from);
            }
        }
    }
}

// Two hinges on one body: the second must not free it from the stop of the first.
TEST(Regression, AStopHoldsBesideAnotherHinge)
{
    for (const bool stop_first : {false, true})
    {
        Scene scene(weightless());
        const BodyId wall = add_static(scene, box(0.1f, 0.1f), {}, {0, -3}).body;
        const BodyId bar = add_dynamic(scene, {0.5, 0}, box(0.5f, 0.05f), {.friction = 0, .restitution = 1}).body;
        const BodyId tail = add_dynamic(scene, {1.5, 0}, box(0.4f, 0.05f), {.friction = 0}).body;
        const RevoluteDef at_stop{
            .body_a = wall, .body_b = bar, .anchor_a = {0, 3}, .anchor_b = {-0.5f, 0}, .enable_limit = true, .upper_angle = 0};
        const RevoluteDef beside{.body_a = bar,
                                 .body_b = tail,
                                 .anchor_a = {0.5f, 0},
                                 .anchor_b = {-0.5f, 0},
                                 .enable_limit = true,
                                 .lower_angle = -1,
                                 .upper_angle = 1};
        scene.create_joint(stop_first ? at_stop : beside);
        scene.create_joint(stop_first ? beside : at_stop);
        const BodyId ball =
            add_dynamic(scene, {0.6, -1.5}, Circle{.radius = 0.1f}, {.friction = 0, .restitution = 1}, {0, 5}).body;
        steps(scene, 30);
        EXPECT_LT(scene.body(ball).velocity().y, -4.5f) << "the bar stands at its stop like a wall, first made: " << stop_first;
    }
}

} // namespace
