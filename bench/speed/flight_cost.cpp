#include "speed/flight_cost.h"

#include "speed/pile.h"
#include "speed/task_pool.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace speed {

using namespace carom;

namespace {

using Clock = std::chrono::steady_clock;
using Build = std::function<void(Scene&)>;

constexpr int pile_bodies = 5000;
constexpr int drum_bodies = 2000;
constexpr float drum_radius = 14;
constexpr int drum_sides = 48;
constexpr double drum_pitch = 0.51;

void add_pile(Scene& scene) { build_pile(scene, pile_bodies, 40); }

void add_fast_ball(Scene& scene)
{
    const BodyId ball = scenes::add_dynamic(scene, {0, 25}, Circle{.radius = 0.2f}, {.friction = 0, .restitution = 1}, {100, 0});
    scene.body(ball).set_gravity_scale(0);
}

void build_drum(Scene& scene)
{
    const BodyId drum = scene.create_body({.type = BodyType::Kinematic, .angular_velocity = 0.6f});
    Chain wall{.start = {drum_radius, 0}, .closed = true};
    for (int i = 1; i <= drum_sides; ++i)
    {
        const Rotation q = Rotation::from_angle(2 * 3.14159265f * static_cast<float>(i) / drum_sides);
        wall.pieces.push_back({{drum_radius * q.c, drum_radius * q.s}, 0});
    }
    scene.create_shape(drum, wall, {.restitution = 0.5f});
    constexpr int columns = 40;
    for (int i = 0; i < drum_bodies; ++i)
        add_piece(scene, {(i % columns - 0.5 * columns) * drum_pitch, (i / columns - 0.25 * columns) * 0.8 * drum_pitch}, i,
                  {.restitution = 0.5f});
}

struct Side
{
    Scene scene;
    std::vector<double> ms{};

    void step()
    {
        const auto begin = Clock::now();
        scene.step(dt);
        ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
};

FlightCost compare(const std::string& what, Side without, Side with, int settling, int timed, const RunOptions& options)
{
    for (int i = 0; i < settling + timed; ++i)
    {
        options.progress(what + ", step " + std::to_string(i) + " of " + std::to_string(settling + timed));
        if (i == settling)
        {
            without.ms.clear();
            with.ms.clear();
        }
        without.step();
        with.step();
    }
    const StepReport& report = with.scene.report();
    return {what, median(without.ms), median(with.ms), report.flight_bodies, report.flight_impacts, report.bulk_impacts};
}

} // namespace

void flight_costs(const RunOptions& options, const std::function<void(const FlightCost&)>& tell)
{
    TaskPool pool(options.threads);
    const auto side = [&](bool continuous, std::initializer_list<Build> builds)
    {
        Side s{Scene({.gravity = {0, -10}, .sleeping = false, .continuous = continuous, .tasks = pool.hooks()})};
        for (const Build& build : builds)
            build(s.scene);
        return s;
    };
    tell(compare("a pile at rest, off and on", side(false, {add_pile}), side(true, {add_pile}), 400, 300, options));
    tell(compare("the pile, and a ball at 100 m/s", side(true, {add_pile}), side(true, {add_pile, add_fast_ball}), 400, 300,
                 options));
    tell(compare("tumbling at e 0.5, off and on", side(false, {build_drum}), side(true, {build_drum}), 300, 300, options));
}

} // namespace speed
