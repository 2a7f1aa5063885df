// One-way shapes block what comes against their direction and let pass what comes from behind, whole.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(LawOneWay, BlocksFromAboveLetsPassFromBelow)
{
    for (const Geometry& geometry :
         {Geometry{Circle{.radius = 0.3f}}, Geometry{box(0.3f, 0.3f)}, Geometry{Capsule{{-0.2f, 0}, {0.2f, 0}, 0.3f, 0.3f}}})
        for (const Geometry& platform : {Geometry{box(3, 0.1f)}, Geometry{Segment{{-3, 0}, {3, 0}}}})
        {
            SCOPED_TRACE("body " + std::to_string(geometry.index()) + " platform " + std::to_string(platform.index()));
            Scene scene(sleepless());
            add_static(scene, platform, {.one_way = {0, 1}});
            const BodyId falls = add_dynamic(scene, {-1.5, 2}, geometry).body;
            const BodyId jumps = add_dynamic(scene, {1.5, -2}, geometry, {}, {0, 9}).body;
            double highest = -9;
            for (int i = 0; i < 240; ++i)
            {
                scene.step(1.0f / 60);
                highest = std::max(highest, scene.body(jumps).position().y);
            }
            EXPECT_NEAR(scene.body(falls).position().y, std::holds_alternative<Segment>(platform) ? 0.3 : 0.4, 0.02);
            EXPECT_NEAR(highest, -2 + 81 / (2 * 9.81), 0.05) << "it is not slowed on its way up";
            EXPECT_NEAR(scene.body(jumps).position().y, std::holds_alternative<Segment>(platform) ? 0.3 : 0.4, 0.02)
                << "and lands on it";
        }
}

TEST(LawOneWay, FastBallsToo)
{
    for (const float v : {10.0f, 100.0f, 1000.0f})
    {
        Scene scene(weightless());
        add_static(scene, Segment{{-3, 0}, {3, 0}}, {.one_way = {0, 1}});
        const BodyId down = add_dynamic(scene, {-1, 1}, Circle{.radius = 0.1f}, {.restitution = 0.5f}, {0, -v}).body;
        const BodyId up = add_dynamic(scene, {1, -1}, Circle{.radius = 0.1f}, {.restitution = 0.5f}, {0, v}).body;
        int impacts = 0;
        for (int i = 0; i < 30; ++i)
        {
            scene.step(1.0f / 60);
            impacts += static_cast<int>(scene.impacts().size());
        }
        EXPECT_EQ(impacts, 1);
        EXPECT_GT(scene.body(down).position().y, 0);
        EXPECT_NEAR(scene.body(up).velocity().y, v, 1e-3f * v);
    }
}

TEST(LawOneWay, FromWhenItIsSet)
{
    Scene scene(sleepless());
    const Thing platform = add_static(scene, Segment{{-3, 0}, {3, 0}});
    const BodyId ball = add_dynamic(scene, {0, 0.1}, Circle{.radius = 0.1f}).body;
    steps(scene, 30);
    ASSERT_NEAR(scene.body(ball).position().y, 0.1, 0.01);
    scene.shape(platform.shape).set_def({.one_way = {0, -1}});
    steps(scene, 60);
    EXPECT_LT(scene.body(ball).position().y, -3) << "what rested on it falls through";
    scene.shape(platform.shape).set_def({});
    scene.body(ball).teleport({0, 0.5}, 0);
    scene.body(ball).set_velocity({});
    steps(scene, 60);
    EXPECT_NEAR(scene.body(ball).position().y, 0.1, 0.01) << "and no more once it is solid";
}

TEST(LawOneWay, OneSidedSegmentsAndArcs)
{
    for (const float v : {5.0f, 500.0f})
    {
        Scene scene(weightless());
        add_static(scene, Segment{{-3, 0}, {3, 0}, 0, Sides::Left});
        const BodyId down = add_dynamic(scene, {-1, 1}, Circle{.radius = 0.1f}, {}, {0, -v}).body;
        const BodyId up = add_dynamic(scene, {1, -1}, Circle{.radius = 0.1f}, {}, {0, v}).body;
        steps(scene, 60);
        EXPECT_GT(scene.body(down).position().y, 0);
        EXPECT_NEAR(scene.body(up).velocity().y, v, 1e-3f * v);
    }
}

TEST(LawFilter, CategoriesGroupsAndIgnoredPairs)
{
    const auto touch = [](const Filter& a, const Filter& b)
    {
        Scene scene(weightless());
        add_static(scene, Circle{}, {.filter = a});
        add_dynamic(scene, {0.5, 0}, Circle{}, {.filter = b});
        scene.step(1.0f / 60);
        return !scene.contact_begins().empty();
    };
    EXPECT_TRUE(touch({}, {}));
    EXPECT_FALSE(touch({.category = 2}, {.mask = 1}));
    EXPECT_FALSE(touch({.mask = 4}, {.category = 2}));
    EXPECT_TRUE(touch({.category = 1ull << 40, .mask = 1ull << 63}, {.category = 1ull << 63, .mask = 1ull << 40}));
    EXPECT_TRUE(touch({.mask = 0, .group = 3}, {.mask = 0, .group = 3}));
    EXPECT_FALSE(touch({.group = -3}, {.group = -3}));
    EXPECT_TRUE(touch({.group = -3}, {.group = -4}));
    EXPECT_TRUE(touch({.group = 3}, {.group = 4}));
}

TEST(LawFilter, IgnoredPairsPassAndComeBack)
{
    Scene scene(weightless());
    const BodyId wall = add_static(scene, box(0.5f, 5)).body;
    const BodyId ball = add_dynamic(scene, {-3, 0}, Circle{.radius = 0.2f}, {}, {6, 0}).body;
    scene.ignore_pair(ball, wall);
    steps(scene, 60);
    EXPECT_NEAR(scene.body(ball).position().x, 3, 1e-3);
    scene.restore_pair(wall, ball);
    scene.body(ball).set_velocity({-6, 0});
    steps(scene, 60);
    EXPECT_GT(scene.body(ball).position().x, 0.6);
}
