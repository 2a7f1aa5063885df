#include "pinball/table/new_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace carom::pinball {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> sections = {"elements", "groups", "rules", "card"};

std::string read(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw std::runtime_error("cannot read " + file.string());
    return {(std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>()};
}

// The lines under "@section" up to the next one.
std::string section_of(const std::string& text, std::string_view section)
{
    std::istringstream lines(text);
    std::string wanted;
    std::string line;
    bool inside = false;
    while (std::getline(lines, line))
    {
        if (line.starts_with("@"))
            inside = line.substr(1) == section;
        else if (inside)
            wanted += line + '\n';
    }
    return wanted;
}

// The comment at the top, without its slashes.
std::string about(const std::string& text)
{
    std::istringstream lines(text);
    std::string words;
    for (std::string line; std::getline(lines, line) && line.starts_with("// ");)
        words += (words.empty() ? "" : " ") + line.substr(3);
    return words;
}

void replace(std::string& text, const std::string& mark, const std::string& by)
{
    const std::size_t at = text.find(mark);
    if (at != std::string::npos)
        text.replace(at, mark.size(), by);
}

// Groups have no other entry that a comma could lead to.
std::string joined(std::string_view section, const std::vector<std::string>& parts)
{
    std::string all;
    for (const std::string& part : parts)
    {
        if (section == "groups" && !all.empty() && !part.empty())
            all.insert(all.size() - 1, ",");
        all += part;
    }
    return all;
}

} // namespace

std::vector<Template> templates()
{
    std::vector<Template> all;
    for (const auto& entry : fs::directory_iterator(CAROM_TEMPLATES_DIR))
        if (entry.path().extension() == ".template")
            all.push_back({entry.path().stem().string(), about(read(entry.path())), entry.path()});
    std::ranges::sort(all, {}, &Template::name);
    return all;
}

std::string new_table(std::string_view name, const std::vector<std::string>& with)
{
    const std::vector<Template> known = templates();
    if (name.empty() || name.size() > 200)
        throw std::runtime_error("the name of a table must have 1 to 200 bytes");
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < with.size(); ++i)
    {
        const std::string& wanted = with[i];
        if (std::find(with.begin(), with.begin() + static_cast<std::ptrdiff_t>(i), wanted) !=
            with.begin() + static_cast<std::ptrdiff_t>(i))
            continue; // once is enough
        const auto found = std::ranges::find(known, wanted, &Template::name);
        if (found == known.end())
            throw std::runtime_error("there is no template \"" + wanted + "\"");
        texts.push_back(read(found->file));
    }
    std::string table = read(fs::path(CAROM_TEMPLATES_DIR) / "base.table.json");
    const std::string quoted = nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    replace(table, "\"@name\"", quoted);
    for (const std::string_view section : sections)
    {
        std::vector<std::string> parts;
        for (const std::string& text : texts)
            parts.push_back(section_of(text, section));
        replace(table, "    // @" + std::string(section) + "\n", joined(section, parts));
    }
    return table;
}

} // namespace carom::pinball
