// A body whose state becomes non-finite is put back, disabled and reported; the rest of the world goes on.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(ContractQuarantine, ABodyMadeNonFiniteIsPutAsideAndTheWorldGoesOn)
{
    Scene scene(sleepless());
    add_static(scene, HalfSpace{});
    const Thing mad = add_dynamic(scene, {0, 1}, box(0.5f, 0.5f));
    const Thing sane = add_dynamic(scene, {50, 1}, box(0.5f, 0.5f));
    scene.step(1.0f / 60);
    scene.body(mad.body).apply_impulse({3e38f, 3e38f});
    scene.body(mad.body).apply_impulse({3e38f, 3e38f});
    scene.body(mad.body).apply_angular_impulse(3e38f);
    bool reported = false;
    for (int i = 0; i < 10; ++i)
    {
        const StepReport& report = scene.step(1.0f / 60);
        if (report.has(StepFlag::BodyQuarantined))
        {
            reported = true;
            ASSERT_EQ(report.quarantined.size(), 1u);
            EXPECT_EQ(report.quarantined[0], mad.body);
        }
    }
    EXPECT_TRUE(reported);
    EXPECT_FALSE(scene.body(mad.body).is_enabled());
    EXPECT_TRUE(std::isfinite(scene.body(mad.body).position().x));
    EXPECT_TRUE(std::isfinite(scene.body(mad.body).velocity().x));
    steps(scene, 50);
    EXPECT_TRUE(scene.body(sane.body).is_enabled());
    EXPECT_NEAR(scene.body(sane.body).position().y, 0.5, 0.01);
    EXPECT_NEAR(scene.body(mad.body).position().x, 0, 1) << "its last finite place";
    scene.body(mad.body).set_enabled(true);
    steps(scene, 60);
    EXPECT_NEAR(scene.body(mad.body).position().y, 0.5, 0.01) << "it may come back";
}

TEST(ContractQuarantine, HugeForcesAndNeighboursInContact)
{
    for (const Geometry& geometry : {Geometry{box(0.5f, 0.5f)}, Geometry{Circle{}}})
    {
        Scene scene(sleepless());
        add_static(scene, HalfSpace{});
        const Thing low = add_dynamic(scene, {0, 0.5}, geometry);
        const Thing high = add_dynamic(scene, {0, 1.5}, geometry);
        const Thing aside = add_dynamic(scene, {9, 0.5}, geometry);
        steps(scene, 30);
        for (int i = 0; i < 4; ++i)
        {
            scene.body(high.body).apply_force({0, -3e38f});
            scene.body(high.body).apply_torque(3e38f);
            scene.step(1.0f / 60);
        }
        steps(scene, 30);
        for (const Thing& t : {low, high, aside})
        {
            const Position p = scene.body(t.body).position();
            EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
            EXPECT_TRUE(std::isfinite(scene.body(t.body).velocity().y));
        }
        EXPECT_TRUE(scene.body(aside.body).is_enabled());
        EXPECT_NEAR(scene.body(aside.body).position().y, 0.5, 0.02);
        // The scene can still be asked and stepped.
        EXPECT_NO_THROW(static_cast<void>(scene.overlap_point({9, 0.5})));
    }
}

TEST(ContractQuarantine, FarAwayIsNotNonFinite)
{
    Scene scene(sleepless());
    const Thing fast = add_dynamic(scene, {0, 0}, Circle{}, {}, {1e18f, 0});
    for (int i = 0; i < 60; ++i)
        EXPECT_NO_THROW(scene.step(1.0f / 60));
    EXPECT_TRUE(std::isfinite(scene.body(fast.body).position().x));
}
