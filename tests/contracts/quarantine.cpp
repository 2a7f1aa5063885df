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
