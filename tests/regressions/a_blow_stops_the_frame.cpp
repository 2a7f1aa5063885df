// Symptom: one box of a resting pile was struck, and a step took a thousand times as long as others. What impacts may cost in a sub-step is bounded, by a count; what
// is left over waits for the next one, and the report says so.

#include "regressions/numbers.h"
#include "support/effort.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

struct Blow
{
    int most_impacts = 0;
    bool capped = false;
    double most_energy = 0; ///< over what there was when it was struck
};

double energy_of(Scene& scene)
{
    double sum = 0;
    for (const BodyId id : scene.bodies())
    {
        if (scene.body(id).type() == BodyType::Dynamic)
            sum += energy(scene, id);
    }
    return sum;
}

Blow strike(int count, float speed, float angle)
{
    Scene scene({.sleeping = false});
    add_static(scene, Chain{.start = {-6, 60}, .pieces = {{{-6, 0}}, {{6, 0}}, {{6, 60}}}});
    BodyId struck{};
    for (int i = 0; i < count; ++i)
    {
        const BodyId b = add_dynamic(scene, {i % 8 * 1.1 - 3.5, 0.6 + i / 8 * 1.1}, box(0.5f, 0.5f), {.restitution = 0.5f}).body;
        struck = i == count / 2 ? b : struck;
    }
    steps(scene, 180);
    scene.body(struck).set_velocity({speed * std::cos(angle), speed * std::sin(angle)});
    const double start = energy_of(scene);
    Blow blow;
    for (int i = 0; i < 10; ++i)
    {
        const StepReport& report = scene.step(dt);
        blow.most_impacts = std::max(blow.most_impacts, report.flight_impacts);
        blow.capped |= report.has(StepFlag::ImpactsCapped);
        blow.most_energy = std::max(blow.most_energy, energy_of(scene) / start);
    }
    return blow;
}

} // namespace

TEST(ABlow, CostsSoMuchAndNoMore)
{
    bool any_capped = false;
    for (const int count : {7, 16, 40, 80})
    {
        for (const float speed : {2.0f, 10.0f, 50.0f, 150.0f})
        {
            for (int k = 0; k < 4; ++k)
            {
                SCOPED_TRACE(std::to_string(count) + " boxes, " + std::to_string(speed) + " m/s, " + std::to_string(k));
                const Blow blow = strike(count, speed, static_cast<float>(k) * pi / 2 + 0.1f);
                EXPECT_LT(blow.most_impacts, 2000);
                EXPECT_LT(blow.most_energy, 1 + 1e-3);
                any_capped |= blow.capped;
            }
        }
    }
    EXPECT_TRUE(any_capped);
}

// All of them at once: who is met next is looked for as often as the impacts ask, which has its budget, too.
TEST(ABlow, ThrownApartTheyGainNothing)
{
    bool any_capped = false;
    for (const auto& [speed, spin] : {std::pair(10.0f, 1e4f), {1e3f, 1e2f}, {1e4f, 1e4f}, {1e5f, 1e3f}})
    {
        SCOPED_TRACE(std::to_string(speed) + " m/s, " + std::to_string(spin) + " rad/s");
        Random random(7);
        Scene scene({.gravity = {0, 0}, .sleeping = false});
        const int rows = slow_build ? 5 : 12;
        for (int row = 0; row < rows; ++row)
        {
            for (int i = 0; i < rows - row; ++i)
            {
                const BodyId b =
                    add_dynamic(scene, {1.05 * (i + 0.5 * row), 0.5 + row}, box(0.5f, 0.5f), {.restitution = 0.5f}).body;
                scene.body(b).set_velocity(random.vec(d(speed)));
                scene.body(b).set_angular_velocity(random.rangef(-d(spin), d(spin)));
            }
        }
        double before = energy_of(scene);
        for (int i = 0; i < 5; ++i)
        {
            const StepReport& report = scene.step(dt);
            EXPECT_LT(report.flight_impacts, 20'000);
            any_capped |= report.has(StepFlag::ImpactsCapped);
            const double after = energy_of(scene);
            EXPECT_LT(after, before * (1 + 1e-5));
            before = after;
        }
    }
    EXPECT_TRUE(any_capped || slow_build);
}
