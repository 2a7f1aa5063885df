// Stacks, arches without mortar and planks that overhang a table stay where they were put, but for what soft contacts yield, and come to rest.

#include "support/test_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr ShapeDef masonry{.friction = 1, .restitution = 0};

struct Structure
{
    Scene scene{{.gravity = {0, -9.81f}, .sleeping = false}};
    std::vector<BodyId> bodies{};
    std::vector<Position> places{};

    void add(Position at, const Geometry& shape)
    {
        bodies.push_back(add_dynamic(scene, at, shape, masonry).body);
        places.push_back(scene.body(bodies.back()).position());
    }

    void stand(float h, float seconds = 10)
    {
        for (float t = 0; t < seconds; t += h)
            scene.step(h);
    }

    [[nodiscard]] double strayed() const
    {
        double most = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i)
        {
            const Position now = scene.body(bodies[i]).position();
            most = std::max(most, std::hypot(now.x - places[i].x, now.y - places[i].y));
        }
        return most;
    }

    [[nodiscard]] double fastest() const
    {
        double most = 0;
        for (const BodyId body : bodies)
            most = std::max(most, static_cast<double>(length(scene.body(body).velocity())));
        return most;
    }
};

void build_stack(Structure& s, int boxes)
{
    add_static(s.scene, box(5, 0.5f, {0, -0.5f}), masonry);
    for (int i = 0; i < boxes; ++i)
        s.add({0, 0.5 + i}, box(0.5f, 0.5f));
}

// A half circle of stones, 5 m to the inside.
void build_arch(Structure& s, int stones)
{
    add_static(s.scene, box(50, 0.5f, {0, -0.5f}), masonry);
    for (int i = 0; i < stones; ++i)
    {
        const auto at = [&](double radius, double part)
        {
            const double angle = std::numbers::pi * (i + part) / stones;
            return std::array{radius * std::cos(angle), radius * std::sin(angle)};
        };
        const auto center = at(5.5, 0.5);
        Polygon stone;
        for (const auto& [x, y] : {at(5, 0), at(6, 0), at(6, 1), at(5, 1)})
            stone.vertices.push_back({static_cast<float>(x - center[0]), static_cast<float>(y - center[1])});
        s.add({center[0], center[1]}, stone);
    }
}

// Each plank of 2 m lies out over the one below as far as it can times `share`.
void build_overhang(Structure& s, int planks, double share)
{
    add_static(s.scene, box(2, 0.5f, {-2, -0.5f}), masonry);
    double end = 0;
    for (int i = 0; i < planks; ++i)
    {
        end += share / (planks - i);
        s.add({end - 1, 0.1 + 0.2 * i}, box(1, 0.1f));
    }
}

constexpr double at_rest = 0.005; // m/s

// So many bodies stray by less than that, m.
using Bounds = std::vector<std::pair<int, double>>;

template <class Build>
void expect_stands(const Build& build, const Bounds& bounds)
{
    for (const auto& [bodies, strays] : bounds)
    {
        SCOPED_TRACE(std::to_string(bodies) + " bodies");
        Structure s;
        build(s, bodies);
        s.stand(1.0f / 60);
        EXPECT_LT(s.strayed(), strays);
        EXPECT_LT(s.fastest(), at_rest);
    }
}

} // namespace

TEST(LawStanding, StacksSinkByLittle)
{
    expect_stands(build_stack, {{2, 0.0003}, {10, 0.0074}, {16, 0.02}, {17, 0.022}, {50, 0.19}, {100, 0.8}});
}

TEST(LawStanding, ArchesSagByLittle) { expect_stands(build_arch, {{7, 0.00095}, {9, 0.0019}, {15, 0.008}, {25, 0.031}}); }

// Under gravity g, n loads of the pair's own weight press two boxes together by 2 n g / w^2, w the frequency of contacts: and by 5/4 of it, because two points
// bear the load and either gives way on its own.
TEST(LawStanding, ContactsAreAsManyTimesAsStiffAsThereArePasses)
{
    for (const int passes : {1, 2, 4, 9})
    {
        SCOPED_TRACE(std::to_string(passes) + " passes");
        Structure s;
        s.scene = Scene({.gravity = {0, -9.81f}, .most_passes = passes, .sleeping = false});
        build_stack(s, 20);
        s.stand(1.0f / 60);
        const double w = 2 * std::numbers::pi * 0.15 * 240;
        const double sinks = (1.25 * 2 * 190 + 1.25 * 20 / 4.0) * 9.81 / (w * w * passes);
        EXPECT_NEAR(s.strayed(), sinks, 0.03 * sinks);
        double load = 0;
        for (const ContactInfo& contact : s.scene.contacts())
            for (int i = 0; i < contact.point_count; ++i)
                load += static_cast<double>(contact.points[i].normal_impulse);
        const double weights = 20 * 21 / 2 * static_cast<double>(s.scene.body(s.bodies[0]).mass()) * 9.81 / 60;
        EXPECT_NEAR(load, weights, 1e-4 * weights) << "the sums over the step are those of the last pass of each sub-step";
    }
}

TEST(LawStanding, PlanksOverhangATable)
{
    struct Overhang
    {
        int planks;
        double share;
        double tilts; ///< degrees
    };
    for (const auto& [planks, share, tilts] : {Overhang{2, 0.95, 0.087}, {4, 0.95, 0.087}, {4, 0.9, 0.087}, {8, 0.9, 0.38}})
    {
        SCOPED_TRACE(std::to_string(planks) + " planks to " + std::to_string(share));
        Structure s;
        build_overhang(s, planks, share);
        s.stand(1.0f / 60);
        EXPECT_LT(std::abs(s.scene.body(s.bodies.back()).angle()), tilts / 180 * std::numbers::pi);
        EXPECT_LT(s.fastest(), at_rest);
    }
}

TEST(LawStanding, ItConverges)
{
    for (const auto& build : {build_stack, build_arch})
    {
        double coarse = 0;
        for (const float h : {1.0f / 60, 1.0f / 240})
        {
            Structure s;
            build(s, 11);
            s.stand(h, 5);
            EXPECT_LT(s.strayed(), coarse > 0 ? 0.5 * coarse : 1);
            coarse = s.strayed();
        }
    }
}
