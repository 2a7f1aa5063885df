#include "view/body_story.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace carom::view {
namespace {

using Kind = StoryLine::Kind;

struct Push
{
    std::string by;
    Vec2 force{};     ///< N, on the body
    float normal = 0; ///< N
    float along = 0;  ///< N: friction
    float mu = 0;
};

ShapeId own_shape(const Scene& scene, BodyId body, const ContactInfo& contact)
{
    return scene.shape(contact.shape_a).body() == body ? contact.shape_a : contact.shape_b;
}

// The contacts of the last step, each with its mean force.
std::vector<Push> pushes_on(const Scene& scene, BodyId body, float h, const ShapeNamer& namer)
{
    std::vector<Push> pushes;
    for (const ContactInfo& contact : scene.body(body).contacts())
    {
        const bool is_a = own_shape(scene, body, contact) == contact.shape_a;
        Push push;
        float sum = 0;
        float friction = 0;
        for (int i = 0; i < contact.point_count; ++i)
        {
            sum += contact.points[i].normal_impulse;
            friction += contact.points[i].friction_impulse;
        }
        if (!contact.touching || (sum <= 0 && friction == 0))
            continue;
        const Vec2 impulse = sum * contact.normal + friction * perp(contact.normal);
        push.by = namer(scene, is_a ? contact.shape_b : contact.shape_a);
        push.force = (is_a ? -1.0f : 1.0f) * (1 / h) * impulse;
        push.normal = sum / h;
        push.along = std::abs(friction) / h;
        push.mu = std::sqrt(scene.shape(contact.shape_a).def().friction * scene.shape(contact.shape_b).def().friction);
        pushes.push_back(std::move(push));
    }
    return pushes;
}

std::string direction(Vec2 force)
{
    const float across = std::abs(force.x);
    const float upright = std::abs(force.y);
    const std::string vertical = force.y > 0 ? "up" : "down";
    const std::string sideways = force.x > 0 ? "right" : "left";
    if (across < 0.25f * upright)
        return vertical;
    if (upright < 0.25f * across)
        return "to the " + sideways;
    return vertical + " and to the " + sideways;
}

void tell_push(std::vector<StoryLine>& story, const Scene& scene, const Push& push)
{
    story.push_back({Kind::Text, push.by + " pushes " + direction(push.force) + " with " + number(push.normal) + " N"});
    if (push.along < 1e-3f * push.normal)
        return;
    std::string line = "friction: " + number(push.along) + " N";
    if (scene.def().friction_rule == MixRule::GeometricMean)
        line += " of at most μ·N = " + number(push.mu) + "·" + number(push.normal) + " = " + number(push.mu * push.normal) + " N";
    story.push_back({Kind::Formula, line});
}

void tell_state(std::vector<StoryLine>& story, const ConstBody& body)
{
    switch (body.type())
    {
    case BodyType::Static: story.push_back({Kind::Text, "It is static: it never moves, whoever pushes it."}); return;
    case BodyType::Kinematic:
        story.push_back({Kind::Text, "It is kinematic: it moves as it is told, at " + number(length(body.velocity())) +
                                         " m/s, and cannot be pushed."});
        return;
    case BodyType::Dynamic: break;
    }
    story.push_back({Kind::Formula, "m = " + number(body.mass()) + " kg, speed = " + number(length(body.velocity())) + " m/s"});
    if (!body.is_enabled())
        story.push_back({Kind::Text, "It is disabled: it takes part in nothing."});
    else if (!body.is_awake())
        story.push_back(
            {Kind::Text,
             "It sleeps: it has stayed in its place for half a second and is left out of the calculation until something "
             "touches or pushes it. What pushed it when it fell asleep pushes it still:"});
}

void tell_sum(std::vector<StoryLine>& story, const ConstBody& body, Vec2 sum, float weight)
{
    const float size = length(sum);
    const bool rests = size <= 0.03f * std::max(weight, 1e-6f);
    const bool stands = length(body.velocity()) < 0.02f;
    if (rests && stands)
        story.push_back({Kind::Result, "All of them cancel out: it stays where it is."});
    else if (rests)
        story.push_back({Kind::Result, "All of them cancel out: it goes on evenly."});
    else
        story.push_back({Kind::Result, "Together " + number(size) + " N " + direction(sum) +
                                           "; by themselves they would change its velocity by F/m = " +
                                           number(size / body.mass()) + " m/s in each second"});
    if (!rests && stands)
        story.push_back({Kind::Text, "And yet it hardly moves: a lock, a damper, or a force that is not in this list."});
}

void tell_triggers(std::vector<StoryLine>& story, const Scene& scene, const ConstBody& body, const ShapeNamer& namer)
{
    for (const ShapeId shape : body.shapes())
    {
        if (!scene.shape(shape).is_trigger())
            continue;
        const std::vector<ShapeId> inside = scene.inside(shape);
        std::string who;
        for (const ShapeId visitor : inside)
            who += (who.empty() ? "" : ", ") + namer(scene, visitor);
        story.push_back(
            {Kind::Text, "A trigger: it stops nobody and reports who is inside. Now: " + (who.empty() ? "nobody" : who)});
        const Field field = scene.shape(shape).def().field;
        if (field != Field{})
            story.push_back({Kind::Text, "A field acts on what is inside: acceleration " + number(length(field.acceleration)) +
                                             " m/s², force " + number(length(field.force)) + " N, drag " + number(field.drag) +
                                             " /s"});
    }
}

struct JointTeller
{
    const ConstJoint& joint;
    std::vector<StoryLine>& story;

    void operator()(const SpringDef& def) const
    {
        const float length = joint.coordinate();
        const float force = def.stiffness * (def.length - length) - def.damping * joint.speed();
        story.push_back({Kind::Text, std::string("A spring ") + (length > def.length ? "that is stretched" : "that is pressed")});
        story.push_back({Kind::Formula, "F = k·(rest − length) − c·v"});
        story.push_back({Kind::Formula, number(def.stiffness) + "·(" + number(def.length) + " − " + number(length) + ") − " +
                                            number(def.damping) + "·" + signed_number(joint.speed()) + " ≈ " + number(force) +
                                            " N"});
    }
    void operator()(const DistanceDef& def) const
    {
        const bool rod = def.min_length == def.max_length;
        const bool taut = joint.coordinate() >= def.max_length * 0.999f;
        story.push_back({Kind::Text, (rod ? "A rod of " : "A rope of at most ") + number(def.max_length) + " m, now " +
                                         number(joint.coordinate()) +
                                         (rod    ? " m"
                                          : taut ? " m: taut"
                                                 : " m: slack, it does not pull")});
        story.push_back({Kind::Formula, "it pulls with " + number(length(joint.force())) + " N"});
    }
    void operator()(const RevoluteDef& def) const
    {
        story.push_back(
            {Kind::Text, "A hinge, turned by " + number(joint.coordinate()) + " rad at " + number(joint.speed()) + " rad/s"});
        if (def.enable_limit)
            story.push_back({Kind::Text, "limits: " + number(def.lower_angle) + " to " + number(def.upper_angle) + " rad"});
        if (def.enable_motor)
            story.push_back({Kind::Text, "a motor wants " + number(def.motor_speed) + " rad/s and may use " +
                                             number(def.max_motor_torque) + " N·m"});
        story.push_back(
            {Kind::Formula, "it bears " + number(length(joint.force())) + " N, torque " + number(joint.torque()) + " N·m"});
    }
    void operator()(const PrismaticDef& def) const
    {
        story.push_back(
            {Kind::Text, "A slider, moved by " + number(joint.coordinate()) + " m at " + number(joint.speed()) + " m/s"});
        if (def.enable_limit)
            story.push_back(
                {Kind::Text, "limits: " + number(def.lower_translation) + " to " + number(def.upper_translation) + " m"});
        if (def.enable_motor)
            story.push_back({Kind::Text, "a motor wants " + number(def.motor_speed) + " m/s and may use " +
                                             number(def.max_motor_force) + " N"});
        story.push_back({Kind::Formula, "it bears " + number(length(joint.force())) + " N"});
    }

    static std::string signed_number(float value) { return value < 0 ? "(" + number(value) + ")" : number(value); }
};

} // namespace

std::vector<StoryLine> joint_story(const Scene& scene, JointId id)
{
    std::vector<StoryLine> story;
    const ConstJoint joint = scene.joint(id);
    std::visit(JointTeller{joint, story}, joint.def());
    return story;
}

std::vector<StoryLine> body_story(const Scene& scene, BodyId id, float h, const ShapeNamer& namer)
{
    std::vector<StoryLine> story;
    const ConstBody body = scene.body(id);
    const std::vector<ShapeId> shapes = body.shapes();
    story.push_back({Kind::Title, shapes.empty() ? "a body without shapes" : namer(scene, shapes.front())});
    tell_state(story, body);
    tell_triggers(story, scene, body, namer);
    if (body.type() != BodyType::Dynamic || !body.is_enabled())
        return story;

    story.push_back({Kind::Step, "Who pushes it?"});
    const Vec2 gravity = body.mass() * body.gravity_scale() * scene.gravity();
    Vec2 sum = gravity;
    if (gravity != Vec2{})
        story.push_back({Kind::Formula, "weight: m·g = " + number(body.mass()) + "·" +
                                            number(length(body.gravity_scale() * scene.gravity())) + " = " +
                                            number(length(gravity)) + " N " + direction(gravity)});
    for (const Push& push : pushes_on(scene, id, h, namer))
    {
        tell_push(story, scene, push);
        sum += push.force;
    }
    const std::vector<JointId> joints = body.joints();
    for (const JointId joint : joints)
    {
        const ConstJoint j = scene.joint(joint);
        sum += (j.body_b() == id ? 1.0f : -1.0f) * j.force();
        const std::vector<StoryLine> of_joint = joint_story(scene, joint);
        story.insert(story.end(), of_joint.begin(), of_joint.end());
    }
    tell_sum(story, body, sum, length(gravity));
    return story;
}

} // namespace carom::view
