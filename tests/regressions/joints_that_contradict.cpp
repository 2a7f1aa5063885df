// Symptom: joints that cannot all hold threw their bodies. A chain that is too short for its two anchors, a rod between bodies whose centers are locked too
// far apart, a triangle of rods of 1, 1 and 5 m, two hands that part: speeds up to 1e30 m/s, forces that grew step by step until they were infinite.

#include "regressions/numbers.h"
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

enum class Kind
{
    Hinge,
    Rod,
    Weld,
    Slider
};

constexpr Kind all_kinds[] = {Kind::Hinge, Kind::Rod, Kind::Weld, Kind::Slider};
constexpr const char* names[] = {"hinge", "rod", "weld", "slider"};
constexpr float rod = 0.05f;

class Mechanism
{
public:
    Mechanism(Scene& scene, Kind kind) : m_scene(scene), m_kind(kind) {}

    BodyId bar(Position at, MotionLocks locks = {})
    {
        const BodyId body = m_scene.create_body({.type = BodyType::Dynamic, .position = at, .locks = locks});
        m_scene.create_shape(body, box(0.25f, 0.1f), {.filter = {.mask = 0}});
        return body;
    }

    BodyId hand(Position at, Vec2 velocity, float turning = 0)
    {
        return m_scene.create_body(
            {.type = BodyType::Kinematic, .position = at, .velocity = velocity, .angular_velocity = turning});
    }

    void join(BodyId a, Vec2 on_a, BodyId b, Vec2 on_b)
    {
        switch (m_kind)
        {
        case Kind::Hinge: m_scene.create_joint(RevoluteDef{.body_a = a, .body_b = b, .anchor_a = on_a, .anchor_b = on_b}); break;
        case Kind::Rod:
            m_scene.create_joint(
                DistanceDef{.body_a = a, .body_b = b, .anchor_a = on_a, .anchor_b = on_b, .min_length = rod, .max_length = rod});
            break;
        case Kind::Weld:
            m_scene.create_joint(RevoluteDef{.body_a = a, .body_b = b, .anchor_a = on_a, .anchor_b = on_b, .enable_limit = true});
            break;
        case Kind::Slider:
            m_scene.create_joint(
                PrismaticDef{.body_a = a, .body_b = b, .anchor_a = on_a, .anchor_b = on_b, .axis_a = {0.6f, 0.8f}});
            break;
        }
    }

    // From a to b, along x.
    void chain(int count, BodyId a, BodyId b, Vec2 on_b, float apart)
    {
        Vec2 end{};
        for (int i = 0; i < count; ++i)
        {
            const BodyId next = bar({0.25 + (0.5 + d(apart)) * i, 0});
            join(a, end, next, {-0.25f, 0});
            a = next;
            end = {0.25f, 0};
        }
        join(a, end, b, on_b);
    }

private:
    Scene& m_scene;
    Kind m_kind;
};

struct Contradiction
{
    std::string name;
    std::function<void(Mechanism&, float)> make; ///< off by so many m
};

// Nothing is driven.
std::vector<Contradiction> standing()
{
    std::vector<Contradiction> all;
    for (const MotionLocks locks : {MotionLocks{.linear_x = true}, MotionLocks{.linear_y = true},
                                    MotionLocks{.linear_x = true, .linear_y = true}, MotionLocks{true, true, true}})
    {
        for (const float lever : {0.0f, 0.25f})
        {
            all.push_back({"locked", [=](Mechanism& m, float off) { m.join(m.bar({}, locks), {lever, 0}, {}, {0.1f, off}); }});
            all.push_back({"between locked ones", [=](Mechanism& m, float off)
                           {
                               const BodyId middle = m.bar({1 + d(off), 0});
                               m.join(m.bar({}, locks), {0.5f, lever}, middle, {-0.5f, lever});
                               m.join(middle, {0.5f, 0}, m.bar({2 + 2 * d(off), 0}, locks), {-0.5f, 0});
                           }});
        }
    }
    for (const int count : {1, 2, 3, 5})
    {
        all.push_back(
            {"chain of " + std::to_string(count), [=](Mechanism& m, float off)
             { m.chain(count, {}, {}, {0.5f * static_cast<float>(count) + off, 0}, off / static_cast<float>(count)); }});
    }
    all.push_back({"two of a pair", [](Mechanism& m, float off)
                   {
                       const BodyId a = m.bar({});
                       const BodyId b = m.bar({1, 0});
                       m.join(a, {0.5f, 0}, b, {-0.5f, 0});
                       m.join(a, {0.5f, off}, b, {-0.5f, 0});
                   }});
    all.push_back({"one point, two places", [](Mechanism& m, float off)
                   {
                       const BodyId a = m.bar({});
                       m.join(a, {0.2f, 0}, {}, {0.2f, 0});
                       m.join(a, {0.2f, 0}, {}, {0.2f + off, 0});
                   }});
    all.push_back({"center, two places", [](Mechanism& m, float off)
                   {
                       const BodyId a = m.bar({});
                       m.join(a, {}, {}, {off, 0});
                       m.join(a, {}, {}, {-off, 0});
                   }});
    all.push_back({"four corners", [](Mechanism& m, float off)
                   {
                       const BodyId a = m.bar({});
                       for (const float x : {-1.0f, 1.0f})
                       {
                           for (const float y : {-1.0f, 1.0f})
                               m.join(a, {0.25f * x, 0.1f * y}, {}, {(0.25f + off) * x, (0.1f + off) * y});
                       }
                   }});
    all.push_back({"loop of three", [](Mechanism& m, float off)
                   {
                       const BodyId a = m.bar({});
                       const BodyId b = m.bar({1, 0});
                       const BodyId c = m.bar({0.5, 1});
                       m.join(a, {0.25f, 0}, b, {-0.25f, 0});
                       m.join(b, {0.25f, 0}, c, {0.25f, 0});
                       m.join(c, {-0.25f - off, 0}, a, {-0.25f, 0});
                   }});
    return all;
}

// A hand drives.
std::vector<Contradiction> driven()
{
    std::vector<Contradiction> all;
    for (const int count : {1, 2, 3, 5})
    {
        all.push_back({"hands part, chain of " + std::to_string(count), [=](Mechanism& m, float speed)
                       { m.chain(count, m.hand({}, {-speed, 0}), m.hand({0.5 * count, 0}, {speed, 0}), {}, 0); }});
    }
    for (const bool turns : {false, true})
    {
        all.push_back({"a hand turns what is locked", [=](Mechanism& m, float speed)
                       {
                           const BodyId locked = m.bar({1, 0}, {true, true, !turns});
                           m.join(m.hand({}, {}, 4 * speed), {0.5f, 0}, locked, {-0.5f, 0});
                       }});
    }
    return all;
}

struct Extremes
{
    double speed = 0; ///< m/s, of a corner
    double force = 0; ///< N
};

Extremes run(Scene& scene, float hertz, float time)
{
    Extremes most;
    for (int i = 0; i < static_cast<int>(hertz * time); ++i)
    {
        scene.step(1 / hertz);
        EXPECT_TRUE(scene.report().quarantined.empty());
        for (const BodyId id : scene.bodies())
        {
            const ConstBody body = scene.body(id);
            if (body.type() == BodyType::Dynamic)
                most.speed = std::max(most.speed, d(length(body.velocity()) + 0.27f * std::fabs(body.angular_velocity())));
        }
        for (const JointId id : scene.joints())
            most.force = std::max(most.force, d(length(scene.joint(id).force())));
    }
    return most;
}

// Bars weigh 0.1 kg.
void expect_bounds(const std::vector<Contradiction>& all, Vec2 gravity, double most_speed, double most_force)
{
    for (const Kind kind : all_kinds)
    {
        for (const Contradiction& contradiction : all)
        {
            for (const float off : {0.01f, 0.1f, 0.5f, 2.0f})
            {
                for (const float hertz : slow_build ? std::vector{60.0f} : std::vector{30.0f, 60.0f, 240.0f})
                {
                    SCOPED_TRACE(std::string(names[static_cast<int>(kind)]) + ", " + contradiction.name + ", off by " +
                                 std::to_string(off) + ", " + std::to_string(hertz) + " Hz");
                    Scene scene(SceneDef{.gravity = gravity});
                    Mechanism mechanism(scene, kind);
                    contradiction.make(mechanism, off);
                    const Extremes most = run(scene, hertz, 1.5f);
                    EXPECT_LT(most.speed, most_speed);
                    EXPECT_LT(most.force, most_force);
                }
            }
        }
    }
}

} // namespace

// Where no pose is right, no speed is: what matters is that neither speeds nor forces have no end. In most cases they keep below 10 m/s.
TEST(JointsThatContradict, StandAndBearABoundedForce) { expect_bounds(standing(), {}, 50, 1e6); }

// Free axes fall.
TEST(JointsThatContradict, FallAndBearABoundedForce) { expect_bounds(standing(), {0, -9.81f}, 100, 1e6); }

// Hands part at up to 4 m/s and turn at 8 rad/s.
TEST(JointsThatContradict, FollowTheHandsThatDriveThem) { expect_bounds(driven(), {0, -9.81f}, 100, 1e6); }

// Once they no longer contradict each other, they close without a bang.
TEST(JointsThatContradict, CloseWhenTheyCan)
{
    for (const int count : {1, 2, 3, 5})
    {
        for (const float off : {0.1f, 0.5f, 2.0f})
        {
            SCOPED_TRACE(std::to_string(count) + " bars, off by " + std::to_string(off));
            Scene scene(SceneDef{.gravity = {}});
            Mechanism mechanism(scene, Kind::Hinge);
            mechanism.chain(count, {}, {}, {0.5f * static_cast<float>(count) + off, 0}, 0);
            run(scene, 60, 1);
            const Joint last = scene.joint(scene.joints().back());
            auto def = std::get<RevoluteDef>(last.def());
            def.anchor_b.x -= off;
            scene.joint(last.id()).set_def(def);
            EXPECT_LT(run(scene, 60, 2).speed, 10);
            EXPECT_LT(run(scene, 60, 1).speed, 0.1);
            for (const JointId id : scene.joints())
                EXPECT_LT(length(scene.joint(id).anchor_a() - scene.joint(id).anchor_b()), 0.01f);
        }
    }
}
