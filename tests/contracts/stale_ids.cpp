// Null ids, ids of what was destroyed, and references to it.

#include "contracts/contract.h"

using namespace carom;
using namespace carom::test;

TEST_F(Contract, StaleAndNullBodies)
{
    for (const BodyId bad : {gone.body, BodyId{}, BodyId{9999, 1}, BodyId{ball.body.slot, ball.body.generation + 2}})
    {
        EXPECT_FALSE(scene.is_valid(bad));
        refused([&] { scene.destroy(bad); }, {"Scene::destroy", "body"});
        refused([&] { static_cast<void>(scene.body(bad)); }, {"Scene::body"});
        refused([&] { static_cast<void>(std::as_const(scene).body(bad)); }, {"Scene::body"});
        refused([&] { scene.create_shape(bad, Circle{}); }, {"Scene::create_shape", "body"});
        refused([&] { scene.ignore_pair(bad, ball.body); }, {"Scene::ignore_pair"});
        refused([&] { scene.ignore_pair(ball.body, bad); }, {"Scene::ignore_pair"});
        refused([&] { scene.restore_pair(ball.body, bad); }, {"Scene::restore_pair"});
        refused([&] { scene.set_force_law(bad, {}); }, {"Scene::set_force_law", "body"});
    }
}

TEST_F(Contract, StaleAndNullShapes)
{
    for (const ShapeId bad : {gone.shape, ShapeId{}, ShapeId{9999, 1}})
    {
        EXPECT_FALSE(scene.is_valid(bad));
        refused([&] { scene.destroy(bad); }, {"Scene::destroy", "shape"});
        refused([&] { static_cast<void>(scene.shape(bad)); }, {"Scene::shape"});
        refused([&] { scene.set_callbacks(bad, {}); }, {"Scene::set_callbacks"});
        refused([&] { static_cast<void>(scene.inside(bad)); }, {"Scene::inside"});
    }
    refused([&] { static_cast<void>(scene.inside(ball.shape)); }, {"Scene::inside"}); // not a trigger
}

TEST_F(Contract, StaleAndNullJoints)
{
    for (const JointId bad : {gone_joint, JointId{}, JointId{9999, 1}})
    {
        EXPECT_FALSE(scene.is_valid(bad));
        refused([&] { scene.destroy(bad); }, {"Scene::destroy", "joint"});
        refused([&] { static_cast<void>(scene.joint(bad)); }, {"Scene::joint"});
    }
}

// References are checked at every call, not only when they are made.
class StaleReference : public Contract
{
protected:
    Thing doomed = add_dynamic(scene, {5, 9}, Circle{});
    JointId tie = scene.create_joint(SpringDef{.body_a = doomed.body});
    Body body = scene.body(doomed.body);
    Shape shape = scene.shape(doomed.shape);
    Joint link = scene.joint(tie);

    void SetUp() override { scene.destroy(doomed.body); }

    template <class Call>
    void stale(const char* name, Call&& call)
    {
        refused(call, {name});
    }
};

TEST_F(StaleReference, ABodyTakesItsShapesAndJointsAlong)
{
    EXPECT_FALSE(scene.is_valid(tie));
    EXPECT_FALSE(scene.is_valid(doomed.shape));
}

TEST_F(StaleReference, ToABody)
{
    stale("Body::type", [&] { static_cast<void>(body.type()); });
    stale("Body::pose", [&] { static_cast<void>(body.pose()); });
    stale("Body::position", [&] { static_cast<void>(body.position()); });
    stale("Body::rotation", [&] { static_cast<void>(body.rotation()); });
    stale("Body::angle", [&] { static_cast<void>(body.angle()); });
    stale("Body::velocity", [&] { static_cast<void>(body.velocity()); });
    stale("Body::mass", [&] { static_cast<void>(body.mass()); });
    stale("Body::shapes", [&] { static_cast<void>(body.shapes()); });
    stale("Body::joints", [&] { static_cast<void>(body.joints()); });
    stale("Body::contacts", [&] { static_cast<void>(body.contacts()); });
    stale("Body::kinetic_energy", [&] { static_cast<void>(body.kinetic_energy()); });
    stale("Body::user_data", [&] { static_cast<void>(body.user_data()); });
    stale("Body::is_awake", [&] { static_cast<void>(body.is_awake()); });
    stale("Body::set_type", [&] { body.set_type(BodyType::Static); });
    stale("Body::teleport", [&] { body.teleport({}, 0); });
    stale("Body::set_velocity", [&] { body.set_velocity({}); });
    stale("Body::apply_force", [&] { body.apply_force({}); });
    stale("Body::apply_impulse", [&] { body.apply_impulse({}); });
    stale("Body::set_enabled", [&] { body.set_enabled(true); });
    stale("Body::set_awake", [&] { body.set_awake(true); });
    stale("Body::set_mass", [&] { body.set_mass({.mass = 1}); });
    stale("Body::reset_mass", [&] { body.reset_mass(); });
    stale("Body::set_user_data", [&] { body.set_user_data(1); });
    stale("Body::set_locks", [&] { body.set_locks({}); });
    stale("Body::set_can_sleep", [&] { body.set_can_sleep(true); });
    stale("Body::set_sleep_speed", [&] { body.set_sleep_speed(1); });
}

TEST_F(StaleReference, ToAShape)
{
    stale("Shape::body", [&] { static_cast<void>(shape.body()); });
    stale("Shape::geometry", [&] { static_cast<void>(shape.geometry()); });
    stale("Shape::def", [&] { static_cast<void>(shape.def()); });
    stale("Shape::bounds", [&] { static_cast<void>(shape.bounds()); });
    stale("Shape::contains", [&] { static_cast<void>(shape.contains({})); });
    stale("Shape::set_def", [&] { shape.set_def({}); });
    stale("Shape::set_geometry", [&] { shape.set_geometry(Circle{}); });
    stale("Shape::set_user_data", [&] { shape.set_user_data(1); });
}

TEST_F(StaleReference, ToAJoint)
{
    stale("Joint::def", [&] { static_cast<void>(link.def()); });
    stale("Joint::body_a", [&] { static_cast<void>(link.body_a()); });
    stale("Joint::anchor_a", [&] { static_cast<void>(link.anchor_a()); });
    stale("Joint::coordinate", [&] { static_cast<void>(link.coordinate()); });
    stale("Joint::speed", [&] { static_cast<void>(link.speed()); });
    stale("Joint::force", [&] { static_cast<void>(link.force()); });
    stale("Joint::torque", [&] { static_cast<void>(link.torque()); });
    stale("Joint::set_def", [&] { link.set_def(SpringDef{}); });
    stale("Joint::set_user_data", [&] { link.set_user_data(1); });
}
