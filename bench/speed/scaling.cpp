#include "speed/scaling.h"

#include "scenes/build.h"
#include "speed/memory.h"
#include "speed/pile.h"
#include "speed/task_pool.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

namespace speed {

using namespace carom;

namespace {

using Clock = std::chrono::steady_clock;

constexpr float bar_length = 4;
constexpr int columns_per_bar = 25;
constexpr int settling_steps = 90;
constexpr int stirring_steps = 30; // until the bars are in the pile

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

struct Timed
{
    double seconds = 0;
    Stages ms{};
};

// Bars lie over the pile, flat, until it is stirred.
class Pile
{
public:
    Pile(int bodies, const TaskHooks& tasks) : m_scene({.gravity = {0, -10}, .sleeping = false, .tasks = tasks})
    {
        build_pile(m_scene, bodies, 2 * pile_pitch * pile_rows);
        const int columns = (bodies + pile_rows - 1) / pile_rows;
        const float half_width = pile_half_width(bodies);
        for (int c = columns_per_bar / 2; c < columns; c += columns_per_bar)
            add_bar(static_cast<float>(c) * pile_pitch - half_width, pile_pitch * pile_rows + 0.5f);
    }

    [[nodiscard]] Scene& scene() { return m_scene; }

    // Bars come down into the pile, turning.
    void stir()
    {
        for (const BodyId bar : m_bars)
        {
            m_scene.body(bar).set_velocity({0, -2});
            m_scene.body(bar).set_angular_velocity(2);
        }
    }

private:
    void add_bar(float x, float y)
    {
        const BodyId bar = m_scene.create_body({.type = BodyType::Kinematic, .position = {x, y}});
        m_scene.create_shape(bar, box(bar_length / 2, 0.1f));
        m_bars.push_back(bar);
    }

    Scene m_scene;
    std::vector<BodyId> m_bars;
};

} // namespace

PileCost pile_cost(int bodies, const RunOptions& options)
{
    TaskPool pool(options.threads);
    const std::size_t before = heap_bytes();
    Pile pile(bodies, pool.hooks());
    const std::string what = std::to_string(bodies) + " bodies, step ";
    const auto run = [&](int steps, const char* doing)
    {
        Timed timed;
        const auto begin = Clock::now();
        for (int i = 0; i < steps; ++i)
        {
            options.progress(what + std::to_string(i) + " of " + std::to_string(steps) + doing);
            add(timed.ms, stages_of(pile.scene().step(dt).ms));
        }
        timed.seconds = seconds_since(begin);
        return timed;
    };
    run(settling_steps, ", settling");
    pile.stir();
    run(stirring_steps, ", before it is timed");
    PileCost cost;
    cost.bodies = bodies;
    cost.steps = bodies > 100000 ? 30 : 60;
    const auto [seconds, ms] = run(cost.steps, ", stirred");
    cost.pairs = pile.scene().report().pairs;
    cost.ms_per_step = 1e3 * seconds / cost.steps;
    cost.ns_per_body = 1e9 * seconds / cost.steps / bodies;
    std::ranges::transform(ms, cost.stages.begin(), [&](double of_stage) { return 1e6 * of_stage / cost.steps / bodies; });
    cost.bytes_per_body = static_cast<double>(heap_bytes() - before) / bodies;
    return cost;
}

StaticCost static_cost(int shapes, const RunOptions& options)
{
    constexpr int steps = 1000;
    StaticCost cost;
    cost.shapes = shapes;
    options.progress(std::to_string(shapes) + " boxes that do not move");
    auto begin = Clock::now();
    Scene scene({.gravity = {0, -10}, .sleeping = false});
    std::vector<BodyId> boxes;
    for (int i = 0; i < shapes; ++i)
        boxes.push_back(
            scenes::add_static(scene, box(0.4f, 0.4f), {}, {static_cast<double>(i % 1000), -static_cast<double>(i) / 1000}));
    scenes::add_dynamic(scene, {500, 1e5}, Circle{.radius = 0.5f});
    scene.step(dt);
    cost.build_s = seconds_since(begin);
    begin = Clock::now();
    for (int i = 0; i < steps; ++i)
        scene.step(dt);
    cost.us_per_step = 1e6 * seconds_since(begin) / steps;
    begin = Clock::now();
    for (int i = 0; i < steps; ++i)
    {
        const BodyId moved = boxes[static_cast<std::size_t>(i) * 7919 % boxes.size()];
        scene.body(moved).teleport(scene.body(moved).position() + Vec2{0.1f, 0}, 0);
        scene.step(dt);
    }
    cost.us_per_move = 1e6 * seconds_since(begin) / steps;
    return cost;
}

SmallScenesCost small_scenes_cost(int scenes, int threads, const RunOptions& options)
{
    constexpr int steps = 30;
    options.progress(std::to_string(scenes) + " scenes on " + std::to_string(threads) + " threads");
    std::vector<Scene> all;
    for (int i = 0; i < scenes; ++i)
    {
        Scene& scene = all.emplace_back(SceneDef{.gravity = {0, -10}});
        scenes::add_floor(scene);
        for (int k = 0; k < 5; ++k)
            scenes::add_dynamic(scene, {0.1 * (k % 2), 0.5 + 1.1 * k}, box(0.5f, 0.5f), {}, {0, 0},
                                0.01f * static_cast<float>(i % 7));
    }
    const auto begin = Clock::now();
    std::vector<std::thread> workers;
    for (int t = 0; t < threads; ++t)
        workers.emplace_back(
            [&all, t, threads]
            {
                for (std::size_t i = static_cast<std::size_t>(t); i < all.size(); i += static_cast<std::size_t>(threads))
                    for (int k = 0; k < steps; ++k)
                        all[i].step(dt);
            });
    for (std::thread& worker : workers)
        worker.join();
    SmallScenesCost cost;
    cost.scenes = scenes;
    cost.threads = threads;
    cost.us_per_step = 1e6 * seconds_since(begin) / steps / scenes;
    for (const Scene& scene : all)
        cost.hash = cost.hash * 0x100000001b3u ^ scene.state_hash();
    return cost;
}

} // namespace speed
