#include "pinball/table/load_elements.h"

#include "pinball/table/load_parts.h"

#include <algorithm>
#include <set>

namespace carom::pinball {
namespace {

constexpr std::size_t max_elements = 2'000;

void read_shared_keys(FieldReader& in, bool solid, const NameIndex& materials, Element& element)
{
    if (solid)
        element.material = in.reference("material", materials, "material");
    element.score = in.integer("score", range::score, 0);
    element.enabled = in.boolean("enabled", true);
    element.visible = in.boolean("visible", true);
    element.layer = in.integer("layer", {-100, 100, ""}, 0);
    element.color = in.color("color");
}

std::string read_id(FieldReader& in, std::set<std::string>& taken)
{
    const std::string id = in.text("id");
    if (in.object().member("id") == nullptr || in.object().member("id")->kind != JsonNode::Kind::String)
        return id;
    if (!is_valid_id(id))
        in.fail("id", "must be 1 to 40 lower-case letters, digits or underscores");
    else if (!taken.insert(id).second)
        in.fail("id", "\"" + id + "\" is taken by an element above");
    return id;
}

/// The part names lanes and shown elements before all elements are known: these keys are read in a second pass.
void read_links(FieldReader& in, const NameIndex& sensors, const NameIndex& all, Element& element)
{
    if (Plunger* plunger = std::get_if<Plunger>(&element.part))
        plunger->lane = in.reference_or_none("lane", sensors, "sensor");
    if (Light* light = std::get_if<Light>(&element.part); light != nullptr && light->shows == Lamp::Element)
        light->element = in.reference("element", all, "element");
}

std::string id_of(const JsonNode& node)
{
    const JsonNode* id = node.member("id");
    return id != nullptr && id->kind == JsonNode::Kind::String ? id->text.substr(0, 200) : "";
}

} // namespace

NameIndex names_of_all(const Table& table)
{
    NameIndex names;
    for (std::size_t i = 0; i < table.elements.size(); ++i)
        names.emplace(table.elements[i].id, static_cast<Index>(i));
    return names;
}

bool is_valid_id(std::string_view id)
{
    const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    return !id.empty() && id.size() <= 40 && std::all_of(id.begin(), id.end(), allowed);
}

namespace {

bool has_known_type(FieldReader& in, std::size_t& type)
{
    const JsonNode* name = in.member("type", JsonNode::Kind::String, true);
    if (name == nullptr)
        return false;
    type = in.choice("type", type_names, std::nullopt);
    return type_names[type] == name->text;
}

/// True if the element's own keys were read, so that what is left over is unknown.
bool read_element(FieldReader& in, const NameIndex& materials, std::set<std::string>& taken, Element& element)
{
    if (in.object().kind != JsonNode::Kind::Object)
    {
        in.fail("", "must be an object");
        return false;
    }
    element.line = in.object().line;
    element.id = read_id(in, taken);
    std::size_t type = 0;
    if (!has_known_type(in, type))
        return false;
    element.part = type_reader(type).read(in);
    read_shared_keys(in, type_reader(type).solid, materials, element);
    return true;
}

} // namespace

void load_elements(const JsonNode& elements, const NameIndex& materials, Table& table, LoadErrors& errors)
{
    if (elements.items.size() > max_elements)
    {
        errors.push_back({"", "elements", elements.line, elements.column,
                          "there are more than " + std::to_string(max_elements) + " elements"});
        return;
    }
    std::set<std::string> taken;
    std::vector<FieldReader> readers;
    std::vector<bool> read;
    for (std::size_t i = 0; i < elements.items.size(); ++i)
    {
        const JsonNode& node = elements.items[i];
        readers.emplace_back(node, "elements[" + std::to_string(i) + "]", id_of(node), errors);
        read.push_back(read_element(readers.back(), materials, taken, table.elements.emplace_back()));
    }
    const NameIndex sensors = names_of<Sensor>(table);
    const NameIndex all = names_of_all(table);
    for (std::size_t i = 0; i < readers.size(); ++i)
    {
        if (!read[i])
            continue;
        read_links(readers[i], sensors, all, table.elements[i]);
        readers[i].refuse_unknown_keys();
    }
}

} // namespace carom::pinball
