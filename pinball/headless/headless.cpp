#include "pinball/headless/headless.h"

#include "pinball/headless/games.h"
#include "pinball/headless/run.h"
#include "pinball/table/loader.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <unistd.h>

namespace carom::pinball {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int) { interrupted = 1; }

std::optional<Table> load(const std::string& file)
{
    LoadResult result = load_table_file(file);
    for (const LoadError& error : result.errors)
        std::cerr << file << ":" << to_string(error) << '\n';
    return std::move(result.table);
}

void show_progress(const Stats& stats, int balls, bool last)
{
    std::fprintf(stderr, "\r%d of %d balls, mean %.1f s, %d escaped, %d stuck, %.1f us a step %s", stats.balls(), balls,
                 stats.mean_ball_time(), stats.escaped(), stats.stuck(), stats.mean_step_us(), last ? "\n" : "");
}

void play(HeadlessRun& run, int balls)
{
    constexpr std::int64_t steps_between_lines = 50'000;
    const bool on_terminal = isatty(STDERR_FILENO) != 0;
    for (std::int64_t i = 1; run.stats().balls() < balls && !interrupted; ++i)
    {
        run.step();
        if (on_terminal && i % steps_between_lines == 0)
            show_progress(run.stats(), balls, false);
    }
    if (on_terminal)
        show_progress(run.stats(), balls, true);
}

bool write(const std::string& file, const std::string& text)
{
    if (file.empty())
    {
        std::cout << text;
        return true;
    }
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out)
        std::cerr << file << ": cannot be written\n";
    return static_cast<bool>(out);
}

// Better now than after an hour of play.
bool can_write(const std::string& file)
{
    const bool can = file.empty() || std::ofstream(file, std::ios::app);
    if (!can)
        std::cerr << file << ": cannot be written\n";
    return can;
}

} // namespace

int run_headless(const HeadlessOptions& options)
{
    const std::string file = options.table.empty() ? CAROM_TABLES_DIR "/momentum.table.json" : options.table;
    if (!options.watch.empty())
        return watch_game(options.watch);
    if (!options.record.empty())
        return record_game(file, options.seed, options.record);
    const std::optional<Table> table = load(file);
    if (!table || !can_write(options.stats))
        return 1;
    interrupted = 0;
    const auto before = std::signal(SIGINT, on_interrupt);
    HeadlessRun run(*table, options.seed, options.balls_at_once);
    play(run, options.balls);
    run.finish();
    std::signal(SIGINT, before);
    if (!write(options.stats, run.stats().to_json(table->name, options.seed)))
        return 1;
    return interrupted ? 130 : 0;
}

int headless_command(int argc, char** argv)
{
    CLI::App app{"Plays by itself without a window and counts."};
    HeadlessOptions options;
    bool headless = false;
    app.add_flag("--headless", headless, "this mode");
    app.add_option("--ai", options.ai, "who plays")->check(CLI::IsMember({"reflex"}));
    app.add_option("--seed", options.seed, "of the game and the player");
    app.add_option("--balls", options.balls, "to serve, saved ones included")->check(CLI::Range(1, 10'000'000));
    app.add_option("--balls-at-once", options.balls_at_once, "kept in play, whatever the table's rules")->check(CLI::Range(1, 8));
    app.add_option("--stats", options.stats, "JSON file for the numbers");
    auto* record = app.add_option("--record", options.record, "play one game and write it to this file, by its inputs");
    app.add_option("--watch", options.watch, "play this recorded game again and say whether it comes out the same")
        ->check(CLI::ExistingFile)
        ->excludes(record);
    app.add_option("--table", options.table, "table file")->check(CLI::ExistingFile);
    CLI11_PARSE(app, argc, argv);
    return run_headless(options);
}

} // namespace carom::pinball
