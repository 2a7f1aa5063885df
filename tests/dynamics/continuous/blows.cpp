// A blow goes through a crowd within the step that it comes in: of a hundred pairs that nearly touch none may be pressed far into each other.

#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/state/scene_data.h"
#include "support/test_scene.h"

#include <algorithm>
#include <vector>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

constexpr int boxes_in_row = 20;
constexpr int rows_of_boxes = 15;
constexpr double between_boxes = 0.015; // nearer than the 2 cm within which pairs get rows

// Walls one metre long; nothing moves them.
std::vector<BodyId> build_loose_grid(Scene& scene)
{
    std::vector<BodyId> boxes;
    for (int i = 0; i < boxes_in_row * rows_of_boxes; ++i)
    {
        const Position at{(1 + between_boxes) * (i % boxes_in_row), (1 + between_boxes) * (i / boxes_in_row)};
        boxes.push_back(add_dynamic(scene, at, box(0.5f, 0.5f), {.friction = 0.3f}).body);
    }
    return boxes;
}

float deepest_overlap(Scene& scene)
{
    const SceneState& state = scene.data().state;
    float least = 0;
    for (const std::int32_t contact : state.awake_contacts)
        least = std::min(least, least_separation(state.contacts[contact].manifold));
    return -least;
}

} // namespace

TEST(DynamicsBlows, GoThroughALooseCrowd)
{
    constexpr int first = boxes_in_row * (rows_of_boxes / 2);
    for (const float speed : {5.0f, 10.0f, 20.0f})
    {
        SCOPED_TRACE(speed);
        Scene scene(weightless());
        const std::vector<BodyId> boxes = build_loose_grid(scene);
        steps(scene, 3); // since then they are a crowd
        scene.body(boxes[first]).set_velocity({speed, 0});
        float deepest = 0;
        for (int i = 0; i < 120; ++i)
        {
            scene.step(1.0f / 60);
            deepest = std::max(deepest, deepest_overlap(scene));
        }
        EXPECT_LT(deepest, 0.01f) << "a hundredth of a box";
        EXPECT_GT(scene.body(boxes[first + boxes_in_row - 1]).velocity().x, 0.01f * speed)
            << "it does not come out at the other end";
    }
}
