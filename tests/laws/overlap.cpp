// Row 6: overlap is removed along the normal, each body moving by the other's share of the mass; the common center of mass stays put.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

void expect_shared(const Geometry& ga, const Geometry& gb, double reach, double density_b)
{
    Scene scene(weightless());
    const double overlap = 0.1;
    const Thing a = add_dynamic(scene, {0, 0}, ga, {.friction = 0, .restitution = 0});
    const Thing b =
        add_dynamic(scene, {reach - overlap, 0}, gb, {.density = static_cast<float>(density_b), .friction = 0, .restitution = 0});
    const double ma = scene.body(a.body).mass();
    const double mb = scene.body(b.body).mass();
    const double xb = scene.body(b.body).position().x;
    const auto common = [&] { return (ma * scene.body(a.body).position().x + mb * scene.body(b.body).position().x) / (ma + mb); };
    const double before = common();
    steps(scene, 120);
    const double moved_a = -scene.body(a.body).position().x;
    const double moved_b = scene.body(b.body).position().x - xb;
    EXPECT_NEAR(common(), before, 1e-6);
    EXPECT_NEAR(moved_a * ma, moved_b * mb, 1e-5 * (ma + mb));
    EXPECT_GE(moved_a + moved_b, overlap - 0.006) << "within a slop of apart";
    EXPECT_LE(moved_a + moved_b, overlap + 0.02) << "pushed apart, not shot apart";
    EXPECT_NEAR(speed(scene, a.body) + speed(scene, b.body), 0, 2e-3) << "recovery leaves no velocity behind";
    EXPECT_NEAR(scene.body(a.body).position().y, 0, 1e-4);
}

} // namespace

TEST(Row06_ApplyContactForces, OverlapIsRemovedInProportionToTheOtherMass)
{
    for (const double density : {1.0, 4.0, 0.1})
    {
        SCOPED_TRACE(density);
        {
            SCOPED_TRACE("circles");
            expect_shared(Circle{}, Circle{}, 1, density);
        }
        {
            SCOPED_TRACE("boxes");
            expect_shared(box(0.5f, 0.5f), box(0.5f, 0.5f), 1, density);
        }
        {
            SCOPED_TRACE("circle and box");
            expect_shared(Circle{}, box(0.5f, 0.5f), 1, density);
        }
        {
            SCOPED_TRACE("capsules");
            expect_shared(Capsule{{0, -0.5f}, {0, 0.5f}}, Capsule{{0, -0.5f}, {0, 0.5f}}, 0.5, density);
        }
    }
}

TEST(Row06_ApplyContactForces, AWallKeepsItsPlace)
{
    for (const BodyType type : {BodyType::Static, BodyType::Kinematic})
    {
        Scene scene(weightless());
        const Thing wall = add(scene, {.type = type}, box(0.5f, 0.5f));
        const Thing body = add_dynamic(scene, {0.9, 0}, box(0.5f, 0.5f));
        steps(scene, 120);
        EXPECT_EQ(scene.body(wall.body).position().x, 0);
        EXPECT_GE(scene.body(body.body).position().x, 0.994);
        EXPECT_LE(scene.body(body.body).position().x, 1.02);
    }
}

TEST(Row06_ApplyContactForces, NoFasterThanThePushSpeed)
{
    SceneDef def = weightless();
    def.contact_push_speed = 0.5f;
    Scene scene(def);
    add_static(scene, box(0.5f, 0.5f));
    const Thing body = add_dynamic(scene, {0.7, 0}, box(0.5f, 0.5f));
    for (int i = 0; i < 60; ++i)
    {
        const double x = scene.body(body.body).position().x;
        scene.step(1.0f / 60);
        EXPECT_LE(scene.body(body.body).position().x - x, 0.5 / 60 * 1.05);
    }
}
