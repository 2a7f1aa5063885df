// The time at which a flying ball meets a leaf that moves, against stepping both paths finely.

#include "collision/time_of_impact.h"
#include "collision/brute_force.h"
#include "support/effort.h"

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

struct Case
{
    Geometry geometry;
    CenterPath ball;
    double radius;
    FramePath frame;
};

double distance_at(const Case& c, double t)
{
    const auto x = [&](double p, double v, double a) { return p + v * t + 0.5 * a * t * t; };
    const double bx = x(c.ball.x, c.ball.vx, c.ball.ax);
    const double by = x(c.ball.y, c.ball.vy, c.ball.ay);
    const double angle = c.frame.w * t;
    const Rotation q{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    // Into the frame, in doubles: center of mass at the origin of its frame here.
    const double cx = bx - x(c.frame.center.x, c.frame.center.vx, c.frame.center.ax);
    const double cy = by - x(c.frame.center.y, c.frame.center.vy, c.frame.center.ay);
    const double lx = std::cos(angle) * cx + std::sin(angle) * cy;
    const double ly = -std::sin(angle) * cx + std::cos(angle) * cy;
    static_cast<void>(q);
    const Solid s = solid_of(c.geometry, {});
    const Point p{lx, ly};
    if (s.plane)
        return s.normal.x * lx + s.normal.y * ly - s.offset - c.radius;
    double d = 1e9;
    if (s.core.size() == 1)
        return std::hypot(p.x - s.core[0].x, p.y - s.core[0].y) - s.radius[0] - c.radius;
    const std::size_t n = s.core.size();
    for (std::size_t k = 0; k + 1 < n; ++k)
        d = std::min(d, segment_distance(p, s.core[k], s.core[k + 1]));
    if (!s.curve && n > 2)
        d = std::min(d, segment_distance(p, s.core[n - 1], s.core[0]));
    return d - s.radius[0] - c.radius;
}

} // namespace

TEST(CollisionTimeOfImpact, AgreesWithFineStepping)
{
    const int count = part_of(900);
    Random random(5);
    int hits = 0;
    int misses = 0;
    for (int i = 0; i < count; ++i)
    {
        SCOPED_TRACE(i);
        Case c;
        switch (i % 6)
        {
        case 0: c.geometry = Circle{.radius = random.rangef(0.1, 1)}; break;
        case 1: c.geometry = box(random.rangef(0.2, 1), random.rangef(0.01, 0.5)); break;
        case 2: c.geometry = Capsule{{-0.8f, 0}, {0.8f, 0}, 0.2f, 0.2f}; break;
        case 3: c.geometry = Segment{{-1, 0}, {1, 0}, random.chance(0.5) ? 0 : 0.05f}; break;
        case 4: c.geometry = Arc{.radius = 1, .start_angle = random.rangef(-3, 3), .sweep = random.rangef(0.5, 3)}; break;
        default: c.geometry = HalfSpace{}; break;
        }
        c.radius = random.range(0.02, 0.3);
        const double side = i % 6 == 5 ? random.range(0.4, 3) : random.range(-3, 3);
        c.ball = {random.range(-3, 3), side, random.range(-10, 10), random.range(-10, 10), random.range(-5, 5), -10};
        c.frame.center = {0, 0, random.range(-3, 3), i % 6 == 5 ? 0 : random.range(-3, 3), 0, 0};
        c.frame.w = i % 6 == 5 ? 0 : random.range(-20, 20);
        if (distance_at(c, 0) < 0.02)
            continue;
        LeafStore store;
        ASSERT_TRUE(normalize_geometry("test", c.geometry));
        const Leaf leaf = make_leaves(c.geometry, store)[0];
        const Leaf ball = {.type = LeafType::Circle, .r0 = static_cast<float>(c.radius)};
        const double duration = 0.25;
        const auto hit = first_touch(view(leaf, store), c.frame, {&ball}, {c.ball}, duration, 0);
        double first = -1;
        double nearest = 1e9;
        const int n = 1000;
        for (int k = 0; k <= n && first < 0; ++k)
        {
            const double t = duration * k / n;
            const double d = distance_at(c, t);
            nearest = std::min(nearest, d);
            if (d <= 0)
                first = t;
        }
        if (first >= 0)
        {
            // The arc of the reference is a string of 400 chords, 3e-5 m inside at the most.
            ++hits;
            ASSERT_TRUE(hit.has_value()) << "at " << first;
            ASSERT_NEAR(distance_at(c, hit->time), 0, 2e-4);
            ASSERT_LE(hit->time, first + 1e-4);
            ASSERT_GE(hit->time, first - 3 * duration / n - 1e-4);
            ASSERT_NEAR(std::hypot(hit->nx, hit->ny), 1, 1e-6);
        }
        else if (nearest > 2e-3)
        {
            ++misses;
            ASSERT_FALSE(hit.has_value()) << "at " << hit->time << ", nearest " << nearest;
        }
    }
    EXPECT_GT(hits, count / 12);
    EXPECT_GT(misses, count / 12);
}
