// A shot as a program of its own, for whoever looks for its cause.

#include "property/trial.h"

namespace carom::shots {

namespace {

std::string number(float x)
{
    std::ostringstream out;
    out.precision(9);
    out << x;
    const bool whole = out.str().find_first_of(".e") == std::string::npos;
    return out.str() + (whole ? ".0f" : "f");
}

std::string text(Vec2 v) { return "{" + number(v.x) + ", " + number(v.y) + "}"; }
std::string text(Position p)
{
    std::ostringstream out;
    out.precision(17);
    out << "{" << p.x << ", " << p.y << "}";
    return out.str();
}
std::string text(Sides s) { return s == Sides::Both ? "Sides::Both" : s == Sides::Left ? "Sides::Left" : "Sides::Right"; }
std::string text(bool b) { return b ? "true" : "false"; }

struct GeometryText
{
    std::string operator()(const Circle& c) const { return "Circle{" + text(c.center) + ", " + number(c.radius) + "}"; }
    std::string operator()(const Polygon& p) const
    {
        std::string out = "Polygon{{";
        for (const Vec2 v : p.vertices)
            out += text(v) + ", ";
        return out + "}, " + number(p.radius) + "}";
    }
    std::string operator()(const Capsule& c) const
    {
        return "Capsule{" + text(c.a) + ", " + text(c.b) + ", " + number(c.radius_a) + ", " + number(c.radius_b) + "}";
    }
    std::string operator()(const Segment& s) const
    {
        return "Segment{" + text(s.a) + ", " + text(s.b) + ", " + number(s.half_thickness) + ", " + text(s.sides) + "}";
    }
    std::string operator()(const Arc& a) const
    {
        return "Arc{" + text(a.center) + ", " + number(a.radius) + ", " + number(a.start_angle) + ", " + number(a.sweep) + ", " +
               number(a.half_thickness) + ", " + text(a.sides) + "}";
    }
    std::string operator()(const Chain& c) const
    {
        std::string out = "Chain{" + text(c.start) + ", {";
        for (const ChainPiece& piece : c.pieces)
            out += "{" + text(piece.end) + ", " + number(piece.sweep) + "}, ";
        return out + "}, " + text(c.closed) + ", " + number(c.half_thickness) + ", " + text(c.sides) + "}";
    }
    std::string operator()(const HalfSpace& h) const { return "HalfSpace{" + text(h.normal) + ", " + number(h.offset) + "}"; }
};

std::string name(BodyId id) { return id.is_null() ? "BodyId{}" : "b" + std::to_string(id.slot); }

template <class Def>
std::string ends(const Def& d)
{
    return ".body_a = " + name(d.body_a) + ", .body_b = " + name(d.body_b) + ", .anchor_a = " + text(d.anchor_a) +
           ", .anchor_b = " + text(d.anchor_b);
}

struct JointText
{
    std::string operator()(const SpringDef& d) const
    {
        return "SpringDef{" + ends(d) + ", .stiffness = " + number(d.stiffness) + ", .length = " + number(d.length) + "}";
    }
    std::string operator()(const DistanceDef& d) const
    {
        return "DistanceDef{" + ends(d) + ", .min_length = " + number(d.min_length) + ", .max_length = " + number(d.max_length) +
               "}";
    }
    std::string operator()(const RevoluteDef& d) const
    {
        return "RevoluteDef{" + ends(d) + ", .reference_angle = " + number(d.reference_angle) +
               ", .enable_limit = " + text(d.enable_limit) + ", .lower_angle = " + number(d.lower_angle) +
               ", .upper_angle = " + number(d.upper_angle) + ", .limit_restitution = " + number(d.limit_restitution) + "}";
    }
    std::string operator()(const PrismaticDef& d) const
    {
        return "PrismaticDef{" + ends(d) + ", .axis_a = " + text(d.axis_a) + "}";
    }
    std::string operator()(const WeldDef& d) const
    {
        return "WeldDef{" + ends(d) + ", .reference_angle = " + number(d.reference_angle) + "}";
    }
};

void print_shape(std::ostream& out, BodyId body, const ConstShape& shape)
{
    const ShapeDef d = shape.def();
    out << "    scene.create_shape(" << name(body) << ", " << std::visit(GeometryText{}, shape.geometry())
        << ", {.density = " << number(d.density) << ", .friction = " << number(d.friction)
        << ", .restitution = " << number(d.restitution) << ", .filter = {" << d.filter.category << "u, " << d.filter.mask
        << "u}, .trigger = " << text(d.trigger) << "});\n";
}

void print_body(std::ostream& out, const Scene& scene, BodyId id)
{
    const ConstBody body = scene.body(id);
    const MotionLocks locks = body.locks();
    const char* types[] = {"Static", "Kinematic", "Dynamic"};
    out << "    const BodyId " << name(id) << " = scene.create_body({.type = BodyType::" << types[static_cast<int>(body.type())]
        << ", .position = " << text(body.position()) << ", .angle = " << number(body.angle())
        << ", .velocity = " << text(body.velocity()) << ", .angular_velocity = " << number(body.angular_velocity())
        << ", .locks = {" << text(locks.linear_x) << ", " << text(locks.linear_y) << ", " << text(locks.angular)
        << "}, .can_sleep = " << text(body.can_sleep()) << ", .sleep_speed = " << number(body.sleep_speed()) << "});\n";
    for (const ShapeId shape : body.shapes())
        print_shape(out, id, scene.shape(shape));
    if (locks.linear_x) // a bat: its mass was given
        out << "    scene.body(" << name(id) << ").set_mass({" << number(body.mass()) << ", {}, " << number(body.inertia())
            << "});\n";
}

} // namespace

void Trial::print_program(std::ostream& out)
{
    const SceneDef& def = m_scene->def();
    out << "#include \"carom/carom.h\"\n#include <cstdio>\nusing namespace carom;\nint main()\n{\n"
        << "    Scene scene({.gravity = " << text(def.gravity) << ", .length_scale = " << number(def.length_scale)
        << ", .sleeping = " << text(def.sleeping) << "});\n";
    for (const BodyId id : m_scene->bodies())
        print_body(out, *m_scene, id);
    for (const JointId id : m_scene->joints())
        out << "    scene.create_joint(" << std::visit(JointText{}, m_scene->joint(id).def()) << ");\n";
    out << "    for (int i = 1; i <= " << steps << "; ++i)\n    {\n";
    for (const auto& [body, torque] : m_torques)
        out << "        scene.body(" << name(body) << ").apply_torque(" << number(torque) << ");\n";
    out << "        scene.step(" << number(dt) << ");\n";
    for (const BodyId id : m_scene->bodies())
        if (m_scene->body(id).type() == BodyType::Dynamic)
            out << "        std::printf(\"%d body " << id.slot << ": %g %g  v %g %g\\n\", i, scene.body(" << name(id)
                << ").position().x, scene.body(" << name(id) << ").position().y, scene.body(" << name(id)
                << ").velocity().x, scene.body(" << name(id) << ").velocity().y);\n";
    out << "    }\n}\n";
}

} // namespace carom::shots
