// Documents name files and folders in backquotes; every one of them exists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
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

// What stands between single backquotes on one line, fenced blocks left out.
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

} // namespace
