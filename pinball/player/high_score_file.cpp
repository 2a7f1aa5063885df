#include "pinball/player/high_score_file.h"

#include <SDL_filesystem.h>
#include <SDL_stdinc.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <system_error>
#include <thread>

namespace carom::pinball {

namespace {

using Json = nlohmann::json;

// Discarded: there is none, or it is not ours.
Json read(const std::filesystem::path& file)
{
    std::ifstream in(file);
    Json json = in ? Json::parse(in, nullptr, false) : Json(Json::value_t::discarded);
    const bool ours = json.is_object() && json.contains("tables") && json["tables"].is_object();
    return ours ? json : Json(Json::value_t::discarded);
}

Json to_json(const HighScores& scores)
{
    Json list = Json::array();
    for (const HighScore& entry : scores.entries())
        list.push_back({{"name", entry.name}, {"score", entry.score}});
    return list;
}

void set_aside(const std::filesystem::path& file)
{
    std::error_code ignored;
    std::filesystem::rename(file, file.string() + ".broken", ignored);
}

} // namespace

HighScoreFile HighScoreFile::of_user()
{
    char* folder = SDL_GetPrefPath("Carom", "pinball");
    std::filesystem::path file = folder != nullptr ? std::filesystem::path(folder) / "high_scores.json" : std::filesystem::path{};
    SDL_free(folder);
    return HighScoreFile(std::move(file));
}

HighScores HighScoreFile::load(const std::string& table) const
{
    HighScores scores;
    const Json json = read(m_file);
    if (json.is_discarded() || !json["tables"].contains(table) || !json["tables"][table].is_array())
        return scores;
    for (const Json& entry : json["tables"][table])
    {
        const bool whole = entry.is_object() && entry.contains("name") && entry["name"].is_string() && entry.contains("score") &&
                           entry["score"].is_number_integer();
        if (whole)
            scores.insert({entry["name"].get<std::string>(), entry["score"].get<std::int64_t>()});
    }
    return scores;
}

namespace {

// A file that only one can make. One that is older than any write takes was left by a crash.
class Lock
{
public:
    explicit Lock(const std::filesystem::path& file) : m_file(file.string() + ".lock")
    {
        for (int tries = 0; tries < 200 && !m_held; ++tries)
        {
            if (std::FILE* made = std::fopen(m_file.c_str(), "wx"))
            {
                std::fclose(made);
                m_held = true;
                return;
            }
            if (errno != EEXIST)
                return; // nothing can be written there, as whoever writes will find
            break_if_old();
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    ~Lock()
    {
        std::error_code ignored;
        if (m_held)
            std::filesystem::remove(m_file, ignored);
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    void break_if_old() const
    {
        std::error_code error;
        const auto made = std::filesystem::last_write_time(m_file, error);
        if (!error && std::filesystem::file_time_type::clock::now() - made > std::chrono::seconds(5))
            std::filesystem::remove(m_file, error);
    }

    std::filesystem::path m_file;
    bool m_held = false;
};

std::string why_not(const std::filesystem::path& file)
{
    return "high scores cannot be kept: " + file.string() + ": " + std::generic_category().message(errno != 0 ? errno : EIO);
}

} // namespace

// Through a file beside it, so that a crash in the middle leaves the old scores.
std::string HighScoreFile::add(const std::string& table, const HighScore& score) const
{
    if (m_file.empty())
        return "high scores cannot be kept: there is no folder for them (is HOME set?)";
    const Lock lock(m_file);
    HighScores scores = load(table);
    scores.insert(score);
    Json json = read(m_file);
    if (json.is_discarded())
    {
        set_aside(m_file);
        json = {{"format", "carom-high-scores"}, {"version", 1}, {"tables", Json::object()}};
    }
    json["tables"][table] = to_json(scores);
    const std::filesystem::path fresh = m_file.string() + ".new";
    errno = 0;
    std::ofstream out(fresh);
    out << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
    out.close();
    if (!out)
        return why_not(fresh);
    std::error_code error;
    std::filesystem::rename(fresh, m_file, error);
    return error ? "high scores cannot be kept: " + m_file.string() + ": " + error.message() : "";
}

} // namespace carom::pinball
