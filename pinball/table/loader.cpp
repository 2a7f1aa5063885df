#include "pinball/table/loader.h"

#include "pinball/table/load_elements.h"
#include "pinball/table/load_header.h"
#include "pinball/table/load_rules.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

namespace carom::pinball {
namespace {

constexpr std::size_t max_errors_shown = 200;
constexpr std::uintmax_t max_file_size = 4u << 20;

void load_body(FieldReader& in, Table& table, LoadErrors& errors)
{
    const NameIndex materials = load_materials(in, table, errors);
    load_header(in, materials, table);
    if (const JsonNode* elements = in.member("elements", JsonNode::Kind::Array, true))
        load_elements(*elements, materials, table, errors);
    if (const JsonNode* groups = in.member("groups", JsonNode::Kind::Object, false))
        load_groups(*groups, table, errors);
    if (const JsonNode* rules = in.member("rules", JsonNode::Kind::Object, false))
        load_rules(*rules, table, errors);
    load_card(in, table, errors);
    table.outline = in.reference("outline", names_of<Wall>(table), "wall");
    in.refuse_unknown_keys();
}

LoadResult finish(Table table, LoadErrors errors)
{
    std::sort(errors.begin(), errors.end(), [](const LoadError& a, const LoadError& b)
              { return std::tie(a.line, a.column, a.path, a.sentence) < std::tie(b.line, b.column, b.path, b.sentence); });
    if (errors.size() > max_errors_shown)
        errors.resize(max_errors_shown);
    if (!errors.empty())
        return {.errors = std::move(errors)};
    return {.table = std::move(table)};
}

LoadResult unreadable(std::string sentence) { return {.errors = {{.sentence = std::move(sentence)}}}; }

} // namespace

LoadResult load_table(std::string_view text)
{
    LoadErrors errors;
    const std::optional<JsonNode> root = parse_json(text, errors);
    if (!root)
        return finish({}, std::move(errors));
    FieldReader in(*root, "", "", errors);
    Table table;
    if (root->kind != JsonNode::Kind::Object)
        in.fail("", "a table file is one JSON object");
    else if (load_format(in))
        load_body(in, table, errors);
    return finish(std::move(table), std::move(errors));
}

LoadResult load_table_file(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        return unreadable("there is no file " + file.string());
    if (std::filesystem::file_size(file, error) > max_file_size)
        return unreadable("larger than 4 MB: this is no table");
    std::ifstream stream(file, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (!stream)
        return unreadable("cannot read " + file.string());
    LoadResult result = load_table(text);
    result.text = std::move(text);
    return result;
}

} // namespace carom::pinball
