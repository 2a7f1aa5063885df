#include "pinball/table/load_header.h"

#include "pinball/table/load_elements.h"

#include <array>

namespace carom::pinball {
namespace {

constexpr int newest_version = 1;
constexpr std::size_t max_curve_points = std::tuple_size_v<decltype(RestitutionCurve::points)>;

/// e0 / (1 + f v) at these speeds (m/s); the curve between them is off by less than 0.01 for the falloffs in use.
constexpr std::array<float, max_curve_points> falloff_speeds = {0, 0.25f, 0.5f, 1, 1.75f, 3, 5, 8};

RestitutionCurve falloff_curve(float restitution, float falloff)
{
    RestitutionCurve curve;
    for (const float speed : falloff_speeds)
        curve.points[curve.count++] = {speed, restitution / (1 + falloff * speed)};
    return curve;
}

bool is_curve_point(const JsonNode& node)
{
    return node.kind == JsonNode::Kind::Array && node.items.size() == 2 && node.items[0].kind == JsonNode::Kind::Number &&
           node.items[1].kind == JsonNode::Kind::Number && node.items[0].number >= 0 && node.items[0].number <= 100 &&
           node.items[1].number >= 0 && node.items[1].number <= 1;
}

RestitutionCurve read_curve(FieldReader& in, const JsonNode& list)
{
    RestitutionCurve curve;
    if (list.items.size() < 2 || list.items.size() > max_curve_points)
    {
        in.fail(list, "curve", "must have 2 to " + std::to_string(max_curve_points) + " points");
        return curve;
    }
    for (std::size_t i = 0; i < list.items.size(); ++i)
    {
        const JsonNode& node = list.items[i];
        const std::string place = "curve[" + std::to_string(i) + "]";
        if (!is_curve_point(node))
        {
            in.fail(node, place, "must be [speed, restitution] with a speed of 0 to 100 m/s and a restitution of 0 to 1");
            continue;
        }
        const float speed = static_cast<float>(node.items[0].number);
        if (curve.count > 0 && speed <= curve.points[curve.count - 1].speed)
            in.fail(node, place, "speeds must ascend");
        curve.points[curve.count++] = {speed, static_cast<float>(node.items[1].number)};
    }
    return curve;
}

Material read_material(FieldReader& in, std::string name)
{
    Material material{.name = std::move(name), .friction = in.number("friction", {0, 2, ""})};
    if (const JsonNode* curve = in.member("curve", JsonNode::Kind::Array, false))
    {
        if (in.has("restitution") || in.has("falloff_per_mps"))
            in.fail("curve", "takes the place of restitution and falloff_per_mps: give one or the other");
        material.curve = read_curve(in, *curve);
        material.restitution = material.curve.points[0].restitution;
        return material;
    }
    material.restitution = in.number("restitution", range::share);
    const float falloff = in.number("falloff_per_mps", {0, 5, "per m/s"}, 0);
    if (falloff > 0)
        material.curve = falloff_curve(material.restitution, falloff);
    return material;
}

BallDef read_ball(FieldReader in, const NameIndex& materials)
{
    const BallDef ball{.radius = in.number("radius", {0.005, 0.05, "m"}),
                       .mass = in.number("mass", {0.01, 1, "kg"}),
                       .spawn = in.vec2("spawn", range::coordinate),
                       .material = in.reference("material", materials, "material")};
    in.refuse_unknown_keys();
    return ball;
}

Physics read_physics(FieldReader in)
{
    const Physics physics{.g = in.number("g", {0, 30, "m/s²"}, 9.81f),
                          .slope = in.degrees("slope_deg", {0, 45, "degrees"}),
                          .step = in.number("step", {0.0001, 0.01, "s"}, 0.001f),
                          .mu_playfield = in.number("mu_playfield", {0, 2, ""}),
                          .scatter = in.number("scatter", {0, 0.2, ""}, 0)};
    in.refuse_unknown_keys();
    return physics;
}

CabinetDef read_cabinet(FieldReader in)
{
    const CabinetDef usual;
    CabinetDef cabinet{.push_time = in.number("push_time", {0.005, 0.2, "s"}, usual.push_time),
                       .tilt = in.degrees("tilt_deg", {0.1, 30, "degrees"}, usual.tilt),
                       .bob_length = in.number("bob_length", {0.02, 0.5, "m"}, usual.bob_length)};
    if (in.has("nudge_mps"))
        cabinet.nudge_speed = in.vec2("nudge_mps", {0, 1, "m/s"});
    if (in.has("frequency_hz"))
        cabinet.frequency = in.vec2("frequency_hz", {1, 40, "Hz"});
    if (in.has("damping"))
        cabinet.damping = in.vec2("damping", range::share);
    in.refuse_unknown_keys();
    return cabinet;
}

} // namespace

bool load_format(FieldReader& in)
{
    const JsonNode* format = in.member("format", JsonNode::Kind::String, true);
    if (format != nullptr && format->text != "pinball-table")
        in.fail("format", "must be \"pinball-table\"");
    const int version = in.integer("version", {1, 1'000'000, ""});
    if (version > newest_version)
        in.fail("version", "is newer than this program: it reads version " + std::to_string(newest_version));
    return version <= newest_version;
}

NameIndex load_materials(FieldReader& in, Table& table, LoadErrors& errors)
{
    NameIndex names;
    const JsonNode* materials = in.member("materials", JsonNode::Kind::Object, true);
    if (materials == nullptr)
        return names;
    for (std::size_t i = 0; i < materials->items.size(); ++i)
    {
        const std::string& name = materials->keys[i];
        FieldReader reader(materials->items[i], "materials." + name.substr(0, 200), "", errors);
        names.emplace(name, static_cast<Index>(table.materials.size()));
        if (!is_valid_id(name))
            reader.fail("", "the name of a material must be 1 to 40 lower-case letters, digits or underscores");
        if (materials->items[i].kind == JsonNode::Kind::Object)
        {
            table.materials.push_back(read_material(reader, name));
            reader.refuse_unknown_keys();
        }
        else
        {
            reader.fail("", "must be an object");
            table.materials.push_back({.name = name});
        }
    }
    return names;
}

void load_header(FieldReader& in, const NameIndex& materials, Table& table)
{
    table.name = in.text("name");
    table.author = in.text("author", "");
    table.size = in.vec2("size", {0.1, 3, "m"});
    if (const JsonNode* ball = in.member("ball", JsonNode::Kind::Object, true))
        table.ball = read_ball(in.child(*ball, "ball"), materials);
    if (const JsonNode* physics = in.member("physics", JsonNode::Kind::Object, true))
        table.physics = read_physics(in.child(*physics, "physics"));
    if (const JsonNode* cabinet = in.member("cabinet", JsonNode::Kind::Object, false))
        table.cabinet = read_cabinet(in.child(*cabinet, "cabinet"));
}

} // namespace carom::pinball
