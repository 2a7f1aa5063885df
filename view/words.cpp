#include "view/words.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace carom::view {

namespace {

const Values& story_words()
{
    static const Values words = []
    {
        std::ifstream in(CAROM_STORY_TEXT_DIR "/en/stories.md");
        const std::string markdown{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        return parse_words(markdown);
    }();
    return words;
}

} // namespace

std::string filled(std::string_view text, const Values& values)
{
    std::string result;
    while (!text.empty())
    {
        const std::size_t open = text.find('{');
        const std::size_t close = open == std::string_view::npos ? open : text.find('}', open);
        if (close == std::string_view::npos)
            break;
        result += text.substr(0, open);
        const std::string_view name = text.substr(open + 1, close - open - 1);
        const auto value = values.find(name);
        result += value != values.end() ? std::string_view(value->second) : text.substr(open, close - open + 1);
        text = text.substr(close + 1);
    }
    result += text;
    return result;
}

std::vector<std::string> placeholders(std::string_view text)
{
    std::vector<std::string> names;
    for (std::size_t open = text.find('{'); open != std::string_view::npos; open = text.find('{', open + 1))
    {
        const std::size_t close = text.find('}', open);
        if (close == std::string_view::npos)
            break;
        names.emplace_back(text.substr(open + 1, close - open - 1));
    }
    return names;
}

Values parse_words(std::string_view markdown)
{
    Values words;
    while (!markdown.empty())
    {
        const std::size_t end = std::min(markdown.find('\n'), markdown.size());
        const std::string_view line = markdown.substr(0, end);
        const std::size_t colon = line.find(": ");
        if (line.starts_with("- ") && colon != std::string_view::npos)
            words.emplace(line.substr(2, colon - 2), line.substr(colon + 2));
        markdown.remove_prefix(std::min(end + 1, markdown.size()));
    }
    return words;
}

std::string say(std::string_view name, const Values& values)
{
    const auto found = story_words().find(name);
    if (found == story_words().end())
        return '{' + std::string(name) + '}';
    return filled(found->second, values);
}

} // namespace carom::view
