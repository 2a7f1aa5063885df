// Symptom: two bodies on three hinges with long levers made 4e28 J of the 19 J that gravity gives; two bodies pinned twice, free, lost
// their angular momentum; two pins to the world read 0.83 of the weight that they bear.

#include "regressions/numbers.h"
#include "support/effort.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

double angular_momentum(const Scene& scene, const std::vector<BodyId>& bodies)
{
    double sum = 0;
    for (const BodyId id : bodies)
    {
        const ConstBody body = scene.body(id);
        const Position p = body.center_of_mass();
        const Vec2 v = body.velocity();
        sum += d(body.inertia()) * d(body.angular_velocity()) + d(body.mass()) * (p.x * d(v.y) - p.y * d(v.x));
    }
    return sum;
}

double kinetic(const Scene& scene, const std::vector<BodyId>& bodies)
{
    double sum = 0;
    for (const BodyId id : bodies)
        sum += d(scene.body(id).kinetic_energy());
    return sum;
}

double widest_gap(const Scene& scene)
{
    double gap = 0;
    for (const JointId id : scene.joints())
        gap = std::max(gap, d(length(scene.joint(id).anchor_b() - scene.joint(id).anchor_a())));
    return gap;
}

BodyId bar_between(Scene& scene, Vec2 from, Vec2 to, Filter filter = {.mask = 0})
{
    const Vec2 along = to - from;
    const BodyId bar = scene.create_body({.type = BodyType::Dynamic,
                                          .position = {0.5 * d(from.x + to.x), 0.5 * d(from.y + to.y)},
                                          .angle = std::atan2(along.y, along.x)});
    scene.create_shape(bar, box(0.5f * length(along), 0.05f), {.filter = filter});
    return bar;
}

void pin(Scene& scene, BodyId a, BodyId b, Vec2 at)
{
    const auto local = [&](BodyId id) { return id.is_null() ? at : scene.body(id).local_point({d(at.x), d(at.y)}); };
    scene.create_joint(RevoluteDef{.body_a = a, .body_b = b, .anchor_a = local(a), .anchor_b = local(b)});
}

} // namespace

// A ring of bars, some of them pinned twice, spins freely.
TEST(Loops, KeepAngularMomentumAndEnergy)
{
    for (const int sides : slow_build ? std::vector{2, 4} : std::vector{2, 3, 4, 6, 12})
    {
        for (const int pins : {1, 2, 3})
        {
            for (const float spin : {1.0f, 10.0f, 20.0f, 40.0f})
            {
                if (sides == 2 && pins == 1)
                    continue;
                SCOPED_TRACE(std::to_string(sides) + " sides, " + std::to_string(pins) + " pins, " + std::to_string(spin) +
                             " rad/s");
                Scene scene(weightless());
                std::vector<BodyId> bars;
                const auto corner = [&](int i)
                {
                    const float angle = 2 * pi * static_cast<float>(i) / static_cast<float>(sides);
                    return Vec2{std::cos(angle), std::sin(angle)};
                };
                for (int i = 0; i < sides; ++i)
                    bars.push_back(bar_between(scene, corner(i), corner(i + 1)));
                for (int i = 0; i < sides; ++i)
                {
                    for (int k = 0; k < pins; ++k)
                        pin(scene, bars[static_cast<std::size_t>(i)], bars[static_cast<std::size_t>((i + 1) % sides)],
                            (1 - 0.02f * static_cast<float>(k)) * corner(i + 1));
                }
                for (const BodyId bar : bars)
                {
                    const Position p = scene.body(bar).center_of_mass();
                    scene.body(bar).set_velocity({static_cast<float>(-d(spin) * p.y), static_cast<float>(d(spin) * p.x)});
                    scene.body(bar).set_angular_velocity(spin);
                }
                const double l = angular_momentum(scene, bars);
                const double e = kinetic(scene, bars);
                const int rate =
                    spin > 20 ? 120 : 60; // at 40 rad/s a loose ring errs by 3 % with 60 steps/s, by less than 0.2 % with 120
                for (int i = 0; i < 10 * rate; ++i)
                    scene.step(1 / static_cast<float>(rate));
                EXPECT_NEAR(angular_momentum(scene, bars) / l, 1, 0.002);
                EXPECT_NEAR(kinetic(scene, bars) / e, 1, 0.005);
                EXPECT_LT(widest_gap(scene), 1e-3);
            }
        }
    }
}

// Several pins to the world bear the weight together, however it is shared out.
TEST(Loops, PinsBearTheWeightTogether)
{
    for (const int pins : {2, 3, 5})
    {
        Scene scene(sleepless());
        const BodyId bar = bar_between(scene, {-1, 0}, {1, 0});
        for (int i = 0; i < pins; ++i)
            pin(scene, {}, bar, {-0.9f + 1.8f * static_cast<float>(i) / static_cast<float>(pins - 1), 0});
        steps(scene, 120);
        Vec2 force{};
        for (const JointId id : scene.joints())
            force += scene.joint(id).force();
        EXPECT_NEAR(d(force.y), d(scene.body(bar).mass()) * 9.81, 1e-3) << pins << " pins";
    }
}

TEST(Loops, FourBarsSwingOnWithTheirEnergy)
{
    Scene scene(sleepless());
    const Vec2 at[] = {{0, 0}, {0.8f, -0.6f}, {2.3f, -0.9539f}, {2, 0}};
    std::vector<BodyId> bars;
    for (int i = 0; i < 3; ++i)
        bars.push_back(bar_between(scene, at[i], at[i + 1]));
    pin(scene, {}, bars[0], at[0]);
    pin(scene, bars[0], bars[1], at[1]);
    pin(scene, bars[1], bars[2], at[2]);
    pin(scene, bars[2], {}, at[3]);
    const auto energy = [&]
    {
        double sum = kinetic(scene, bars);
        for (const BodyId bar : bars)
            sum += d(scene.body(bar).mass()) * 9.81 * scene.body(bar).center_of_mass().y;
        return sum;
    };
    const double start = energy();
    double swing = 0;
    for (int i = 0; i < 3600; ++i)
    {
        scene.step(dt);
        swing = std::max(swing, kinetic(scene, bars));
    }
    EXPECT_GT(swing, 0.3);
    EXPECT_NEAR(energy(), start, 1e-3 * swing);
}

// Two bodies and three hinges anywhere within some metres, of any weights, at rest under gravity: rigid, swinging, or wedged.
TEST(Loops, WithLongLeversGainNoMoreThanGravityGives)
{
    int tried = 0;
    const int pairs = slow_build ? 40 : 400;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(pairs); ++seed)
    {
        Random random(seed);
        Scene scene(sleepless());
        const auto at = [&](double far)
        { return Vec2{random.rangef(-1, 1) * static_cast<float>(far), random.rangef(-1, 1) * static_cast<float>(far)}; };
        std::vector<BodyId> bodies;
        for (int i = 0; i < 2; ++i)
        {
            const Vec2 p = at(4);
            bodies.push_back(
                scene.create_body({.type = BodyType::Dynamic, .position = {d(p.x), d(p.y)}, .angle = random.rangef(-3, 3)}));
            const float mass = std::exp(random.rangef(-3, 3));
            const float radius = std::exp(random.rangef(-3, 0));
            scene.body(bodies.back()).set_mass({mass, {}, mass * radius * radius});
        }
        pin(scene, bodies[0], bodies[1], at(4));
        pin(scene, bodies[0], bodies[1], at(4));
        pin(scene, {}, bodies[0], at(4));
        if (seed % 3 == 0)
            pin(scene, {}, bodies[1], at(4));
        double weight = 0;
        double low = 0;
        const auto height = [&]
        {
            double sum = 0;
            for (const BodyId id : bodies)
                sum += d(scene.body(id).mass()) * 9.81 * scene.body(id).center_of_mass().y;
            return sum;
        };
        for (const BodyId id : bodies)
            weight += d(scene.body(id).mass()) * 9.81;
        const double start = height();
        double most = -1e9;
        for (int i = 0; i < 300; ++i)
        {
            scene.step(dt);
            low = std::min(low, height() - start);
            most = std::max(most, kinetic(scene, bodies) + height() - start);
        }
        EXPECT_LT(most, 0.01 * -low + 0.002 * weight) << "seed " << seed;
        ++tried;
    }
    EXPECT_EQ(tried, pairs);
}

// Bars from wall to wall, straight or sagging, with balls on them: what games call a bridge.
TEST(Loops, BridgesHoldTogetherUnderTheirLoad)
{
    for (const int count : does_whole_tests() ? std::vector{2, 5, 10, 20, 40, 70, 100} : std::vector{2, 10, 40})
    {
        for (const double slack : {1.0, 0.99, 0.9})
        {
            for (const float load : {0.0f, 1.0f, 10.0f})
            {
                SCOPED_TRACE(std::to_string(count) + " bars, " + std::to_string(slack) + ", load " + std::to_string(load));
                Scene scene(sleepless());
                std::vector<BodyId> bars;
                Vec2 end{};
                const auto tilt = static_cast<float>(std::acos(slack));
                BodyId last{};
                for (int i = 0; i < count; ++i)
                {
                    const float angle = i % 2 == 0 ? -tilt : tilt;
                    const Vec2 next = end + 0.8f * Vec2{std::cos(angle), std::sin(angle)};
                    bars.push_back(bar_between(scene, end, next, {.mask = 2}));
                    pin(scene, last, bars.back(), end);
                    last = bars.back();
                    end = next;
                }
                pin(scene, last, {}, end);
                if (load > 0)
                {
                    const BodyId ball = scene.create_body({.type = BodyType::Dynamic, .position = {0.5 * d(end.x), 1.5}});
                    scene.create_shape(ball, Circle{.radius = 0.5f}, {.density = load, .filter = {.category = 2}});
                }
                double start = 0;
                for (const BodyId id : scene.bodies())
                    start += d(scene.body(id).mass()) * 9.81 * scene.body(id).position().y;
                double gap = 0;
                double most = 0;
                for (int i = 0; i < 600; ++i)
                {
                    scene.step(dt);
                    gap = std::max(gap, widest_gap(scene));
                    double energy = -start;
                    for (const BodyId id : scene.bodies())
                        energy +=
                            d(scene.body(id).kinetic_energy()) + d(scene.body(id).mass()) * 9.81 * scene.body(id).position().y;
                    most = std::max(most, energy);
                }
                EXPECT_LT(gap, 0.08);
                EXPECT_LT(most, 1) << "J beyond the start; what swings has up to 60";
            }
        }
    }
}
