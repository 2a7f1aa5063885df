// Rows 12 to 15: booster, bouncer, broad phase, changes inside callbacks. (Row 16 is tests/laws/tunnelling.cpp.)

#include "support/test_scene.h"

#include <functional>

using namespace carom;
using namespace carom::test;

// --- 12 ----------------------------------------------------------------------------------------------------------------------------------

TEST(Row12_Booster, AForceActsWhileABallIsInside)
{
    for (const float h : {1.0f / 60, 1.0f / 1000})
    {
        Scene scene(weightless());
        add_static(scene, box(1, 1), {.trigger = true, .field = {.force = {10, 0}}});
        const Thing ball = add_dynamic(scene, {-2, 0}, Circle{.radius = 0.1f}, {.density = 30}, {3, 0});
        const double m = scene.body(ball.body).mass();
        steps(scene, static_cast<int>(2 / h), h);
        // The ball touches the trigger over 2.2 m: v² = v0² + 2 F s / m, a step more or less.
        const double s = 2.2;
        const double v = std::sqrt(9 + 2 * 10 * s / m);
        EXPECT_NEAR(scene.body(ball.body).velocity().x, v, 10 / m * static_cast<double>(h) * 2 + 0.02 * v) << h;
        EXPECT_GT(scene.body(ball.body).velocity().x, 3.5);
    }
}

TEST(Row12_Booster, AnAccelerationIsTheSameForEveryMass)
{
    for (const float density : {1.0f, 50.0f})
    {
        Scene scene(weightless());
        add_static(scene, box(50, 50), {.trigger = true, .field = {.acceleration = {0, 4}}});
        const Thing body = add_dynamic(scene, {0, 0}, box(0.5f, 0.5f), {.density = density});
        steps(scene, 61);
        EXPECT_NEAR(scene.body(body.body).velocity().y, 4, 4.0 / 60 + 1e-3);
    }
}

TEST(Row12_Booster, DragSlowsExponentially)
{
    Scene scene(weightless());
    add_static(scene, box(50, 50), {.trigger = true, .field = {.drag = 2}});
    const Thing body = add_dynamic(scene, {0, 0}, Circle{}, {}, {8, 0});
    steps(scene, 1);
    const double v = scene.body(body.body).velocity().x;
    steps(scene, 60);
    EXPECT_NEAR(scene.body(body.body).velocity().x, v * std::exp(-2.0), 0.01 * v);
}

TEST(Row12_Booster, OnlyIfMovingAlong)
{
    for (const float sign : {1.0f, -1.0f})
    {
        Scene scene(weightless());
        add_static(scene, box(50, 50), {.trigger = true, .field = {.acceleration = {6, 0}, .only_if_moving_along = true}});
        const Thing body = add_dynamic(scene, {0, 0}, Circle{}, {}, {sign * 2, 0});
        steps(scene, 30);
        if (sign > 0)
            EXPECT_NEAR(scene.body(body.body).velocity().x, 2 + 6 * 0.5, 0.15);
        else
            EXPECT_NEAR(scene.body(body.body).velocity().x, -2, 1e-5);
    }
}

TEST(Row12_Booster, MovesNeitherKinematicNorStaticBodies)
{
    Scene scene(weightless());
    add_static(scene, box(50, 50), {.trigger = true, .field = {.force = {6, 0}, .acceleration = {6, 0}}});
    const Thing bar = add(scene, {.type = BodyType::Kinematic, .velocity = {0, 1}}, box(1, 1));
    steps(scene, 30);
    EXPECT_EQ(scene.body(bar.body).velocity(), (Vec2{0, 1}));
}

// --- 13 ----------------------------------------------------------------------------------------------------------------------------------

TEST(Row13_Bouncer, KicksAboveTheThresholdOnly)
{
    for (const Geometry& geometry : {Geometry{Circle{.radius = 0.25f}}, Geometry{box(0.25f, 0.25f)}})
        for (const float v : {0.5f, 0.9f, 1.1f, 4.0f})
        {
            SCOPED_TRACE("v " + std::to_string(v) + " shape " + std::to_string(geometry.index()));
            Scene scene(weightless());
            add_static(scene, box(0.5f, 3), {.friction = 0, .restitution = 0.5f, .kick = {.speed = 3, .threshold = 1}});
            const Thing body = add_dynamic(scene, {-1, 0}, geometry, {.friction = 0, .restitution = 0.5f}, {v, 0});
            float kick = 0;
            for (int i = 0; i < 60; ++i)
            {
                scene.step(1.0f / 60);
                if (!scene.impacts().empty())
                {
                    kick = scene.impacts()[0].kick_speed;
                    EXPECT_EQ(scene.impacts()[0].energy_lost < 0, v > 1) << "a kick adds energy here";
                }
            }
            EXPECT_EQ(kick, v > 1 ? 3.0f : 0.0f);
            EXPECT_NEAR(scene.body(body.body).velocity().x,
                        v > 1 ? -0.5 * static_cast<double>(v) - 3 : -0.5 * static_cast<double>(v), 1e-3);
        }
}

TEST(Row13_Bouncer, TheImpulseOfAKickFollowsTheEventsTerms)
{
    Scene scene(weightless());
    add_static(scene, Circle{}, {.friction = 0, .restitution = 0.2f, .kick = {.speed = 3, .threshold = 1}});
    const Thing ball =
        add_dynamic(scene, {-1, 0}, Circle{.radius = 0.25f}, {.density = 7, .friction = 0, .restitution = 0.6f}, {8, 0});
    const double m = scene.body(ball.body).mass();
    for (int i = 0; i < 10 && scene.impacts().empty(); ++i)
        scene.step(1.0f / 60);
    ASSERT_EQ(scene.impacts().size(), 1u);
    EXPECT_NEAR(scene.impacts()[0].impulse, m * (1.4 * 8 + 3), 1e-3);
}

TEST(Row13_Bouncer, CooldownHoldsItBack)
{
    Scene scene(weightless());
    // Between a bouncer and a wall that gives everything back, 1 m of way: hits come every 0.3 s and faster.
    add_static(scene, box(0.5f, 3, {-0.5f, 0}),
               {.friction = 0, .restitution = 1, .kick = {.speed = 1, .threshold = 0.5f, .cooldown = 1}});
    add_static(scene, box(0.5f, 3, {1.7f, 0}), {.friction = 0, .restitution = 1});
    add_dynamic(scene, {0.6, 0}, Circle{.radius = 0.1f}, {.friction = 0, .restitution = 1}, {-6, 0});
    std::vector<double> kicks;
    int hits = 0;
    for (int i = 0; i < 300; ++i)
    {
        scene.step(1.0f / 60);
        for (const ImpactEvent& e : scene.impacts())
        {
            ++hits;
            if (e.kick_speed > 0)
                kicks.push_back(i / 60.0 + static_cast<double>(e.time));
        }
    }
    EXPECT_GT(hits, 20);
    ASSERT_GE(kicks.size(), 4u);
    EXPECT_LE(kicks.size(), 5u);
    for (std::size_t i = 1; i < kicks.size(); ++i)
        EXPECT_GE(kicks[i] - kicks[i - 1], 1 - 1.0 / 60);
}

TEST(Row13_Bouncer, AChainHasOneCooldown)
{
    Scene scene(weightless());
    add_static(scene, Chain{.start = {-2, 0}, .pieces = {{{0, 0}}, {{2, 0}}}},
               {.friction = 0, .kick = {.speed = 1, .threshold = 0.5f, .cooldown = 1}});
    add_dynamic(scene, {-1, 0.5}, Circle{.radius = 0.1f}, {.friction = 0}, {0, -4});
    add_dynamic(scene, {1, 1.5}, Circle{.radius = 0.1f}, {.friction = 0}, {0, -4});
    add_dynamic(scene, {1.6, 5.5}, Circle{.radius = 0.1f}, {.friction = 0}, {0, -4});
    std::vector<float> kicks;
    for (int i = 0; i < 120; ++i)
    {
        scene.step(1.0f / 60);
        for (const ImpactEvent& e : scene.impacts())
            kicks.push_back(e.kick_speed);
    }
    ASSERT_EQ(kicks.size(), 3u);
    EXPECT_EQ(kicks[0], 1) << "the first ball is kicked";
    EXPECT_EQ(kicks[1], 0) << "the second comes 0.25 s later, to another piece";
    EXPECT_EQ(kicks[2], 1) << "the third after the cooldown";
}

// --- 14 ----------------------------------------------------------------------------------------------------------------------------------

TEST(Row14_BroadPhase, PairsGrowWithTheBodiesNotWithTheirSquare)
{
    const auto pairs = [](int n)
    {
        SceneDef def = weightless();
        Scene scene(def);
        Random random(1);
        const double size = std::sqrt(static_cast<double>(n)) * 1.5;
        for (int i = 0; i < n; ++i)
            add_dynamic(scene, {random.range(0, size), random.range(0, size)}, Circle{.radius = 0.3f}, {.filter = {.group = -1}},
                        random.vec(1));
        // The group forbids contacts; so count boxes that overlap through shapes that may touch.
        for (const BodyId body : scene.bodies())
            for (const ShapeId shape : scene.body(body).shapes())
                scene.shape(shape).set_def({});
        scene.step(1.0f / 60);
        return static_cast<double>(scene.report().pairs) / n;
    };
    const double small = pairs(500);
    const double large = pairs(4000);
    EXPECT_GT(small, 0.1);
    EXPECT_LT(large, 1.3 * small) << "pairs per body stay what they are";
}

TEST(Row14_BroadPhase, FindsEveryPairAmongSizesThatDifferByAThousand)
{
    SceneDef def = weightless();
    def.contact_push_speed = 0;
    Scene scene(def);
    Random random(2);
    struct Disc
    {
        Thing thing;
        Position p;
        double r;
    };
    std::vector<Disc> discs;
    for (int i = 0; i < 600; ++i)
    {
        const double r = 0.01 * std::pow(1000, random.unit() * random.unit());
        const Position p{random.range(-30, 30), random.range(-30, 30)};
        discs.push_back({add_dynamic(scene, p, Circle{.radius = static_cast<float>(r)}, {.restitution = 0}), p,
                         static_cast<double>(static_cast<float>(r))});
    }
    scene.step(1e-6f);
    int want = 0;
    for (std::size_t i = 0; i < discs.size(); ++i)
        for (std::size_t j = i + 1; j < discs.size(); ++j)
            want += std::hypot(discs[i].p.x - discs[j].p.x, discs[i].p.y - discs[j].p.y) < discs[i].r + discs[j].r;
    int got = 0;
    for (const ContactInfo& c : scene.contacts())
        got += c.point_count > 0 && c.points[0].separation < 0;
    EXPECT_GT(want, 150);
    EXPECT_EQ(got, want);
}

// --- 15 ----------------------------------------------------------------------------------------------------------------------------------

namespace {

// A rain of balls and boxes through triggers onto a floor, in which callbacks do things to the scene. The hash after 200 steps.
using Deed = std::function<void(Scene&, ShapeId own, ShapeId other, Random&)>;

struct Outcome
{
    std::uint64_t hash = 0;
    int deeds = 0;
};

Outcome rain(const Deed& deed)
{
    Scene scene;
    Random random(11);
    add_static(scene, box(10, 0.5f, {0, -0.5f}), {.restitution = 0.5f});
    add_static(scene, box(10, 0.3f, {0, 2}), {.trigger = true});
    Outcome outcome;
    const auto act = [&](Scene& s, ShapeId own, ShapeId other)
    {
        if (outcome.deeds < 400)
        {
            ++outcome.deeds;
            deed(s, own, other, random);
        }
    };
    const auto listen = [&](ShapeId shape)
    {
        scene.set_callbacks(shape,
                            {.on_contact_begin = [&act](Scene& s, const ContactBeginEvent& e) { act(s, e.shape_a, e.shape_b); },
                             .on_impact = [&act](Scene& s, const ImpactEvent& e) { act(s, e.shape_a, e.shape_b); },
                             .on_contact_end = [&act](Scene& s, const ContactEndEvent& e) { act(s, e.shape_a, e.shape_b); },
                             .on_trigger_enter = [&act](Scene& s, const TriggerEvent& e) { act(s, e.visitor, e.trigger); },
                             .on_trigger_inside = [&act](Scene& s, const TriggerEvent& e) { act(s, e.visitor, e.trigger); },
                             .on_trigger_exit = [&act](Scene& s, const TriggerEvent& e) { act(s, e.visitor, e.trigger); }});
    };
    for (int i = 0; i < 200; ++i)
    {
        if (i % 2 == 0)
        {
            const Geometry geometry = i % 4 == 0 ? Geometry{Circle{.radius = 0.2f}} : Geometry{box(0.2f, 0.2f)};
            listen(add_dynamic(scene, {random.range(-3, 3), 3}, geometry, {.restitution = 0.5f}, {0, -5}).shape);
        }
        scene.step(1.0f / 60);
    }
    outcome.hash = scene.state_hash();
    return outcome;
}

void expect_deterministic(const Deed& deed)
{
    const Outcome first = rain(deed);
    const Outcome second = rain(deed);
    EXPECT_GT(first.deeds, 20);
    EXPECT_EQ(first.deeds, second.deeds);
    EXPECT_EQ(first.hash, second.hash);
}

BodyId body_of(Scene& scene, ShapeId shape) { return scene.is_valid(shape) ? scene.shape(shape).body() : BodyId{}; }

void destroy_body(Scene& scene, ShapeId shape)
{
    const BodyId body = body_of(scene, shape);
    if (!body.is_null() && scene.body(body).type() == BodyType::Dynamic)
        scene.destroy(body);
}

} // namespace

TEST(Row15_SafeChanges, DestroyingOneself)
{
    expect_deterministic([](Scene& s, ShapeId own, ShapeId, Random&) { destroy_body(s, own); });
}

TEST(Row15_SafeChanges, DestroyingTheOther)
{
    expect_deterministic([](Scene& s, ShapeId, ShapeId other, Random&) { destroy_body(s, other); });
}

TEST(Row15_SafeChanges, DestroyingBothParties)
{
    expect_deterministic(
        [](Scene& s, ShapeId own, ShapeId other, Random&)
        {
            destroy_body(s, own);
            destroy_body(s, other);
        });
}

TEST(Row15_SafeChanges, DestroyingShapesOnly)
{
    expect_deterministic(
        [](Scene& s, ShapeId own, ShapeId, Random&)
        {
            if (s.is_valid(own))
                s.destroy(own);
        });
}

TEST(Row15_SafeChanges, DestroyingEveryDynamicBody)
{
    expect_deterministic(
        [](Scene& s, ShapeId, ShapeId, Random&)
        {
            for (const BodyId id : s.bodies())
                if (s.body(id).type() == BodyType::Dynamic)
                    s.destroy(id);
        });
}

TEST(Row15_SafeChanges, CreatingBodiesShapesAndJoints)
{
    expect_deterministic(
        [](Scene& s, ShapeId own, ShapeId, Random& random)
        {
            const Thing fresh = add_dynamic(s, {random.range(-3, 3), random.range(0.5, 4)}, Circle{.radius = 0.1f});
            const BodyId body = body_of(s, own);
            if (body.is_null())
                return;
            s.create_shape(fresh.body, box(0.1f, 0.1f, {0.2f, 0}));
            s.create_joint(DistanceDef{.body_a = body, .body_b = fresh.body});
        });
}

TEST(Row15_SafeChanges, EveryVerb)
{
    expect_deterministic(
        [](Scene& s, ShapeId own, ShapeId, Random& random)
        {
            const BodyId body = body_of(s, own);
            if (body.is_null() || s.body(body).type() != BodyType::Dynamic)
                return;
            switch (random.below(9))
            {
            case 0: s.body(body).teleport({random.range(-3, 3), 4}, 1); break;
            case 1: s.body(body).set_enabled(false); break;
            case 2: s.body(body).set_type(BodyType::Kinematic); break;
            case 3: s.body(body).set_velocity(random.vec(5)); break;
            case 4: s.shape(own).set_geometry(Capsule{{-0.1f, 0}, {0.1f, 0}, 0.1f, 0.1f}); break;
            case 5: s.shape(own).set_def({.trigger = true}); break;
            case 6: s.body(body).set_awake(false); break;
            case 7: s.body(body).set_mass({.mass = 3, .inertia = 1}); break;
            default: s.set_callbacks(own, {}); break;
            }
        });
}

TEST(Row15_SafeChanges, ChangingOnesOwnCallbacksInsideThem)
{
    Scene scene({.gravity = {0, -10}});
    add_static(scene, HalfSpace{}, {.restitution = 1});
    const Thing ball = add_dynamic(scene, {0, 1}, Circle{}, {.restitution = 1});
    int calls = 0;
    const auto big = std::make_shared<std::vector<int>>(1000, 7);
    scene.set_callbacks(ball.shape, {.on_impact = [&calls, big, shape = ball.shape](Scene& s, const ImpactEvent&)
                                     {
                                         s.set_callbacks(shape, {});
                                         calls += (*big)[999];
                                     }});
    steps(scene, 200);
    EXPECT_EQ(calls, 7) << "what it captured lives until it returns";
}

TEST(Row15_SafeChanges, SteppingInsideACallbackIsRefused)
{
    Scene scene(weightless());
    add_static(scene, box(1, 1), {.trigger = true});
    const Thing ball = add_dynamic(scene, {0, 0}, Circle{});
    int refused = 0;
    scene.set_callbacks(ball.shape, {.on_trigger_enter = [&](Scene& s, const TriggerEvent&)
                                     {
                                         EXPECT_THROW(s.step(1.0f / 60), Error);
                                         EXPECT_THROW(s.update(1.0f / 60), Error);
                                         ++refused;
                                     }});
    scene.step(1.0f / 60);
    EXPECT_EQ(refused, 1);
    EXPECT_EQ(scene.step_count(), 1u);
}

TEST(Row15_SafeChanges, AThrowInsideACallbackLeavesTheSceneUsable)
{
    Scene scene(weightless());
    add_static(scene, box(1, 1), {.trigger = true});
    const Thing ball = add_dynamic(scene, {0, 0}, Circle{});
    scene.set_callbacks(ball.shape, {.on_trigger_enter = [](Scene&, const TriggerEvent&) { throw std::runtime_error("mine"); }});
    EXPECT_THROW(scene.step(1.0f / 60), std::runtime_error);
    EXPECT_NO_THROW(steps(scene, 10));
    EXPECT_EQ(scene.step_count(), 11u);
}

TEST(Row15_SafeChanges, TheOtherPartyStillHears)
{
    // The first callback destroys its own body: the floor's callback for the same event is still called, with the stale id.
    Scene scene({.gravity = {0, -10}});
    const Thing floor = add_static(scene, HalfSpace{});
    const Thing ball = add_dynamic(scene, {0, 0.6}, Circle{});
    int heard = 0;
    const auto destroy_ball = [&](Scene& s, const ContactBeginEvent&)
    {
        if (s.is_valid(ball.body))
            s.destroy(ball.body);
    };
    scene.set_callbacks(ball.shape, {.on_contact_begin = destroy_ball});
    scene.set_callbacks(
        floor.shape, {.on_contact_begin =
                          [&](Scene& s, const ContactBeginEvent& e)
                      {
                          ++heard;
                          EXPECT_EQ(e.shape_b, ball.shape);
                          destroy_ball(s, e);
                      },
                      .on_contact_end = [&](Scene&, const ContactEndEvent& e) { heard += e.shape_b == ball.shape ? 10 : 100; }});
    steps(scene, 20);
    EXPECT_FALSE(scene.is_valid(ball.body));
    EXPECT_EQ(heard, 11);
}
