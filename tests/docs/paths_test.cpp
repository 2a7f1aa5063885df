// Documents name files and folders in backquotes; every one of them exists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path source_dir = CAROM_SOURCE_DIR;

std::string read_file(const fs::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> documents()
{
    std::vector<fs::path> found;
    for (const fs::path& folder : {source_dir, source_dir / "docs", source_dir / "docs/decisions"})
    {
        if (!fs::exists(folder))
            continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        {
            if (entry.path().extension() == ".md")
                found.push_back(entry.path());
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

// Texts between single backquotes on one line, without fenced blocks.
std::vector<std::string> quoted(const std::string& text)
{
    std::vector<std::string> found;
    std::size_t line_start = 0;
    bool fenced = false;
    while (line_start < text.size())
    {
        const std::size_t line_end = std::min(text.find('\n', line_start), text.size());
        const std::string line = text.substr(line_start, line_end - line_start);
        line_start = line_end + 1;
        if (line.starts_with("```"))
            fenced = !fenced;
        if (fenced || line.starts_with("```"))
            continue;
        for (std::size_t open = line.find('`'); open != std::string::npos;)
        {
            const std::size_t close = line.find('`', open + 1);
            if (close == std::string::npos)
                break;
            found.push_back(line.substr(open + 1, close - open - 1));
            open = line.find('`', close + 1);
        }
    }
    return found;
}

bool is_path_character(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) || std::string("_-./").find(c) != std::string::npos;
}

// A path of the repository: only path characters, and either it has a slash and starts with a top-level folder of the project
// (known from the design, so that a vanished folder is noticed too), or it looks like a file at the top.
bool looks_like_path(const std::string& text)
{
    if (text.size() < 3 || !std::all_of(text.begin(), text.end(), is_path_character) || text.starts_with("build"))
        return false;
    static const std::vector<std::string> folders = {"include", "src",      "scenes", "view",  "pinball", "lab", "bench",
                                                     "tests",   "examples", "docs",   "cmake", "scripts", ".ci"};
    const std::string relative = text.starts_with("./") ? text.substr(2) : text;
    const std::size_t slash = relative.find('/');
    if (slash != std::string::npos)
        return std::find(folders.begin(), folders.end(), relative.substr(0, slash)) != folders.end();
    return text.starts_with("./") || relative.ends_with(".md") || relative == "CMakeLists.txt" || relative == "packages.txt";
}

// Documents in docs/ may name their neighbours.
bool exists(const fs::path& document, const std::string& path)
{
    return fs::exists(source_dir / path) || fs::exists(document.parent_path() / path);
}

TEST(Documents, EveryPathTheyNameExists)
{
    const std::vector<fs::path> files = documents();
    ASSERT_FALSE(files.empty());
    int checked = 0;
    for (const fs::path& document : files)
    {
        for (const std::string& text : quoted(read_file(document)))
        {
            if (!looks_like_path(text))
                continue;
            ++checked;
            EXPECT_TRUE(exists(document, text)) << document.filename() << " names `" << text << "`, which does not exist";
        }
    }
    EXPECT_GT(checked, 20) << "hardly any path was recognized: is the test blind?";
}

TEST(Documents, TheModuleMapIsComplete)
{
    const std::string text = read_file(source_dir / "ARCHITECTURE.md");
    for (const fs::directory_entry& entry : fs::directory_iterator(source_dir / "src"))
    {
        if (!entry.is_directory())
            continue;
        const std::string path = "src/" + entry.path().filename().string();
        EXPECT_NE(text.find(path), std::string::npos) << "ARCHITECTURE.md does not mention " << path;
    }
}

TEST(Documents, LinksToFilesLead)
{
    for (const fs::path& document : documents())
    {
        const std::string text = read_file(document);
        for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2))
        {
            const std::size_t end = text.find_first_of(")# ", at + 2);
            const std::string target = text.substr(at + 2, end - at - 2);
            if (target.empty() || target.find("://") != std::string::npos)
                continue;
            EXPECT_TRUE(exists(document, target)) << document.filename() << " links to " << target << ", which does not exist";
        }
    }
}

// --- the rooms of the step ----------------------------------------------------------------------------------------------------------------

const fs::path dynamics_dir = source_dir / "src/dynamics";

bool is_source(const fs::path& path)
{
    return path.extension() == ".h" || path.extension() == ".cpp" || path.extension() == ".inl";
}

std::vector<fs::path> sources_in(const fs::path& folder)
{
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    {
        if (entry.is_regular_file() && is_source(entry.path()))
            found.push_back(entry.path());
    }
    return found;
}

TEST(Rooms, ArchitectureNamesEach)
{
    const std::string text = read_file(source_dir / "ARCHITECTURE.md");
    int rooms = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(dynamics_dir))
    {
        if (!entry.is_directory())
            continue;
        ++rooms;
        const std::string name = entry.path().filename().string() + "/";
        EXPECT_NE(text.find(name), std::string::npos) << "ARCHITECTURE.md does not mention src/dynamics/" << name;
    }
    EXPECT_GT(rooms, 5);
}

TEST(Rooms, HoldFewFilesAndNoneIsLong)
{
    std::map<fs::path, int> files;
    for (const fs::path& source : sources_in(dynamics_dir))
    {
        ++files[source.parent_path()];
        const std::string text = read_file(source);
        EXPECT_LE(std::ranges::count(text, '\n'), 500) << source << " is too long for one subject";
    }
    for (const auto& [room, count] : files)
        EXPECT_LE(count, 16) << room << " is crowded";
}

// A source file may leave that to its header.
TEST(Rooms, EveryFileSaysWhatItIsFor)
{
    for (const fs::path& source : sources_in(dynamics_dir))
    {
        const std::string text = read_file(source);
        const std::string opening = text.starts_with("#pragma once\n\n") ? text.substr(14) : text;
        const bool has_header = source.extension() == ".cpp" && fs::exists(fs::path(source).replace_extension(".h"));
        EXPECT_TRUE(opening.starts_with("//") || has_header) << source << " does not begin with a comment";
    }
}

// The table of how islands are solved names every choice that there is, and ARCHITECTURE.md stays short.
TEST(Rooms, TheTableOfPoliciesIsComplete)
{
    const std::string text = read_file(source_dir / "ARCHITECTURE.md");
    const std::string header = read_file(dynamics_dir / "islands/policy.h");
    const std::size_t begin = header.find("struct IslandPolicy");
    const std::string policy = header.substr(begin, header.find("};", begin) - begin);
    int choices = 0;
    for (const char* type : {"bool ", "std::int32_t "})
    {
        for (std::size_t at = policy.find(type); at != std::string::npos; at = policy.find(type, at + 1))
        {
            const std::size_t name = at + std::string(type).size();
            const std::string choice = policy.substr(name, policy.find(' ', name) - name);
            EXPECT_NE(text.find("`" + choice + "`"), std::string::npos) << "ARCHITECTURE.md has no row for " << choice;
            ++choices;
        }
    }
    EXPECT_GT(choices, 8);
}

TEST(Rooms, ArchitectureHasTwoPages)
{
    std::istringstream text(read_file(source_dir / "ARCHITECTURE.md"));
    EXPECT_LE(std::distance(std::istream_iterator<std::string>(text), {}), 1800);
}

// Types and functions that documents name exist.
TEST(Documents, NamesOfTheEngineExist)
{
    std::string engine;
    for (const char* folder : {"src", "include"})
    {
        for (const fs::path& source : sources_in(source_dir / folder))
            engine += read_file(source);
    }
    int checked = 0;
    for (const char* document : {"ARCHITECTURE.md", "docs/solver.md"})
    {
        for (const std::string& text : quoted(read_file(source_dir / document)))
        {
            const bool is_name = std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
            if (!is_name || text.size() < 8)
                continue;
            ++checked;
            EXPECT_NE(engine.find(text), std::string::npos)
                << document << " names " << text << ", which the engine does not have";
        }
    }
    EXPECT_GT(checked, 15);
}

} // namespace
