// A block rocks from edge to edge as Housner (1963) says: it turns about its edge without loss, and when it meets the other edge, that impact alone takes
// 1 - (1 - 1.5 sin² a)² of its energy, a the angle of the diagonal.

#include "support/test_scene.h"

#include <cmath>
#include <numbers>
#include <span>

using namespace carom;
using namespace carom::test;

namespace {

struct Block
{
    float width = 0.5f;
    float height = 2;
    double share = 0.8; ///< of the angle at which it would fall over
};

constexpr ShapeDef rough{.friction = 2, .restitution = 0};

double diagonal(const Block& block) { return std::atan(static_cast<double>(block.width / block.height)); }

double first_swing_of_theory(const Block& block)
{
    const double a = diagonal(block);
    const double keeps = 1 - 1.5 * std::sin(a) * std::sin(a);
    return a - std::acos(std::cos(a) + keeps * keeps * (std::cos(a - block.share * a) - std::cos(a)));
}

// Turned about its left edge, which stays at the origin.
BodyId add_block(Scene& scene, const Block& block, double x, double y, Vec2 velocity = {})
{
    const double turn = block.share * diagonal(block);
    const double w = 0.5 * static_cast<double>(block.width);
    const double h = 0.5 * static_cast<double>(block.height);
    const BodyId body =
        scene.create_body({.type = BodyType::Dynamic,
                           .position = {x + w * std::cos(turn) - h * std::sin(turn), y + w * std::sin(turn) + h * std::cos(turn)},
                           .angle = static_cast<float>(turn),
                           .velocity = velocity});
    scene.create_shape(body, box(0.5f * block.width, 0.5f * block.height), rough);
    return body;
}

double first_swing(Scene& scene, BodyId body, float h = 1.0f / 60)
{
    double least = 0;
    for (float t = 0; t < 6; t += h)
    {
        scene.step(h);
        const double angle = scene.body(body).angle();
        least = std::min(least, angle);
        if (least < 0 && angle > 0.5 * least)
            break;
    }
    return -least;
}

void expect_swing(Scene& scene, BodyId body, const Block& block, double share, float h = 1.0f / 60)
{
    const double theory = first_swing_of_theory(block);
    EXPECT_NEAR(first_swing(scene, body, h), theory, share * theory);
}

Chain long_ground()
{
    Chain ground{.start = {-20.13f, 0}};
    for (int i = -39; i <= 40; ++i)
        ground.pieces.push_back({.end = {0.5f * static_cast<float>(i) - 0.13f, 0}});
    return ground;
}

} // namespace

TEST(LawRocking, BlocksOfAnySizeSwingBackAsHighAsTheImpactLeavesThem)
{
    for (const Block block : {Block{}, Block{.share = 0.4}, Block{.width = 1, .share = 0.6}, Block{.width = 1.5f, .share = 0.5},
                              Block{.width = 0.3f, .share = 0.7}, Block{0.1f, 0.4f, 0.7}, Block{5, 15, 0.6}})
    {
        SCOPED_TRACE("block of " + std::to_string(block.width) + " x " + std::to_string(block.height));
        Scene scene({.gravity = {0, -9.81f}});
        add_static(scene, box(50, 0.5f, {0, -0.5f}), rough);
        expect_swing(scene, add_block(scene, block, -0.5 * static_cast<double>(block.width), 0), block, 0.015);
    }
}

TEST(LawRocking, ItConverges)
{
    double coarse = 0;
    for (const float h : {1.0f / 60, 1.0f / 240})
    {
        Scene scene({.gravity = {0, -9.81f}});
        add_static(scene, box(50, 0.5f, {0, -0.5f}), rough);
        const Block block{0.1f, 0.4f, 0.7};
        const double theory = first_swing_of_theory(block);
        const double error = std::abs(first_swing(scene, add_block(scene, block, 0, 0), h) - theory);
        EXPECT_LT(error, coarse > 0 ? 0.5 * coarse : 0.015 * theory);
        coarse = error;
    }
}

TEST(LawRocking, OnAnyGround)
{
    const Block block;
    const auto on = [&](const char* name, const auto& lay)
    {
        SCOPED_TRACE(name);
        Scene scene({.gravity = {0, -9.81f}});
        lay(scene);
        expect_swing(scene, add_block(scene, block, -0.25, 0), block, 0.02);
    };
    on("half-space", [](Scene& scene) { add_static(scene, HalfSpace{}, rough); });
    on("segment", [](Scene& scene) { add_static(scene, Segment{{-10, 0}, {10, 0}}, rough); });
    on("chain", [](Scene& scene) { add_static(scene, long_ground(), rough); });
    on("tiles",
       [](Scene& scene)
       {
           for (int i = -10; i < 10; ++i)
               add_static(scene, box(0.35f, 0.25f, {0.7f * static_cast<float>(i) + 0.11f, -0.25f}), rough);
       });
}

TEST(LawRocking, OnALift)
{
    const Block block;
    Scene scene({.gravity = {0, -9.81f}});
    const BodyId lift = scene.create_body({.type = BodyType::Kinematic, .velocity = {1, 0.5f}});
    scene.create_shape(lift, box(10, 0.5f, {0, -0.5f}), rough);
    expect_swing(scene, add_block(scene, block, -0.25, 0, {1, 0.5f}), block, 0.02);
}

// A block on a heavy platform, with other boxes beside.
struct Company
{
    Scene scene{{.gravity = {0, -9.81f}}};
    BodyId block;

    Company(const Block& of, int others)
    {
        add_static(scene, HalfSpace{}, rough);
        const BodyId platform = scene.create_body({.type = BodyType::Dynamic, .position = {0, 0.25}});
        ShapeDef heavy = rough;
        heavy.density = 1000;
        scene.create_shape(platform, box(50, 0.25f), heavy);
        for (int i = 0; i < others; ++i)
            add_dynamic(scene, {-2.0 - 0.4 * i, 0.65}, box(0.15f, 0.15f), rough);
        block = add_block(scene, of, -0.25, 0.5);
    }
};

// A blow begins anywhere within a step, and often goes on in the next.
TEST(LawRocking, OnAHeavyPlatformBesideAnyNumberOfOthers)
{
    const auto on_platform = [](const Block& block, int others, double share, float h)
    {
        SCOPED_TRACE("beside " + std::to_string(others) + ", block of " + std::to_string(block.width));
        Company company(block, others);
        expect_swing(company.scene, company.block, block, share, h);
    };
    for (const Block block : {Block{}, Block{.width = 0.3f}, Block{.width = 1, .share = 0.6}})
    {
        on_platform(block, 10, 0.02, 1.0f / 60);
        for (const int others : {20, 150})
        {
            for (const double more : {-0.05, -0.03, -0.01, 0.0, 0.02})
            {
                Block raised = block;
                raised.share += more;
                on_platform(raised, others, 0.04, 1.0f / 60);
                on_platform(raised, others, 0.01, 1.0f / 240);
            }
        }
    }
}

// The loads that a blow must not take back are among them.
TEST(LawRocking, ContactsReportTheImpulsesThatChangeItsMomentum)
{
    Company company({.width = 0.3f}, 30);
    const Body block = company.scene.body(company.block);
    const float weight = block.mass() * 9.81f / 60;
    bool bore = true;
    for (int i = 0; i < 180; ++i)
    {
        const Vec2 before = block.velocity();
        company.scene.step(1.0f / 60);
        Vec2 impulse{0, -weight};
        for (const ContactInfo& contact : block.contacts())
        {
            const float sign = contact.shape_b == block.shapes().front() ? 1.0f : -1.0f;
            for (const ContactInfo::Point& p : std::span(contact.points).first(static_cast<std::size_t>(contact.point_count)))
                impulse += sign * (p.normal_impulse * contact.normal + p.friction_impulse * perp(contact.normal));
        }
        // A block that a blow has left without a load flies on, and its impacts in flight are events alone.
        if (bore)
        {
            ASSERT_LT(length(impulse - block.mass() * (block.velocity() - before)), 0.015f * weight) << "step " << i;
        }
        bore = std::abs(impulse.y) < 0.1f * weight;
    }
}
