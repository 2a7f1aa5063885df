// The README's program is the first example; it is built and run by package/consumers.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace {

std::string read_file(const std::string& name)
{
    std::ifstream file(std::string(CAROM_SOURCE_DIR "/") + name);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(Readme, ItsProgramIsTheFirstExample)
{
    const std::string readme = read_file("README.md");
    const std::size_t open = readme.find("```cpp\n");
    ASSERT_NE(open, std::string::npos);
    const std::size_t begin = open + 7;
    const std::string program = readme.substr(begin, readme.find("```", begin) - begin);
    const std::string example = read_file("examples/first_ball.cpp");
    EXPECT_EQ(example.substr(example.find("#include")), program);
}

} // namespace
