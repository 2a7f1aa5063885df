#include "view/body_story.h"

#include "view/words.h"

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
    const std::string vertical = say(force.y > 0 ? "up" : "down");
    const std::string sideways = say(force.x > 0 ? "right" : "left");
    if (across < 0.25f * upright)
        return vertical;
    if (upright < 0.25f * across)
        return sideways;
    return say("and", {{"first", vertical}, {"second", sideways}});
}

void tell_push(std::vector<StoryLine>& story, const Scene& scene, const Push& push)
{
    story.push_back(
        {Kind::Text, say("push", {{"name", push.by}, {"direction", direction(push.force)}, {"force", number(push.normal)}})});
    if (push.along < 1e-3f * push.normal)
        return;
    const bool is_limit_known = scene.def().friction_rule == MixRule::GeometricMean;
    story.push_back({Kind::Formula, say(is_limit_known ? "rubs at most" : "rubs", {{"force", number(push.along)},
                                                                                   {"mu", number(push.mu)},
                                                                                   {"normal", number(push.normal)},
                                                                                   {"most", number(push.mu * push.normal)}})});
}

void tell_state(std::vector<StoryLine>& story, const ConstBody& body)
{
    switch (body.type())
    {
    case BodyType::Static: story.push_back({Kind::Text, say("static")}); return;
    case BodyType::Kinematic:
        story.push_back({Kind::Text, say("kinematic", {{"speed", number(length(body.velocity()))}})});
        return;
    case BodyType::Dynamic: break;
    }
    story.push_back(
        {Kind::Formula, say("mass and speed", {{"mass", number(body.mass())}, {"speed", number(length(body.velocity()))}})});
    if (!body.is_enabled())
        story.push_back({Kind::Text, say("disabled")});
    else if (!body.is_awake())
        story.push_back({Kind::Text, say("sleeps")});
}

void tell_sum(std::vector<StoryLine>& story, const ConstBody& body, Vec2 sum, float weight)
{
    const float size = length(sum);
    const bool rests = size <= 0.03f * std::max(weight, 1e-6f);
    const bool stands = length(body.velocity()) < 0.02f;
    if (rests && stands)
        story.push_back({Kind::Result, say("cancel and stays")});
    else if (rests)
        story.push_back({Kind::Result, say("cancel and goes on")});
    else
        story.push_back(
            {Kind::Result,
             say("together", {{"force", number(size)}, {"direction", direction(sum)}, {"change", number(size / body.mass())}})});
    if (!rests && stands)
        story.push_back({Kind::Text, say("hardly moves")});
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
        story.push_back({Kind::Text, say("trigger", {{"who", who.empty() ? say("nobody") : who}})});
        const Field field = scene.shape(shape).def().field;
        if (field != Field{})
            story.push_back({Kind::Text, say("field", {{"acceleration", number(length(field.acceleration))},
                                                       {"force", number(length(field.force))},
                                                       {"drag", number(field.drag)}})});
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
        story.push_back({Kind::Text, say(length > def.length ? "spring stretched" : "spring pressed")});
        story.push_back({Kind::Formula, say("spring law")});
        story.push_back({Kind::Formula, number(def.stiffness) + "·(" + number(def.length) + " − " + number(length) + ") − " +
                                            number(def.damping) + "·" + signed_number(joint.speed()) + " ≈ " + number(force) +
                                            " N"});
    }
    void operator()(const DistanceDef& def) const
    {
        const bool rod = def.min_length == def.max_length;
        const bool taut = joint.coordinate() >= def.max_length * 0.999f;
        story.push_back({Kind::Text, say(rod    ? "rod"
                                         : taut ? "rope taut"
                                                : "rope slack",
                                         {{"most", number(def.max_length)}, {"length", number(joint.coordinate())}})});
        story.push_back({Kind::Formula, say("pulls", {{"force", number(length(joint.force()))}})});
    }
    void operator()(const RevoluteDef& def) const
    {
        story.push_back({Kind::Text, say("hinge", {{"angle", number(joint.coordinate())}, {"speed", number(joint.speed())}})});
        if (def.enable_limit)
            story.push_back(
                {Kind::Text, say("hinge limits", {{"low", number(def.lower_angle)}, {"high", number(def.upper_angle)}})});
        if (def.enable_motor)
            story.push_back(
                {Kind::Text, say("hinge motor", {{"speed", number(def.motor_speed)}, {"torque", number(def.max_motor_torque)}})});
        story.push_back(
            {Kind::Formula, say("hinge bears", {{"force", number(length(joint.force()))}, {"torque", number(joint.torque())}})});
    }
    void operator()(const PrismaticDef& def) const
    {
        story.push_back({Kind::Text, say("slider", {{"way", number(joint.coordinate())}, {"speed", number(joint.speed())}})});
        if (def.enable_limit)
            story.push_back({Kind::Text, say("slider limits",
                                             {{"low", number(def.lower_translation)}, {"high", number(def.upper_translation)}})});
        if (def.enable_motor)
            story.push_back(
                {Kind::Text, say("slider motor", {{"speed", number(def.motor_speed)}, {"force", number(def.max_motor_force)}})});
        story.push_back({Kind::Formula, say("slider bears", {{"force", number(length(joint.force()))}})});
    }

    void operator()(const WeldDef&) const
    {
        story.push_back({Kind::Text, say("weld")});
        story.push_back(
            {Kind::Formula, say("weld bears", {{"force", number(length(joint.force()))}, {"torque", number(joint.torque())}})});
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
    story.push_back({Kind::Title, shapes.empty() ? say("no shapes") : namer(scene, shapes.front())});
    tell_state(story, body);
    tell_triggers(story, scene, body, namer);
    if (body.type() != BodyType::Dynamic || !body.is_enabled())
        return story;

    story.push_back({Kind::Step, say("who pushes")});
    const Vec2 gravity = body.mass() * body.gravity_scale() * scene.gravity();
    Vec2 sum = gravity;
    if (gravity != Vec2{})
        story.push_back({Kind::Formula, say("weight", {{"mass", number(body.mass())},
                                                       {"g", number(length(body.gravity_scale() * scene.gravity()))},
                                                       {"weight", number(length(gravity))},
                                                       {"direction", direction(gravity)}})});
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
