#pragma once

/// @file
/// The ten best games: a value. Whoever owns a disk loads and saves it as text.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace carom::pinball {

struct HighScore
{
    std::string name{}; ///< up to three letters
    std::int64_t score = 0;
    friend bool operator==(const HighScore&, const HighScore&) = default;
};

class HighScores
{
public:
    static constexpr int places = 10;

    /// Where the score stands now, from 0, or -1 where it is not among the best. A later equal score ranks behind.
    int insert(HighScore entry);
    void rename(int rank, std::string_view name);
    [[nodiscard]] const std::vector<HighScore>& entries() const { return m_entries; }
    [[nodiscard]] std::int64_t best() const { return m_entries.empty() ? 0 : m_entries.front().score; }

    /// One line a place: the score, a space, the name.
    [[nodiscard]] std::string to_text() const;
    /// Reads what to_text writes; lines that are no entry are passed over.
    [[nodiscard]] static HighScores from_text(std::string_view text);

private:
    std::vector<HighScore> m_entries{};
};

} // namespace carom::pinball
