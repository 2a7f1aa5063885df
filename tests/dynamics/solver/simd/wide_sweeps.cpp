// Bodies whose ways are found eight at a time go where they go one by one: with a force law anywhere each is asked by itself.

#include "dynamics/state/scene_data.h"
#include "support/test_scene.h"

#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

Geometry some_geometry(Random& random)
{
    switch (random.below(5))
    {
    case 0: return Circle{.center = random.vec(0.1), .radius = random.rangef(0.1, 0.3)};
    case 1: return Capsule{{-0.2f, 0}, {0.2f, 0.1f}, 0.15f, random.rangef(0.05, 0.15)};
    case 2: return Polygon{.vertices = {{-0.3f, -0.2f}, {0.3f, -0.2f}, {0, 0.3f}}, .radius = random.rangef(0, 0.1)};
    case 3: return Polygon{.vertices = {{-0.3f, -0.2f}, {0, -0.3f}, {0.3f, -0.2f}, {0.2f, 0.3f}, {-0.2f, 0.3f}}};
    default: return box(0.25f, 0.2f);
    }
}

Load no_load(void*, const BodyMotion&) { return {}; }

// After each step, what sweep found of each shape: box, shift, and any way beside it.
std::vector<std::vector<float>> paths(bool one_by_one)
{
    Scene scene;
    Random random(41);
    add_static(scene, HalfSpace{});
    const Thing far = add_dynamic(scene, {1000, 0.2}, Circle{.radius = 0.2f});
    if (one_by_one)
        scene.set_force_law(far.body, {.function = no_load});
    for (int i = 0; i < 150; ++i)
    {
        const Thing thing = add_dynamic(scene, {0.8 * (i % 15), 0.5 + 0.8 * (i / 15)}, some_geometry(random), {}, random.vec(3));
        Body body = scene.body(thing.body);
        body.set_angular_velocity(random.rangef(-5, 5));
        if (i % 4 == 0)
            scene.create_shape(thing.body, some_geometry(random));
        if (i % 40 == 39)
            body.set_type(BodyType::Kinematic);
    }
    std::vector<std::vector<float>> result;
    for (int i = 0; i < 90; ++i)
    {
        scene.step(1.0f / 60);
        std::vector<float>& numbers = result.emplace_back();
        const internal::SceneState& state = scene.data().state;
        for (int shape = 0; shape < state.shapes.capacity(); ++shape)
        {
            const internal::BoxPath& p = state.broad_phase.path(shape);
            numbers.insert(numbers.end(), {p.box.lx, p.box.ly, p.box.ux, p.box.uy, p.shift.x, p.shift.y, p.any_displacement});
        }
    }
    return result;
}

} // namespace

TEST(WideSweeps, LeadWhereOneByOneLeads) { EXPECT_TRUE(paths(false) == paths(true)); }
