#include "tour/text.h"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace carom::tour {
namespace {

constexpr std::string_view try_it = "Try";
constexpr std::string_view controls = "Controls";
constexpr std::string_view words = "Words";
constexpr std::string_view formula_indent = "    ";

std::string_view without_blanks(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

class Parser
{
public:
    explicit Parser(const std::string& file) : m_file(file) {}

    ChapterText parse(std::string_view markdown)
    {
        while (!markdown.empty())
        {
            const std::size_t end = markdown.find('\n');
            ++m_line;
            read(markdown.substr(0, end));
            markdown = end == std::string_view::npos ? std::string_view{} : markdown.substr(end + 1);
        }
        if (m_text.title.empty())
            fail("there is no title (a line \"# ...\")");
        return std::move(m_text);
    }

private:
    void read(std::string_view line)
    {
        const std::string_view words_of_line = without_blanks(line);
        if (words_of_line.empty())
            m_goes_on = false;
        else if (words_of_line.starts_with("<!--"))
            read_setting(words_of_line);
        else if (line.starts_with("# "))
            m_text.title = without_blanks(line.substr(2));
        else if (line.starts_with("## "))
            begin_part(without_blanks(line.substr(3)));
        else if (line.starts_with("- "))
            read_entry(without_blanks(line.substr(2)));
        else if (line.starts_with(formula_indent) && !(m_goes_on && last_is(Block::Kind::Task)))
            append(Block::Kind::Formula, words_of_line);
        else
            read_prose(words_of_line);
    }

    // <!-- name: 3 -->
    void read_setting(std::string_view line)
    {
        const std::size_t colon = line.find(": ");
        const std::size_t end = line.find("-->");
        if (colon == std::string_view::npos || end == std::string_view::npos || colon > end)
            fail("a setting is no \"<!-- name: number -->\"");
        m_sets[std::string(without_blanks(line.substr(4, colon - 4)))] = std::stof(std::string(line.substr(colon + 2, end - colon - 2)));
        m_goes_on = false;
    }

    void begin_part(std::string_view name)
    {
        m_part = name;
        m_goes_on = false;
        if (m_part != controls && m_part != words)
            append(Block::Kind::Heading, name);
    }

    void read_entry(std::string_view entry)
    {
        if (m_part == try_it)
        {
            append(Block::Kind::Task, entry);
            m_goes_on = true;
            return;
        }
        if (m_part != controls && m_part != words)
            fail("a list stands in none of the parts Try, Controls and Words");
        const std::size_t colon = entry.find(": ");
        if (colon == std::string_view::npos)
            fail("a list entry is no \"name: text\"");
        Values& list = m_part == controls ? m_text.controls : m_text.words;
        list[std::string(entry.substr(0, colon))] = without_blanks(entry.substr(colon + 2));
    }

    // Lines without a blank one between them are one paragraph.
    void read_prose(std::string_view line)
    {
        if (m_part == controls || m_part == words)
            fail("prose stands among the names");
        if (m_goes_on)
        {
            m_text.blocks.back().text += ' ';
            m_text.blocks.back().text += line;
            return;
        }
        append(Block::Kind::Paragraph, line);
        m_goes_on = true;
    }

    void append(Block::Kind kind, std::string_view text)
    {
        m_text.blocks.push_back({kind, std::string(text), std::exchange(m_sets, {})});
        m_goes_on = false;
    }

    [[nodiscard]] bool last_is(Block::Kind kind) const { return !m_text.blocks.empty() && m_text.blocks.back().kind == kind; }

    [[noreturn]] void fail(const char* what) const
    {
        throw std::runtime_error(m_file + ", line " + std::to_string(m_line) + ": " + what);
    }

    const std::string& m_file;
    ChapterText m_text{};
    std::string m_part{};
    std::map<std::string, float> m_sets{}; ///< for the next block
    int m_line = 0;
    bool m_goes_on = false; ///< the next line belongs to the last block
};

} // namespace

ChapterText parse_text(std::string_view markdown, const std::string& file) { return Parser(file).parse(markdown); }

ChapterText load_text(const std::string& name, const std::string& language)
{
    const std::string file = std::string(CAROM_TOUR_TEXT_DIR) + '/' + language + '/' + name + ".md";
    std::ifstream in(file);
    if (!in)
        throw std::runtime_error(file + ": there is no such chapter");
    const std::string markdown{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    return parse_text(markdown, file);
}

} // namespace carom::tour
