// carom-bench: the ten scenes of Box2D's benchmark program, timed on Carom and on the engines installed beside it, with the quality of
// the same run.

#include "speed/company.h"
#include "speed/flight_cost.h"
#include "speed/report.h"
#include "speed/scaling.h"
#include "truth/chart.h"

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iostream>

namespace {

using carom::scenes::SceneEntry;

volatile std::sig_atomic_t stop_asked = 0;
void ask_stop(int) { stop_asked = 1; }

struct Options
{
    std::string scene = "all";
    std::vector<std::string> engines{"carom"};
    speed::RunOptions run{};
    std::string csv;
    bool json = false;
    bool list = false;
    bool verify = false;
    bool flight = false;
    bool company = false;
    int scaling = 0; ///< most bodies; 0: not asked for
    std::string plot;
};

/// One line on a terminal, rewritten in place a few times a second; looks for Ctrl-C on the way.
void show_progress(const std::string& what)
{
    using Clock = std::chrono::steady_clock;
    static Clock::time_point next;
    if (stop_asked)
        throw speed::Interrupted{};
    if (isatty(STDERR_FILENO) && Clock::now() > next)
    {
        next = Clock::now() + std::chrono::milliseconds(200);
        std::cerr << "\r\033[K" << what << std::flush;
    }
}

void clear_progress()
{
    if (isatty(STDERR_FILENO))
        std::cerr << "\r\033[K" << std::flush;
}

std::vector<const SceneEntry*> chosen_scenes(const std::string& name)
{
    std::vector<const SceneEntry*> list;
    if (name == "all")
        for (const SceneEntry& entry : carom::scenes::benchmark_scenes())
            list.push_back(&entry);
    else if (const SceneEntry* entry = carom::scenes::find_scene(name))
        list.push_back(entry);
    else
        throw std::runtime_error("there is no scene \"" + name + "\"; --list names them");
    return list;
}

speed::Contender chosen_engine(const std::string& key, int threads)
{
    const std::vector<speed::Contender> all = speed::contenders();
    const auto found = std::find_if(all.begin(), all.end(), [&](const speed::Contender& c) { return c.key == key; });
    if (found == all.end())
        throw std::runtime_error("the engine \"" + key +
                                 "\" was not found when carom-bench was built; --list names those that were");
    if (threads > found->most_threads)
        throw std::runtime_error("--threads " + std::to_string(threads) + ": " + found->name + " uses " +
                                 std::to_string(found->most_threads) + " at most");
    return *found;
}

void run_one(const SceneEntry& scene, const speed::Contender& engine, const Options& options, std::vector<speed::Result>& results)
try
{
    results.push_back(speed::run(scene, engine, options.run));
    clear_progress();
    if (!options.json)
        speed::print_times(std::cout, results.back());
}
catch (const truth::Missing& missing)
{
    std::cerr << "carom-bench: " << scene.name << " is left out for " << engine.name << ", which has no " << missing.what()
              << '\n';
}

int benchmark(const Options& options)
{
    std::vector<speed::Contender> engines;
    for (const std::string& key : options.engines)
        engines.push_back(chosen_engine(key, options.run.threads));
    std::vector<speed::Result> results;
    if (!options.json)
        speed::print_times_header(std::cout);
    try
    {
        for (const SceneEntry* scene : chosen_scenes(options.scene))
            for (const speed::Contender& engine : engines)
                run_one(*scene, engine, options, results);
    }
    catch (const speed::Interrupted&)
    {
        std::cerr << "\nstopped; what was finished follows or stands above\n";
    }
    if (options.json)
        speed::print_json(std::cout, results);
    else if (!results.empty())
    {
        speed::print_quality(std::cout, results);
        speed::print_memory(std::cout, results);
    }
    if (!options.csv.empty())
    {
        std::ofstream file(options.csv);
        speed::print_csv(file, results);
        if (!file.flush())
            throw std::runtime_error("--csv " + options.csv + ": cannot be written");
    }
    const bool same = std::ranges::all_of(results, &speed::Result::repeats);
    return stop_asked ? 130 : same ? 0 : 1;
}

/// Empty where all thread counts give the same hashes all along; else where they part.
std::string compare_threads(const SceneEntry& scene, const speed::Contender& carom, speed::RunOptions run, std::uint64_t& last)
{
    run.threads = 1;
    const std::vector<std::uint64_t> want = speed::hashes(scene, carom, run);
    last = want.back();
    for (const int threads : {2, 3, 8})
    {
        run.threads = threads;
        const std::vector<std::uint64_t> got = speed::hashes(scene, carom, run);
        const auto parted = std::mismatch(want.begin(), want.end(), got.begin()).first - want.begin();
        if (parted != static_cast<std::ptrdiff_t>(want.size()))
            return "with " + std::to_string(threads) + " threads other bits within the first " +
                   std::to_string((parted + 1) * speed::hash_interval) + " steps";
    }
    return {};
}

int verify(const Options& options)
{
    const speed::Contender carom = chosen_engine("carom", 1);
    bool good = true;
    for (const SceneEntry* scene : chosen_scenes(options.scene))
    {
        std::uint64_t last = 0;
        const std::string difference = compare_threads(*scene, carom, options.run, last);
        good = good && difference.empty();
        clear_progress();
        const std::string verdict = difference.empty() ? "the same with 1, 2, 3 and 8 threads" : "NO: " + difference;
        std::printf("%-14s %016llx  %s\n", std::string(scene->name).c_str(), static_cast<unsigned long long>(last),
                    verdict.c_str());
        std::fflush(stdout);
    }
    return good ? 0 : 1;
}

// Each line as soon as it is known.
int show_scaling(const Options& options)
{
    const auto say = [](const char* format, auto... values)
    {
        clear_progress();
        if constexpr (sizeof...(values) == 0)
            std::fputs(format, stdout);
        else
            std::printf(format, values...);
        std::fflush(stdout);
    };
    std::vector<truth::Series> piles;
    for (const int threads : options.run.threads > 1 ? std::vector{1, options.run.threads} : std::vector{1})
    {
        say("A stirred pile, %d threads\n%10s %10s %6s %12s %8s %12s", threads, "bodies", "pairs", "steps", "ms/step", "B/body",
            "ns/body:");
        for (const char* stage : speed::stage_names)
            say(" %8s", stage);
        say("\n");
        const std::string name = std::to_string(threads) + (threads > 1 ? " threads" : " thread");
        piles.push_back({.name = name, .color = threads > 1 ? "#d55e00" : "#0072b2", .lines = {{}}});
        speed::RunOptions run = options.run;
        run.threads = threads;
        for (int n = 1000; n <= options.scaling; n *= 10)
        {
            const speed::PileCost c = speed::pile_cost(n, run);
            say("%10d %10d %6d %12.3f %8.0f %12.0f", c.bodies, c.pairs, c.steps, c.ms_per_step, c.bytes_per_body, c.ns_per_body);
            for (const double ns : c.stages)
                say(" %8.0f", ns);
            say("\n");
            piles.back().lines.front().push_back({std::log10(c.pairs), 1e6 * c.ms_per_step / c.pairs});
        }
    }
    if (!options.plot.empty())
        truth::write_svg({.title = "A stirred pile: how cost grows",
                          .x_label = "pairs, power of ten (bodies: a third of it)",
                          .y_label = "ns a pair and step",
                          .series = piles},
                         std::filesystem::path(options.plot) / "scaling.svg");
    say("\nBoxes that never move\n%10s %10s %12s %12s\n", "boxes", "built, s", "us/step", "us/move");
    for (int n = 1000; n <= options.scaling; n *= 10)
    {
        const speed::StaticCost c = speed::static_cost(n, options.run);
        say("%10d %10.2f %12.2f %12.2f\n", c.shapes, c.build_s, c.us_per_step, c.us_per_move);
    }
    say("\nSmall scenes of their own\n%10s %10s %14s  %s\n", "scenes", "threads", "us/scene step", "hash of all");
    for (const int threads : {1, 2, 4})
    {
        const speed::SmallScenesCost c = speed::small_scenes_cost(std::min(10000, options.scaling), threads, options.run);
        say("%10d %10d %14.2f  %016llx\n", c.scenes, c.threads, c.us_per_step, static_cast<unsigned long long>(c.hash));
    }
    return 0;
}

int show_flight_costs(const Options& options)
{
    std::printf("Impacts at their own time, medians\n%-34s %12s %12s %8s %8s %8s %8s\n", "", "ms without", "ms with", "extra %",
                "fliers", "impacts", "others");
    speed::flight_costs(options.run,
                        [](const speed::FlightCost& c)
                        {
                            clear_progress();
                            std::printf("%-34s %12.3f %12.3f %8.1f %8d %8d %8d\n", c.what.c_str(), c.without_ms, c.with_ms,
                                        c.extra_percent(), c.fliers, c.impacts, c.others);
                            std::fflush(stdout);
                        });
    return 0;
}

int show_company_costs(const Options& options)
{
    std::printf("Truth in company, medians of a step's time\n%-28s", "");
    for (const std::string& engine : options.engines)
        std::printf(" %12s", engine.c_str());
    std::printf("   ms\n");
    speed::company_costs(options.run, options.engines,
                         [](const speed::CompanyCost& c)
                         {
                             clear_progress();
                             std::printf("%-28s", c.what.c_str());
                             for (const double ms : c.ms)
                                 std::printf(" %12.3f", ms);
                             std::printf("\n");
                             std::fflush(stdout);
                         });
    return 0;
}

int list_all()
{
    std::cout << "Engines\n";
    for (const speed::Contender& c : speed::contenders())
        std::printf("  %-14s %s, %s\n", c.key.c_str(), c.name.c_str(), c.isa.c_str());
    std::fflush(stdout);
    std::cout << "Scenes of --scene all\n";
    for (const SceneEntry& entry : carom::scenes::benchmark_scenes())
        std::cout << "  " << entry.name << ": " << entry.description << '\n';
    std::cout << "Others\n ";
    for (const SceneEntry& entry : carom::scenes::small_scenes())
        std::cout << ' ' << entry.name;
    std::cout << '\n';
    return 0;
}

void add_options(CLI::App& app, Options& o)
{
    app.add_option("--scene", o.scene, "a scene's name, or all: the ten of Box2D's benchmark")->capture_default_str();
    app.add_option("--engine", o.engines, "carom, box2d24, chipmunk, box2d3; several take turns, as in carom,box2d24")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--threads", o.run.threads, "threads a scene may use")->check(CLI::Range(1, 64))->capture_default_str();
    app.add_option("--repeat", o.run.repeat, "runs of each; the fastest counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_flag("--discrete", o.run.discrete, "without continuous collision: what impacts at their own time cost a scene");
    app.add_option("--disturbed", o.run.disturbed, "quality from so many more runs, with bodies off their places by up to 0.1 mm")
        ->check(CLI::Range(0, 100))
        ->capture_default_str();
    app.add_option("--steps", o.run.steps, "steps, the first one included (default: the scene's own number)")
        ->check(CLI::Range(2, 1000000));
    app.add_option("--finer", o.run.finer, "part each step into so many: what the scene comes to when steps are short")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    app.add_flag("--json", o.json, "print a list of {scene, engine, isa, threads, ..., quality} instead of tables");
    app.add_option("--csv", o.csv, "also write the results into this file");
    app.add_flag("--verify", o.verify, "no times: whole runs with 1, 2, 3 and 8 threads must give the same bits");
    app.add_option("--scaling", o.scaling,
                   "no scenes: how cost grows from 1,000 to so many bodies, and to as many that never move")
        ->check(CLI::Range(1000, 10000000));
    app.add_option("--plot", o.plot, "with --scaling: also draw scaling.svg into this folder")->check(CLI::ExistingDirectory);
    app.add_flag("--flight", o.flight,
                 "no scenes: what impacts at their own time cost a pile at rest, with a fast ball, and one that tumbles");
    app.add_flag("--company", o.company, "no scenes: what crowds in flight, landings, small islands and long joint graphs cost");
    app.add_flag("--list", o.list, "engines and scenes");
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app{"The scenes of Box2D's benchmark: times, stages, hashes, and the quality of the same run."};
    add_options(app, options);
    CLI11_PARSE(app, argc, argv);
    std::signal(SIGINT, ask_stop);
    options.run.progress = show_progress;
    try
    {
        return options.list          ? list_all()
               : options.scaling > 0 ? show_scaling(options)
               : options.flight      ? show_flight_costs(options)
               : options.company     ? show_company_costs(options)
               : options.verify      ? verify(options)
                                     : benchmark(options);
    }
    catch (const speed::Interrupted&)
    {
        std::cerr << "\nstopped; what was finished stands above\n";
        return 130;
    }
    catch (const std::exception& error)
    {
        std::cerr << "carom-bench: " << error.what() << '\n';
        return 1;
    }
}
