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
    /// Keeps the scores of other tables. A broken file is put aside as *.broken. False where nothing could be written.
    bool save(const std::string& table, const HighScores& scores) const;

private:
    std::filesystem::path m_file;
};

} // namespace carom::pinball
