// Welds: bodies that are welded together move as one, and the seams read back what statics says.

#include "support/test_scene.h"

#include <cmath>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr double weld_g = static_cast<double>(9.81f);

struct Beam
{
    std::vector<BodyId> planks;
    std::vector<JointId> seams;
};

// Planks of 1 m in a row, each welded to the one before and the first to the world at `root`.
Beam cantilever(Scene& scene, int count, float angle = 0)
{
    Beam beam;
    const Rotation q = Rotation::from_angle(angle);
    BodyId previous{};
    for (int i = 0; i < count; ++i)
    {
        const Vec2 middle = rotate(q, {0.5f + static_cast<float>(i), 0});
        const BodyId plank = scene.create_body({.type = BodyType::Dynamic, .position = Position(middle), .angle = angle});
        scene.create_shape(plank, box(0.5f, 0.1f));
        beam.seams.push_back(scene.create_joint(WeldDef{.body_a = previous,
                                                        .body_b = plank,
                                                        .anchor_a = i == 0 ? Vec2{} : Vec2{0.5f, 0},
                                                        .anchor_b = {-0.5f, 0},
                                                        .reference_angle = i == 0 ? angle : 0}));
        beam.planks.push_back(plank);
        previous = plank;
    }
    return beam;
}

// Two unlike bodies welded together, and the same shapes on one body.
struct WeldedPair
{
    BodyId a;
    BodyId b;
    BodyId whole;
};

WeldedPair weld_and_whole(Scene& scene, Vec2 apart)
{
    WeldedPair pair;
    pair.a = add_dynamic(scene, {0, 0}, box(0.5f, 0.1f), {.friction = 0}).body;
    pair.b = add_dynamic(scene, {0.9, 0.4}, Circle{.radius = 0.3f}, {.friction = 0}).body;
    scene.create_joint(WeldDef{.body_a = pair.a, .body_b = pair.b, .anchor_a = {0.5f, 0}, .anchor_b = {-0.4f, -0.4f}});
    pair.whole = add_dynamic(scene, Position(apart), box(0.5f, 0.1f), {.friction = 0}).body;
    scene.create_shape(pair.whole, Circle{.center = {0.9f, 0.4f}, .radius = 0.3f}, {.friction = 0});
    return pair;
}

} // namespace

TEST(LawWeld, ACantileverDoesNotSag)
{
    for (const int count : {1, 2, 6, 16, 17, 42})
    {
        for (const float angle : {0.0f, 0.7f})
        {
            Scene scene(sleepless());
            const Beam beam = cantilever(scene, count, angle);
            const Position end = scene.body(beam.planks.back()).position();
            steps(scene, 300);
            const Vec2 moved = scene.body(beam.planks.back()).position() - end;
            EXPECT_LT(length(moved), 1e-5f * static_cast<float>(count)) << count << " planks at " << angle;
            // Statics at every seam: the weight of what hangs on it, and its moment about the seam.
            const double m = scene.body(beam.planks[0]).mass();
            for (std::size_t i = 0; i < beam.seams.size(); ++i)
            {
                const double hanging = static_cast<double>(beam.seams.size() - i);
                const ConstJoint seam = scene.joint(beam.seams[i]);
                const double weight = hanging * m * weld_g;
                const double moment = weight * 0.5 * hanging * std::cos(static_cast<double>(angle));
                EXPECT_NEAR(seam.force().y, weight, 1e-4 * weight);
                EXPECT_NEAR(seam.force().x, 0, 1e-4 * weight);
                EXPECT_NEAR(seam.torque(), moment, 1e-4 * moment) << "seam " << i << " of " << count;
            }
        }
    }
}

TEST(LawWeld, TwoBodiesFlyAsOne)
{
    Scene scene(sleepless());
    const WeldedPair pair = weld_and_whole(scene, {0, 50});
    const float w = 8;
    Position center = scene.body(pair.whole).center_of_mass();
    center.y -= 50;
    for (const BodyId id : {pair.a, pair.b, pair.whole})
    {
        const Vec2 arm = id == pair.whole ? Vec2{} : scene.body(id).center_of_mass() - center;
        scene.body(id).set_velocity(Vec2{3, 20} + cross(w, arm));
        scene.body(id).set_angular_velocity(w);
    }
    for (int i = 0; i < 120; ++i)
    {
        scene.step(1.0f / 60);
        const ConstBody part = scene.body(pair.a);
        const ConstBody whole = scene.body(pair.whole);
        ASSERT_NEAR(part.position().x, whole.position().x, 2e-3);
        ASSERT_NEAR(part.position().y + 50, whole.position().y, 2e-3);
        ASSERT_NEAR(part.angular_velocity(), w, 2e-3);
        const Vec2 gap = part.world_point({0.5f, 0}) - scene.body(pair.b).world_point({-0.4f, -0.4f});
        ASSERT_LT(length(gap), 1e-4f);
    }
}

TEST(LawWeld, TwoBodiesTakeABlowAsOne)
{
    Scene scene(weightless());
    const WeldedPair pair = weld_and_whole(scene, {0, 50});
    BodyId balls[2];
    for (int i = 0; i < 2; ++i)
        balls[i] =
            add_dynamic(scene, {0.95, 50.0 * i + 2}, Circle{.radius = 0.2f}, {.friction = 0, .restitution = 0.5f}, {0, -6}).body;
    steps(scene, 20);
    EXPECT_NEAR(scene.body(balls[0]).velocity().y, scene.body(balls[1]).velocity().y, 1e-4);
    EXPECT_NEAR(scene.body(pair.a).angular_velocity(), scene.body(pair.whole).angular_velocity(), 1e-4);
    EXPECT_NEAR(scene.body(pair.b).angular_velocity(), scene.body(pair.whole).angular_velocity(), 1e-4);
    EXPECT_GT(std::fabs(scene.body(pair.whole).angular_velocity()), 1) << "the blow has turned it";
}

TEST(LawWeld, ARingOfWeldsStaysRound)
{
    constexpr int count = 12;
    const float half = std::tan(pi / count);
    Scene scene(sleepless());
    scene.create_shape(scene.create_body({.position = {0, -3}}), HalfSpace{});
    std::vector<BodyId> arcs;
    for (int i = 0; i < count; ++i)
    {
        const float t = 2 * pi * static_cast<float>(i) / count;
        arcs.push_back(scene.create_body({.type = BodyType::Dynamic,
                                          .position = {static_cast<double>(std::cos(t)), static_cast<double>(std::sin(t))},
                                          .angle = t + pi / 2}));
        scene.create_shape(arcs.back(), box(half, 0.05f));
    }
    for (int i = 0; i < count; ++i)
        scene.create_joint(WeldDef{.body_a = arcs[static_cast<std::size_t>(i)],
                                   .body_b = arcs[static_cast<std::size_t>((i + 1) % count)],
                                   .anchor_a = {half, 0},
                                   .anchor_b = {-half, 0},
                                   .reference_angle = 2 * pi / count});
    steps(scene, 300);
    for (int i = 0; i < count; ++i)
    {
        const Vec2 across = scene.body(arcs[static_cast<std::size_t>(i)]).position() -
                            scene.body(arcs[static_cast<std::size_t>((i + count / 2) % count)]).position();
        EXPECT_NEAR(length(across), 2, 1e-3);
    }
}

TEST(LawWeld, ItReadsBackWhatItWasMadeOf)
{
    Scene scene;
    const BodyId a = add_dynamic(scene, {0, 0}, box(0.5f, 0.1f)).body;
    const BodyId b = add_dynamic(scene, {1, 0}, box(0.5f, 0.1f)).body;
    const JointId id = scene.create_joint(WeldDef{
        .body_a = a, .body_b = b, .anchor_a = {0.5f, 0}, .anchor_b = {-0.5f, 0}, .reference_angle = 0.25f, .user_data = 7});
    const WeldDef def = std::get<WeldDef>(scene.joint(id).def());
    EXPECT_EQ(def.body_b, b);
    EXPECT_EQ(def.anchor_b, (Vec2{-0.5f, 0}));
    EXPECT_EQ(def.reference_angle, 0.25f);
    EXPECT_EQ(def.user_data, 7u);
    EXPECT_EQ(scene.joint(id).coordinate(), 0);
    EXPECT_EQ(scene.joint(id).speed(), 0);
    steps(scene, 30);
    EXPECT_NEAR(scene.body(b).angle() - scene.body(a).angle(), 0.25, 1e-4) << "it turns them to the angle that it holds";
}
