// Mass, center and inertia against integration by strips over the shape's own membership test, written here.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

struct Sums
{
    double area = 0;
    double x = 0;
    double y = 0;
    double second = 0; // about the center
};

// Distance to a segment in doubles.
double to_segment(double px, double py, Vec2 a, Vec2 b)
{
    const double ex = static_cast<double>(b.x) - a.x;
    const double ey = static_cast<double>(b.y) - a.y;
    const double t = std::clamp(((px - a.x) * ex + (py - a.y) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
    return std::hypot(px - a.x - t * ex, py - a.y - t * ey);
}

// inside(x, y) over a box of half size `reach`, midpoint rule on n x n cells.
template <class Inside>
Sums integrate(double reach, int n, Inside&& inside)
{
    Sums s;
    const double cell = 2 * reach / n;
    double xx = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
            const double x = -reach + (i + 0.5) * cell;
            const double y = -reach + (j + 0.5) * cell;
            if (!inside(x, y))
                continue;
            s.area += 1;
            s.x += x;
            s.y += y;
            xx += x * x + y * y;
        }
    s.x /= s.area;
    s.y /= s.area;
    s.second = (xx - s.area * (s.x * s.x + s.y * s.y)) * cell * cell;
    s.area *= cell * cell;
    return s;
}

void expect_mass(const Geometry& geometry, const Sums& want, double tolerance = 2e-3)
{
    Scene scene(weightless());
    const Thing t = add_dynamic(scene, {0, 0}, geometry, {.density = 3});
    const Body body = scene.body(t.body);
    EXPECT_NEAR(body.mass(), 3 * want.area, tolerance * 3 * want.area);
    const double size = std::sqrt(want.area);
    EXPECT_NEAR(body.local_center_of_mass().x, want.x, tolerance * size);
    EXPECT_NEAR(body.local_center_of_mass().y, want.y, tolerance * size);
    EXPECT_NEAR(body.inertia(), 3 * want.second, 2 * tolerance * 3 * want.second);
}

std::vector<Vec2> ring(int n, Random& random)
{
    std::vector<Vec2> points;
    for (int i = 0; i < n; ++i)
    {
        const double angle = 2 * 3.14159265358979 * (i + random.range(-0.2, 0.2)) / n;
        points.push_back({static_cast<float>(1.2 * std::cos(angle) + 0.3), static_cast<float>(0.7 * std::sin(angle) - 0.2)});
    }
    return points; // on an ellipse: convex
}

bool in_convex(const std::vector<Vec2>& v, double x, double y, double radius)
{
    bool in = true;
    double d = 1e9;
    for (std::size_t i = 0; i < v.size(); ++i)
    {
        const Vec2 a = v[i];
        const Vec2 b = v[(i + 1) % v.size()];
        in = in && (static_cast<double>(b.x) - a.x) * (y - a.y) - (static_cast<double>(b.y) - a.y) * (x - a.x) >= 0;
        d = std::min(d, to_segment(x, y, a, b));
    }
    return in || d <= radius;
}

} // namespace

TEST(GeometryMass, Circle)
{
    Scene scene(weightless());
    const Thing t = add_dynamic(scene, {0, 0}, Circle{.center = {0.5f, -1}, .radius = 0.75f}, {.density = 2});
    const double area = 3.14159265358979 * 0.75 * 0.75;
    EXPECT_NEAR(scene.body(t.body).mass(), 2 * area, 1e-5);
    EXPECT_NEAR(scene.body(t.body).inertia(), 2 * area * 0.75 * 0.75 / 2, 1e-5);
    EXPECT_EQ(scene.body(t.body).local_center_of_mass(), (Vec2{0.5f, -1}));
}

TEST(GeometryMass, RoundedPolygonsOf3To40Vertices)
{
    Random random(31);
    for (const int n : {3, 4, 5, 7, 12, 25, 40})
        for (const float radius : {0.0f, 0.15f})
        {
            SCOPED_TRACE(std::to_string(n) + " vertices, radius " + std::to_string(radius));
            const std::vector<Vec2> points = ring(n, random);
            expect_mass(Polygon{points, radius}, integrate(2, 900, [&](double x, double y)
                                                           { return in_convex(points, x, y, static_cast<double>(radius)); }));
        }
}

TEST(GeometryMass, ClockwiseIsTheSame)
{
    Random random(32);
    std::vector<Vec2> points = ring(6, random);
    const Sums want = integrate(2, 900, [&](double x, double y) { return in_convex(points, x, y, 0); });
    std::reverse(points.begin(), points.end());
    expect_mass(Polygon{points}, want);
}

TEST(GeometryMass, TaperedCapsules)
{
    for (const float rb : {0.3f, 0.1f, 0.02f})
    {
        const Capsule capsule{{-0.6f, 0.2f}, {0.7f, -0.1f}, 0.3f, rb};
        // The hull of two circles is the union of the circles between, radius running from one to the other.
        const double ex = 1.3;
        const double ey = static_cast<double>(-0.1f) - static_cast<double>(0.2f);
        const double l = std::hypot(ex, ey);
        const double slope = (0.3 - static_cast<double>(rb)) / l; // sin of the taper
        const Sums want = integrate(1.2, 1200,
                                    [&](double x, double y)
                                    {
                                        const double along = ((x + 0.6) * ex + (y - 0.2) * ey) / l;
                                        const double across = std::fabs((x + 0.6) * ey - (y - 0.2) * ex) / l;
                                        // The circle whose side passes nearest stands at along shifted towards the thick end... distance to the hull's axis, tilted.
                                        const double t =
                                            std::clamp(along - across * slope / std::sqrt(1 - slope * slope), 0.0, l);
                                        return std::hypot(along - t, across) <= 0.3 - slope * t;
                                    });
        SCOPED_TRACE(rb);
        expect_mass(capsule, want);
    }
}

TEST(GeometryMass, AThickSegmentIsTheCapsuleItIs)
{
    const Segment segment{{-0.5f, 0.1f}, {0.7f, 0.4f}, 0.2f};
    expect_mass(segment, integrate(1.2, 1000, [&](double x, double y) { return to_segment(x, y, segment.a, segment.b) <= 0.2; }));
}

TEST(GeometryMass, SeveralShapesAddUp)
{
    Scene scene(weightless());
    const BodyId body = scene.create_body({.type = BodyType::Dynamic});
    scene.create_shape(body, box(0.5f, 0.5f, {-1, 0}), {.density = 1});
    const ShapeId heavy = scene.create_shape(body, box(0.5f, 0.5f, {1, 0}), {.density = 3});
    EXPECT_NEAR(scene.body(body).mass(), 4, 1e-5);
    EXPECT_NEAR(scene.body(body).local_center_of_mass().x, 0.5, 1e-6);
    EXPECT_NEAR(scene.body(body).inertia(), 1 * (1.0 / 6 + 2.25) + 3 * (1.0 / 6 + 0.25), 1e-5);
    scene.destroy(heavy);
    EXPECT_NEAR(scene.body(body).mass(), 1, 1e-6);
    EXPECT_NEAR(scene.body(body).local_center_of_mass().x, -1, 1e-6);
    // Triggers have no mass... a trigger shape on the same body leaves it as it was.
    scene.body(body).set_mass({.mass = 9, .center = {0.25f, 0}, .inertia = 2});
    EXPECT_EQ(scene.body(body).mass(), 9);
    EXPECT_EQ(scene.body(body).local_center_of_mass(), (Vec2{0.25f, 0}));
    scene.body(body).reset_mass();
    EXPECT_NEAR(scene.body(body).mass(), 1, 1e-6);
}

// The body's frame stays where it is when its center of mass moves, and its material keeps its velocity.
TEST(GeometryMass, AChangedCenterMovesNothing)
{
    Scene scene(weightless());
    const Thing t = add_dynamic(scene, {1, 2}, box(0.5f, 0.5f), {}, {3, 0}, 2);
    const Vec2 corner = scene.body(t.body).velocity_at({1.5, 2.5});
    scene.create_shape(t.body, box(0.5f, 0.5f, {4, 0}));
    EXPECT_NEAR(scene.body(t.body).position().x, 1, 1e-6);
    EXPECT_NEAR(scene.body(t.body).velocity_at({1.5, 2.5}).x, corner.x, 1e-4);
    EXPECT_NEAR(scene.body(t.body).velocity_at({1.5, 2.5}).y, corner.y, 1e-4);
}
