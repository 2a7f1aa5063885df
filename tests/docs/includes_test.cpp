// The rules of who may include whom (ARCHITECTURE.md). The build enforces most of it for the modules of the engine; this test says it of every
// folder, and of the standard headers that the engine does without.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path source_dir = CAROM_SOURCE_DIR;

struct Include
{
    std::string file; // where it stands, relative to the source folder
    std::string name; // what is included
    bool system = false;
};

bool is_source(const fs::path& path) { return path.extension() == ".cpp" || path.extension() == ".h"; }

std::vector<Include> includes_in_file(const fs::path& path)
{
    std::vector<Include> found;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
    {
        if (!line.starts_with("#include "))
            continue;
        const bool system = line.find('<') != std::string::npos;
        const std::size_t open = line.find_first_of("<\"");
        const std::size_t close = line.find_first_of(">\"", open + 1);
        found.push_back({fs::relative(path, source_dir).string(), line.substr(open + 1, close - open - 1), system});
    }
    return found;
}

std::vector<Include> includes_in(const std::string& folder)
{
    std::vector<Include> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source_dir / folder))
    {
        if (!entry.is_regular_file() || !is_source(entry.path()))
            continue;
        const std::vector<Include> more = includes_in_file(entry.path());
        found.insert(found.end(), more.begin(), more.end());
    }
    return found;
}

bool is_one_of(const std::string& name, const std::vector<std::string>& names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string first_folder(const std::string& name) { return name.substr(0, name.find('/')); }

TEST(Includes, AModuleSeesOnlyTheModulesAboveIt)
{
    const std::vector<std::string> modules = {"core", "geometry", "collision", "dynamics", "scene"};
    int seen = 0;
    for (std::size_t i = 0; i < modules.size(); ++i)
    {
        for (const Include& include : includes_in("src/" + modules[i]))
        {
            const std::string folder = first_folder(include.name);
            seen += is_one_of(folder, modules);
            for (std::size_t below = i + 1; below < modules.size(); ++below)
                EXPECT_NE(folder, modules[below]) << include.file << " includes " << include.name;
        }
    }
    EXPECT_GT(seen, 50) << "hardly any include was recognized: is the test blind?";
}

TEST(Includes, ThePublicHeadersNameOnlyThemselves)
{
    for (const Include& include : includes_in("include"))
        EXPECT_TRUE(include.system || first_folder(include.name) == "carom") << include.file << " includes " << include.name;
}

// The WebAssembly library has none of these, and the simulation needs neither clock nor hash map.
TEST(Includes, TheEngineNeedsLittleOfTheStandardLibrary)
{
    const std::vector<std::string> banned = {"thread", "mutex",    "condition_variable", "future",        "fstream", "filesystem",
                                             "format", "iostream", "unordered_map",      "unordered_set", "chrono",  "random",
                                             "regex",  "execution"};
    const std::vector<std::string> threads = {"thread", "mutex", "condition_variable"};
    for (const Include& include : includes_in("src"))
    {
        const bool in_task_pool =
            include.file.find("core/") != std::string::npos && include.file.find("task_pool") != std::string::npos;
        const bool in_clock = include.file.find("core/") != std::string::npos && include.file.find("clock") != std::string::npos;
        if ((in_task_pool && is_one_of(include.name, threads)) || (in_clock && include.name == "chrono"))
            continue;
        EXPECT_FALSE(include.system && is_one_of(include.name, banned)) << include.file << " includes <" << include.name << ">";
    }
}

void expect_no_internals(const std::string& folder)
{
    const std::vector<std::string> internals = {"core", "geometry", "collision", "dynamics", "scene", "src"};
    for (const Include& include : includes_in(folder))
        EXPECT_FALSE(is_one_of(first_folder(include.name), internals)) << include.file << " includes " << include.name;
}

TEST(Includes, ProgramsUseThePublicHeadersOnly)
{
    for (const char* folder : {"scenes", "view", "pinball", "lab", "bench", "examples"})
        expect_no_internals(folder);
}

// The game runs headless and gives the same bits everywhere: no window, no sound, no clock, no random device, no hash map.
TEST(Includes, ThePinballGameHasNoWindowAndNoClock)
{
    const std::vector<std::string> banned = {"chrono", "random", "thread", "ctime", "unordered_map", "unordered_set"};
    for (const char* folder : {"pinball/table", "pinball/elements", "pinball/rules", "pinball/game", "pinball/autoplay"})
    {
        for (const Include& include : includes_in(folder))
        {
            EXPECT_FALSE(is_one_of(include.name, banned)) << include.file << " includes <" << include.name << ">";
            EXPECT_FALSE(include.name.find("SDL") != std::string::npos || include.name.find("imgui") != std::string::npos ||
                         first_folder(include.name) == "view" || include.name.find("player/") != std::string::npos)
                << include.file << " includes " << include.name;
        }
    }
}

} // namespace
