// Bad input is refused in every build with one sentence that names the function, the field and the value; the scene is unchanged.

#include "contracts/contract.h"

using namespace carom;
using namespace carom::test;

namespace {

void scene_refused(const SceneDef& def, const char* field)
{
    try
    {
        const Scene scene(def);
        ADD_FAILURE() << "not refused: " << field;
    }
    catch (const Error& error)
    {
        EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
}

} // namespace

TEST(ContractScene, EveryFieldOfItsDefinition)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        scene_refused({.gravity = {bad, 0}}, "gravity");
        scene_refused({.gravity = {0, bad}}, "gravity");
        scene_refused({.length_scale = bad}, "length_scale");
        scene_refused({.fixed_step = bad}, "fixed_step");
        scene_refused({.max_frame_time = bad}, "max_frame_time");
        scene_refused({.contact_hertz = bad}, "contact_hertz");
        scene_refused({.contact_damping_ratio = bad}, "contact_damping_ratio");
        scene_refused({.contact_push_speed = bad}, "contact_push_speed");
    }
    scene_refused({.length_scale = 0}, "length_scale");
    scene_refused({.length_scale = -1}, "length_scale");
    scene_refused({.substeps = 0}, "substeps");
    scene_refused({.substeps = 65}, "substeps");
    scene_refused({.most_subdivisions = 0}, "most_subdivisions");
    scene_refused({.most_subdivisions = 65}, "most_subdivisions");
    scene_refused({.most_passes = 0}, "most_passes");
    scene_refused({.most_passes = 17}, "most_passes");
    scene_refused({.fixed_step = 0}, "fixed_step");
    scene_refused({.contact_hertz = 0}, "contact_hertz");
    scene_refused({.contact_push_speed = -1}, "contact_push_speed");
    scene_refused({.friction_rule = MixRule::Function}, "mix_function");
    scene_refused({.restitution_rule = MixRule::Function}, "mix_function");
    scene_refused({.tasks = {.worker_count = 0}}, "worker_count");
    scene_refused({.tasks = {.worker_count = 65}}, "worker_count");
}

TEST_F(Contract, StepAndUpdate)
{
    for (const float bad : {not_a_number, infinite, -infinite, -1.0f, 0.0f})
        refused([&] { scene.step(bad); }, {"Scene::step", "h"});
    for (const float bad : {not_a_number, infinite, -infinite, -1.0f})
        refused([&] { scene.update(bad); }, {"Scene::update", "frame_time"});
    EXPECT_NO_THROW(scene.update(0));
    refused([&] { scene.set_gravity({not_a_number, 0}); }, {"Scene::set_gravity", "gravity", "nan"});
}

TEST_F(Contract, TheSentenceNamesFunctionFieldAndValue)
{
    refused([&] { scene.step(-0.25f); }, {"Scene::step", "h", "-0.25"});
    refused([&] { scene.create_shape(ball.body, Circle{.radius = -3.5f}); }, {"Scene::create_shape", "Circle.radius", "-3.5"});
    refused([&] { scene.create_shape(ball.body, Circle{}, {.friction = -0.75f}); }, {"Scene::create_shape", "friction", "-0.75"});
    refused([&] { scene.body(ball.body).set_linear_damping(-2); }, {"Body::set_linear_damping", "damping", "-2"});
}

// A stale id never names a later object in the same slot.
TEST_F(Contract, SlotsAreReusedIdsAreNot)
{
    std::vector<BodyId> old;
    for (int i = 0; i < 200; ++i)
    {
        const Thing t = add_dynamic(scene, {9, 9}, Circle{});
        for (const BodyId id : old)
            ASSERT_NE(id, t.body);
        old.push_back(t.body);
        scene.destroy(t.body);
    }
    for (const BodyId id : old)
        EXPECT_FALSE(scene.is_valid(id));
}

TEST_F(Contract, Queries)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        const Position p{static_cast<double>(bad), 0};
        refused([&] { static_cast<void>(scene.raycast_closest(p, {1, 0})); }, {"Scene::raycast_closest", "origin"});
        refused([&] { static_cast<void>(scene.raycast_closest({}, {bad, 0})); }, {"Scene::raycast_closest", "translation"});
        refused([&] { static_cast<void>(scene.raycast_all(p, {1, 0})); }, {"Scene::raycast_all", "origin"});
        refused([&] { static_cast<void>(scene.raycast_any({}, {0, bad})); }, {"Scene::raycast_any", "translation"});
        refused([&] { static_cast<void>(scene.shapecast_closest(Circle{}, {.start = {p, {}}})); },
                {"Scene::shapecast_closest", "way.start.position"});
        refused([&] { static_cast<void>(scene.shapecast_all(Circle{}, {.translation = {bad, 0}})); },
                {"Scene::shapecast_all", "way.translation"});
        refused([&] { static_cast<void>(scene.shapecast_any(Circle{}, {.turn = bad})); }, {"Scene::shapecast_any", "way.turn"});
        refused([&] { static_cast<void>(scene.overlap_point(p)); }, {"Scene::overlap_point", "point"});
        refused([&] { static_cast<void>(scene.overlap_box({p, {1, 1}})); }, {"Scene::overlap_box", "box"});
        refused([&] { static_cast<void>(scene.overlap_shape(Circle{}, {p, {}})); }, {"Scene::overlap_shape", "pose"});
        refused([&] { static_cast<void>(scene.closest_point(p, 1)); }, {"Scene::closest_point", "point"});
        refused([&] { static_cast<void>(scene.shape(ball.shape).contains(p)); }, {"Shape::contains", "point"});
    }
    refused([&] { static_cast<void>(scene.shapecast_any(Circle{}, {.turn = 7})); }, {"Scene::shapecast_any", "way.turn", "7"});
    refused([&] { static_cast<void>(scene.shapecast_any(HalfSpace{}, {})); }, {"Scene::shapecast_any", "geometry"});
    refused([&] { static_cast<void>(scene.shapecast_any(Circle{.radius = -1}, {})); }, {"Scene::shapecast_any", "radius"});
    refused([&] { static_cast<void>(scene.overlap_box({{1, 1}, {0, 0}})); }, {"Scene::overlap_box", "box"});
    refused([&] { static_cast<void>(scene.closest_point({}, not_a_number)); }, {"Scene::closest_point", "max_distance"});
    refused([&] { static_cast<void>(scene.closest_point({}, -1)); }, {"Scene::closest_point", "max_distance"});
}
