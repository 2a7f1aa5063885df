// Symptom: after a body was quarantined Joint::force() of its joints stayed NaN, the events of the step had NaN in their velocities, and a static body that it
// had struck got a velocity that was no number.

#include "regressions/numbers.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

bool finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

void expect_finite(const Scene& scene)
{
    for (const BodyId id : scene.bodies())
    {
        EXPECT_TRUE(finite(scene.body(id).velocity()));
        EXPECT_TRUE(std::isfinite(scene.body(id).position().x) && std::isfinite(scene.body(id).position().y));
    }
    for (const JointId id : scene.joints())
    {
        EXPECT_TRUE(finite(scene.joint(id).force()));
        EXPECT_TRUE(std::isfinite(scene.joint(id).torque()));
    }
    for (const ImpactEvent& e : scene.impacts())
    {
        EXPECT_TRUE(finite(e.velocity_a) && finite(e.velocity_b) && finite(e.velocity_after_a) && finite(e.velocity_after_b));
        EXPECT_TRUE(std::isfinite(e.impulse) && std::isfinite(e.energy_lost) && std::isfinite(e.approach_speed));
    }
    for (const ContactBeginEvent& e : scene.contact_begins())
        EXPECT_TRUE(finite(e.normal) && std::isfinite(e.point.x) && std::isfinite(e.point.y));
}

// A law that gives no valid force makes its body unsound.
Load no_force(void*, const BodyMotion&) { return {{std::nanf(""), 0}, 0}; }

struct Wreck
{
    std::string name;
    void (*make)(Scene&, BodyId body);
};

std::vector<Wreck> wrecks()
{
    return {
        {"a law", [](Scene& s, BodyId body) { s.set_force_law(body, {.function = no_force, .greatest_force = 1}); }},
        {"a speed", [](Scene& s, BodyId body) { s.body(body).set_velocity({3e38f, 3e38f}); }},
        {"a force", [](Scene& s, BodyId body) { s.body(body).apply_force({3e38f, 0}); }},
        {"a blow", [](Scene& s, BodyId body) { s.body(body).apply_impulse({0, -1e38f}); }},
    };
}

} // namespace

// In a pile on the floor, in a chain, and alone.
TEST(Quarantine, TakesForcesAndEventsAlong)
{
    for (const Wreck& wreck : wrecks())
    {
        for (const int bodies : {1, 4, 40})
        {
            for (const bool jointed : {false, true})
            {
                SCOPED_TRACE(wreck.name + ", " + std::to_string(bodies) + " bodies" + (jointed ? ", jointed" : ""));
                Scene scene(SceneDef{});
                scene.create_shape(scene.create_body({}), box(50, 0.5f, {0, -0.5f}), {});
                std::vector<BodyId> made;
                for (int i = 0; i < bodies; ++i)
                {
                    made.push_back(
                        scene.create_body({.type = BodyType::Dynamic, .position = {0.45 * (i % 8), 0.3 + 0.5 * (i / 8)}}));
                    scene.create_shape(made.back(), i % 2 == 0 ? Geometry{Circle{.radius = 0.25f}} : Geometry{box(0.2f, 0.25f)},
                                       {});
                    if (jointed)
                        scene.create_joint(RevoluteDef{.body_a = i == 0 ? BodyId{} : made[static_cast<std::size_t>(i - 1)],
                                                       .body_b = made.back(),
                                                       .anchor_a = i == 0 ? Vec2{-0.2f, 0.3f} : Vec2{0.2f, 0},
                                                       .anchor_b = {-0.2f, 0}});
                }
                std::map<std::pair<std::uint32_t, std::uint32_t>, int> open;
                for (int i = 0; i < 40; ++i)
                {
                    if (i == 20)
                        wreck.make(scene, made[made.size() / 2]);
                    scene.step(dt);
                    expect_finite(scene);
                    for (const ContactBeginEvent& e : scene.contact_begins())
                        ++open[{e.shape_a.slot, e.shape_b.slot}];
                    for (const ContactEndEvent& e : scene.contact_ends())
                        --open[{e.shape_a.slot, e.shape_b.slot}];
                    for (const auto& [pair, times] : open)
                        EXPECT_TRUE(times == 0 || times == 1) << "in step " << i;
                    if (HasFailure())
                        return;
                }
            }
        }
    }
}
