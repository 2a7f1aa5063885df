// Symptom: a box on a rope, rod or hinge that was pulled at 30 to 300 m/s went through a wall of tiles, in 89 of 648 ways to do it, and two of them
// made 1e7 m/s. A hinge with a lever went through thin walls in 384 of 500 ways, a chain of four links in 391.

#include "regressions/numbers.h"
#include "regressions/shapes.h"
#include "support/effort.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float length_of_pull = 3;
constexpr Filter no_filter{.mask = 0};

// --- walls, with their faces to the left at x = 0 ------------------------------------------------------------------------------------

struct Wall
{
    std::string name;
    std::function<void(Scene&)> make;
};

void fixed(Scene& scene, const Geometry& geometry) { scene.create_shape(scene.create_body({}), geometry, {}); }

void tiles(Scene& scene, float side)
{
    for (int i = -40; i < 40; ++i)
    {
        const BodyId tile = scene.create_body({.position = {0.5 * d(side), (i + 0.5) * d(side)}});
        scene.create_shape(tile, box(0.5f * side, 0.5f * side), {});
    }
}

std::vector<Wall> walls()
{
    return {
        {"tiles of 0.5 m", [](Scene& s) { tiles(s, 0.5f); }},
        {"tiles of 2 m", [](Scene& s) { tiles(s, 2); }},
        {"segment", [](Scene& s) { fixed(s, Segment{.a = {0, -1000}, .b = {0, 1000}}); }},
        {"chain", [](Scene& s)
         { fixed(s, Chain{.start = {0, -1000}, .pieces = {{{0, -2}}, {{0, 0}}, {{0, 1}}, {{0, 3}}, {{0, 1000}}}}); }},
        {"thin box", [](Scene& s) { fixed(s, box(0.05f, 1000, {0.05f, 0})); }},
        {"half-space", [](Scene& s) { fixed(s, HalfSpace{.normal = {-1, 0}, .offset = 0}); }},
    };
}

// --- what is dragged -----------------------------------------------------------------------------------------------------------------

std::vector<NamedShape> dragged_shapes()
{
    std::vector<NamedShape> shapes = moving_shapes();
    shapes.emplace_back("plank", box(0.25f, 0.03f));
    return shapes;
}

struct Pull
{
    std::string name;
    std::function<void(Scene&, BodyId hand, BodyId body)> join; ///< the body is length_of_pull to the left of the hand
};

std::vector<Pull> pulls()
{
    constexpr float l = length_of_pull;
    return {
        {"rope", [](Scene& s, BodyId a, BodyId b)
         { s.create_joint(DistanceDef{.body_a = a, .body_b = b, .min_length = 0, .max_length = l}); }},
        {"rod", [](Scene& s, BodyId a, BodyId b)
         { s.create_joint(DistanceDef{.body_a = a, .body_b = b, .min_length = l, .max_length = l}); }},
        {"two ropes",
         [](Scene& s, BodyId a, BodyId b)
         {
             for (const float side : {-0.2f, 0.2f})
                 s.create_joint(DistanceDef{.body_a = a, .body_b = b, .anchor_b = {0, side}, .min_length = 0, .max_length = l});
         }},
        {"hinge",
         [](Scene& s, BodyId a, BodyId b) { s.create_joint(RevoluteDef{.body_a = a, .body_b = b, .anchor_a = {-l, 0}}); }},
        {"hinge with a lever", [](Scene& s, BodyId a, BodyId b)
         { s.create_joint(RevoluteDef{.body_a = a, .body_b = b, .anchor_a = {1 - l, 0}, .anchor_b = {1, 0}}); }},
        {"slider along the wall", [](Scene& s, BodyId a, BodyId b)
         { s.create_joint(PrismaticDef{.body_a = a, .body_b = b, .anchor_a = {-l, 0}, .axis_a = {0, 1}}); }},
        {"slider with a stop",
         [](Scene& s, BodyId a, BodyId b)
         {
             s.create_joint(PrismaticDef{.body_a = a,
                                         .body_b = b,
                                         .anchor_a = {-l, 0},
                                         .axis_a = {1, 0},
                                         .enable_limit = true,
                                         .lower_translation = -0.5f,
                                         .upper_translation = 0.5f});
         }},
    };
}

enum class Hand
{
    Kinematic,
    Carried, ///< kinematic, from target to target
    Heavy
};

struct Drag
{
    Scene scene;
    BodyId hand{};
    std::vector<BodyId> bodies;
    Hand kind;
    float speed;
    double x = -4;
    float fastest = 0; ///< in speeds of the hand

    Drag(Hand of, float v, const SceneDef& def = {}) : scene(def), kind(of), speed(v)
    {
        hand = scene.create_body({.type = of == Hand::Heavy ? BodyType::Dynamic : BodyType::Kinematic,
                                  .position = {x, 0.1},
                                  .velocity = {of == Hand::Carried ? 0 : v, 0},
                                  .gravity_scale = 0});
        if (of == Hand::Heavy)
            scene.create_shape(hand, Circle{.radius = 0.2f}, {.density = 1000, .filter = no_filter});
    }

    BodyId add(const Geometry& geometry, double at)
    {
        bodies.push_back(scene.create_body({.type = BodyType::Dynamic, .position = {at, 0.1}}));
        scene.create_shape(bodies.back(), geometry, {});
        return bodies.back();
    }

    // Nobody's center comes to the wall, and nothing is `most` times as fast as the hand.
    void run(double seconds, float h, float most = 20)
    {
        for (double t = 0; t < seconds; t += d(h))
        {
            x += d(speed) * d(h);
            if (kind == Hand::Carried)
                scene.body(hand).set_target_pose({x, 0.1}, 0);
            ASSERT_TRUE(scene.step(h).quarantined.empty());
            for (const BodyId id : bodies)
            {
                const ConstBody body = scene.body(id);
                if (std::fabs(body.position().y) > 19)
                    return; // round the wall
                ASSERT_LT(body.center_of_mass().x, 0) << "after " << t << " s";
                fastest = std::max(fastest, length(body.velocity()) / speed);
                ASSERT_LT(fastest, most) << "after " << t << " s";
            }
        }
    }
};

} // namespace

namespace {

// A body that is dragged faster than a step can follow is thrown about: whether one case stays below a bound hangs on its last bits. With the speeds of the hand
// changed by up to 3 %, 2 to 5 of 1,134 bodies and 0 to 3 of 96 short chains are faster than 20 times the hand, and none than 180 times.
constexpr float fast = 20;
constexpr float thrown = 300;

} // namespace

TEST(Walls, StopWhatIsDragged)
{
    int fast_ones = 0;
    int n = 0;
    for (const Wall& wall : walls())
    {
        for (const Pull& pull : pulls())
        {
            for (const NamedShape& shape : dragged_shapes())
            {
                for (const Hand hand : {Hand::Kinematic, Hand::Carried, Hand::Heavy})
                {
                    if (++n % 7 != 0 && slow_build)
                        continue;
                    const float speed = std::vector{10.0f, 30.0f, 100.0f, 300.0f, 1000.0f}[static_cast<std::size_t>(n % 5)];
                    const float h = n % 2 == 0 ? 1.0f / 60 : 1.0f / 30;
                    SCOPED_TRACE(shape.first + " on a " + pull.name + " at " + std::to_string(speed) + " m/s, " + wall.name +
                                 ", hand " + std::to_string(static_cast<int>(hand)));
                    Drag drag(hand, speed);
                    wall.make(drag.scene);
                    pull.join(drag.scene, drag.hand, drag.add(shape.second, -4 - d(length_of_pull)));
                    drag.run(1.2, h, thrown);
                    if (HasFatalFailure())
                        return;
                    fast_ones += drag.fastest > fast ? 1 : 0;
                }
            }
        }
    }
    EXPECT_LE(fast_ones, n / 150);
}

// Chains that are pulled through, from a few links that are solved at once to more than that.
TEST(Walls, StopChains)
{
    int fast_ones = 0;
    int n = 0;
    for (const Wall& wall : walls())
    {
        for (const int links : slow_build ? std::vector{4} : std::vector{2, 4, 8, 20, 70})
        {
            for (const NamedShape& shape : std::vector<NamedShape>{{"box", box(0.25f, 0.25f)},
                                                                   {"ball", Circle{.radius = 0.25f}},
                                                                   {"plank", box(0.25f, 0.03f)},
                                                                   {"capsule", Capsule{{-0.2f, 0}, {0.2f, 0}, 0.1f, 0.1f}}})
            {
                const float speed = std::vector{10.0f, 30.0f, 100.0f, 300.0f}[static_cast<std::size_t>(++n % 4)];
                SCOPED_TRACE(std::to_string(links) + " links, " + shape.first + " at " + std::to_string(speed) + " m/s, " +
                             wall.name);
                Drag drag(n % 3 == 0 ? Hand::Heavy : n % 3 == 1 ? Hand::Kinematic : Hand::Carried, speed);
                wall.make(drag.scene);
                BodyId last = drag.hand;
                for (int i = 1; i <= links; ++i)
                {
                    const BodyId link = drag.add(shape.second, -4 - 0.6 * i);
                    drag.scene.create_joint(
                        RevoluteDef{.body_a = last, .body_b = link, .anchor_a = {-0.3f, 0}, .anchor_b = {0.3f, 0}});
                    last = link;
                }
                drag.run(1, dt, links > 40 ? 60.0f : thrown); // too many for one solve: they are as springs
                if (HasFatalFailure())
                    return;
                fast_ones += links <= 40 && drag.fastest > fast ? 1 : 0;
            }
        }
    }
    EXPECT_LE(fast_ones, n / 20);
}

// The hand goes on for 20 m behind the wall and waits there. Once the wall is gone the body comes to it, no faster than its size asks for.
TEST(Walls, AreForgottenWhenTheyGo)
{
    for (const Pull& pull : pulls())
    {
        for (const NamedShape& shape : dragged_shapes())
        {
            SCOPED_TRACE(shape.first + " on a " + pull.name);
            Drag drag(Hand::Kinematic, 20, weightless());
            const BodyId wall = drag.scene.create_body({});
            drag.scene.create_shape(wall, Segment{.a = {0, -1000}, .b = {0, 1000}}, {});
            const BodyId body = drag.add(shape.second, -4 - d(length_of_pull));
            pull.join(drag.scene, drag.hand, body);
            drag.run(1.2, dt);
            if (HasFatalFailure())
                return;
            drag.scene.body(drag.hand).set_velocity({});
            drag.scene.destroy(wall);
            float fastest = 0;
            for (int i = 0; i < 900; ++i)
            {
                drag.scene.step(dt);
                fastest = std::max(fastest, length(drag.scene.body(body).velocity()));
            }
            EXPECT_LT(fastest, 100);
            const Position hand = drag.scene.body(drag.hand).position();
            EXPECT_LT(length(hand - drag.scene.body(body).center_of_mass()), length_of_pull + 0.7f);
        }
    }
}
