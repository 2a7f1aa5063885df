// carom-truth: experiments with known answers, run on Carom and on the engines installed beside it.

#include "truth/pictures.h"
#include "truth/report.h"

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>

namespace {

volatile std::sig_atomic_t stop_asked = 0;
void ask_stop(int) { stop_asked = 1; }

struct Options
{
    double hz = 60;
    int subdivisions = 32;
    double share = 1;
    std::vector<int> only{};
    bool json = false;
    bool peers = true;
    bool converge = false;
    std::filesystem::path plot{};
};

/// One line on a terminal, rewritten in place; looks for Ctrl-C on the way.
class Progress
{
public:
    explicit Progress(std::string prefix) : m_prefix(std::move(prefix)) {}
    void operator()(const std::string& what)
    {
        if (stop_asked)
        {
            throw truth::Interrupted{};
        }
        if (isatty(STDERR_FILENO) && what != m_last)
        {
            m_last = what;
            std::cerr << "\r\033[K" << m_prefix << ": " << what << std::flush;
        }
    }
    static void clear()
    {
        if (isatty(STDERR_FILENO))
        {
            std::cerr << "\r\033[K" << std::flush;
        }
    }

private:
    std::string m_prefix;
    std::string m_last = "none yet";
};

truth::Metrics run(const truth::Experiment& experiment, const truth::Engine& engine, const Options& options, double hz)
{
    Progress progress(std::to_string(experiment.number) + ". " + experiment.title + ", " + engine.name);
    progress("");
    const truth::Setup setup{.engine = engine, .hz = hz, .share = options.share, .progress = progress};
    truth::Metrics metrics = experiment.run(setup);
    Progress::clear();
    return metrics;
}

void run_all_engines(const truth::Experiment& experiment, const std::vector<truth::Engine>& engines, const Options& options,
                     truth::Results& results)
{
    std::vector<truth::Row> rows;
    for (const truth::Metric& metric : run(experiment, engines.front(), options, options.hz))
    {
        rows.push_back({.ours = metric});
    }
    if (options.converge && experiment.shrinks)
    {
        const truth::Metrics finer = run(experiment, engines.front(), options, 4 * options.hz);
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            rows[i].finer_error = finer[i].error();
            rows[i].converges = !finer[i].has_bound() || truth::converges(rows[i].ours, finer[i]);
        }
    }
    for (std::size_t e = 1; e < engines.size(); ++e)
    {
        const truth::Metrics peer = run(experiment, engines[e], options, options.hz);
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            rows[i].peers.push_back(peer[i].value);
        }
    }
    results.rows.insert(results.rows.end(), rows.begin(), rows.end());
}

bool wanted(const Options& options, int number)
{
    return options.only.empty() || std::find(options.only.begin(), options.only.end(), number) != options.only.end();
}

std::vector<truth::Engine> chosen_engines(const Options& options)
{
    std::vector<truth::Engine> engines = truth::engines();
    engines.front() = truth::carom_engine(options.subdivisions);
    engines.resize(options.peers ? engines.size() : 1);
    return engines;
}

void draw_all(const Options& options)
{
    std::filesystem::create_directories(options.plot);
    for (const truth::Picture& picture : truth::pictures())
    {
        if (!wanted(options, picture.experiment))
        {
            continue;
        }
        std::vector<truth::Setup> setups;
        for (const truth::Engine& engine : chosen_engines(options))
        {
            setups.push_back({.engine = engine, .hz = options.hz, .progress = Progress(picture.file + ", " + engine.name)});
        }
        picture.draw(setups, options.plot / picture.file);
        Progress::clear();
        std::cout << (options.plot / picture.file).string() << std::endl;
    }
}

truth::Results run_all(const Options& options)
{
    const std::vector<truth::Engine> engines = chosen_engines(options);
    truth::Results results{.convergence = options.converge};
    for (std::size_t i = 1; i < engines.size(); ++i)
    {
        results.peer_names.push_back(engines[i].name);
    }
    if (!options.json)
    {
        truth::print_header(std::cout, results, options.hz);
    }
    try
    {
        for (const truth::Experiment& experiment : truth::experiments())
        {
            if (wanted(options, experiment.number))
            {
                run_all_engines(experiment, engines, options, results);
                if (!options.json)
                {
                    truth::print_experiment(std::cout, results, experiment);
                }
            }
        }
    }
    catch (const truth::Interrupted&)
    {
        std::cerr << "\nstopped; what was finished follows or stands above\n";
    }
    return results;
}

std::string check_number(const std::string& text)
{
    return truth::find_experiment(std::atoi(text.c_str())) ? std::string() : "there is no experiment " + text;
}

/// 0, or what to leave the program with.
int plot(const Options& options)
{
    try
    {
        draw_all(options);
        return 0;
    }
    catch (const truth::Interrupted&)
    {
        return 130;
    }
    catch (const std::exception& error)
    {
        std::cerr << "carom-truth: " << error.what() << '\n';
        return 1;
    }
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app{
        "Experiments with known answers: exact value, ours, how far off it may be, and the engines installed beside it."};
    app.add_option("--hz", options.hz, "steps per second")->check(CLI::Range(10.0, 100000.0))->capture_default_str();
    app.add_option("--only", options.only, "numbers of experiments, as in 1,9")->delimiter(',')->check(check_number);
    app.add_option("--subdivisions", options.subdivisions, "most subdivisions of a sub-step (SceneDef::most_subdivisions)")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    app.add_option("--share", options.share, "fraction of the cases to run")->check(CLI::Range(0.01, 1.0))->capture_default_str();
    app.add_flag("--json", options.json, "print a list of {experiment, metric, exact, value, bound, ok}");
    app.add_flag("!--no-peers", options.peers, "run Carom alone");
    app.add_flag("--converge", options.converge, "also run at four times the rate: the errors must shrink");
    app.add_option("--plot", options.plot, "write pictures of experiments 1, 6 and 15 as SVG into this folder, and no table");
    CLI11_PARSE(app, argc, argv);

    std::signal(SIGINT, ask_stop);
    if (!options.plot.empty())
    {
        return plot(options);
    }
    const truth::Results results = run_all(options);
    if (options.json)
    {
        truth::print_json(std::cout, results);
    }
    else
    {
        truth::print_summary(std::cout, results);
    }
    return stop_asked ? 130 : truth::all_ok(results) ? 0 : 1;
}
