#include "speed/company.h"

#include "scenes/build.h"
#include "speed/contestant.h"
#include "speed/pile.h"
#include "speed/task_pool.h"
#include "truth/random.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace speed {

using namespace carom;
using scenes::BuiltScene;

namespace {

using Clock = std::chrono::steady_clock;

struct Company
{
    const char* what;
    SceneMaker make;
    int steps = 120;
};

SceneDef without_gravity(SceneDef def)
{
    def.gravity = {};
    return def;
}

void add_walls(Scene& scene, Vec2 low, Vec2 high, float e)
{
    scenes::add_static(
        scene, Chain{.start = low, .pieces = {{{high.x, low.y}, 0}, {high, 0}, {{low.x, high.y}, 0}, {low, 0}}, .closed = true},
        {.friction = 0, .restitution = e});
}

// Discs of 0.1 m on a jittered lattice that fill that share of a square, at 1 m/s each.
void add_gas(Scene& scene, Vec2 low, int count, float filled, truth::Random& random)
{
    constexpr float radius = 0.1f;
    const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count))));
    const float pitch = std::sqrt(std::numbers::pi_v<float> * radius * radius / filled);
    const float side = pitch * static_cast<float>(columns);
    add_walls(scene, low, low + Vec2{side, side}, 1);
    for (int i = 0; i < count; ++i)
    {
        const Vec2 at = low + pitch * Vec2{static_cast<float>(i % columns) + 0.5f, static_cast<float>(i / columns) + 0.5f};
        const auto angle = static_cast<float>(random.in(0, 2 * std::numbers::pi));
        scenes::add_dynamic(scene, {at.x, at.y}, Circle{.radius = radius}, {.friction = 0, .restitution = 1},
                            {std::cos(angle), std::sin(angle)});
    }
}

SceneMaker gas(int count, float filled)
{
    return [=](const SceneDef& def)
    {
        BuiltScene built{Scene(without_gravity(def))};
        truth::Random random(7);
        add_gas(built.scene, {}, count, filled, random);
        return built;
    };
}

BuiltScene tables(const SceneDef& def)
{
    BuiltScene built{Scene(without_gravity(def))};
    truth::Random random(8);
    for (int i = 0; i < 100; ++i)
        add_gas(built.scene, {5.0f * static_cast<float>(i % 10), 5.0f * static_cast<float>(i / 10)}, 16, 0.1f, random);
    return built;
}

BuiltScene landing(const SceneDef& def)
{
    BuiltScene built{Scene(def)};
    add_walls(built.scene, {-10, 0}, {10, 40}, 0.6f);
    for (int i = 0; i < 2000; ++i)
        scenes::add_dynamic(built.scene, {-9.6 + 0.32 * (i % 60) + 0.07 * (i / 60 % 3), 1 + 0.4 * (i / 60)},
                            Circle{.radius = 0.1f}, {.restitution = 0.6f});
    return built;
}

BuiltScene pendulums(const SceneDef& def)
{
    BuiltScene built{Scene(def)};
    for (int i = 0; i < 10000; ++i)
    {
        const Position pivot{3.0 * (i % 100), 3.0 * (i / 100)};
        const BodyId bar = scenes::add_dynamic(built.scene, {pivot.x + 0.5, pivot.y}, box(0.5f, 0.05f), {.filter = {.mask = 0}});
        built.scene.create_joint(RevoluteDef{
            .body_b = bar, .anchor_a = {static_cast<float>(pivot.x), static_cast<float>(pivot.y)}, .anchor_b = {-0.5f, 0}});
    }
    return built;
}

SceneMaker chain(int bars)
{
    return [=](const SceneDef& def)
    {
        BuiltScene built{Scene(def)};
        BodyId last{};
        for (int i = 0; i < bars; ++i)
        {
            const BodyId bar = scenes::add_dynamic(built.scene, {0.25 + 0.5 * i, 0}, box(0.25f, 0.05f), {.filter = {.mask = 0}});
            built.scene.create_joint(
                RevoluteDef{.body_a = last, .body_b = bar, .anchor_a = {i > 0 ? 0.25f : 0, 0}, .anchor_b = {-0.25f, 0}});
            last = bar;
        }
        return built;
    };
}

BuiltScene dumbbells(const SceneDef& def)
{
    BuiltScene built{Scene(def)};
    scenes::add_static(built.scene, HalfSpace{.normal = {0, 1}}, {.friction = 0, .restitution = 1});
    for (int i = 0; i < 1000; ++i)
    {
        const ShapeDef elastic{.friction = 0, .restitution = 1, .filter = {.group = -1}};
        const double x = 2.0 * i;
        const BodyId a = scenes::add_dynamic(built.scene, {x, 1}, Circle{.radius = 0.1f}, elastic);
        const BodyId b = scenes::add_dynamic(built.scene, {x + 0.8, 1.6 + 0.0005 * i}, Circle{.radius = 0.1f}, elastic);
        built.scene.create_joint(DistanceDef{.body_a = a, .body_b = b});
    }
    return built;
}

std::vector<Company> companies()
{
    return {{"gas of 1,000, 30 % filled", gas(1000, 0.3f)},
            {"gas of 1,000, 70 % filled", gas(1000, 0.7f)},
            {"100 tables of 16 balls", tables},
            {"2,000 balls land, e 0.6", landing},
            {"10,000 pendulums", pendulums},
            {"chain of 17 bars let go", chain(17), 300},
            {"chain of 129 bars let go", chain(129), 300},
            {"1,000 elastic dumbbells", dumbbells}};
}

} // namespace

void company_costs(const RunOptions& options, const std::vector<std::string>& engines,
                   const std::function<void(const CompanyCost&)>& tell)
{
    TaskPool pool(options.threads);
    for (const Company& company : companies())
    {
        CompanyCost cost{company.what};
        for (const Contender& contender : contenders())
        {
            if (std::ranges::find(engines, contender.key) == engines.end())
                continue;
            const auto contestant =
                contender.enter(company.make, {.gravity = {0, -10}, .sleeping = false, .tasks = pool.hooks()});
            std::vector<double> ms;
            for (int i = 0; i < company.steps; ++i)
            {
                options.progress(cost.what + ", " + contender.key + ", step " + std::to_string(i));
                contestant->prepare(dt);
                const auto begin = Clock::now();
                contestant->step(dt);
                ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
            }
            cost.ms.push_back(median(ms));
        }
        tell(cost);
    }
}

} // namespace speed
