// split_concave covers an outline with convex parts, without overlap.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

double area_of(const std::vector<Vec2>& v)
{
    double twice = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
    {
        const Vec2 a = v[i];
        const Vec2 b = v[(i + 1) % v.size()];
        twice += static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
    }
    return 0.5 * twice;
}

// Crossing number.
bool inside(const std::vector<Vec2>& v, double x, double y)
{
    bool in = false;
    for (std::size_t i = 0; i < v.size(); ++i)
    {
        const Vec2 a = v[i];
        const Vec2 b = v[(i + 1) % v.size()];
        if ((a.y > y) != (b.y > y) &&
            x < static_cast<double>(a.x) + (y - a.y) * (static_cast<double>(b.x) - a.x) / (static_cast<double>(b.y) - a.y))
            in = !in;
    }
    return in;
}

double nearest_edge(const std::vector<Vec2>& v, double x, double y)
{
    double d = 1e9;
    for (std::size_t i = 0; i < v.size(); ++i)
    {
        const Vec2 a = v[i];
        const Vec2 b = v[(i + 1) % v.size()];
        const double ex = static_cast<double>(b.x) - a.x;
        const double ey = static_cast<double>(b.y) - a.y;
        const double t = std::clamp(((x - a.x) * ex + (y - a.y) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
        d = std::min(d, std::hypot(x - a.x - t * ex, y - a.y - t * ey));
    }
    return d;
}

void expect_split(const std::vector<Vec2>& outline)
{
    const std::vector<Polygon> parts = split_concave(outline);
    ASSERT_FALSE(parts.empty());
    double sum = 0;
    Scene scene(weightless());
    for (const Polygon& part : parts)
    {
        sum += area_of(part.vertices);
        EXPECT_GT(area_of(part.vertices), 0);
        EXPECT_NO_THROW(static_cast<void>(add_static(scene, part))) << "each part is a convex polygon";
    }
    EXPECT_NEAR(sum, std::fabs(area_of(outline)), 1e-4 * sum);
    Random random(4);
    int tried = 0;
    for (int i = 0; i < 2000; ++i)
    {
        const double x = random.range(-3, 3);
        const double y = random.range(-3, 3);
        if (nearest_edge(outline, x, y) < 1e-3)
            continue;
        int covered = 0;
        bool at_seam = false;
        for (const Polygon& part : parts)
        {
            covered += inside(part.vertices, x, y);
            at_seam = at_seam || nearest_edge(part.vertices, x, y) < 1e-4;
        }
        if (at_seam)
            continue;
        ++tried;
        ASSERT_EQ(covered, inside(outline, x, y) ? 1 : 0) << x << ", " << y;
    }
    EXPECT_GT(tried, 1000);
}

} // namespace

TEST(GeometrySplit, KnownOutlines)
{
    expect_split({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
    expect_split({{0, 2}, {1, 2}, {1, 1}, {2, 1}, {2, 0}, {0, 0}}); // clockwise
    expect_split({{-2, -2}, {2, -2}, {2, 2}, {1.5f, 2}, {1.5f, -1}, {-1.5f, -1}, {-1.5f, 2}, {-2, 2}});
    expect_split({{0, 0}, {2, 0}, {2, 2}, {0, 2}}); // already convex
    EXPECT_EQ(split_concave(std::vector<Vec2>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}).size(), 1u);
}

TEST(GeometrySplit, RandomStars)
{
    Random random(12);
    for (int i = 0; i < 200; ++i)
    {
        SCOPED_TRACE(i);
        std::vector<Vec2> star;
        const int n = 4 + random.below(40);
        for (int k = 0; k < n; ++k)
        {
            const double angle = 2 * 3.14159265358979 * (k + random.range(-0.3, 0.3)) / n;
            const double r = random.range(0.4, 2.5);
            star.push_back({static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle))});
        }
        if (random.chance(0.5))
            std::reverse(star.begin(), star.end());
        expect_split(star);
        if (::testing::Test::HasFailure())
            return;
    }
}

TEST(GeometryPolygon, PointsInLineAreDroppedAndAnyNumberIsTaken)
{
    Scene scene(weightless());
    const Thing t = add_dynamic(scene, {0, 0}, Polygon{{{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}}});
    EXPECT_EQ(std::get<Polygon>(scene.shape(t.shape).geometry()).vertices.size(), 4u);
    std::vector<Vec2> many;
    for (int i = 0; i < 400; ++i)
        many.push_back({static_cast<float>(10 * std::cos(i * 2 * 3.14159265358979 / 400)),
                        static_cast<float>(10 * std::sin(i * 2 * 3.14159265358979 / 400))});
    const Thing wheel = add_dynamic(scene, {0, 50}, Polygon{many});
    EXPECT_EQ(std::get<Polygon>(scene.shape(wheel.shape).geometry()).vertices.size(), 400u);
    EXPECT_NEAR(scene.body(wheel.body).mass(), area_of(many), 0.01);
}

// In quadratic time: it was cubic, 2,000 corners took 7.7 s.
TEST(GeometrySplit, ManyCorners)
{
    Random random(7);
    std::vector<Vec2> star;
    const int n = 4000;
    for (int k = 0; k < n; ++k)
    {
        const double angle = 2 * 3.14159265358979 * k / n;
        const double r = random.range(2, 3);
        star.push_back({static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle))});
    }
    double sum = 0;
    for (const Polygon& part : split_concave(star))
        sum += area_of(part.vertices);
    EXPECT_NEAR(sum, area_of(star), 1e-4 * sum);
}

// Corners that are left out leave no dent: from a circle of 100,000 ten were left.
TEST(GeometryOutlines, KeepTheirShapeWithAnyNumberOfCorners)
{
    for (const int corners : {3, 100, 500, 1000, 3000, 100000})
    {
        for (const float size : {0.01f, 1.0f, 300.0f})
        {
            SCOPED_TRACE(std::to_string(corners) + " corners of " + std::to_string(size) + " m");
            Polygon circle;
            for (int i = 0; i < corners; ++i)
            {
                const double angle = 2 * 3.14159265358979 * i / corners;
                circle.vertices.push_back(
                    {size * static_cast<float>(std::cos(angle)), size * static_cast<float>(std::sin(angle))});
            }
            Scene scene(weightless());
            const ShapeId shape = scene.create_shape(scene.create_body({}), circle);
            const Geometry geometry = scene.shape(shape).geometry();
            const std::vector<Vec2>& kept = std::get<Polygon>(geometry).vertices;
            if (corners <= 100)
            {
                EXPECT_EQ(kept.size(), circle.vertices.size());
            }
            for (std::size_t i = 0; i < kept.size() && corners > 100; ++i)
            {
                const Vec2 middle = 0.5f * (kept[i] + kept[(i + 1) % kept.size()]);
                EXPECT_LT(size - length(middle), std::max(2.5e-5f * size, 1.2e-6f));
            }
        }
    }
}

// Points on the edges of a square, near its corners too, leave its four corners wherever the outline begins.
TEST(GeometryOutlines, LoseWhatLiesOnALine)
{
    for (int first = 0; first < 400; first += 37)
    {
        Polygon square;
        for (int i = 0; i < 400; ++i)
        {
            const int k = (i + first) % 400;
            const float along = static_cast<float>(k % 100) / 50 - 1;
            const Vec2 sides[] = {{along, -1}, {1, along}, {-along, 1}, {-1, -along}};
            square.vertices.push_back(sides[k / 100]);
            if (k % 7 == 0)
                square.vertices.push_back(sides[k / 100]);
        }
        Scene scene(weightless());
        const ShapeId shape = scene.create_shape(scene.create_body({}), square);
        const Geometry geometry = scene.shape(shape).geometry();
        EXPECT_EQ(std::get<Polygon>(geometry).vertices.size(), 4u) << "from " << first;
    }
}
