#pragma once

/// @file
/// High scores between runs: one JSON file for all tables.

#include "pinball/rules/high_scores.h"

#include <filesystem>
#include <string>

namespace carom::pinball {

class HighScoreFile
{
public:
    explicit HighScoreFile(std::filesystem::path file) : m_file(std::move(file)) {}
    /// The file in the user's data directory; without one nothing is kept.
    [[nodiscard]] static HighScoreFile of_user();

    /// No file, or one that cannot be read: no scores.
    [[nodiscard]] HighScores load(const std::string& table) const;
    /// Adds one to those that the file has by now, under a lock: several machines may run. Scores of other tables are kept; a broken file is put
    /// aside as *.broken. Empty, or a sentence that says why the score cannot be kept.
    [[nodiscard]] std::string add(const std::string& table, const HighScore& score) const;

private:
    std::filesystem::path m_file;
};

} // namespace carom::pinball
