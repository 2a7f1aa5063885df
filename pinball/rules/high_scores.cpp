#include "pinball/rules/high_scores.h"

#include <algorithm>
#include <charconv>

namespace carom::pinball {

namespace {

constexpr std::size_t name_length = 3;

std::string letters_of(std::string_view name)
{
    std::string letters;
    for (const char c : name)
        if (c > ' ' && c < 127 && letters.size() < name_length)
            letters += c;
    return letters;
}

} // namespace

int HighScores::insert(HighScore entry)
{
    entry.name = letters_of(entry.name);
    const auto place = std::ranges::find_if(m_entries, [&](const HighScore& e) { return e.score < entry.score; });
    const int rank = static_cast<int>(place - m_entries.begin());
    if (rank >= places || entry.score <= 0)
        return -1;
    m_entries.insert(place, std::move(entry));
    if (m_entries.size() > places)
        m_entries.pop_back();
    return rank;
}

void HighScores::rename(int rank, std::string_view name)
{
    if (rank >= 0 && rank < static_cast<int>(m_entries.size()))
        m_entries[static_cast<std::size_t>(rank)].name = letters_of(name);
}

std::string HighScores::to_text() const
{
    std::string text;
    for (const HighScore& entry : m_entries)
        text += std::to_string(entry.score) + ' ' + entry.name + '\n';
    return text;
}

HighScores HighScores::from_text(std::string_view text)
{
    HighScores scores;
    while (!text.empty())
    {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        HighScore entry;
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), entry.score);
        if (error != std::errc{})
            continue;
        entry.name = line.substr(static_cast<std::size_t>(end - line.data()));
        scores.insert(std::move(entry));
    }
    return scores;
}

} // namespace carom::pinball
