// Row 9: m x'' = -k (x - length) - c x', two attachment points, either may be the world.

#include "support/test_scene.h"

#include <complex>

using namespace carom;
using namespace carom::test;

namespace {

struct Oscillator
{
    double mass;
    double stiffness;
    double damping;
    double start; // stretch at rest

    // x(t) = A e^(p t) + B e^(q t), p and q the roots of m s² + c s + k.
    [[nodiscard]] double at(double t) const
    {
        const std::complex<double> root = std::sqrt(std::complex<double>(damping * damping - 4 * mass * stiffness));
        const std::complex<double> p = (-damping + root) / (2 * mass);
        const std::complex<double> q = (-damping - root) / (2 * mass);
        return (start * (q * std::exp(p * t) - p * std::exp(q * t)) / (q - p)).real();
    }
};

struct Hung
{
    Scene scene;
    BodyId body;
    JointId joint;
    double mass;
};

Hung hang(double hertz, double zeta, const Geometry& geometry, SceneDef def = weightless())
{
    Hung h{Scene(def), {}, {}, 0};
    h.body = add_dynamic(h.scene, {2.5, 0}, geometry, {.density = 2}).body;
    h.mass = h.scene.body(h.body).mass();
    const double omega = 2 * 3.14159265358979 * hertz;
    h.joint = h.scene.create_joint(SpringDef{.body_b = h.body,
                                             .stiffness = static_cast<float>(h.mass * omega * omega),
                                             .damping = static_cast<float>(2 * zeta * h.mass * omega),
                                             .length = 2});
    return h;
}

} // namespace

TEST(Row09_Spring, FollowsTheDifferentialEquation)
{
    for (const double hertz : {1.0, 5.0})
        for (const double zeta : {0.0, 0.1, 0.2, 3.0})
            for (const float h : {1.0f / 60, 1.0f / 240})
                for (const Geometry& geometry : {Geometry{Circle{}}, Geometry{box(0.5f, 0.5f)}})
                {
                    SCOPED_TRACE("hertz " + std::to_string(hertz) + " zeta " + std::to_string(zeta) + " h " + std::to_string(h) +
                                 " shape " + std::to_string(geometry.index()));
                    Hung hung = hang(hertz, zeta, geometry);
                    const double omega = 2 * 3.14159265358979 * hertz;
                    const Oscillator want{hung.mass, hung.mass * omega * omega, 2 * zeta * hung.mass * omega, 0.5};
                    double worst = 0;
                    const int count = static_cast<int>(3 / hertz / static_cast<double>(h) + 0.5); // three periods
                    for (int i = 1; i <= count; ++i)
                    {
                        hung.scene.step(h);
                        const double x = hung.scene.body(hung.body).position().x - 2;
                        worst = std::max(worst, std::fabs(x - want.at(i * static_cast<double>(h))));
                    }
                    // 3 periods are 19 radians. A phase error of (omega h)²/8 per radian, h the sub-step, is what a good second-order
                    // integrator may leave; the rest is the position error within a sub-step.
                    const double oh = omega * static_cast<double>(h) / 4;
                    EXPECT_LT(worst, 0.5 * (19 * oh * oh / 4 + 0.02));
                }
}

TEST(Row09_Spring, AnUndampedSpringKeepsItsAmplitude)
{
    for (const double hertz : {1.0, 5.0})
    {
        Hung hung = hang(hertz, 0, Circle{});
        double high = 0;
        for (int i = 0; i < 60 * 20; ++i)
        {
            hung.scene.step(1.0f / 60);
            if (i > 60 * 18)
                high = std::max(high, std::fabs(hung.scene.body(hung.body).position().x - 2));
        }
        EXPECT_NEAR(high, 0.5, 0.02) << hertz;
    }
}

TEST(Row09_Spring, StableHoweverStiff)
{
    for (const float stiffness : {1e4f, 1e6f, 1e8f, 1e12f})
        for (const float damping : {0.0f, 1e2f, 1e6f, 1e10f})
            for (const Geometry& geometry : {Geometry{Circle{}}, Geometry{box(0.5f, 0.5f)}})
            {
                SCOPED_TRACE("k " + std::to_string(stiffness) + " c " + std::to_string(damping));
                Scene scene(weightless());
                const BodyId body = add_dynamic(scene, {2.5, 0}, geometry).body;
                scene.create_joint(SpringDef{.body_b = body, .stiffness = stiffness, .damping = damping, .length = 2});
                double farthest = 0;
                for (int i = 0; i < 600; ++i)
                {
                    scene.step(1.0f / 60);
                    farthest = std::max(farthest,
                                        std::fabs(std::hypot(scene.body(body).position().x, scene.body(body).position().y) - 2));
                }
                EXPECT_LT(farthest, 0.55);
                EXPECT_FALSE(scene.report().has(StepFlag::BodyQuarantined));
                EXPECT_TRUE(scene.body(body).is_enabled());
            }
}

TEST(Row09_Spring, TwoBodiesOscillateAboutTheirCommonCenter)
{
    Scene scene(weightless());
    const BodyId a = add_dynamic(scene, {0, 0}, Circle{}, {.density = 1}).body;
    const BodyId b = add_dynamic(scene, {3, 0}, Circle{}, {.density = 3}).body;
    const double ma = scene.body(a).mass();
    const double mb = scene.body(b).mass();
    const double k = 20;
    scene.create_joint(SpringDef{.body_a = a, .body_b = b, .stiffness = static_cast<float>(k), .length = 2.5f});
    const Oscillator want{ma * mb / (ma + mb), k, 0, 0.5};
    double worst = 0;
    for (int i = 1; i <= 240; ++i)
    {
        scene.step(1.0f / 120);
        const double stretch = scene.body(b).position().x - scene.body(a).position().x - 2.5;
        worst = std::max(worst, std::fabs(stretch - want.at(i / 120.0)));
        EXPECT_NEAR((ma * scene.body(a).position().x + mb * scene.body(b).position().x) / (ma + mb), 3 * mb / (ma + mb), 1e-5);
    }
    EXPECT_LT(worst, 0.02);
}

TEST(Row09_Spring, NegativeLengthIsMeasured)
{
    Scene scene(weightless());
    const BodyId body = add_dynamic(scene, {3, 4}, Circle{}).body;
    const JointId joint = scene.create_joint(SpringDef{.body_b = body, .stiffness = 50});
    EXPECT_NEAR(std::get<SpringDef>(scene.joint(joint).def()).length, 5, 1e-6);
    EXPECT_NEAR(scene.joint(joint).coordinate(), 5, 1e-6);
    steps(scene, 60);
    EXPECT_NEAR(speed(scene, body), 0, 1e-6);
}

// Row 11: a plunger on a slider, pulled back against its spring and let go, throws a resting ball: the energy of the spring is
// shared as by mechanics. Rod and ball move together until the spring is at its length (a ball that only leans on the rod leaves there).
TEST(Row11_SpringLauncher, RodAndBallShareTheEnergyOfTheSpring)
{
    for (const float h : {1.0f / 240, 1.0f / 1000})
    {
        Scene scene(weightless());
        const BodyId rod = add_dynamic(scene, {-0.3, 0}, box(0.2f, 0.1f), {.density = 5, .friction = 0, .restitution = 0}).body;
        const BodyId ball =
            add_dynamic(scene, {0, 0}, Circle{.radius = 0.1f}, {.density = 20, .friction = 0, .restitution = 0}).body;
        const double m_rod = scene.body(rod).mass();
        const double m_ball = scene.body(ball).mass();
        scene.create_joint(PrismaticDef{.body_b = rod, .anchor_a = {-0.3f, 0}, .axis_a = {1, 0}});
        // The spring's anchor is far behind, so that it is 0.1 m short of its length at the start.
        const double k = 400;
        const double pull = 0.1;
        scene.create_joint(SpringDef{
            .body_b = rod, .anchor_a = {-2.3f, 0}, .stiffness = static_cast<float>(k), .length = static_cast<float>(2 + pull)});
        double fastest = 0;
        for (int i = 0; i < static_cast<int>(0.6f / h); ++i)
        {
            scene.step(h);
            fastest = std::max(fastest, static_cast<double>(scene.body(ball).velocity().x));
        }
        const double want = std::sqrt(k * pull * pull / (m_rod + m_ball));
        EXPECT_NEAR(fastest, want, 0.02 * want) << "h " << h;
        EXPECT_NEAR(scene.body(ball).velocity().x, want, 0.02 * want);
    }
}

// x(t) = F / k (1 - cos w t), on a slider whose limits are far away.
TEST(Row09Springs, AConstantPushAgainstASpringOnASlider)
{
    for (const float h : {1.0f / 60, 1.0f / 1000})
    {
        Scene scene(weightless());
        const BodyId rod = add_dynamic(scene, {}, box(0.1f, 0.1f)).body;
        const float mass = scene.body(rod).mass();
        constexpr float omega = 6;
        scene.create_joint(
            PrismaticDef{.body_b = rod, .axis_a = {1, 0}, .enable_limit = true, .lower_translation = -5, .upper_translation = 5});
        scene.create_joint(SpringDef{.body_b = rod, .anchor_a = {-9, 0}, .stiffness = mass * omega * omega, .length = 9});
        const float push = 36 * mass;
        for (int i = 1; i <= static_cast<int>(std::lround(2 / h)); ++i)
        {
            scene.body(rod).apply_force({push, 0});
            scene.step(h);
            const double t = static_cast<double>(h) * i;
            ASSERT_NEAR(scene.body(rod).position().x, 1 - std::cos(omega * t), 0.01) << "h " << h << " at " << t;
        }
    }
}
