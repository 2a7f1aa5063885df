#include "web/describe.h"

#include "speed/plan.h"

#include <nlohmann/json.hpp>

namespace web {
namespace {

using nlohmann::json;

json pair(truth::Vec v) { return {v.x, v.y}; }

struct ShapeToJson
{
    json operator()(const truth::Disc& d) const { return {{"kind", "disc"}, {"center", pair(d.center)}, {"radius", d.radius}}; }
    json operator()(const truth::Capsule& c) const
    {
        return {{"kind", "capsule"}, {"a", pair(c.a)}, {"b", pair(c.b)}, {"radius", c.radius}};
    }
    json operator()(const truth::Segment&) const { return {{"kind", "segment"}}; }
    json operator()(const truth::Polygon& p) const
    {
        json corners = json::array();
        for (const truth::Vec v : p.vertices)
            corners.push_back(pair(v));
        return {{"kind", "polygon"}, {"corners", corners}};
    }
};

} // namespace

std::string describe(const carom::scenes::SceneEntry& entry)
{
    const carom::scenes::BuiltScene built = entry.create({});
    speed::Translator translator;
    const speed::Changes all = translator.look(built.scene);
    json bodies = json::array();
    for (const speed::BodyPlan& body : all.bodies)
    {
        json shapes = json::array();
        for (const auto& [shape, material] : body.shapes)
        {
            json s = std::visit(ShapeToJson{}, shape);
            s["density"] = material.density;
            s["friction"] = material.friction;
            s["restitution"] = material.restitution;
            shapes.push_back(s);
        }
        bodies.push_back({{"dynamic", body.def.motion == truth::Motion::Dynamic},
                          {"position", pair(body.def.position)},
                          {"angle", body.def.angle},
                          {"shapes", shapes}});
    }
    json hinges = json::array();
    for (const truth::Hinge& h : all.hinges)
        hinges.push_back(
            {{"a", h.a}, {"b", h.b}, {"anchor", pair(h.anchor)}, {"speed", h.motor_speed}, {"torque", h.motor_torque}});
    return json{{"name", entry.name},  {"steps", entry.frames}, {"warm_up", warm_up}, {"h", entry.h},
                {"gravity", {0, -10}}, {"bodies", bodies},      {"hinges", hinges}}
        .dump();
}

} // namespace web
