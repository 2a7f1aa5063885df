#include "pinball/player/high_score_file.h"

#include <SDL_filesystem.h>
#include <SDL_stdinc.h>
#include <nlohmann/json.hpp>

#include <fstream>

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

// Through a file beside it, so that a crash in the middle leaves the old scores.
bool HighScoreFile::save(const std::string& table, const HighScores& scores) const
{
    if (m_file.empty())
        return false;
    Json json = read(m_file);
    if (json.is_discarded())
    {
        set_aside(m_file);
        json = {{"format", "carom-high-scores"}, {"version", 1}, {"tables", Json::object()}};
    }
    json["tables"][table] = to_json(scores);
    const std::filesystem::path fresh = m_file.string() + ".new";
    std::ofstream out(fresh);
    out << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
    out.close();
    if (!out)
        return false;
    std::error_code error;
    std::filesystem::rename(fresh, m_file, error);
    return !error;
}

} // namespace carom::pinball
