// Bodies on joints that strike something: the blow acts through the joints.

#include "support/test_scene.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float pi_f = std::numbers::pi_v<float>;

struct Falling
{
    Scene scene;
    std::vector<BodyId> bodies{};
    float restitution = 1;

    Falling(float e, SceneDef def) : scene(def), restitution(e)
    {
        scene.create_shape(scene.create_body({}), HalfSpace{.normal = {0, 1}}, {.friction = 0, .restitution = e});
    }

    BodyId add(Vec2 at, float angle, const Geometry& geometry)
    {
        BodyDef def{.type = BodyType::Dynamic, .position = {at.x, at.y}, .angle = angle};
        bodies.push_back(scene.create_body(def));
        scene.create_shape(bodies.back(), geometry, {.friction = 0, .restitution = restitution, .filter = {.group = -1}});
        return bodies.back();
    }

    [[nodiscard]] double energy() const
    {
        double sum = 0;
        for (const BodyId id : bodies)
        {
            const auto body = scene.body(id);
            const Vec2 v = body.velocity();
            sum += 0.5 * (body.mass() * dot(v, v) + body.inertia() * body.angular_velocity() * body.angular_velocity()) -
                   body.mass() * scene.def().gravity.y * body.position().y;
        }
        return sum;
    }
};

// Bars in a row from `at`, each hinged to the last one.
void add_bars(Falling& f, int count, float angle, Vec2 at)
{
    const Vec2 u{std::cos(angle), std::sin(angle)};
    BodyId last{};
    for (int i = 0; i < count; ++i)
    {
        const BodyId bar = f.add(at + (0.25f + 0.5f * static_cast<float>(i)) * u, angle, box(0.25f, 0.05f));
        if (i > 0)
            f.scene.create_joint(RevoluteDef{.body_a = last, .body_b = bar, .anchor_a = {0.25f, 0}, .anchor_b = {-0.25f, 0}});
        last = bar;
    }
}

void add_dumbbell(Falling& f, float angle, Vec2 at)
{
    const BodyId a = f.add(at, 0, Circle{.radius = 0.1f});
    const BodyId b = f.add(at + Vec2{std::cos(angle), std::sin(angle)}, 0, Circle{.radius = 0.1f});
    f.scene.create_joint(DistanceDef{.body_a = a, .body_b = b});
}

void add_square(Falling& f, Vec2 at)
{
    for (int i = 0; i < 4; ++i)
    {
        const float angle = pi_f / 2 * static_cast<float>(i);
        f.add(at + 0.25f * Vec2{std::sin(angle), -std::cos(angle)}, angle, box(0.25f, 0.05f));
    }
    for (std::size_t i = 0; i < 4; ++i)
        f.scene.create_joint(
            RevoluteDef{.body_a = f.bodies[i], .body_b = f.bodies[(i + 1) % 4], .anchor_a = {0.25f, 0}, .anchor_b = {-0.25f, 0}});
}

void add_triangle(Falling& f, Vec2 at)
{
    for (const Vec2 corner : {Vec2{0, 0}, Vec2{0.6f, 0.3f}, Vec2{1, 0}})
        f.add(at + corner, 0, Circle{.radius = 0.1f});
    for (std::size_t i = 0; i < 3; ++i)
        f.scene.create_joint(DistanceDef{.body_a = f.bodies[i], .body_b = f.bodies[(i + 1) % 3]});
}

void add_welded(Falling& f, Vec2 at)
{
    const BodyId a = f.add(at, 0, box(0.25f, 0.05f));
    const BodyId b = f.add(at + Vec2{0.3f, 0.2f}, 1.2f, box(0.25f, 0.05f));
    f.scene.create_joint(WeldDef{.body_a = a, .body_b = b, .anchor_a = {0.25f, 0}, .anchor_b = {-0.05f, -0.05f}});
}

void expect_energy_stays(Falling& f, const std::string& what, double tolerance)
{
    const double before = f.energy();
    int impacts = 0;
    for (int i = 0; i < 300; ++i)
    {
        f.scene.step(1.0f / 60);
        impacts += static_cast<int>(f.scene.impacts().size());
        ASSERT_NEAR(f.energy() / before, 1, tolerance) << what << " in step " << i;
    }
    EXPECT_GT(impacts, 2) << what;
}

} // namespace

// Discs of equal mass on a rod fall at v, the lower one strikes: its impulse is (1 + e) v m / (1 - sin² / 2), and the discs turn freely.
TEST(LawJoinedBounces, ADumbbellBouncesAsItsMassesSay)
{
    constexpr float speed = 3;
    for (const float e : {0.3f, 0.7f, 1.0f})
    {
        for (const float angle : {0.2f, 0.7f, 1.2f})
        {
            Falling f(e, weightless());
            add_dumbbell(f, angle, {0, 0.3f});
            for (const BodyId body : f.bodies)
                f.scene.body(body).set_velocity({0, -speed});
            steps(f.scene, 6);
            const double s = std::sin(static_cast<double>(angle));
            const double impulse = (1 + static_cast<double>(e)) * speed / (1 - s * s / 2);
            const Vec2 a = f.scene.body(f.bodies[0]).velocity();
            const Vec2 b = f.scene.body(f.bodies[1]).velocity();
            EXPECT_NEAR(0.5f * (a.y + b.y), impulse / 2 - speed, 0.01 * speed) << e << ", " << angle;
            EXPECT_NEAR(0.5f * (a.x + b.x), 0, 0.01 * speed) << e << ", " << angle;
        }
    }
}

TEST(LawJoinedBounces, ElasticBouncesKeepTheEnergy)
{
    for (const float angle : {0.0f, 0.3f, 1.0f})
    {
        Falling f(1, {});
        add_dumbbell(f, angle, {0, 2});
        expect_energy_stays(f, "dumbbell at " + std::to_string(angle), 0.002);
    }
    for (const int count : {2, 3, 5})
    {
        Falling f(1, {});
        add_bars(f, count, 0, {0, 2});
        expect_energy_stays(f, std::to_string(count) + " bars", 0.002);
    }
    Falling square(1, {});
    add_square(square, {0, 2});
    expect_energy_stays(square, "square of bars", 0.002);
    Falling triangle(1, {});
    add_triangle(triangle, {0, 2});
    expect_energy_stays(triangle, "triangle of rods", 0.002);
    Falling welded(1, {});
    add_welded(welded, {0, 2});
    expect_energy_stays(welded, "welded pair", 0.002);
}

// Each blow, however many bodies hang on the one that strikes, parts the surfaces at e times the speed at which they met.
TEST(LawJoinedBounces, SurfacesPartAtTheirShareOfTheSpeed)
{
    for (const float e : {0.4f, 0.8f})
    {
        for (const int count : {2, 4, 9})
        {
            Falling f(e, weightless());
            add_bars(f, count, 0.4f, {0, 0.5f});
            for (const BodyId body : f.bodies)
                f.scene.body(body).set_velocity({0, -3});
            bool has_struck = false;
            for (int i = 0; i < 30 && !has_struck; ++i)
            {
                f.scene.step(1.0f / 60);
                for (const ImpactEvent& hit : f.scene.impacts())
                {
                    const float part = dot(hit.velocity_after_b - hit.velocity_after_a, hit.normal);
                    EXPECT_NEAR(part, e * hit.approach_speed, 0.01f * hit.approach_speed) << count << " bars";
                    has_struck = true;
                }
            }
            EXPECT_TRUE(has_struck) << count;
        }
    }
}
