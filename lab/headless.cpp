#include "lab/headless.h"

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>

namespace carom::lab {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int) { interrupted = 1; }

/// One line on a terminal that is rewritten; silent in the first two seconds.
class Progress
{
public:
    Progress(std::string_view name, int total) : m_name(name), m_total(total), m_terminal(isatty(STDERR_FILENO) != 0) {}
    ~Progress()
    {
        if (m_shown)
            std::fprintf(stderr, "\r\033[K");
    }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void at(int step)
    {
        const auto now = Clock::now();
        if (!m_terminal || now < m_next)
            return;
        m_next = now + std::chrono::milliseconds(200);
        m_shown = true;
        std::fprintf(stderr, "\r\033[K%s: step %d of %d, Ctrl-C reports what is done", m_name.c_str(), step, m_total);
    }

private:
    using Clock = std::chrono::steady_clock;
    std::string m_name;
    int m_total;
    bool m_terminal;
    bool m_shown = false;
    Clock::time_point m_next = Clock::now() + std::chrono::seconds(2);
};

struct Totals
{
    double sweep = 0, pairs = 0, contacts = 0, islands = 0, solve = 0, commit = 0, events = 0, total = 0;
    std::uint32_t flags = 0;

    void add(const StepReport& report)
    {
        const StageTimes& ms = report.ms;
        const auto sum = [](double& to, float value) { to += static_cast<double>(value); };
        sum(sweep, ms.sweep);
        sum(pairs, ms.pairs);
        sum(contacts, ms.contacts);
        sum(islands, ms.islands);
        sum(solve, ms.solve);
        sum(commit, ms.commit);
        sum(events, ms.events);
        sum(total, ms.total);
        flags |= report.flags;
    }
};

nlohmann::ordered_json stage_means(const Totals& t, int steps)
{
    const double n = steps > 0 ? steps : 1;
    return {{"sweep", t.sweep / n}, {"pairs", t.pairs / n},   {"contacts", t.contacts / n}, {"islands", t.islands / n},
            {"solve", t.solve / n}, {"commit", t.commit / n}, {"events", t.events / n},     {"total", t.total / n}};
}

nlohmann::ordered_json flag_names(std::uint32_t flags)
{
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    const std::pair<StepFlag, const char*> known[] = {{StepFlag::BodyQuarantined, "body_quarantined"},
                                                      {StepFlag::ImpactsCapped, "impacts_capped"},
                                                      {StepFlag::ColorsExhausted, "colors_exhausted"},
                                                      {StepFlag::TimeDropped, "time_dropped"}};
    for (const auto& [flag, name] : known)
        if ((flags & static_cast<std::uint32_t>(flag)) != 0)
            names.push_back(name);
    return names;
}

std::string hex(std::uint64_t value)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

double kinetic_energy(const Scene& scene)
{
    double sum = 0;
    for (const BodyId body : scene.bodies())
        sum += static_cast<double>(scene.body(body).kinetic_energy());
    return sum;
}

nlohmann::ordered_json describe(const HeadlessRun& run, const Scene& scene, const Totals& totals, int steps, float h)
{
    const StepReport& report = scene.report();
    return {{"scene", run.entry->name},
            {"steps", steps},
            {"h", h},
            {"bodies", report.bodies},
            {"awake_bodies", report.awake_bodies},
            {"shapes", report.shapes},
            {"joints", report.joints},
            {"pairs", report.pairs},
            {"touching", report.touching},
            {"hash", hex(scene.state_hash())},
            {"kinetic_energy", kinetic_energy(scene)},
            {"ms", stage_means(totals, steps)},
            {"flags", flag_names(totals.flags)}};
}

} // namespace

std::string run_headless(const HeadlessRun& run)
{
    const auto previous = std::signal(SIGINT, on_interrupt);
    const float h = run.h > 0 ? run.h : run.entry->h;
    scenes::BuiltScene built = run.entry->create(run.base);
    Totals totals;
    int done = 0;
    {
        Progress progress(run.entry->name, run.steps);
        for (; done < run.steps && interrupted == 0; ++done)
        {
            totals.add(built.step(h));
            progress.at(done + 1);
        }
    }
    std::signal(SIGINT, previous);
    return describe(run, built.scene, totals, done, h).dump();
}

} // namespace carom::lab
