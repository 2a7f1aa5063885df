// Islands that stay in place from step to step must come out as islands that are built anew.

#include "support/test_scene.h"

#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr int steps_compared = 120;

std::vector<BodyId> add_pyramid(Scene& scene, double x, int rows)
{
    std::vector<BodyId> bodies;
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i)
            bodies.push_back(
                add_dynamic(scene, {x + 1.05 * i + 0.525 * row, 0.5 + row}, box(0.5f, 0.5f), {.friction = 0.6f}).body);
    return bodies;
}

// A sheet of hinges that hangs from the world.
std::vector<BodyId> add_sheet(Scene& scene, double x, int columns, int rows)
{
    std::vector<BodyId> bodies;
    for (int i = 0; i < columns * rows; ++i)
    {
        const Position at{x + i % columns, 30.0 - i / columns};
        bodies.push_back(add_dynamic(scene, at, Circle{.radius = 0.2f}, {.filter = {2, 4}}).body);
        const auto hinge = [&](BodyId a, Position anchor)
        {
            const Vec2 from = a == BodyId{} ? Vec2{static_cast<float>(anchor.x), static_cast<float>(anchor.y)}
                                            : anchor - scene.body(a).position();
            scene.create_joint(RevoluteDef{.body_a = a, .body_b = bodies.back(), .anchor_a = from, .anchor_b = anchor - at});
        };
        if (i % columns > 0)
            hinge(bodies[static_cast<std::size_t>(i - 1)], {at.x - 0.5, at.y});
        if (i >= columns)
            hinge(bodies[static_cast<std::size_t>(i - columns)], {at.x, at.y + 0.5});
        else
            hinge(BodyId{}, {at.x, at.y + 0.5});
    }
    return bodies;
}

struct PilesAndSheet
{
    Scene scene{sleepless()};
    std::vector<BodyId> bodies{};

    // A body that flies high above keeps all islands from staying in place.
    explicit PilesAndSheet(bool with_flier)
    {
        add_static(scene, box(60, 0.5f, {0, -0.5f}));
        for (const double x : {-40.0, -10.0})
        {
            const std::vector<BodyId> pyramid = add_pyramid(scene, x, 10);
            bodies.insert(bodies.end(), pyramid.begin(), pyramid.end());
        }
        const std::vector<BodyId> sheet = add_sheet(scene, 20, 10, 8);
        bodies.insert(bodies.end(), sheet.begin(), sheet.end());
        if (with_flier)
            add_dynamic(scene, {0, 10000}, Circle{.radius = 0.5f});
    }
};

} // namespace

TEST(DynamicsCachedGraph, AreThoseBuiltAnew)
{
    PilesAndSheet kept(false);
    PilesAndSheet anew(true);
    for (int i = 0; i < steps_compared; ++i)
    {
        if (i == 60)
            for (PilesAndSheet* world : {&kept, &anew}) // something changes on the way
                world->scene.body(world->bodies[30]).apply_impulse({40, 0});
        if (i == 90)
            for (PilesAndSheet* world : {&kept, &anew})
                world->scene.destroy(world->bodies[100]);
        kept.scene.step(1.0f / 60);
        anew.scene.step(1.0f / 60);
        for (std::size_t b = 0; b < kept.bodies.size(); ++b)
        {
            if (i >= 90 && b == 100)
                continue;
            const ConstBody x = kept.scene.body(kept.bodies[b]);
            const ConstBody y = anew.scene.body(anew.bodies[b]);
            ASSERT_EQ(x.position().x, y.position().x) << "body " << b << " step " << i;
            ASSERT_EQ(x.position().y, y.position().y) << "body " << b << " step " << i;
            ASSERT_EQ(x.angular_velocity(), y.angular_velocity()) << "body " << b << " step " << i;
        }
        ASSERT_EQ(kept.scene.report().touching, anew.scene.report().touching);
        ASSERT_EQ(kept.scene.report().colors, anew.scene.report().colors);
        ASSERT_EQ(kept.scene.report().islands + 1, anew.scene.report().islands);
    }
}
