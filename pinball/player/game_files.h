#pragma once

/// @file
/// The recorded games of this user: a file each, named by its time. The newest hundred are kept.

#include "pinball/recording/recording.h"

#include <filesystem>
#include <optional>
#include <string>

namespace carom::pinball {

class GameFiles
{
public:
    static constexpr std::size_t most_files = 100;

    explicit GameFiles(std::filesystem::path folder) : m_folder(std::move(folder)) {}
    /// In the user's data directory; without one nothing is kept.
    [[nodiscard]] static GameFiles of_user();

    /// A sentence where the game cannot be kept, else nothing.
    [[nodiscard]] std::string add(const Recording& recording) const;
    [[nodiscard]] std::optional<std::filesystem::path> newest() const;

private:
    std::filesystem::path m_folder;
};

} // namespace carom::pinball
