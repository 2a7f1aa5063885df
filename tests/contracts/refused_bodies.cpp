// Bodies: what their definitions and verbs refuse.

#include "contracts/contract.h"

using namespace carom;
using namespace carom::test;

TEST_F(Contract, BodyDefinitions)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        body_refused({.position = {static_cast<double>(bad), 0}}, "position");
        body_refused({.position = {0, static_cast<double>(bad)}}, "position");
        body_refused({.angle = bad}, "angle");
        body_refused({.velocity = {bad, 0}}, "velocity");
        body_refused({.velocity = {0, bad}}, "velocity");
        body_refused({.angular_velocity = bad}, "angular_velocity");
        body_refused({.gravity_scale = bad}, "gravity_scale");
        body_refused({.linear_damping = bad}, "linear_damping");
        body_refused({.angular_damping = bad}, "angular_damping");
        body_refused({.sleep_speed = bad}, "sleep_speed");
    }
    body_refused({.linear_damping = -1}, "linear_damping");
    body_refused({.angular_damping = -1}, "angular_damping");
    body_refused({.sleep_speed = -1}, "sleep_speed");
}

TEST_F(Contract, BodyVerbsThatSet)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        verb_refused("Body::teleport", "position", [&](Body b) { b.teleport({static_cast<double>(bad), 0}, 0); });
        verb_refused("Body::teleport", "angle", [&](Body b) { b.teleport({}, bad); });
        verb_refused("Body::set_velocity", "velocity", [&](Body b) { b.set_velocity({bad, 0}); });
        verb_refused("Body::set_angular_velocity", "radians_per_second", [&](Body b) { b.set_angular_velocity(bad); });
        verb_refused("Body::set_gravity_scale", "scale", [&](Body b) { b.set_gravity_scale(bad); });
        verb_refused("Body::set_linear_damping", "damping", [&](Body b) { b.set_linear_damping(bad); });
        verb_refused("Body::set_angular_damping", "damping", [&](Body b) { b.set_angular_damping(bad); });
        verb_refused("Body::set_sleep_speed", "speed", [&](Body b) { b.set_sleep_speed(bad); });
        verb_refused("Body::set_mass", "mass", [&](Body b) { b.set_mass({.mass = bad, .inertia = 1}); });
        verb_refused("Body::set_mass", "center", [&](Body b) { b.set_mass({.mass = 1, .center = {bad, 0}, .inertia = 1}); });
        verb_refused("Body::set_mass", "inertia", [&](Body b) { b.set_mass({.mass = 1, .inertia = bad}); });
        refused([&] { scene.body(bar.body).set_target_pose({static_cast<double>(bad), 0}, 0); },
                {"Body::set_target_pose", "position"});
        refused([&] { scene.body(bar.body).set_target_pose({}, bad); }, {"Body::set_target_pose", "angle"});
    }
    refused([&] { scene.body(ball.body).set_mass({.mass = 0, .inertia = 1}); }, {"Body::set_mass", "mass"});
    refused([&] { scene.body(ball.body).set_mass({.mass = 1, .inertia = -1}); }, {"Body::set_mass", "inertia"});
    refused([&] { scene.body(fixed.body).set_mass({.mass = 1, .inertia = 1}); }, {"Body::set_mass"});
    refused([&] { scene.body(ball.body).set_target_pose({}, 0); }, {"Body::set_target_pose"});
    refused([&] { scene.body(fixed.body).set_target_pose({}, 0); }, {"Body::set_target_pose"});
    refused([&] { scene.body(ball.body).set_linear_damping(-1); }, {"Body::set_linear_damping", "damping", "-1"});
    refused([&] { scene.body(ball.body).set_angular_damping(-1); }, {"Body::set_angular_damping", "damping", "-1"});
    refused([&] { scene.body(ball.body).set_sleep_speed(-1); }, {"Body::set_sleep_speed", "speed", "-1"});
}

TEST_F(Contract, BodyVerbsThatPushOrAsk)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        verb_refused("Body::apply_force", "force", [&](Body b) { b.apply_force({bad, 0}); });
        verb_refused("Body::apply_force", "force", [&](Body b) { b.apply_force({bad, 0}, {}); });
        verb_refused("Body::apply_force", "world_point", [&](Body b) { b.apply_force({1, 0}, {static_cast<double>(bad), 0}); });
        verb_refused("Body::apply_torque", "torque", [&](Body b) { b.apply_torque(bad); });
        verb_refused("Body::apply_impulse", "impulse", [&](Body b) { b.apply_impulse({bad, 0}); });
        verb_refused("Body::apply_impulse", "impulse", [&](Body b) { b.apply_impulse({bad, 0}, {}); });
        verb_refused("Body::apply_impulse", "world_point",
                     [&](Body b) { b.apply_impulse({1, 0}, {0, static_cast<double>(bad)}); });
        verb_refused("Body::apply_angular_impulse", "impulse", [&](Body b) { b.apply_angular_impulse(bad); });
        verb_refused("Body::velocity_at", "world_point",
                     [&](Body b) { static_cast<void>(b.velocity_at({static_cast<double>(bad), 0})); });
        verb_refused("Body::interpolated_pose", "alpha", [&](Body b) { static_cast<void>(b.interpolated_pose(bad)); });
    }
}

TEST_F(Contract, BodiesWithMasslessShapesCannotBecomeDynamic)
{
    const Thing arc = add_static(scene, Arc{});
    refused([&] { scene.body(arc.body).set_type(BodyType::Dynamic); }, {"Body::set_type"});
    const Thing plane = add_static(scene, HalfSpace{});
    refused([&] { scene.body(plane.body).set_type(BodyType::Dynamic); }, {"Body::set_type"});
    refused([&] { scene.body(plane.body).set_type(BodyType::Kinematic); }, {"Body::set_type"});
    EXPECT_NO_THROW(scene.body(arc.body).set_type(BodyType::Kinematic));
}

TEST_F(Contract, ForceLaws)
{
    for (const float bad : {-1.0f, not_a_number, infinite})
    {
        refused([&] { scene.set_force_law(ball.body, {.greatest_force = bad}); }, {"Scene::set_force_law", "greatest_force"});
        refused([&] { scene.set_force_law(ball.body, {.greatest_torque = bad}); }, {"Scene::set_force_law", "greatest_torque"});
    }
}
