// The colors that bodies list are those of their contacts, whatever a user does between steps.

#include "dynamics/state/coloring.h"
#include "dynamics/state/scene_data.h"
#include "support/test_scene.h"

#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

void expect_colors_of_contacts(const SceneState& state, int& colored)
{
    for (int body = 0; body < state.bodies.capacity(); ++body)
    {
        if (!state.bodies.is_live(body))
            continue;
        std::uint64_t colors = 0;
        for (int edge = state.bodies[body].first_contact; edge != none && is_moving_dynamic(state, body);
             edge = state.contacts[edge >> 1].next[edge & 1])
        {
            const int color = state.contacts[edge >> 1].color;
            if (color == none || color == color_limit)
                continue;
            ASSERT_EQ(colors >> color & 1u, 0u) << "body " << body << " has color " << color << " twice";
            colors |= std::uint64_t{1} << color;
            ++colored;
        }
        ASSERT_EQ(state.colors[static_cast<std::size_t>(body)], colors) << "body " << body;
    }
}

void disturb(Scene& scene, BodyId& body, int what)
{
    switch (what)
    {
    case 0: scene.body(body).set_awake(false); break;
    case 1: scene.body(body).set_enabled(!scene.body(body).is_enabled()); break;
    case 2:
        scene.body(body).set_type(scene.body(body).type() == BodyType::Dynamic ? BodyType::Kinematic : BodyType::Dynamic);
        break;
    case 3: scene.body(body).teleport({0, 8}, 0.3f); break;
    case 4: scene.body(body).set_velocity({2, 6}); break;
    default: scene.destroy(body); body = add_dynamic(scene, {0.5, 7}, box(0.25f, 0.2f)).body;
    }
}

} // namespace

TEST(DynamicsContactColors, AreThoseThatTheirContactsHave)
{
    Scene scene;
    Random random(11);
    add_static(scene, Chain{.start = {-4, 0}, .pieces = {{.end = {4, 0}}, {.end = {4, 9}}, {.end = {-4, 9}}}, .closed = true});
    std::vector<BodyId> bodies;
    for (int i = 0; i < 300; ++i)
        bodies.push_back(add_dynamic(scene, {random.range(-3.5, 3.5), random.range(0.5, 8)},
                                     i % 3 == 0 ? Geometry{Circle{.radius = 0.2f}} : Geometry{box(0.2f, 0.15f)})
                             .body);
    int colored = 0;
    int fewest_awake = 1000;
    for (int i = 0; i < 600; ++i)
    {
        SCOPED_TRACE("step " + std::to_string(i));
        scene.step(1.0f / 60);
        expect_colors_of_contacts(scene.data().state, colored);
        if (HasFatalFailure())
            return;
        fewest_awake = std::min(fewest_awake, scene.report().awake_bodies);
        if (i % 40 < 6) // between times it may come to rest
            disturb(scene, bodies[static_cast<std::size_t>(random.range(0, 300))], i % 40);
    }
    EXPECT_GT(colored, 100000);
    EXPECT_LT(fewest_awake, 250) << "some have slept";
}
