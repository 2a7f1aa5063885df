// Force laws: when they are called, that their loads act as forces do, and that nothing is passed through for their sake.

#include "support/effort.h"
#include "support/test_scene.h"
#include "support/threads.h"

#include <limits>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float step = 1.0f / 60;

/// Gives the same load always, and remembers how it was called.
struct Constant
{
    Load load{};
    std::vector<BodyMotion> calls{};
    std::size_t impacts = 0;

    static Load law(void* user, const BodyMotion& motion)
    {
        auto& self = *static_cast<Constant*>(user);
        self.calls.push_back(motion);
        self.calls.back().impacts = {}; // valid during the call only
        self.impacts += motion.impacts.size();
        return self.load;
    }
    ForceLaw declared(float force, float torque)
    {
        return {.function = law, .user = this, .greatest_force = force, .greatest_torque = torque};
    }
    ForceLaw undeclared() { return {.function = law, .user = this}; }
};

TEST(ForceLaw, IsCalledOnceAtTheStartOfEverySubstep)
{
    Scene scene;
    const Thing ball = add_dynamic(scene, {0, 100}, Circle{}, {}, {1, 0});
    Constant law;
    scene.set_force_law(ball.body, law.undeclared());
    steps(scene, 3, step);
    ASSERT_EQ(law.calls.size(), 12u);
    for (std::size_t i = 0; i < law.calls.size(); ++i)
    {
        const BodyMotion& m = law.calls[i];
        const double h = static_cast<double>(step) / 4;
        EXPECT_NEAR(m.time, static_cast<double>(i % 4) * h, 1e-12);
        EXPECT_FLOAT_EQ(m.h, step / 4);
        const double t = static_cast<double>(i) * h;
        EXPECT_NEAR(m.pose.position.x, t, 1e-6);
        EXPECT_NEAR(m.pose.position.y, 100 - 0.5 * 9.81 * t * t, 1e-6);
        EXPECT_NEAR(m.velocity.y, -9.81 * t, 1e-5);
    }
    scene.set_force_law(ball.body, {});
    steps(scene, 3, step);
    EXPECT_EQ(law.calls.size(), 12u) << "it was removed";
}

TEST(ForceLaw, OnlyMovesWhatIsDynamicAwakeAndEnabled)
{
    Scene scene;
    Constant law{.load = {.force = {100, 100}, .torque = 10}};
    const Thing fixed = add_static(scene, box(1, 1));
    const Thing lift = add(scene, {.type = BodyType::Kinematic, .position = {5, 0}}, Circle{});
    const Thing off = add(scene, {.type = BodyType::Dynamic, .position = {10, 0}, .enabled = false}, Circle{});
    const Thing asleep = add(scene, {.type = BodyType::Dynamic, .position = {15, 0}}, Circle{});
    scene.body(asleep.body).set_awake(false);
    for (const Thing& t : {fixed, lift, off, asleep})
        scene.set_force_law(t.body, law.undeclared());
    steps(scene, 5, step);
    EXPECT_TRUE(law.calls.empty());
    EXPECT_FALSE(scene.body(asleep.body).is_awake());
    scene.body(asleep.body).set_awake(true);
    steps(scene, 1, step);
    EXPECT_EQ(law.calls.size(), 4u);
    EXPECT_GT(scene.body(asleep.body).velocity().x, 0);
}

TEST(ForceLaw, AConstantLoadIsAnAppliedForceBitForBit)
{
    const auto run = [](bool by_law)
    {
        Scene scene(sleepless());
        add_static(scene, HalfSpace{});
        const Thing crate = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f));
        const Thing ball = add_dynamic(scene, {5, 3}, Circle{}, {.restitution = 0.5f});
        Constant law{.load = {.force = {3, 1}, .torque = 0.5f}};
        for (const BodyId body : {crate.body, ball.body})
            if (by_law)
                scene.set_force_law(body, law.declared(4, 1));
        for (int i = 0; i < 100; ++i)
        {
            for (const BodyId body : {crate.body, ball.body})
                if (!by_law)
                {
                    scene.body(body).apply_force(law.load.force);
                    scene.body(body).apply_torque(law.load.torque);
                }
            scene.step(step);
        }
        return std::pair{scene.body(crate.body).pose(), scene.body(ball.body).pose()};
    };
    const auto [crate, ball] = run(true);
    const auto [pushed_crate, pushed_ball] = run(false);
    EXPECT_EQ(crate.position, pushed_crate.position);
    EXPECT_EQ(ball.position, pushed_ball.position);
    EXPECT_GT(ball.position.x, 5.5);
}

TEST(ForceLaw, SeesWhatItsOwnLoadDidWithinTheStep)
{
    // Drag: v' = -k v. Called once a step it would leave 1 - k dt.
    Scene scene(weightless());
    const Thing ball = add_dynamic(scene, {}, Circle{}, {}, {10, 0});
    struct Drag
    {
        float strength;
        static Load law(void* user, const BodyMotion& m) { return {.force = -static_cast<Drag*>(user)->strength * m.velocity}; }
    } drag{20 * scene.body(ball.body).mass()};
    scene.set_force_law(ball.body, {.function = Drag::law, .user = &drag});
    scene.step(step);
    EXPECT_NEAR(scene.body(ball.body).velocity().x, 10 * std::pow(1 - 20 * step / 4, 4), 1e-4);
}

TEST(ForceLaw, IsToldEveryImpactOnce)
{
    Scene scene(sleepless());
    add_static(scene, HalfSpace{}, {.restitution = 0.8f});
    const Thing ball = add_dynamic(scene, {0, 1}, Circle{.radius = 0.1f}, {.restitution = 0.8f});
    const Thing other = add_dynamic(scene, {1, 1.3}, Circle{.radius = 0.1f}, {.restitution = 0.8f});
    Constant law;
    scene.set_force_law(ball.body, law.undeclared());
    std::size_t impacts = 0;
    const auto count = [&]
    {
        for (const ImpactEvent& impact : scene.impacts())
            impacts += impact.body_a == ball.body || impact.body_b == ball.body ? 1 : 0;
    };
    for (int i = 0; i < 150; ++i)
    {
        scene.step(step);
        count();
    }
    scene.body(ball.body).set_enabled(false);
    scene.destroy(other.body);
    EXPECT_GT(impacts, 3u);
    EXPECT_EQ(law.impacts, impacts);
}

TEST(ForceLaw, WhatIsNoForcePutsTheBodyAside)
{
    constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
    for (const Load bad : {Load{.force = {not_a_number, 0}}, Load{.torque = not_a_number}, Load{.force = {0, 3e38f}}})
    {
        Scene scene(sleepless());
        add_static(scene, HalfSpace{});
        const Thing mad = add_dynamic(scene, {0, 2}, box(0.5f, 0.5f));
        const Thing sane = add_dynamic(scene, {0, 5}, box(0.5f, 0.5f));
        steps(scene, 10);
        Constant law{.load = bad};
        scene.set_force_law(mad.body, law.undeclared());
        const StepReport& report = scene.step(step);
        ASSERT_EQ(report.quarantined.size(), 1u);
        EXPECT_EQ(report.quarantined[0], mad.body);
        EXPECT_EQ(law.calls.size(), 1u) << "it is not asked again";
        EXPECT_FALSE(scene.body(mad.body).is_enabled());
        EXPECT_TRUE(std::isfinite(scene.body(mad.body).position().x));
        EXPECT_TRUE(std::isfinite(scene.body(mad.body).angle()));
        scene.set_force_law(mad.body, {});
        scene.body(mad.body).set_enabled(true);
        steps(scene, 240);
        EXPECT_NEAR(scene.body(mad.body).position().y, 0.5, 0.01) << "it may come back";
        EXPECT_TRUE(scene.body(sane.body).is_enabled());
    }
}

// A bat at rest that a torque throws against a ball at rest, all within one long step. The ball's velocity afterwards.
Vec2 thrown(int rate, bool declared, Position& ball_at)
{
    Scene scene(weightless());
    const Thing bat = add(scene, {.type = BodyType::Dynamic, .locks = {.linear_x = true, .linear_y = true}},
                          Capsule{.a = {}, .b = {1, 0}, .radius_a = 0.05f, .radius_b = 0.05f}, {.restitution = 0.5f});
    scene.body(bat.body).set_mass({.mass = 1, .center = {}, .inertia = 1});
    scene.create_joint(RevoluteDef{.body_b = bat.body});
    const Thing ball = add_dynamic(scene, {0.8, 0.35}, Circle{.radius = 0.1f}, {.friction = 0, .restitution = 0.5f});
    Constant law{.load = {.torque = 4000}};
    scene.set_force_law(bat.body, declared ? law.declared(0, 4000) : law.undeclared());
    for (int i = 0; i < rate / 60; ++i)
        scene.step(1.0f / static_cast<float>(rate));
    scene.set_force_law(bat.body, {});
    for (int i = 0; i < rate / 60; ++i)
        scene.step(1.0f / static_cast<float>(rate));
    ball_at = scene.body(ball.body).position();
    return scene.body(ball.body).velocity();
}

TEST(ForceLaw, WhatItThrowsIsMetAtItsTimeHoweverLongTheStep)
{
    Position at_fine;
    Position at_coarse;
    const Vec2 fine = thrown(3840, true, at_fine);
    const Vec2 coarse = thrown(60, true, at_coarse);
    EXPECT_GT(length(fine), 10);
    EXPECT_NEAR(length(coarse), length(fine), 0.01f * length(fine));
    EXPECT_LT(length(at_coarse - at_fine), 0.02f);
}

TEST(ForceLaw, WhatItThrowsUndeclaredIsStillNotPassed)
{
    Position at;
    const Vec2 velocity = thrown(60, false, at);
    EXPECT_GT(velocity.y, 0) << "the bat came from below";
    EXPECT_GT(length(velocity), 5);
}

TEST(ForceLaw, NoPushLeadsThroughAWall)
{
    for (const bool declared : {true, false})
    {
        for (const bool rests : {true, false})
        {
            for (const float acceleration : {100.0f, 1000.0f, 3000.0f})
            {
                Scene scene(rests ? sleepless() : weightless());
                add_static(scene, HalfSpace{});
                add_static(scene, Segment{.a = {1.0f, -1}, .b = {1.0f, 50}});
                const Thing crate = add_dynamic(scene, {0, 0.2 + (rests ? 0 : 1)}, box(0.2f, 0.2f), {.friction = 0.1f});
                const Thing ball = add_dynamic(scene, {-1, 0.1 + (rests ? 0 : 1)}, Circle{.radius = 0.1f});
                steps(scene, 20);
                const float most = acceleration * (scene.body(crate.body).mass() + scene.body(ball.body).mass());
                Constant push_crate{.load = {.force = {acceleration * scene.body(crate.body).mass(), 0}}};
                Constant push_ball{.load = {.force = {acceleration * scene.body(ball.body).mass(), 0}}};
                scene.set_force_law(crate.body, declared ? push_crate.declared(most, 0) : push_crate.undeclared());
                scene.set_force_law(ball.body, declared ? push_ball.declared(most, 0) : push_ball.undeclared());
                for (int i = 0; i < 60; ++i)
                {
                    scene.step(step);
                    ASSERT_LT(scene.body(crate.body).position().x, 1) << declared << rests << acceleration << " step " << i;
                    ASSERT_LT(scene.body(ball.body).position().x, 1) << declared << rests << acceleration << " step " << i;
                }
            }
        }
    }
}

TEST(ForceLaw, ResultsDoNotDependOnTheThreads)
{
    struct Swing
    {
        float phase = 0;
        static Load law(void* user, const BodyMotion& m)
        {
            auto& self = *static_cast<Swing*>(user);
            self.phase += m.h + 0.01f * static_cast<float>(m.impacts.size());
            return {.force = {self.phase - m.velocity.x, 0}, .torque = 0.1f * self.phase};
        }
    };
    const auto run = [](TaskHooks tasks)
    {
        SceneDef def = sleepless();
        def.tasks = tasks;
        Scene scene(def);
        add_static(scene, HalfSpace{}, {.restitution = 0.7f});
        std::vector<Swing> swings(900);
        for (std::size_t i = 0; i < swings.size(); ++i)
        {
            const Thing ball = add_dynamic(scene, {2.0 * static_cast<double>(i), 0.3 + 0.01 * static_cast<double>(i % 7)},
                                           Circle{.radius = 0.1f}, {.restitution = 0.7f});
            scene.set_force_law(ball.body, {.function = Swing::law, .user = &swings[i], .greatest_force = 3});
        }
        steps(scene, slow_build ? 15 : 60);
        return scene.state_hash();
    };
    const std::uint64_t alone = run({});
    Threads three(3);
    EXPECT_EQ(run(three.hooks()), alone);
}

} // namespace
