#include "speed/run.h"

#include "speed/memory.h"
#include "speed/task_pool.h"

#include "scenes/random.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <set>
#include <utility>

namespace speed {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int samples = 10; // in the second half of the steps
constexpr int counts = 100; // in all of them

double processor_ms() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int step_count(const carom::scenes::SceneEntry& entry, const RunOptions& options)
{
    return (options.steps > 0 ? options.steps : entry.frames) * options.finer;
}

float step_length(const carom::scenes::SceneEntry& entry, const RunOptions& options)
{
    return entry.h / static_cast<float>(options.finer);
}

/// Steps a contestant and adds up what that takes.
class Stopwatch
{
public:
    explicit Stopwatch(Contestant& contestant, float h) : m_contestant(contestant), m_h(h) {}
    void step(bool counted)
    {
        m_contestant.prepare(m_h);
        const double processor_start = processor_ms();
        const Clock::time_point start = Clock::now();
        m_contestant.step(m_h);
        const std::chrono::duration<double, std::milli> took = Clock::now() - start;
        const double processor_took = processor_ms() - processor_start;
        if (!counted)
            return;
        ms += took.count();
        cpu_ms += processor_took;
        add(stages, m_contestant.stages());
    }

    double ms = 0;
    double cpu_ms = 0;
    Stages stages{};

private:
    Contestant& m_contestant;
    float m_h;
};

/// So many times in all steps, at even distances, the last of them at the end.
bool is_one_of(int times, int step, int steps)
{
    const int spacing = std::max(1, steps / times);
    return (steps - 1 - step) % spacing == 0;
}

bool is_sample(int step, int steps) { return step >= steps / 2 && is_one_of(2 * samples, step, steps); }

std::string position(const Contender& contender, const carom::scenes::SceneEntry& entry, int step, int steps)
{
    return std::string(entry.name) + ", " + contender.name + ": step " + std::to_string(step) + " of " + std::to_string(steps);
}

/// Beside the engine's own bytes stand those of the meter.
void weigh(Result& result, const Contestant& contestant, int bodies_built, std::size_t bytes_built, std::size_t bytes_of_meter)
{
    result.peak_mb = static_cast<double>(peak_bytes()) / 1e6;
    // A scene that makes bodies on its way has no weight of its own at the start.
    if (result.bodies != bodies_built)
        return;
    result.bytes_per_body = static_cast<double>(bytes_built) / bodies_built;
    const std::size_t bytes = contestant.bytes() - bytes_of_meter;
    if (result.contacts > 0 && bytes >= bytes_built)
        result.bytes_per_contact = static_cast<double>(bytes - bytes_built) / result.contacts;
}

Result describe(const carom::scenes::SceneEntry& entry, const Contender& contender, const RunOptions& options,
                Contestant& contestant, const Stopwatch& watch)
{
    return {.scene = std::string(entry.name),
            .engine = contender.key,
            .isa = contender.isa,
            .threads = options.threads,
            .bodies = static_cast<int>(contestant.scene().bodies().size()),
            .joints = static_cast<int>(contestant.scene().joints().size()),
            .contacts = contestant.contacts(),
            .steps = step_count(entry, options),
            .ms = watch.ms,
            .cpu_ms = watch.cpu_ms,
            .stages = watch.stages,
            .has_stages = watch.stages != Stages{},
            .hash = contestant.hash()};
}

SceneMaker maker_of(const carom::scenes::SceneEntry& entry) { return entry.create; }

/// Puts what is new in a scene off its place by a hair's breadth.
class Disturbance
{
public:
    explicit Disturbance(std::uint64_t seed) : m_random(seed) {}

    void disturb_new(carom::Scene& scene)
    {
        constexpr double most = 1e-4; // m
        for (const carom::BodyId id : scene.bodies())
        {
            if (!m_seen.insert(id).second)
                continue;
            carom::Body body = scene.body(id);
            const double dx = most * (2 * m_random.unit() - 1);
            const double dy = most * (2 * m_random.unit() - 1);
            if (body.type() == carom::BodyType::Dynamic)
                body.teleport({body.position().x + dx, body.position().y + dy}, body.angle());
        }
    }

private:
    carom::SplitMix64 m_random;
    std::set<carom::BodyId> m_seen{};
};

/// The same scene a hair's breadth beside itself: where it is chaotic it goes another way.
SceneMaker disturbed(const carom::scenes::SceneEntry& entry, std::uint64_t seed)
{
    return [&entry, seed](const carom::SceneDef& def)
    {
        carom::scenes::BuiltScene built = entry.create(def);
        Disturbance disturbance(seed);
        disturbance.disturb_new(built.scene);
        if (built.before_step)
        {
            built.before_step = [before = std::move(built.before_step), disturbance = std::move(disturbance)](carom::Scene& scene,
                                                                                                              float h) mutable
            {
                before(scene, h);
                disturbance.disturb_new(scene);
            };
        }
        return built;
    };
}

/// `meter`: may be null.
Result run_once(const carom::scenes::SceneEntry& entry, const Contender& contender, const RunOptions& options,
                const SceneMaker& make, QualityMeter* meter)
{
    forget_peak();
    TaskPool pool(contender.key == "carom" ? options.threads : 1);
    carom::SceneDef def;
    def.tasks = pool.hooks();
    def.tasks.worker_count = options.threads;
    def.continuous = !options.discrete;
    const std::unique_ptr<Contestant> contestant = contender.enter(make, def);
    const int steps = step_count(entry, options);
    const int bodies_built = static_cast<int>(contestant->scene().bodies().size());
    const std::size_t bytes_built = contestant->bytes();
    if (meter != nullptr)
        meter->start(*contestant);
    Stopwatch watch(*contestant, step_length(entry, options));
    for (int step = 0; step < steps; ++step)
    {
        options.progress(position(contender, entry, step, steps));
        watch.step(step > 0);
        if (meter != nullptr && is_sample(step, steps))
            meter->sample(*contestant);
        if (meter != nullptr && is_one_of(counts, step, steps))
            meter->count(*contestant);
    }
    Result result = describe(entry, contender, options, *contestant, watch);
    weigh(result, *contestant, bodies_built, bytes_built, meter != nullptr ? meter->bytes() : 0);
    return result;
}

} // namespace

Result run(const carom::scenes::SceneEntry& entry, const Contender& contender, const RunOptions& options)
{
    QualityMeter meter(entry.stands);
    Result best = run_once(entry, contender, options, maker_of(entry), options.disturbed == 0 ? &meter : nullptr);
    for (int i = 1; i < options.repeat; ++i)
    {
        const Result again = run_once(entry, contender, options, maker_of(entry), nullptr);
        best.repeats = best.repeats && again.hash == best.hash;
        best.cpu_ms = std::min(best.cpu_ms, again.cpu_ms);
        if (again.ms < best.ms)
        {
            best.ms = again.ms;
            best.stages = again.stages;
        }
    }
    for (int i = 1; i <= options.disturbed; ++i)
        static_cast<void>(run_once(entry, contender, options, disturbed(entry, static_cast<std::uint64_t>(i)), &meter));
    best.quality = meter.result();
    return best;
}

std::vector<std::uint64_t> hashes(const carom::scenes::SceneEntry& entry, const Contender& contender, const RunOptions& options)
{
    TaskPool pool(options.threads);
    carom::SceneDef def;
    def.tasks = pool.hooks();
    const std::unique_ptr<Contestant> contestant = contender.enter(maker_of(entry), def);
    const int steps = step_count(entry, options);
    const float h = step_length(entry, options);
    std::vector<std::uint64_t> list;
    for (int step = 0; step < steps; ++step)
    {
        options.progress(position(contender, entry, step, steps) + ", " + std::to_string(options.threads) + " threads");
        contestant->prepare(h);
        contestant->step(h);
        if ((step + 1) % hash_interval == 0 || step + 1 == steps)
            list.push_back(contestant->hash());
    }
    return list;
}

double median(std::vector<double>& values)
{
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

} // namespace speed
