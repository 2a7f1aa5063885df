// The same shot at steps of 1/120, 1/240 and 1/1000 s leaves with the same speed and angle. 2,000 shots at full length, each with one moving element of
// Momentum on a table of its own, so that nothing else is hit. Speeds are read where the steps of all three end together: at multiples of
// 25 ms.

#include "bench_table.h"
#include "pinball/table/loader.h"
#include "support/effort.h"
#include "support/test_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace carom::pinball::test {
namespace {

using carom::test::Random;

const int shots_per_kind = carom::test::does_whole_tests() ? 500 : carom::test::part_of(250);
constexpr double common_time = 0.025; // s
constexpr float millisecond = 0.001f;

/// A ball, and one button that is held for a while.
struct Shot
{
    Vec2 position{};
    Vec2 velocity{};
    Vec2 rolling{};
    int press = 0;       ///< ms
    int release = 10000; ///< ms
    int exit = 0;        ///< ms at the least; the speed is read at the next common time
    Buttons held{};
};

Table table_with(const char* id)
{
    LoadResult result = load_table_file(CAROM_TABLES_DIR "/momentum.table.json");
    Table table = std::move(*result.table);
    const auto is_other = [&](const Element& element) { return element.id != id; };
    std::erase_if(table.elements, is_other);
    EXPECT_EQ(table.elements.size(), 1u) << id;
    if (auto* plunger = std::get_if<Plunger>(&table.elements.front().part))
        plunger->lane = none;
    return table;
}

/// The events of the button within a step.
std::vector<ButtonChange> changes_of(const Shot& shot, double begin, double end)
{
    std::vector<ButtonChange> changes;
    for (const auto& [ms, buttons] : {std::pair{shot.press, shot.held}, std::pair{shot.release, Buttons{}}})
    {
        const double time = 0.001 * ms;
        if (time > begin - 1e-6 && time < end - 1e-6)
            changes.push_back({std::max(time - begin, 0.0), buttons});
    }
    return changes;
}

/// The ball's velocity when it has left.
Vec2 exit_velocity(const Table& momentum, const Shot& shot, int rate)
{
    Table table = momentum;
    table.physics.step = 1 / static_cast<float>(rate);
    Playfield field(table, 1);
    shoot(field, shot.position, shot.velocity).state.rolling = shot.rolling;
    const int steps_between = static_cast<int>(std::lround(common_time * rate));
    const int steps = static_cast<int>(std::ceil(shot.exit / 25.0)) * steps_between;
    for (int i = 0; i < steps; ++i)
        field.step_through(changes_of(shot, static_cast<double>(i) / rate, static_cast<double>(i + 1) / rate));
    return field.balls().front().state.velocity;
}

struct Worst
{
    double speed = 0; ///< relative
    double angle = 0; ///< degrees
};

void compare(const Table& table, const Shot& shot, int number, Worst& worst)
{
    const Vec2 fine = exit_velocity(table, shot, 1000);
    for (const int rate : {120, 240})
    {
        const Vec2 v = exit_velocity(table, shot, rate);
        const double speed = std::abs(double{length(v)} / double{length(fine)} - 1);
        const double angle = std::abs(std::atan2(double{cross(fine, v)}, double{dot(fine, v)})) * 180 / 3.14159265358979;
        worst.speed = std::max(worst.speed, speed);
        worst.angle = std::max(worst.angle, angle);
        EXPECT_LE(speed, 0.01) << "shot " << number << " at " << rate << " Hz: " << length(v) << " instead of " << length(fine)
                               << " m/s";
        EXPECT_LE(angle, 1.0) << "shot " << number << " at " << rate << " Hz, degrees";
    }
}

void run_shots(const Table& table, std::uint64_t seed, const std::function<Shot(Random&)>& make)
{
    Random random(seed);
    Table empty = table;
    empty.elements.clear();
    Worst worst;
    int struck = 0;
    for (int i = 0; i < shots_per_kind; ++i)
    {
        const Shot shot = make(random);
        compare(table, shot, i, worst);
        struck += length(exit_velocity(table, shot, 240) - exit_velocity(empty, shot, 240)) > 0.1f ? 1 : 0;
    }
    EXPECT_GE(struck, shots_per_kind - (shots_per_kind + 99) / 100) << "the others rolled by";
    ::testing::Test::RecordProperty("worst_speed_error", std::to_string(worst.speed));
    ::testing::Test::RecordProperty("worst_angle_error_deg", std::to_string(worst.angle));
    std::printf("worst of %d shots: speed %.3f %%, angle %.3f degrees\n", shots_per_kind, 100 * worst.speed, worst.angle);
}

struct Bat
{
    explicit Bat(const Flipper& flipper, float ball_radius) : pivot(flipper.pivot), length(flipper.length)
    {
        const float tilt = std::asin((flipper.base_radius - flipper.tip_radius) / flipper.length);
        along = rotate(Rotation::from_angle(flipper.rest - tilt), {1, 0});
        normal = perp(along);
        height = flipper.base_radius + ball_radius;
    }
    /// Where a ball's centre is that is `above` the face, at a place along the bat.
    [[nodiscard]] Vec2 over(float place, float above) const { return pivot + place * along + (height + above) * normal; }

    Vec2 pivot;
    Vec2 along;
    Vec2 normal;
    float length;
    float height;
};

// It stays on the face until the stroke ends: one that comes over the tip meanwhile loses touch and bounces on the edge.
TEST(StepIndependence, ABallThatRollsDownTheBatAndIsShot)
{
    const Table table = table_with("flipper_left");
    const Bat bat(std::get<Flipper>(table.elements.front().part), table.ball.radius);
    run_shots(table, 1,
              [&](Random& random)
              {
                  // Somewhere between base and tip when the button is pressed.
                  const float at_press = random.rangef(0.02, 0.045);
                  const float speed = random.rangef(0.1, 0.6);
                  const int press = 5 + random.below(40);
                  const Vec2 start = bat.over(at_press - speed * millisecond * static_cast<float>(press), 0);
                  return Shot{.position = start,
                              .velocity = speed * bat.along,
                              .rolling = speed * bat.along,
                              .press = press,
                              .exit = press + 60,
                              .held = {.left = true}};
              });
}

// It meets the bat in the fast half of the stroke, or held up at its stop. On a bat that only starts to move a ball of this rubber bounces ten
// to forty times, and whether it does so once more before the stop changes its way by leaps: no step size has the one right answer then.
TEST(StepIndependence, ABallThatFallsOnTheBatAndIsShot)
{
    const Table table = table_with("flipper_left");
    const Bat bat(std::get<Flipper>(table.elements.front().part), table.ball.radius);
    run_shots(table, 2,
              [&](Random& random)
              {
                  const float speed = random.rangef(0.3, 3);
                  const Vec2 way = rotate(Rotation::from_angle(random.rangef(-0.6, 0.6)), -bat.normal);
                  const int arrives = 55 + random.below(40); // at the bat, had it stayed down
                  const Vec2 start =
                      bat.over(random.rangef(0.02, 0.05), 0) - (speed * millisecond * static_cast<float>(arrives)) * way;
                  return Shot{.position = start,
                              .velocity = speed * way,
                              .press = arrives - 12 - random.below(40),
                              .exit = arrives + 60,
                              .held = {.left = true}};
              });
}

// It lies on the rod when that is let go. The rod is drawn away from under it and it needs a quarter of a second to catch up; let go before, the
// rod strikes it in the air, once or twice before its stop: again leaps.
TEST(StepIndependence, ABallThatThePlungerLaunches)
{
    const Table table = table_with("plunger");
    const auto& plunger = std::get<Plunger>(table.elements.front().part);
    const Vec2 on_the_rod = plunger.pos + Vec2{0, plunger.half.y + table.ball.radius};
    const float downhill = 5.0f / 7.0f * table.physics.g * std::sin(table.physics.slope);
    const int catches_up = static_cast<int>(std::ceil(2 * plunger.pull_speed / downhill / millisecond));
    run_shots(
        table, 3,
        [&](Random& random)
        {
            const int press = 20 + random.below(40);
            const int release = press + catches_up + random.below(400);
            return Shot{
                .position = on_the_rod, .press = press, .release = release, .exit = release + 60, .held = {.plunger = true}};
        });
}

TEST(StepIndependence, ABallThatABumperKicks)
{
    const Table table = table_with("pop1");
    const auto& bumper = std::get<Bumper>(table.elements.front().part);
    run_shots(table, 4,
              [&](Random& random)
              {
                  // Aimed at a point of the ring within 60 degrees of the way it comes.
                  const Vec2 out = rotate(Rotation::from_angle(random.rangef(-3.1, 3.1)), {1, 0});
                  const Vec2 way = rotate(Rotation::from_angle(random.rangef(-1.05, 1.05)), -out);
                  const float speed = random.rangef(0.3, 3);
                  const int arrives = 10 + random.below(40);
                  const Vec2 touch = bumper.pos + (bumper.radius + table.ball.radius) * out;
                  const Vec2 v = speed * way;
                  return Shot{.position = touch - (millisecond * static_cast<float>(arrives)) * v,
                              .velocity = v,
                              .rolling = random.chance(0.5) ? v : Vec2{},
                              .exit = arrives + 40};
              });
}

} // namespace
} // namespace carom::pinball::test
