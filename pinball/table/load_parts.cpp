#include "pinball/table/load_parts.h"

#include "pinball/table/load_path.h"

#include <cmath>
#include <utility>

namespace carom::pinball {
namespace {

constexpr std::size_t max_springs = 8;

Part read_wall(FieldReader& in)
{
    constexpr std::array<std::string_view, 3> sides = {"both", "left", "right"};
    Wall wall{.path = read_open_path(in)};
    wall.path.half_thickness = in.number("radius", range::thickness, 0);
    wall.path.sides = static_cast<Sides>(in.choice("sides", sides, 0));
    return wall;
}

Part read_solid(FieldReader& in)
{
    Solid solid{.path = read_closed_path(in)};
    solid.path.half_thickness = in.number("radius", range::thickness, 0);
    return solid;
}

Part read_post(FieldReader& in)
{
    return Post{.pos = in.vec2("pos", range::coordinate), .radius = in.number("radius", range::radius)};
}

Part read_plane(FieldReader& in) { return Plane{.point = in.vec2("point", range::coordinate), .normal = in.direction("normal")}; }

void check_flipper(FieldReader& in, const Flipper& flipper)
{
    const double stroke = std::abs(double{flipper.up} - flipper.rest);
    if (in.has("rest_deg") && in.has("up_deg") && (stroke < 0.08 || stroke > 2.97))
        in.fail("up_deg", "must differ from rest_deg by 5 to 170 degrees");
    if (flipper.length > 0 && std::abs(flipper.base_radius - flipper.tip_radius) >= flipper.length)
        in.fail("length", "is too short for its radii: one circle would lie inside the other");
}

Part read_flipper(FieldReader& in)
{
    constexpr std::array<std::string_view, 2> inputs = {"left", "right"};
    Flipper flipper{
        .pivot = in.vec2("pivot", range::coordinate),
        .length = in.number("length", {0.02, 0.2, "m"}),
        .base_radius = in.number("base_radius", {0.002, 0.05, "m"}),
        .tip_radius = in.number("tip_radius", {0.002, 0.05, "m"}),
        .rest = in.degrees("rest_deg", range::angle),
        .up = in.degrees("up_deg", range::angle),
        .inertia = in.number("inertia", {1e-6, 0.01, "kg m²"}),
        .coil_torque = in.number("coil_torque", {0.01, 10, "N m"}),
        .coil_rise = in.number("coil_rise", {0, 0.2, "s"}, 0.015f),
        .hold_torque_ratio = in.number("hold_torque_ratio", range::share, 0.3f),
        .eos = in.degrees("eos_deg", {0, 45, "degrees"}, 6 * pi / 180),
        .return_ratio = in.number("return_ratio", {0.001, 1, ""}, 0.06f),
        .stop_restitution = in.number("stop_restitution", range::share, 0.3f),
        .input = static_cast<Side>(in.choice("input", inputs, std::nullopt)),
    };
    check_flipper(in, flipper);
    return flipper;
}

Part read_plunger(FieldReader& in)
{
    return Plunger{
        .pos = in.vec2("pos", range::coordinate),
        .half = in.vec2("half", {0.001, 0.1, "m"}),
        .axis = in.direction("axis"),
        .stroke = in.number("stroke", {0.005, 0.3, "m"}),
        .mass = in.number("mass", range::mass),
        .k = in.number("k", range::spring),
        .c = in.number("c", range::damper, 0),
        .preload = in.number("preload", {0, 100, "N"}, 0),
        .pull_speed = in.number("pull_speed", {0.001, 10, "m/s"}, 0.09f),
    };
}

Part read_bumper(FieldReader& in)
{
    return Bumper{
        .pos = in.vec2("pos", range::coordinate),
        .radius = in.number("radius", range::radius),
        .kick_speed = in.number("kick_speed", range::speed),
        .threshold = in.number("threshold", range::speed, 0.06f),
        .cooldown = in.number("cooldown", range::time, 0.05f),
    };
}

/// Keeps the kicking edge from corners[0] to corners[1] and turns the triangle counter-clockwise.
std::array<Vec2, 3> read_triangle(FieldReader& in)
{
    const std::vector<Vec2> points = in.points("corners", 3, range::coordinate);
    if (points.empty())
        return {};
    const float area = cross(points[1] - points[0], points[2] - points[0]) / 2;
    if (std::abs(area) < 1e-6f)
        in.fail("corners", "the triangle encloses no area");
    if (area < 0)
        return {points[1], points[0], points[2]};
    return {points[0], points[1], points[2]};
}

Part read_slingshot(FieldReader& in)
{
    return Slingshot{
        .corners = read_triangle(in),
        .radius = in.number("radius", {0.0005, 0.1, "m"}),
        .kick_speed = in.number("kick_speed", range::speed),
        .threshold = in.number("threshold", range::speed, 0.15f),
        .cooldown = in.number("cooldown", range::time, 0.08f),
    };
}

/// The two ends of a target, spinner or gate: at least a millimetre apart.
std::pair<Vec2, Vec2> read_ends(FieldReader& in)
{
    const Vec2 a = in.vec2("a", range::coordinate);
    const Vec2 b = in.vec2("b", range::coordinate);
    if (in.has("a") && in.has("b") && std::abs(a.x - b.x) + std::abs(a.y - b.y) < 0.001f)
        in.fail("b", "lies on a");
    return {a, b};
}

template <typename Target>
Part read_target(FieldReader& in)
{
    const auto [a, b] = read_ends(in);
    return Target{.a = a,
                  .b = b,
                  .radius = in.number("radius", {0.0005, 0.02, "m"}, 0.0015f),
                  .min_speed = in.number("min_speed", range::speed, 0.11f)};
}

TargetSpring read_target_spring(FieldReader in)
{
    const TargetSpring spring{
        .anchor = in.vec2("anchor", range::coordinate),
        .local = in.vec2("local", {-0.2, 0.2, "m"}),
        .k = in.number("k", range::spring),
        .c = in.number("c", range::damper, 0),
        .rest = in.number("rest", {0, 0.5, "m"}),
    };
    in.refuse_unknown_keys();
    return spring;
}

std::vector<TargetSpring> read_target_springs(FieldReader& in)
{
    std::vector<TargetSpring> springs;
    const JsonNode* list = in.member("springs", JsonNode::Kind::Array, true);
    if (list == nullptr)
        return springs;
    if (list->items.empty() || list->items.size() > max_springs)
    {
        in.fail(*list, "springs", "must have 1 to " + std::to_string(max_springs) + " springs");
        return springs;
    }
    for (std::size_t i = 0; i < list->items.size(); ++i)
    {
        const std::string place = "springs[" + std::to_string(i) + "]";
        if (list->items[i].kind == JsonNode::Kind::Object)
            springs.push_back(read_target_spring(in.child(list->items[i], place)));
        else
            in.fail(list->items[i], place, "must be an object");
    }
    return springs;
}

Part read_sprung_target(FieldReader& in)
{
    return SprungTarget{
        .pos = in.vec2("pos", range::coordinate),
        .half = in.vec2("half", {0.001, 0.1, "m"}),
        .axis = in.direction("axis"),
        .mass = in.number("mass", range::mass),
        .max_travel = in.number("max_travel", {0.0005, 0.1, "m"}),
        .min_impulse = in.number("min_impulse", {0, 10, "N s"}, 0.02f),
        .springs = read_target_springs(in),
    };
}

Part read_spinner(FieldReader& in)
{
    const auto [a, b] = read_ends(in);
    return Spinner{.a = a,
                   .b = b,
                   .inertia = in.number("inertia", {1e-8, 0.001, "kg m²"}),
                   .damping = in.number("damping", {0, 100, "1/s"}),
                   .drag_on_ball = in.number("drag_on_ball", range::share)};
}

Part read_gate(FieldReader& in)
{
    const auto [a, b] = read_ends(in);
    return Gate{.a = a, .b = b, .radius = in.number("radius", {0.0005, 0.02, "m"}, 0.001f), .open_dir = in.direction("open_dir")};
}

Part read_sensor(FieldReader& in)
{
    Sensor sensor{.pos = in.vec2("pos", range::coordinate)};
    const bool is_box = in.has("half");
    if (is_box == in.has("radius"))
        in.fail("half", "a sensor has either half (a box) or radius (a circle)");
    else if (is_box)
        sensor.half = in.vec2("half", range::half_size);
    else
        sensor.radius = in.number("radius", range::radius);
    sensor.kills = in.boolean("kills", false);
    return sensor;
}

Part read_booster(FieldReader& in)
{
    return Booster{.pos = in.vec2("pos", range::coordinate),
                   .half = in.vec2("half", range::half_size),
                   .force = in.vec2("force", {-20, 20, "N"}),
                   .only_if_moving_along = in.boolean("only_if_moving_along", false)};
}

Part read_kicker(FieldReader& in)
{
    return Kicker{.pos = in.vec2("pos", range::coordinate),
                  .half = in.vec2("half", range::half_size),
                  .kick = in.vec2("kick", {-10, 10, "m/s"}),
                  .lit = in.boolean("lit", false)};
}

Part read_saucer(FieldReader& in)
{
    return Saucer{.pos = in.vec2("pos", range::coordinate),
                  .radius = in.number("radius", range::radius),
                  .max_capture_speed = in.number("max_capture_speed", range::speed),
                  .hold = in.number("hold", range::time),
                  .kick = in.vec2("kick", {-10, 10, "m/s"}),
                  .spread = in.degrees("spread_deg", {0, 45, "degrees"}, 0)};
}

Part read_captive_ball(FieldReader& in) { return CaptiveBall{.pos = in.vec2("pos", range::coordinate)}; }

Part read_light(FieldReader& in)
{
    constexpr std::array<std::string_view, 8> lamps = {"element", "ball_save", "bonus",      "letter",
                                                       "lock",    "multiball", "extra_ball", "shoot_again"};
    Light light{.pos = in.vec2("pos", range::coordinate),
                .radius = in.number("radius", range::radius),
                .shows = static_cast<Lamp>(in.choice("shows", lamps, std::nullopt)),
                .label = in.text("label", "")};
    if (light.shows == Lamp::Bonus || light.shows == Lamp::Letter)
        light.number = in.integer("number", {1, 100, ""});
    return light;
}

/// In the order of Part and type_names.
constexpr std::array<TypeReader, type_names.size()> type_readers = {{
    {read_wall, true},
    {read_solid, true},
    {read_post, true},
    {read_plane, true},
    {read_flipper, true},
    {read_plunger, true},
    {read_bumper, true},
    {read_slingshot, true},
    {read_target<DropTarget>, true},
    {read_target<Standup>, true},
    {read_sprung_target, true},
    {read_spinner, false},
    {read_gate, true},
    {read_sensor, false},
    {read_booster, false},
    {read_kicker, false},
    {read_saucer, false},
    {read_captive_ball, false},
    {read_light, false},
}};

} // namespace

const TypeReader& type_reader(std::size_t type) { return type_readers[type]; }

} // namespace carom::pinball
