// 2. A disc that keeps the fraction e of its speed rises to e² of its height, at every height and down to rest.

#include "truth/experiments/drop.h"
#include "truth/experiments/experiments.h"
#include "truth/random.h"

#include <cstdio>

namespace truth {
namespace {

constexpr double gravity = -earth.y;

Metrics apex_ratios(const Setup& setup)
{
    Metrics metrics;
    Drop drop = drop_disc(setup, 5, 0.5);
    const std::vector<double> heights = apexes(setup, drop, 4, 4);
    double before = 5;
    for (std::size_t i = 0; i < 4; ++i)
    {
        const double height = i < heights.size() ? heights[i] : 0;
        metrics.push_back({2, "e 0.5: apex ratio " + std::to_string(i + 1) + ", from samples", 0.25, height / before, 0.002});
        before = height;
    }
    return metrics;
}

// A hop of duration T rises g T² / 8: impacts give the heights of hops too short for three samples.
Metrics hop_ratios(const Setup& setup)
{
    Metrics metrics;
    Drop drop = drop_disc(setup, 5, 0.5);
    const bool reported = drop.world->reports_impacts();
    const std::vector<double> times = impact_times(setup, drop, 7, 4);
    double before = 5;
    for (std::size_t i = 0; i < 6; ++i)
    {
        const double duration = i + 1 < times.size() ? times[i + 1] - times[i] : 0;
        const double height = gravity * duration * duration / 8;
        const double ratio = reported ? height / before : none;
        metrics.push_back({2, "e 0.5: apex ratio " + std::to_string(i + 1) + ", from impacts", 0.25, ratio, 0.002});
        before = height;
    }
    return metrics;
}

/// When the ball is last higher than a millimeter, by the closed form: hop k lasts twice e^k falls and rises e^2k of the height.
double exact_rest_time(double height, double e)
{
    const double fall = std::sqrt(2 * height / gravity);
    double start = fall;
    double last = fall;
    for (double speed = e; speed * speed * height > 1e-3; speed *= e)
    {
        const double from_apex = std::sqrt(2 * (speed * speed * height - 1e-3) / gravity);
        last = start + speed * fall + from_apex;
        start += 2 * speed * fall;
    }
    return last;
}

Metric rest_time(const Setup& setup)
{
    Drop drop = drop_disc(setup, 5, 0.5);
    std::vector<double> heights;
    for (int step = 0; step < setup.steps(10); ++step)
    {
        drop.world->step(setup.dt());
        heights.push_back(drop.height());
    }
    std::size_t last = heights.size();
    while (last > 0 && std::abs(heights[last - 1] - heights.back()) <= 1e-3)
    {
        --last;
    }
    return {2, "e 0.5: rest time, s", exact_rest_time(5, 0.5), static_cast<double>(last) * setup.dt(), 0.01};
}

double effective_restitution(const Setup& setup, double height, double e)
{
    Drop drop = drop_disc(setup, height, e);
    const std::vector<double> heights = apexes(setup, drop, 1, 6);
    return heights.empty() ? 0 : std::sqrt(std::max(0.0, heights.front()) / height);
}

Metric restitution_at(const Setup& setup, double e)
{
    Random random(2);
    Farthest worst(e);
    for (int i = 0; i < setup.cases(40); ++i)
    {
        worst.add(effective_restitution(setup, random.in(0.5, 10), e));
    }
    char name[64];
    std::snprintf(name, sizeof name, "e %g: effective restitution, worst of 40 heights", e);
    setup.tell(name);
    return {2, name, e, worst.value(), 0.002};
}

/// From the two first impacts where the engine reports them: the hop is shorter than three samples.
double slow_restitution(const Setup& setup, double height)
{
    Drop drop = drop_disc(setup, height, 0.5);
    if (!drop.world->reports_impacts())
    {
        return effective_restitution(setup, height, 0.5);
    }
    const std::vector<double> times = impact_times(setup, drop, 2, 1);
    return times.size() < 2 ? 0 : (times[1] - times[0]) / 2 / std::sqrt(2 * height / gravity);
}

Metrics slow_drops(const Setup& setup)
{
    Random random(22);
    Farthest worst(0.5);
    Errors all;
    for (int i = 0; i < setup.cases(40); ++i)
    {
        const double e = slow_restitution(setup, random.in(0.005, 0.045));
        worst.add(e);
        all.add(e);
    }
    return {{2, "e 0.5 at 0.3 to 0.94 m/s: effective restitution, mean", 0.5, all.mean(), 0.005},
            {2, "e 0.5 at 0.3 to 0.94 m/s: effective restitution, worst", 0.5, worst.value(), 0.005}};
}

void append(Metrics& to, const Metrics& from) { to.insert(to.end(), from.begin(), from.end()); }

} // namespace

Metrics restitution(const Setup& setup)
{
    Metrics metrics = apex_ratios(setup);
    append(metrics, hop_ratios(setup));
    metrics.push_back(rest_time(setup));
    for (const double e : {0.3, 0.5, 0.8, 0.95, 1.0})
    {
        metrics.push_back(restitution_at(setup, e));
    }
    append(metrics, slow_drops(setup));
    return metrics;
}

} // namespace truth
