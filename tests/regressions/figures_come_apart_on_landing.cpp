// Symptom: a contact knew its own body alone, and the joints pushed on, turn after turn. A light foot under a heavy figure did not stop within the turns of a
// sub-step, the joints took that for a wall that holds what they pull, yielded, and the figure came apart by half a metre.

#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float half = 0.2f; // of a link

struct Landing
{
    int links = 2;
    float ratio = 1; // density of the last link over that of the first
    float speed = 1; // m/s, down
    float lean = 0;  // rad
    bool limited = false;
    float brake = 0; // N m, of every hinge
};

struct Harm
{
    float depth = 0;
    double gap = 0;
};

// For the link's upper end, or for its lower one where `end` is negative.
Position end_of(const Scene& scene, BodyId link, float end)
{
    const ConstBody body = scene.body(link);
    return body.world_point({0, end});
}

std::vector<BodyId> add_links(Scene& scene, const Landing& landing)
{
    scene.create_shape(scene.create_body({}), box(50, 1, {0, -1}), {});
    std::vector<BodyId> links;
    for (int i = 0; i < landing.links; ++i)
    {
        const float along = static_cast<float>(2 * i + 1) * half;
        links.push_back(scene.create_body({.type = BodyType::Dynamic,
                                           .position = {along * std::sin(landing.lean), 0.1f + along * std::cos(landing.lean)},
                                           .angle = -landing.lean,
                                           .velocity = {0, -landing.speed}}));
        const float share = static_cast<float>(i) / static_cast<float>(landing.links - 1);
        scene.create_shape(links.back(), box(0.08f, half), {.density = 1 + (landing.ratio - 1) * share});
        if (i > 0)
            scene.create_joint(RevoluteDef{.body_a = links[links.size() - 2],
                                           .body_b = links.back(),
                                           .anchor_a = {0, half},
                                           .anchor_b = {0, -half},
                                           .enable_limit = landing.limited,
                                           .lower_angle = -0.3f,
                                           .upper_angle = 0.3f,
                                           .enable_motor = landing.brake > 0,
                                           .max_motor_torque = landing.brake});
    }
    return links;
}

Harm harm_of(const Landing& landing)
{
    Scene scene{SceneDef{}};
    const std::vector<BodyId> links = add_links(scene, landing);
    Harm harm;
    for (int step = 0; step < 60; ++step)
    {
        EXPECT_TRUE(scene.step(1.0f / 60).quarantined.empty());
        for (const ContactInfo& contact : scene.contacts())
        {
            for (int i = 0; i < contact.point_count; ++i)
                harm.depth = std::max(harm.depth, -contact.points[i].separation);
        }
        for (std::size_t i = 1; i < links.size(); ++i)
        {
            const Vec2 apart = end_of(scene, links[i], -half) - end_of(scene, links[i - 1], half);
            harm.gap = std::max(harm.gap, static_cast<double>(length(apart)));
        }
    }
    return harm;
}

void expect_whole(int links, float speed)
{
    for (const float ratio : {1.0f, 3.0f, 10.0f})
    {
        for (const float lean : {0.0f, 0.1f, 0.8f})
        {
            for (const bool limited : {false, true})
            {
                SCOPED_TRACE(std::to_string(links) + " links, " + std::to_string(ratio) + " times as heavy, " +
                             std::to_string(speed) + " m/s, lean " + std::to_string(lean) + (limited ? ", limits" : ""));
                const Harm harm = harm_of({links, ratio, speed, lean, limited});
                EXPECT_LT(harm.gap, 0.01);
                EXPECT_LT(harm.depth, 0.03f);
            }
        }
    }
}

} // namespace

TEST(FiguresThatLand, TwoLinksStayTogether)
{
    for (const float speed : {3.0f, 10.0f, 30.0f})
        expect_whole(2, speed);
}

TEST(FiguresThatLand, FourLinksStayTogether)
{
    for (const float speed : {3.0f, 10.0f, 30.0f})
        expect_whole(4, speed);
}

TEST(FiguresThatLand, EightLinksStayTogether)
{
    for (const float speed : {3.0f, 10.0f})
        expect_whole(8, speed);
}

// A contact's impulse comes with what the joints answer, and a motor answers with no more than it can do.
TEST(FiguresThatLand, AWeakBrakeIsNoWeld)
{
    for (const int count : {2, 3})
    {
        for (const float speed : {1.0f, 3.0f, 5.0f})
        {
            SCOPED_TRACE(std::to_string(count) + " links, " + std::to_string(speed) + " m/s");
            Scene free{SceneDef{}};
            Scene braked{SceneDef{}};
            Landing landing{.links = count, .speed = speed, .lean = 0.8f};
            const std::vector<BodyId> in_free = add_links(free, landing);
            landing.brake = 1e-5f;
            const std::vector<BodyId> in_braked = add_links(braked, landing);
            for (int step = 0; step < 8; ++step)
            {
                (void)free.step(1.0f / 60);
                (void)braked.step(1.0f / 60);
            }
            for (std::size_t i = 0; i < in_free.size(); ++i)
                EXPECT_NEAR(braked.body(in_braked[i]).angular_velocity(), free.body(in_free[i]).angular_velocity(), 0.05f) << i;
        }
    }
}
