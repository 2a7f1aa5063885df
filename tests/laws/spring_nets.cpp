// Springs that share bodies, free of friction: energy, momentum and angular momentum stay, whatever the springs' number and stiffness.

#include "support/test_scene.h"

#include <array>
#include <cmath>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

struct Totals
{
    double energy = 0;
    double px = 0;
    double py = 0;
    double spin = 0;
};

struct Net
{
    struct Thread
    {
        BodyId a;
        BodyId b;
        Vec2 anchor_a;
        Vec2 anchor_b;
        double length;
        double stiffness;
    };

    Scene scene = Scene(weightless());
    std::vector<BodyId> bodies{};
    std::vector<Thread> threads{};

    BodyId add(Vec2 at, const Geometry& geometry)
    {
        bodies.push_back(add_dynamic(scene, at, geometry, {.filter = {.mask = 0}}).body);
        return bodies.back();
    }

    [[nodiscard]] Vec2 place(BodyId body, Vec2 anchor) const
    {
        const auto of = scene.body(body);
        const double c = std::cos(static_cast<double>(of.angle()));
        const double s = std::sin(static_cast<double>(of.angle()));
        return {static_cast<float>(of.position().x + c * anchor.x - s * anchor.y),
                static_cast<float>(of.position().y + s * anchor.x + c * anchor.y)};
    }

    [[nodiscard]] double distance(const Thread& t) const
    {
        const Vec2 gap = place(t.b, t.anchor_b) - place(t.a, t.anchor_a);
        return std::hypot(static_cast<double>(gap.x), static_cast<double>(gap.y));
    }

    void join(BodyId a, BodyId b, double stiffness, double longer, Vec2 anchor_a = {}, Vec2 anchor_b = {})
    {
        Thread& t = threads.emplace_back(Thread{a, b, anchor_a, anchor_b, 0, stiffness});
        t.length = longer * distance(t);
        scene.create_joint(SpringDef{.body_a = a,
                                     .body_b = b,
                                     .anchor_a = anchor_a,
                                     .anchor_b = anchor_b,
                                     .stiffness = static_cast<float>(stiffness),
                                     .length = static_cast<float>(t.length)});
    }

    [[nodiscard]] Totals totals() const
    {
        Totals sum;
        for (const BodyId id : bodies)
        {
            const auto body = scene.body(id);
            const double m = body.mass();
            const Vec2 v = body.velocity();
            const double w = body.angular_velocity();
            sum.energy += 0.5 * (m * dot(v, v) + body.inertia() * w * w);
            sum.px += m * v.x;
            sum.py += m * v.y;
            sum.spin += m * (body.position().x * v.y - body.position().y * v.x) + body.inertia() * w;
        }
        for (const Thread& t : threads)
            sum.energy += 0.5 * t.stiffness * (distance(t) - t.length) * (distance(t) - t.length);
        return sum;
    }
};

// Triangles in a strip, a tenth too small for their springs.
Net truss(int masses, double stiffness)
{
    Net net;
    for (int i = 0; i < masses; ++i)
    {
        net.add({0.5f * static_cast<float>(i), i % 2 == 0 ? 0.0f : 0.9f}, Circle{.radius = 0.3f});
        for (int k = 1; k <= 2 && k <= i; ++k)
            net.join(net.bodies[static_cast<std::size_t>(i - k)], net.bodies.back(), stiffness, 1.1);
    }
    return net;
}

// Bars and springs between points off their centers.
Net bars(double stiffness)
{
    Net net;
    const BodyId a = net.add({0, 0}, box(0.5f, 0.1f));
    const BodyId b = net.add({1.5f, 0.2f}, box(0.5f, 0.2f));
    net.join(a, b, stiffness, 1.2, {0.5f, 0.1f}, {-0.5f, 0.1f});
    net.join(a, b, stiffness, 1.1, {0.5f, -0.1f}, {-0.5f, -0.1f});
    net.join(a, b, stiffness, 0.9, {0, 0.1f}, {0, 0.1f});
    return net;
}

void expect_kept(Net net, int steps, const std::string& what)
{
    for (std::size_t i = 0; i < net.bodies.size(); ++i)
        net.scene.body(net.bodies[i]).set_velocity({0.1f, 0.1f * static_cast<float>(i)});
    const Totals before = net.totals();
    double worst = 0;
    for (int i = 0; i < steps; ++i)
    {
        net.scene.step(1.0f / 60);
        worst = std::max(worst, std::fabs(net.totals().energy / before.energy - 1));
    }
    const Totals after = net.totals();
    const double momentum = std::hypot(before.px, before.py);
    EXPECT_LT(worst, 0.002) << what;
    EXPECT_NEAR(after.px, before.px, 0.01 * momentum) << what;
    EXPECT_NEAR(after.py, before.py, 0.01 * momentum) << what;
    EXPECT_NEAR(after.spin, before.spin, 0.01 * std::fabs(before.spin)) << what;
}

} // namespace

TEST(LawSpringNets, KeepEnergyAndMomenta)
{
    for (const double stiffness : {1e3, 1e4, 1e5})
    {
        const std::string at = " at " + std::to_string(stiffness) + " N/m";
        for (const int masses : {2, 3, 5, 17, 40})
            expect_kept(truss(masses, stiffness), 120, std::to_string(masses) + " masses" + at);
        expect_kept(bars(stiffness), 120, "bars" + at);
    }
}

// Hung up at rest, each spring bears what hangs on it.
TEST(LawSpringNets, HangAtRestWhereTheirWeightPutsThem)
{
    constexpr double stiffness = 2000;
    Scene scene;
    BodyId above;
    std::vector<BodyId> bodies;
    for (int i = 0; i < 20; ++i)
    {
        bodies.push_back(
            add_dynamic(scene, {0, -0.5f * static_cast<float>(i + 1)}, Circle{.radius = 0.1f}, {.filter = {.mask = 0}}).body);
        scene.create_joint(SpringDef{
            .body_a = above, .body_b = bodies.back(), .stiffness = static_cast<float>(stiffness), .damping = 20, .length = 0.5f});
        above = bodies.back();
    }
    steps(scene, 1800);
    const double weight =
        static_cast<double>(scene.body(bodies[0]).mass()) * std::fabs(static_cast<double>(SceneDef{}.gravity.y));
    double y = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const double stretch = static_cast<double>(bodies.size() - i) * weight / stiffness;
        y -= 0.5 + stretch;
        EXPECT_NEAR(scene.body(bodies[i]).position().y, y, 1e-3) << i;
    }
}

// With one part to a sub-step, as many as there are, stiff springs are damped; with enough they are not.
TEST(LawSpringNets, SubdivisionsAreForTheUserToChoose)
{
    const auto kept = [](int most_subdivisions)
    {
        SceneDef def = weightless();
        def.most_subdivisions = most_subdivisions;
        Net net{.scene = Scene(def)};
        for (int i = 0; i < 3; ++i)
            net.add({static_cast<float>(i), i == 1 ? 0.9f : 0.0f}, Circle{.radius = 0.3f});
        for (std::size_t i = 0; i < 3; ++i)
            net.join(net.bodies[i], net.bodies[(i + 1) % 3], 1e5, 1.1);
        const double before = net.totals().energy;
        steps(net.scene, 300);
        return net.totals().energy / before;
    };
    EXPECT_LT(kept(1), 0.5);
    EXPECT_NEAR(kept(32), 1, 0.002);
}

// However stiff and damped, nothing flies apart or rings.
TEST(LawSpringNets, AreStableHoweverStiffAndDamped)
{
    for (const float stiffness : {1e6f, 1e9f})
    {
        for (const float damping : {0.0f, 1e6f})
        {
            Net net = truss(6, 1);
            for (const Net::Thread& t : net.threads)
                net.scene.create_joint(SpringDef{.body_a = t.a,
                                                 .body_b = t.b,
                                                 .stiffness = stiffness,
                                                 .damping = damping,
                                                 .length = 1.01f * static_cast<float>(t.length) / 1.1f});
            steps(net.scene, 100);
            EXPECT_FALSE(net.scene.report().has(StepFlag::BodyQuarantined));
            for (const Net::Thread& t : net.threads)
                EXPECT_NEAR(net.distance(t) * 1.1 / t.length, 1.01, 0.05) << stiffness << " N/m, " << damping << " N s/m";
        }
    }
}
