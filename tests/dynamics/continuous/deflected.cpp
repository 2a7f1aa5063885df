// The grid of deflected fliers finds everything that a path may meet, as they come, go and change their paths.

#include "dynamics/continuous/deflected.h"

#include "scenes/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace carom::internal;

namespace {

double in(carom::SplitMix64& random, double low, double high) { return low + (high - low) * random.unit(); }

Reach random_reach(carom::SplitMix64& random, double end)
{
    const double size = random.unit() < 0.02 ? 30 : 1; // some are much larger than the others
    return {in(random, -40, 40),   in(random, -40, 40),        in(random, -100, 100),
            in(random, -100, 100), in(random, 0, end) * 0.999, size * in(random, 0.1, 1)};
}

// The least distance of two circles that move evenly, over the rest of the sub-step.
bool meet(const Reach& a, const Reach& b, double end)
{
    const double start = std::max(a.time, b.time);
    const double x = a.x + (start - a.time) * a.vx - b.x - (start - b.time) * b.vx;
    const double y = a.y + (start - a.time) * a.vy - b.y - (start - b.time) * b.vy;
    const double vx = a.vx - b.vx;
    const double vy = a.vy - b.vy;
    const double v2 = vx * vx + vy * vy;
    const double t = v2 > 0 ? std::clamp(-(x * vx + y * vy) / v2, 0.0, end - start) : 0;
    return std::hypot(x + t * vx, y + t * vy) <= a.radius + b.radius;
}

} // namespace

TEST(DeflectedFliers, FindAllThatAPathMayMeet)
{
    constexpr double end = 1.0 / 240;
    for (const int count : {1, 15, 16, 17, 100, 701})
    {
        carom::SplitMix64 random(static_cast<std::uint64_t>(count));
        std::vector<Reach> reaches(static_cast<std::size_t>(count));
        std::vector<std::int32_t> indices(reaches.size());
        DeflectedFliers deflected;
        deflected.set_all(end, reaches);
        int met = 0;
        int visited = 0;
        for (int round = 0; round < 3; ++round) // they come, change their paths, and start a new sub-step
        {
            for (int i = 0; i < count; ++i)
            {
                const auto flier = static_cast<std::size_t>(count - 1 - i);
                reaches[flier] = random_reach(random, end);
                if (round == 0)
                    indices[flier] = deflected.add(static_cast<std::int32_t>(flier));
                if (round < 2)
                    deflected.set(indices[flier], reaches);
            }
            if (round == 2)
                deflected.set_all(end, reaches);
            for (std::size_t i = 0; i < reaches.size(); ++i)
            {
                std::vector<std::int32_t> found;
                visited += deflected.for_each_near(reaches[i], [&](std::int32_t flier) { found.push_back(flier); });
                for (std::size_t k = 0; k < reaches.size(); ++k)
                {
                    if (!meet(reaches[i], reaches[k], end))
                        continue;
                    ++met;
                    EXPECT_NE(std::ranges::find(found, static_cast<std::int32_t>(k)), found.end())
                        << count << " " << round << " " << i << " " << k;
                }
            }
        }
        EXPECT_GE(met, count);
        if (count == 701)
        {
            EXPECT_LT(visited, 3 * count * count / 2);
        }
    }
}
