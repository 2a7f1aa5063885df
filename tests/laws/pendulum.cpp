// T = 2 pi sqrt(L/g) / agm(1, cos(amplitude / 2)), any amplitude; the energy stays.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

constexpr double pi_d = 3.14159265358979323846;

double agm(double a, double b)
{
    for (int i = 0; i < 30; ++i)
    {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return a;
}

double period_of(double length, double amplitude)
{
    return 2 * pi_d * std::sqrt(length / static_cast<double>(9.81f)) / agm(1, std::cos(0.5 * amplitude));
}

struct Swing
{
    double period = 0;
    double amplitude_lost = 0; // share of the height of the swing, first and last five seconds compared
    double length_error = 0;
};

// Measures the time between crossings of the vertical; `length` is the equivalent length.
template <class Connect>
Swing swing(double amplitude, double reach, const Geometry& geometry, float h, double seconds, Connect&& connect)
{
    Scene scene(sleepless());
    const double x = reach * std::sin(amplitude);
    const double y = -reach * std::cos(amplitude);
    const BodyId body =
        add(scene, {.type = BodyType::Dynamic, .position = {x, y}, .angle = static_cast<float>(amplitude)}, geometry).body;
    connect(scene, body);
    double highest_early = -1e9;
    double highest_late = -1e9;
    Swing result;
    double first = -1;
    double last = 0;
    int crossings = 0;
    double before = x;
    for (int i = 1; i * static_cast<double>(h) < seconds; ++i)
    {
        scene.step(h);
        const Position p = scene.body(body).center_of_mass();
        if ((before < 0) != (p.x < 0))
        {
            const double t = (i - 1 + before / (before - p.x)) * static_cast<double>(h);
            if (first < 0)
                first = t;
            last = t;
            ++crossings;
        }
        before = p.x;
        const double t = i * static_cast<double>(h);
        if (t < 5)
            highest_early = std::max(highest_early, p.y);
        if (t > seconds - 5)
            highest_late = std::max(highest_late, p.y);
        result.length_error = std::max(result.length_error, std::fabs(std::hypot(p.x, p.y) - reach));
    }
    result.period = 2 * (last - first) / (crossings - 1);
    // The height above the lowest point of this very swing, so that the stretch of the joint under load does not count.
    result.amplitude_lost = (highest_early - highest_late) / (highest_early + reach);
    return result;
}

} // namespace

TEST(LawPendulum, ABallOnARodHasThePeriodOfAPointMass)
{
    for (const double amplitude : {0.05, 1.0, 2.0943951})
        for (const float h : {1.0f / 60, 1.0f / 240})
        {
            SCOPED_TRACE("amplitude " + std::to_string(amplitude) + " h " + std::to_string(h));
            const Swing s = swing(amplitude, 2, Circle{.radius = 0.1f}, h, 20,
                                  [](Scene& scene, BodyId body) { scene.create_joint(DistanceDef{.body_b = body}); });
            EXPECT_NEAR(s.period, period_of(2, amplitude), 0.005 * s.period);
            EXPECT_LT(std::fabs(s.amplitude_lost), 0.02);
            EXPECT_LT(s.length_error, 0.01);
        }
}

TEST(LawPendulum, ABarOnAHingeIsACompoundPendulum)
{
    // Equivalent length (I/m + d²) / d, I/m = (w² + h²) / 12.
    const double d = 1;
    const double equivalent = ((0.2 * 0.2 + 2 * 2) / 12 + d * d) / d;
    for (const double amplitude : {0.05, 1.0, 2.0943951})
        for (const float h : {1.0f / 60, 1.0f / 240})
        {
            SCOPED_TRACE("amplitude " + std::to_string(amplitude) + " h " + std::to_string(h));
            const Swing s = swing(amplitude, d, box(0.1f, 1), h, 20, [](Scene& scene, BodyId body)
                                  { scene.create_joint(RevoluteDef{.body_b = body, .anchor_b = {0, 1}}); });
            EXPECT_NEAR(s.period, period_of(equivalent, amplitude), 0.005 * s.period);
            EXPECT_LT(std::fabs(s.amplitude_lost), 0.02);
            EXPECT_LT(s.length_error, 0.01);
        }
}
