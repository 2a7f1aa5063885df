// Symptom: one box of a resting pile was struck, and a step took a thousand times as long as others. What impacts may cost in a sub-step is bounded, by a count; what
// is left over waits for the next one, and the report says so.

#include "regressions/numbers.h"
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
    steps(scene, 60);
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
