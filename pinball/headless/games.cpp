#include "pinball/headless/games.h"

#include "pinball/autoplay/reflex.h"
#include "pinball/recording/recording.h"
#include "pinball/table/loader.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace carom::pinball {

namespace {

constexpr std::int64_t longest_game = 3'600'000; // steps

bool has_ended(const Game& game)
{
    return std::ranges::any_of(game.events(), [](const GameEvent& event) { return event.kind == EventKind::GameEnded; });
}

void show_progress(const Game& game)
{
    constexpr std::int64_t steps_between_lines = 50'000;
    if (game.step_count() % steps_between_lines == 0 && isatty(STDERR_FILENO) != 0)
        std::fprintf(stderr, "\r%.0f s, score %lld ",
                     static_cast<double>(game.step_count()) * static_cast<double>(game.table().physics.step),
                     static_cast<long long>(game.score()));
}

void report(const Game& game)
{
    const double seconds = static_cast<double>(game.step_count()) * static_cast<double>(game.table().physics.step);
    std::printf("%s: %.1f s, score", game.table().name.c_str(), seconds);
    for (const std::int64_t score : scores_of(game))
        std::printf(" %lld", static_cast<long long>(score));
    std::printf(", hash %016llx\n", static_cast<unsigned long long>(game.state_hash()));
}

} // namespace

int record_game(const std::string& table_file, std::uint64_t seed, const std::string& file)
{
    std::error_code ignored;
    if (std::filesystem::equivalent(table_file, file, ignored))
    {
        std::cerr << file << " is the table itself\n";
        return 1;
    }
    LoadResult result = load_table_file(table_file);
    for (const LoadError& error : result.errors)
        std::cerr << table_file << ":" << to_string(error) << '\n';
    if (!result.table)
        return 1;
    if (!std::ofstream(file, std::ios::app)) // better now than after the game
    {
        std::cerr << file << ": cannot be written\n";
        return 1;
    }
    const Options options{.seed = seed};
    Game game(*result.table, options);
    ReflexPlayer player(*result.table, seed);
    Recorder recorder(std::move(result.text), options);
    do
    {
        const Input input = player.play(game);
        recorder.note(input);
        game.step(input);
        show_progress(game);
    } while (!has_ended(game) && game.step_count() < longest_game);
    const Recording recording = recorder.recording(game);
    if (const std::string trouble = recording.save(file); !trouble.empty())
    {
        std::cerr << trouble << '\n';
        return 1;
    }
    report(game);
    return 0;
}

int watch_game(const std::string& file)
{
    LoadedRecording loaded = load_recording(file);
    if (!loaded.recording)
    {
        std::cerr << loaded.trouble << '\n';
        return 1;
    }
    Playback playback(std::move(*loaded.recording));
    Game game = playback.new_game();
    while (!playback.is_over())
    {
        game.step(playback.next());
        show_progress(game);
    }
    report(game);
    const bool same = playback.came_out_the_same(game);
    std::puts(same ? "the same game to the last bit" : "it came out differently: this is another version of the machine");
    return same ? 0 : 1;
}

} // namespace carom::pinball
