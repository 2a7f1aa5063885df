#include "pinball/player/game_files.h"

#include <SDL_filesystem.h>
#include <SDL_stdinc.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <system_error>
#include <vector>

namespace carom::pinball {

namespace {

namespace fs = std::filesystem;

constexpr const char* extension = ".game.json";

// Names sort by time; two games of one second are told apart by a letter.
std::string name_of_now()
{
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d-%H%M%S", &utc);
    return text;
}

// From the oldest to the newest.
std::vector<fs::path> files_in(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().string().ends_with(extension))
            files.push_back(entry->path());
    std::ranges::sort(files);
    return files;
}

} // namespace

GameFiles GameFiles::of_user()
{
    char* folder = SDL_GetPrefPath("Carom", "pinball");
    fs::path games = folder != nullptr ? fs::path(folder) / "games" : fs::path{};
    SDL_free(folder);
    return GameFiles(std::move(games));
}

std::string GameFiles::add(const Recording& recording) const
{
    std::error_code error;
    if (m_folder.empty() || (fs::create_directories(m_folder, error), error))
        return "The game cannot be kept: there is no folder for it.";
    const std::string name = name_of_now();
    fs::path file = m_folder / (name + extension);
    for (char letter = 'b'; fs::exists(file, error) && letter <= 'z'; ++letter)
        file = m_folder / (name + letter + extension);
    if (std::string trouble = recording.save(file); !trouble.empty())
        return trouble;
    const std::vector<fs::path> files = files_in(m_folder);
    for (std::size_t i = 0; i + most_files < files.size(); ++i)
        fs::remove(files[i], error);
    return {};
}

std::optional<fs::path> GameFiles::newest() const
{
    const std::vector<fs::path> files = files_in(m_folder);
    return files.empty() ? std::nullopt : std::optional(files.back());
}

} // namespace carom::pinball
