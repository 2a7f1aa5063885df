// Bad input is refused in every build with one sentence that names the function, the field and the value; the scene is unchanged.

#include "support/test_scene.h"

#include <functional>
#include <limits>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

// A scene with one of everything, and one of everything destroyed.
class Contract : public ::testing::Test
{
protected:
    Scene scene{SceneDef{}};
    Thing fixed = add_static(scene, box(10, 0.5f));
    Thing ball = add_dynamic(scene, {0, 3}, Circle{});
    Thing crate = add_dynamic(scene, {2, 3}, box(0.5f, 0.5f));
    Thing bar = add(scene, {.type = BodyType::Kinematic, .position = {-4, 5}}, Capsule{});
    Thing zone = add_static(scene, box(1, 1, {0, 8}), {.trigger = true});
    JointId joint = scene.create_joint(SpringDef{.body_a = ball.body, .body_b = crate.body, .stiffness = 10});
    JointId hinge = scene.create_joint(RevoluteDef{.body_b = crate.body, .anchor_a = {2, 3}});
    Thing gone = make_gone();
    JointId gone_joint = make_gone_joint();

    Thing make_gone()
    {
        const Thing t = add_dynamic(scene, {9, 9}, Circle{});
        scene.destroy(t.body);
        return t;
    }
    JointId make_gone_joint()
    {
        const JointId id = scene.create_joint(SpringDef{.body_a = ball.body, .body_b = crate.body});
        scene.destroy(id);
        return id;
    }

    // Refused with a sentence that has each of the words; nothing changed.
    template <class Call>
    void refused(Call&& call, std::initializer_list<const char*> words)
    {
        const std::uint64_t before = scene.state_hash();
        const std::size_t bodies = scene.bodies().size();
        const std::size_t joints = scene.joints().size();
        try
        {
            call();
            ADD_FAILURE() << "not refused: " << *words.begin() << ", " << *(words.end() - 1);
        }
        catch (const Error& error)
        {
            const std::string sentence = error.what();
            for (const char* word : words)
                EXPECT_NE(sentence.find(word), std::string::npos) << "no '" << word << "' in: " << sentence;
            EXPECT_EQ(sentence.find('\n'), std::string::npos) << "one sentence: " << sentence;
        }
        EXPECT_EQ(scene.state_hash(), before) << *words.begin() << ", " << *(words.end() - 1);
        EXPECT_EQ(scene.bodies().size(), bodies);
        EXPECT_EQ(scene.joints().size(), joints);
    }

    void body_refused(const BodyDef& def, const char* field)
    {
        refused([&] { static_cast<void>(scene.create_body(def)); }, {"Scene::create_body", field});
    }
    void geometry_refused(const Geometry& geometry, const char* field, BodyId body)
    {
        refused([&] { scene.create_shape(body, geometry); }, {"Scene::create_shape", field});
    }
    void geometry_refused(const Geometry& geometry, const char* field)
    {
        geometry_refused(geometry, field, ball.body);
        refused([&] { scene.shape(ball.shape).set_geometry(geometry); }, {"Shape::set_geometry", field});
        refused([&] { static_cast<void>(scene.overlap_shape(geometry, {})); }, {"Scene::overlap_shape", field});
    }
    void def_refused(const ShapeDef& def, const char* field)
    {
        refused([&] { scene.create_shape(ball.body, Circle{}, def); }, {"Scene::create_shape", field});
        refused([&] { scene.shape(ball.shape).set_def(def); }, {"Shape::set_def", field});
    }
    template <class Def>
    void joint_refused(const Def& def, const char* field)
    {
        refused([&] { scene.create_joint(def); }, {"Scene::create_joint", field});
    }
};

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
    }
    body_refused({.linear_damping = -1}, "linear_damping");
    body_refused({.angular_damping = -1}, "angular_damping");
}

TEST_F(Contract, Geometries)
{
    for (const float bad : {not_a_number, infinite, -infinite, 0.0f, -1.0f})
    {
        geometry_refused(Circle{.radius = bad}, "radius");
        geometry_refused(Capsule{.radius_a = bad}, "radius_a");
        geometry_refused(Capsule{.radius_b = bad}, "radius_b");
        geometry_refused(Arc{.radius = bad}, "radius", fixed.body);
    }
    for (const float bad : {not_a_number, infinite, -infinite, -1.0f})
    {
        geometry_refused(Segment{.half_thickness = bad}, "half_thickness");
        geometry_refused(Arc{.half_thickness = bad}, "half_thickness", fixed.body);
        geometry_refused(Chain{.pieces = {{.end = {1, 0}}}, .half_thickness = bad}, "half_thickness", fixed.body);
        Polygon round = box(1, 1);
        round.radius = bad;
        geometry_refused(round, "radius");
    }
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        geometry_refused(Circle{.center = {bad, 0}}, "center");
        geometry_refused(Circle{.center = {0, bad}}, "center");
        geometry_refused(Capsule{.a = {bad, 0}}, "Capsule.a");
        geometry_refused(Capsule{.b = {0, bad}}, "Capsule.b");
        geometry_refused(Segment{.a = {bad, 0}}, "Segment.a");
        geometry_refused(Segment{.b = {bad, 0}}, "Segment.b");
        geometry_refused(Polygon{{{0, 0}, {1, 0}, {bad, 1}}}, "vertices");
        geometry_refused(Arc{.center = {bad, 0}}, "center", fixed.body);
        geometry_refused(Arc{.start_angle = bad}, "start_angle", fixed.body);
        geometry_refused(Arc{.sweep = bad}, "sweep", fixed.body);
        geometry_refused(HalfSpace{.normal = {bad, 1}}, "normal", fixed.body);
        geometry_refused(HalfSpace{.offset = bad}, "offset", fixed.body);
        geometry_refused(Chain{.start = {bad, 0}, .pieces = {{.end = {1, 0}}}}, "start", fixed.body);
        geometry_refused(Chain{.pieces = {{.end = {bad, 0}}}}, "end", fixed.body);
        geometry_refused(Chain{.pieces = {{.end = {1, 0}, .sweep = bad}}}, "sweep", fixed.body);
    }
    geometry_refused(Polygon{}, "vertices");
    geometry_refused(Polygon{{{0, 0}, {1, 0}}}, "vertices");
    geometry_refused(Polygon{{{0, 0}, {1, 0}, {2, 0}}}, "vertices");
    geometry_refused(Polygon{{{0, 0}, {1, 0}, {1, 0}, {0, 0}}}, "vertices");
    geometry_refused(Polygon{{{0, 0}, {2, 0}, {1, 0.5f}, {1, 2}}}, "vertices"); // concave
    geometry_refused(Polygon{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, "vertices");    // crosses itself
    geometry_refused(Polygon{{{0, 1}, {0.5878f, -0.809f}, {-0.951f, 0.309f}, {0.951f, 0.309f}, {-0.5878f, -0.809f}}},
                     "vertices"); // a pentagram turns twice
    geometry_refused(Segment{{1, 1}, {1, 1}}, "Segment.b");
    geometry_refused(Capsule{.a = {1, 1}, .b = {1, 1}}, "Capsule.b");
    geometry_refused(Capsule{.a = {0, 0}, .b = {0.1f, 0}, .radius_a = 1, .radius_b = 0.2f}, "Capsule.b");
    geometry_refused(HalfSpace{.normal = {0, 0}}, "normal", fixed.body);
    geometry_refused(Arc{.sweep = 0}, "sweep", fixed.body);
    geometry_refused(Arc{.sweep = 7}, "sweep", fixed.body);
    geometry_refused(Arc{.sweep = -7}, "sweep", fixed.body);
    geometry_refused(Arc{.radius = 1, .half_thickness = 1}, "half_thickness", fixed.body);
    geometry_refused(Chain{}, "pieces", fixed.body);
    geometry_refused(Chain{.pieces = {{.end = {0, 0}}}}, "end", fixed.body);
    geometry_refused(Chain{.pieces = {{.end = {1, 0}, .sweep = 2 * pi}}}, "sweep", fixed.body);
    // No mass: not for what moves freely.
    geometry_refused(Arc{}, "", ball.body);
    geometry_refused(Chain{.pieces = {{.end = {1, 0}}}}, "", ball.body);
    geometry_refused(HalfSpace{}, "", ball.body);
    geometry_refused(HalfSpace{}, "", bar.body);
}

TEST_F(Contract, BoxHelper)
{
    for (const float bad : {not_a_number, infinite, 0.0f, -1.0f})
    {
        refused([&] { static_cast<void>(box(bad, 1)); }, {"box", "half_width"});
        refused([&] { static_cast<void>(box(1, bad)); }, {"box", "half_height"});
    }
    refused([&] { static_cast<void>(box(1, 1, {not_a_number, 0})); }, {"box", "center"});
    refused([&] { static_cast<void>(box(1, 1, {}, infinite)); }, {"box", "angle"});
    refused([&] { static_cast<void>(box(1, 1, {}, 0, -1)); }, {"box", "radius"});
}

TEST_F(Contract, ShapeDefinitions)
{
    for (const float bad : {not_a_number, infinite, -infinite, -1.0f})
    {
        def_refused({.density = bad}, "density");
        def_refused({.friction = bad}, "friction");
        def_refused({.restitution = bad}, "restitution");
        def_refused({.rolling_resistance = bad}, "rolling_resistance");
        def_refused({.kick = {.speed = bad}}, "Kick::speed");
        def_refused({.kick = {.threshold = bad}}, "Kick::threshold");
        def_refused({.kick = {.cooldown = bad}}, "Kick::cooldown");
        def_refused({.trigger = true, .field = {.drag = bad}}, "Field::drag");
    }
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        def_refused({.surface_speed = bad}, "surface_speed");
        def_refused({.one_way = {bad, 0}}, "one_way");
        def_refused({.trigger = true, .field = {.force = {bad, 0}}}, "Field::force");
        def_refused({.trigger = true, .field = {.acceleration = {0, bad}}}, "Field::acceleration");
    }
    def_refused({.restitution = 1.5f}, "restitution");
    RestitutionCurve curve;
    curve.count = 9;
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
    curve.count = 2;
    curve.points[0] = {5, 0.5f};
    curve.points[1] = {1, 0.5f};
    def_refused({.restitution_curve = curve}, "RestitutionCurve"); // descending
    curve.points[1] = {6, 1.5f};
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
    curve.points[1] = {6, not_a_number};
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
    curve.points[0] = {-1, 0.5f};
    curve.points[1] = {6, 0.5f};
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
    curve.points[0] = {not_a_number, 0.5f};
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
}

TEST_F(Contract, BodyVerbs)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        const Body body = scene.body(ball.body);
        const auto verb = [&](const char* name, const char* field, auto&& call)
        { refused([&] { call(scene.body(ball.body)); }, {name, field}); };
        verb("Body::teleport", "position", [&](Body b) { b.teleport({static_cast<double>(bad), 0}, 0); });
        verb("Body::teleport", "angle", [&](Body b) { b.teleport({}, bad); });
        verb("Body::set_velocity", "velocity", [&](Body b) { b.set_velocity({bad, 0}); });
        verb("Body::set_angular_velocity", "radians_per_second", [&](Body b) { b.set_angular_velocity(bad); });
        verb("Body::apply_force", "force", [&](Body b) { b.apply_force({bad, 0}); });
        verb("Body::apply_force", "force", [&](Body b) { b.apply_force({bad, 0}, {}); });
        verb("Body::apply_force", "world_point", [&](Body b) { b.apply_force({1, 0}, {static_cast<double>(bad), 0}); });
        verb("Body::apply_torque", "torque", [&](Body b) { b.apply_torque(bad); });
        verb("Body::apply_impulse", "impulse", [&](Body b) { b.apply_impulse({bad, 0}); });
        verb("Body::apply_impulse", "impulse", [&](Body b) { b.apply_impulse({bad, 0}, {}); });
        verb("Body::apply_impulse", "world_point", [&](Body b) { b.apply_impulse({1, 0}, {0, static_cast<double>(bad)}); });
        verb("Body::apply_angular_impulse", "impulse", [&](Body b) { b.apply_angular_impulse(bad); });
        verb("Body::set_gravity_scale", "scale", [&](Body b) { b.set_gravity_scale(bad); });
        verb("Body::set_linear_damping", "damping", [&](Body b) { b.set_linear_damping(bad); });
        verb("Body::set_angular_damping", "damping", [&](Body b) { b.set_angular_damping(bad); });
        verb("Body::set_mass", "mass", [&](Body b) { b.set_mass({.mass = bad, .inertia = 1}); });
        verb("Body::set_mass", "center", [&](Body b) { b.set_mass({.mass = 1, .center = {bad, 0}, .inertia = 1}); });
        verb("Body::set_mass", "inertia", [&](Body b) { b.set_mass({.mass = 1, .inertia = bad}); });
        verb("Body::velocity_at", "world_point",
             [&](Body b) { static_cast<void>(b.velocity_at({static_cast<double>(bad), 0})); });
        verb("Body::interpolated_pose", "alpha", [&](Body b) { static_cast<void>(b.interpolated_pose(bad)); });
        refused([&] { scene.body(bar.body).set_target_pose({static_cast<double>(bad), 0}, 0); },
                {"Body::set_target_pose", "position"});
        refused([&] { scene.body(bar.body).set_target_pose({}, bad); }, {"Body::set_target_pose", "angle"});
        static_cast<void>(body);
    }
    refused([&] { scene.body(ball.body).set_mass({.mass = 0, .inertia = 1}); }, {"Body::set_mass", "mass"});
    refused([&] { scene.body(ball.body).set_mass({.mass = 1, .inertia = -1}); }, {"Body::set_mass", "inertia"});
    refused([&] { scene.body(fixed.body).set_mass({.mass = 1, .inertia = 1}); }, {"Body::set_mass"});
    refused([&] { scene.body(ball.body).set_target_pose({}, 0); }, {"Body::set_target_pose"});
    refused([&] { scene.body(fixed.body).set_target_pose({}, 0); }, {"Body::set_target_pose"});
    refused([&] { scene.body(ball.body).set_linear_damping(-1); }, {"Body::set_linear_damping", "damping", "-1"});
    refused([&] { scene.body(ball.body).set_angular_damping(-1); }, {"Body::set_angular_damping", "damping", "-1"});
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

TEST_F(Contract, Joints)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        joint_refused(SpringDef{.body_a = ball.body, .anchor_a = {bad, 0}}, "anchor_a");
        joint_refused(SpringDef{.body_a = ball.body, .anchor_b = {bad, 0}}, "anchor_b");
        joint_refused(SpringDef{.body_a = ball.body, .length = bad}, "length");
        joint_refused(DistanceDef{.body_a = ball.body, .min_length = bad}, "min_length");
        joint_refused(DistanceDef{.body_a = ball.body, .max_length = bad}, "max_length");
        joint_refused(RevoluteDef{.body_a = ball.body, .reference_angle = bad}, "reference_angle");
        joint_refused(RevoluteDef{.body_a = ball.body, .lower_angle = bad}, "lower_angle");
        joint_refused(RevoluteDef{.body_a = ball.body, .upper_angle = bad}, "upper_angle");
        joint_refused(RevoluteDef{.body_a = ball.body, .motor_speed = bad}, "motor_speed");
        joint_refused(RevoluteDef{.body_a = ball.body, .spring_angle = bad}, "spring_angle");
        joint_refused(PrismaticDef{.body_a = ball.body, .axis_a = {bad, 0}}, "axis_a");
        joint_refused(PrismaticDef{.body_a = ball.body, .reference_angle = bad}, "reference_angle");
        joint_refused(PrismaticDef{.body_a = ball.body, .lower_translation = bad}, "lower_translation");
        joint_refused(PrismaticDef{.body_a = ball.body, .upper_translation = bad}, "upper_translation");
        joint_refused(PrismaticDef{.body_a = ball.body, .motor_speed = bad}, "motor_speed");
        joint_refused(PrismaticDef{.body_a = ball.body, .spring_translation = bad}, "spring_translation");
    }
    for (const float bad : {not_a_number, infinite, -infinite, -1.0f})
    {
        joint_refused(SpringDef{.body_a = ball.body, .stiffness = bad}, "stiffness");
        joint_refused(SpringDef{.body_a = ball.body, .damping = bad}, "damping");
        joint_refused(DistanceDef{.body_a = ball.body, .hertz = bad}, "hertz");
        joint_refused(DistanceDef{.body_a = ball.body, .damping_ratio = bad}, "damping_ratio");
        joint_refused(RevoluteDef{.body_a = ball.body, .limit_restitution = bad}, "limit_restitution");
        joint_refused(RevoluteDef{.body_a = ball.body, .max_motor_torque = bad}, "max_motor_torque");
        joint_refused(RevoluteDef{.body_a = ball.body, .spring_hertz = bad}, "spring_hertz");
        joint_refused(RevoluteDef{.body_a = ball.body, .spring_damping_ratio = bad}, "spring_damping_ratio");
        joint_refused(PrismaticDef{.body_a = ball.body, .limit_restitution = bad}, "limit_restitution");
        joint_refused(PrismaticDef{.body_a = ball.body, .max_motor_force = bad}, "max_motor_force");
        joint_refused(PrismaticDef{.body_a = ball.body, .spring_hertz = bad}, "spring_hertz");
        joint_refused(PrismaticDef{.body_a = ball.body, .spring_damping_ratio = bad}, "spring_damping_ratio");
    }
    joint_refused(DistanceDef{.body_a = ball.body, .min_length = 3, .max_length = 2}, "max_length");
    joint_refused(RevoluteDef{.body_a = ball.body, .enable_limit = true, .lower_angle = 1, .upper_angle = 0}, "_angle");
    joint_refused(PrismaticDef{.body_a = ball.body, .enable_limit = true, .lower_translation = 1, .upper_translation = 0},
                  "_translation");
    joint_refused(PrismaticDef{.body_a = ball.body, .axis_a = {0, 0}}, "axis_a");
    joint_refused(RevoluteDef{.body_a = ball.body, .limit_restitution = 1.5f}, "limit_restitution");
    joint_refused(SpringDef{}, "body");                                         // the world and the world
    joint_refused(SpringDef{.body_a = ball.body, .body_b = ball.body}, "body"); // a body with itself
    joint_refused(SpringDef{.body_a = gone.body}, "body_a");
    joint_refused(RevoluteDef{.body_a = ball.body, .body_b = gone.body}, "body_b");
    // Another kind, other bodies.
    refused([&] { scene.joint(joint).set_def(RevoluteDef{.body_a = ball.body, .body_b = crate.body}); }, {"Joint::set_def"});
    refused([&] { scene.joint(joint).set_def(SpringDef{.body_a = ball.body}); }, {"Joint::set_def"});
    refused([&] { scene.joint(joint).set_def(SpringDef{.body_a = ball.body, .body_b = crate.body, .stiffness = -1}); },
            {"Joint::set_def", "stiffness"});
}

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

TEST_F(Contract, ForceLaws)
{
    for (const float bad : {-1.0f, not_a_number, infinite})
    {
        refused([&] { scene.set_force_law(ball.body, {.greatest_force = bad}); }, {"Scene::set_force_law", "greatest_force"});
        refused([&] { scene.set_force_law(ball.body, {.greatest_torque = bad}); }, {"Scene::set_force_law", "greatest_torque"});
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
TEST_F(Contract, ReferencesToWhatWasDestroyed)
{
    const Thing doomed = add_dynamic(scene, {5, 9}, Circle{});
    const JointId tie = scene.create_joint(SpringDef{.body_a = doomed.body});
    Body body = scene.body(doomed.body);
    Shape shape = scene.shape(doomed.shape);
    Joint link = scene.joint(tie);
    scene.destroy(doomed.body);
    EXPECT_FALSE(scene.is_valid(tie)) << "a body takes its joints along";
    EXPECT_FALSE(scene.is_valid(doomed.shape));
    const auto body_refused = [&](const char* name, auto&& call) { refused(call, {name}); };
    body_refused("Body::type", [&] { static_cast<void>(body.type()); });
    body_refused("Body::pose", [&] { static_cast<void>(body.pose()); });
    body_refused("Body::position", [&] { static_cast<void>(body.position()); });
    body_refused("Body::rotation", [&] { static_cast<void>(body.rotation()); });
    body_refused("Body::angle", [&] { static_cast<void>(body.angle()); });
    body_refused("Body::velocity", [&] { static_cast<void>(body.velocity()); });
    body_refused("Body::mass", [&] { static_cast<void>(body.mass()); });
    body_refused("Body::shapes", [&] { static_cast<void>(body.shapes()); });
    body_refused("Body::joints", [&] { static_cast<void>(body.joints()); });
    body_refused("Body::contacts", [&] { static_cast<void>(body.contacts()); });
    body_refused("Body::kinetic_energy", [&] { static_cast<void>(body.kinetic_energy()); });
    body_refused("Body::user_data", [&] { static_cast<void>(body.user_data()); });
    body_refused("Body::is_awake", [&] { static_cast<void>(body.is_awake()); });
    body_refused("Body::set_type", [&] { body.set_type(BodyType::Static); });
    body_refused("Body::teleport", [&] { body.teleport({}, 0); });
    body_refused("Body::set_velocity", [&] { body.set_velocity({}); });
    body_refused("Body::apply_force", [&] { body.apply_force({}); });
    body_refused("Body::apply_impulse", [&] { body.apply_impulse({}); });
    body_refused("Body::set_enabled", [&] { body.set_enabled(true); });
    body_refused("Body::set_awake", [&] { body.set_awake(true); });
    body_refused("Body::set_mass", [&] { body.set_mass({.mass = 1}); });
    body_refused("Body::reset_mass", [&] { body.reset_mass(); });
    body_refused("Body::set_user_data", [&] { body.set_user_data(1); });
    body_refused("Body::set_locks", [&] { body.set_locks({}); });
    body_refused("Body::set_can_sleep", [&] { body.set_can_sleep(true); });
    body_refused("Shape::body", [&] { static_cast<void>(shape.body()); });
    body_refused("Shape::geometry", [&] { static_cast<void>(shape.geometry()); });
    body_refused("Shape::def", [&] { static_cast<void>(shape.def()); });
    body_refused("Shape::bounds", [&] { static_cast<void>(shape.bounds()); });
    body_refused("Shape::contains", [&] { static_cast<void>(shape.contains({})); });
    body_refused("Shape::set_def", [&] { shape.set_def({}); });
    body_refused("Shape::set_geometry", [&] { shape.set_geometry(Circle{}); });
    body_refused("Shape::set_user_data", [&] { shape.set_user_data(1); });
    body_refused("Joint::def", [&] { static_cast<void>(link.def()); });
    body_refused("Joint::body_a", [&] { static_cast<void>(link.body_a()); });
    body_refused("Joint::anchor_a", [&] { static_cast<void>(link.anchor_a()); });
    body_refused("Joint::coordinate", [&] { static_cast<void>(link.coordinate()); });
    body_refused("Joint::speed", [&] { static_cast<void>(link.speed()); });
    body_refused("Joint::force", [&] { static_cast<void>(link.force()); });
    body_refused("Joint::torque", [&] { static_cast<void>(link.torque()); });
    body_refused("Joint::set_def", [&] { link.set_def(SpringDef{}); });
    body_refused("Joint::set_user_data", [&] { link.set_user_data(1); });
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
        refused([&] { static_cast<void>(scene.overlap_point(p)); }, {"Scene::overlap_point", "point"});
        refused([&] { static_cast<void>(scene.overlap_box({p, {1, 1}})); }, {"Scene::overlap_box", "box"});
        refused([&] { static_cast<void>(scene.overlap_shape(Circle{}, {p, {}})); }, {"Scene::overlap_shape", "pose"});
        refused([&] { static_cast<void>(scene.closest_point(p, 1)); }, {"Scene::closest_point", "point"});
        refused([&] { static_cast<void>(scene.shape(ball.shape).contains(p)); }, {"Shape::contains", "point"});
    }
    refused([&] { static_cast<void>(scene.overlap_box({{1, 1}, {0, 0}})); }, {"Scene::overlap_box", "box"});
    refused([&] { static_cast<void>(scene.closest_point({}, not_a_number)); }, {"Scene::closest_point", "max_distance"});
    refused([&] { static_cast<void>(scene.closest_point({}, -1)); }, {"Scene::closest_point", "max_distance"});
}

TEST_F(Contract, SplitConcave)
{
    refused([&] { static_cast<void>(split_concave(std::vector<Vec2>{})); }, {"split_concave", "outline"});
    refused([&] { static_cast<void>(split_concave(std::vector<Vec2>{{0, 0}, {1, 0}})); }, {"split_concave", "outline"});
    refused([&] { static_cast<void>(split_concave(std::vector<Vec2>{{0, 0}, {1, 1}, {1, 0}, {0, 1}})); },
            {"split_concave", "outline"});
    refused([&] { static_cast<void>(split_concave(std::vector<Vec2>{{0, 0}, {1, not_a_number}, {1, 0}})); },
            {"split_concave", "outline"});
}

// --- quarantine --------------------------------------------------------------------------------------------------------------------------

TEST(ContractQuarantine, HugeForcesAndNeighboursInContact)
{
    for (const Geometry& geometry : {Geometry{box(0.5f, 0.5f)}, Geometry{Circle{}}})
    {
        Scene scene(sleepless());
        add_static(scene, HalfSpace{});
        const Thing low = add_dynamic(scene, {0, 0.5}, geometry);
        const Thing high = add_dynamic(scene, {0, 1.5}, geometry);
        const Thing aside = add_dynamic(scene, {9, 0.5}, geometry);
        steps(scene, 30);
        for (int i = 0; i < 4; ++i)
        {
            scene.body(high.body).apply_force({0, -3e38f});
            scene.body(high.body).apply_torque(3e38f);
            scene.step(1.0f / 60);
        }
        steps(scene, 30);
        for (const Thing& t : {low, high, aside})
        {
            const Position p = scene.body(t.body).position();
            EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
            EXPECT_TRUE(std::isfinite(scene.body(t.body).velocity().y));
        }
        EXPECT_TRUE(scene.body(aside.body).is_enabled());
        EXPECT_NEAR(scene.body(aside.body).position().y, 0.5, 0.02);
        // The scene can still be asked and stepped.
        EXPECT_NO_THROW(static_cast<void>(scene.overlap_point({9, 0.5})));
    }
}

TEST(ContractQuarantine, FarAwayIsNotNonFinite)
{
    Scene scene(sleepless());
    const Thing fast = add_dynamic(scene, {0, 0}, Circle{}, {}, {1e18f, 0});
    for (int i = 0; i < 60; ++i)
        EXPECT_NO_THROW(scene.step(1.0f / 60));
    EXPECT_TRUE(std::isfinite(scene.body(fast.body).position().x));
}
