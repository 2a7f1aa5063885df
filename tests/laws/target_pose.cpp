// Kinematic bodies are in the recorded sub-step poses.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(Row10_Kinematic, TargetPoseGoesTheShorterWayRound)
{
    Scene scene(sleepless());
    const Thing bar = add(scene, {.type = BodyType::Kinematic, .angle = 3.0f}, box(1, 0.1f));
    const Thing probe = add(scene, {.type = BodyType::Dynamic, .position = {-5, 0}, .gravity_scale = 0}, Circle{});
    scene.body(bar.body).set_target_pose({}, -3.0f);
    scene.set_record_substeps(true);
    scene.step(1.0f / 60);
    int seen = 0;
    for (const SubstepPose& p : scene.report().substep_poses)
    {
        if (p.body != bar.body)
            continue;
        ++seen;
        EXPECT_GT(std::fabs(p.pose.rotation.angle()), 2.99f) << "never near 0";
    }
    EXPECT_GE(seen, 4);
    static_cast<void>(probe);
}
