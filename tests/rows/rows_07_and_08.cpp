// Row 7: triggers. Row 8: contact begin, end and impact.

#include "support/test_scene.h"

#include <map>

using namespace carom;
using namespace carom::test;

namespace {

struct Log
{
    int enters = 0;
    int insides = 0;
    int exits = 0;
};

Log& watch(Scene& scene, ShapeId trigger, Log& log)
{
    scene.set_callbacks(trigger, {.on_trigger_enter = [&log](Scene&, const TriggerEvent&) { ++log.enters; },
                                  .on_trigger_inside = [&log](Scene&, const TriggerEvent&) { ++log.insides; },
                                  .on_trigger_exit = [&log](Scene&, const TriggerEvent&) { ++log.exits; }});
    return log;
}

} // namespace

TEST(Row07_Trigger, PassesThroughAndReportsEnterInsideExit)
{
    Scene scene(weightless());
    const Thing trigger = add_static(scene, box(0.5f, 5), {.trigger = true});
    const Thing ball = add_dynamic(scene, {-2, 0}, Circle{.radius = 0.25f}, {}, {2, 0});
    Log log;
    watch(scene, trigger.shape, log);
    int inside_steps = 0;
    for (int i = 0; i < 120; ++i)
    {
        scene.step(1.0f / 60);
        const double x = scene.body(ball.body).position().x;
        const bool inside = !scene.inside(trigger.shape).empty();
        inside_steps += inside;
        if (std::fabs(x) < 0.7)
        {
            EXPECT_TRUE(inside) << x;
        }
        if (std::fabs(x) > 0.8)
        {
            EXPECT_FALSE(inside) << x;
        }
    }
    EXPECT_EQ(log.enters, 1);
    EXPECT_EQ(log.exits, 1);
    EXPECT_EQ(log.insides, inside_steps);
    EXPECT_NEAR(inside_steps, 1.5 / 2 * 60, 3);
    EXPECT_NEAR(scene.body(ball.body).velocity().x, 2, 1e-6) << "it blocks nothing";
    EXPECT_TRUE(scene.impacts().empty());
}

TEST(Row07_Trigger, AFastTriggerNeverMissesABody)
{
    for (const BodyType type : {BodyType::Kinematic, BodyType::Dynamic})
    {
        Scene scene(weightless());
        add(scene, {.type = type, .position = {-3, 0}, .velocity = {200, 0}}, Circle{.radius = 0.1f}, {.trigger = true});
        add_dynamic(scene, {0, 0}, Circle{.radius = 0.1f});
        int enters = 0;
        int exits = 0;
        for (int i = 0; i < 10; ++i)
        {
            scene.step(1.0f / 60);
            enters += static_cast<int>(scene.trigger_enters().size());
            exits += static_cast<int>(scene.trigger_exits().size());
        }
        EXPECT_EQ(enters, 1);
        EXPECT_EQ(exits, 1);
    }
}

TEST(Row07_Trigger, SeesBodiesOfEveryTypeAndSleepers)
{
    for (const BodyType type : {BodyType::Static, BodyType::Kinematic, BodyType::Dynamic})
        for (const BodyType trigger_type : {BodyType::Static, BodyType::Kinematic, BodyType::Dynamic})
            for (const bool awake : {true, false})
                for (const bool trigger_first : {true, false})
                {
                    SCOPED_TRACE("visitor " + std::to_string(static_cast<int>(type)) + " trigger " +
                                 std::to_string(static_cast<int>(trigger_type)) + " awake " + std::to_string(awake) +
                                 " trigger first " + std::to_string(trigger_first));
                    SceneDef def;
                    def.gravity = {};
                    Scene scene(def);
                    const auto visitor = [&] { return add(scene, {.type = type, .awake = awake}, box(0.5f, 0.5f)); };
                    const auto trigger = [&]
                    { return add(scene, {.type = trigger_type, .position = {0.3, 0}}, Circle{}, {.trigger = true}); };
                    const Thing a = trigger_first ? trigger() : visitor();
                    const Thing b = trigger_first ? visitor() : trigger();
                    const Thing& t = trigger_first ? a : b;
                    const Thing& v = trigger_first ? b : a;
                    scene.step(1.0f / 60);
                    EXPECT_EQ(scene.trigger_enters().size(), 1u);
                    ASSERT_EQ(scene.inside(t.shape).size(), 1u);
                    EXPECT_EQ(scene.inside(t.shape)[0], v.shape);
                    scene.destroy(v.body);
                    scene.step(1.0f / 60);
                    EXPECT_EQ(scene.trigger_exits().size(), 1u);
                    EXPECT_TRUE(scene.inside(t.shape).empty());
                }
}

TEST(Row07_Trigger, EveryEnterHasItsExitWhateverEndsIt)
{
    struct How
    {
        const char* name;
        void (*end)(Scene&, const Thing& trigger, const Thing& visitor);
    };
    const How ways[] = {
        {"destroy visitor body", [](Scene& s, const Thing&, const Thing& v) { s.destroy(v.body); }},
        {"destroy visitor shape", [](Scene& s, const Thing&, const Thing& v) { s.destroy(v.shape); }},
        {"destroy trigger body", [](Scene& s, const Thing& t, const Thing&) { s.destroy(t.body); }},
        {"destroy trigger shape", [](Scene& s, const Thing& t, const Thing&) { s.destroy(t.shape); }},
        {"disable visitor", [](Scene& s, const Thing&, const Thing& v) { s.body(v.body).set_enabled(false); }},
        {"disable trigger", [](Scene& s, const Thing& t, const Thing&) { s.body(t.body).set_enabled(false); }},
        {"teleport visitor", [](Scene& s, const Thing&, const Thing& v) { s.body(v.body).teleport({50, 0}, 0); }},
        {"teleport trigger", [](Scene& s, const Thing& t, const Thing&) { s.body(t.body).teleport({50, 0}, 0); }},
        {"filter",
         [](Scene& s, const Thing& t, const Thing&) { s.shape(t.shape).set_def({.filter = {.mask = 0}, .trigger = true}); }},
        {"no trigger any more", [](Scene& s, const Thing& t, const Thing&) { s.shape(t.shape).set_def({}); }},
        {"visitor's geometry",
         [](Scene& s, const Thing&, const Thing& v) { s.shape(v.shape).set_geometry(Circle{.center = {40, 0}}); }},
        {"ignored pair", [](Scene& s, const Thing& t, const Thing& v) { s.ignore_pair(t.body, v.body); }},
    };
    for (const How& how : ways)
        for (const bool asleep : {false, true})
        {
            SCOPED_TRACE(std::string(how.name) + (asleep ? ", asleep" : ""));
            SceneDef def;
            def.gravity = {};
            Scene scene(def);
            const Thing trigger = add_static(scene, box(1, 1), {.trigger = true});
            const Thing visitor = add_dynamic(scene, {0.2, 0}, Circle{});
            steps(scene, 2);
            ASSERT_EQ(scene.inside(trigger.shape).size(), 1u);
            if (asleep)
                scene.body(visitor.body).set_awake(false);
            how.end(scene, trigger, visitor);
            int exits = 0;
            int enters = 0;
            for (int i = 0; i < 3; ++i)
            {
                scene.step(1.0f / 60);
                for (const TriggerEvent& e : scene.trigger_exits())
                {
                    ++exits;
                    EXPECT_EQ(e.trigger, trigger.shape);
                    EXPECT_EQ(e.visitor, visitor.shape);
                }
                enters += static_cast<int>(scene.trigger_enters().size());
            }
            EXPECT_EQ(exits, 1);
            EXPECT_EQ(enters, 0);
        }
}

TEST(Row07_Trigger, SetTypeKeepsPairsPaired)
{
    SceneDef def;
    def.gravity = {};
    Scene scene(def);
    const Thing trigger = add_static(scene, box(1, 1), {.trigger = true});
    const Thing visitor = add_dynamic(scene, {0.2, 0}, Circle{});
    int balance = 0;
    for (int i = 0; i < 12; ++i)
    {
        scene.body(visitor.body).set_type(static_cast<BodyType>(i % 3));
        scene.step(1.0f / 60);
        balance += static_cast<int>(scene.trigger_enters().size()) - static_cast<int>(scene.trigger_exits().size());
        EXPECT_EQ(balance, 1) << i;
        EXPECT_EQ(scene.inside(trigger.shape).size(), 1u) << i;
    }
}

TEST(Row07_Trigger, TriggersDoNotSeeTriggers)
{
    Scene scene(weightless());
    add_static(scene, box(1, 1), {.trigger = true});
    add_dynamic(scene, {0, 0}, Circle{}, {.trigger = true});
    scene.step(1.0f / 60);
    EXPECT_TRUE(scene.trigger_enters().size() == 0 || scene.trigger_enters().size() == 2) << "both or neither";
}

TEST(Row08_CollisionCallback, BeginImpactEndAsSpansAndAsCallbacks)
{
    Scene scene({.gravity = {0, -10}, .sleeping = false});
    const Thing floor = add_static(scene, HalfSpace{}, {.restitution = 1});
    const Thing ball = add_dynamic(scene, {0, 1.5}, Circle{}, {.restitution = 1});
    std::string story;
    scene.set_callbacks(ball.shape, {.on_contact_begin =
                                         [&](Scene&, const ContactBeginEvent& e)
                                     {
                                         story += 'b';
                                         EXPECT_EQ(e.shape_a, ball.shape);
                                         EXPECT_EQ(e.shape_b, floor.shape);
                                         EXPECT_NEAR(e.normal.y, -1, 1e-5) << "from the owner to the other";
                                     },
                                     .on_impact =
                                         [&](Scene&, const ImpactEvent& e)
                                     {
                                         story += 'i';
                                         EXPECT_EQ(e.shape_a, ball.shape);
                                         EXPECT_NEAR(e.approach_speed, std::sqrt(2.0 * 10), 0.01);
                                         EXPECT_NEAR(e.speed_a - e.speed_b, e.approach_speed, 1e-4);
                                         EXPECT_NEAR(e.normal.y, -1, 1e-5);
                                         EXPECT_EQ(e.effective_mass_b, 0);
                                     },
                                     .on_contact_end = [&](Scene&, const ContactEndEvent&) { story += 'e'; }});
    int begins = 0;
    int impacts = 0;
    int ends = 0;
    for (int i = 0; i < 75; ++i)
    {
        scene.step(1.0f / 60);
        begins += static_cast<int>(scene.contact_begins().size());
        impacts += static_cast<int>(scene.impacts().size());
        ends += static_cast<int>(scene.contact_ends().size());
    }
    // Falls 1 m (0.447 s), back up and down (0.894 s): once in 75 steps.
    EXPECT_EQ(begins, 1);
    EXPECT_EQ(impacts, 1);
    EXPECT_EQ(ends, 1);
    EXPECT_EQ(story, "bie");
}

TEST(Row08_CollisionCallback, EveryBeginHasItsEnd)
{
    struct How
    {
        const char* name;
        void (*end)(Scene&, const Thing&);
    };
    const How ways[] = {
        {"destroy body", [](Scene& s, const Thing& t) { s.destroy(t.body); }},
        {"destroy shape", [](Scene& s, const Thing& t) { s.destroy(t.shape); }},
        {"disable", [](Scene& s, const Thing& t) { s.body(t.body).set_enabled(false); }},
        {"teleport", [](Scene& s, const Thing& t) { s.body(t.body).teleport({0, 50}, 0); }},
        {"filter", [](Scene& s, const Thing& t) { s.shape(t.shape).set_def({.filter = {.category = 0, .mask = 0}}); }},
        {"becomes a trigger", [](Scene& s, const Thing& t) { s.shape(t.shape).set_def({.trigger = true}); }},
        {"geometry", [](Scene& s, const Thing& t) { s.shape(t.shape).set_geometry(Circle{.center = {0, 40}}); }},
        {"impulse", [](Scene& s, const Thing& t) { s.body(t.body).set_velocity({0, 30}); }},
    };
    for (const How& how : ways)
        for (const bool asleep : {false, true})
        {
            SCOPED_TRACE(std::string(how.name) + (asleep ? ", asleep" : ""));
            Scene scene;
            add_static(scene, box(5, 0.5f, {0, -0.5f}));
            const Thing body = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f));
            int begins = 0;
            int ends = 0;
            const auto count = [&](int n)
            {
                for (int i = 0; i < n; ++i)
                {
                    scene.step(1.0f / 60);
                    begins += static_cast<int>(scene.contact_begins().size());
                    ends += static_cast<int>(scene.contact_ends().size());
                }
            };
            count(asleep ? 200 : 5);
            ASSERT_EQ(begins, 1);
            ASSERT_EQ(ends, 0);
            ASSERT_EQ(scene.body(body.body).is_awake(), !asleep);
            how.end(scene, body);
            count(5);
            EXPECT_EQ(ends, 1);
            EXPECT_EQ(begins, 1);
        }
}

TEST(Row08_CollisionCallback, ABounceInsideAStepYieldsBeginImpactAndEndInOrder)
{
    Scene scene(weightless());
    add_static(scene, HalfSpace{}, {.restitution = 1});
    add_dynamic(scene, {0, 1}, Circle{}, {.restitution = 1}, {0, -100});
    scene.step(1.0f / 60);
    ASSERT_EQ(scene.contact_begins().size(), 1u);
    ASSERT_EQ(scene.impacts().size(), 1u);
    EXPECT_NEAR(scene.impacts()[0].time, 0.5 / 100, 1e-5);
    EXPECT_NEAR(scene.contact_begins()[0].time, 0.5 / 100, 1e-5);
    scene.step(1.0f / 60);
    EXPECT_LE(scene.contact_ends().size(), 1u);
}

TEST(Row08_CollisionCallback, EventsAreSortedAndPaired)
{
    Scene scene;
    add_static(scene, Chain{.start = {-3, 0}, .pieces = {{.end = {3, 0}}, {.end = {3, 8}}, {.end = {-3, 8}}}, .closed = true});
    Random random(4);
    for (int i = 0; i < 80; ++i)
    {
        const Position at{random.range(-2.5, 2.5), random.range(0.5, 7)};
        const Vec2 velocity = random.vec(5);
        add_dynamic(scene, at, i % 2 == 0 ? Geometry{Circle{.radius = 0.2f}} : Geometry{box(0.2f, 0.2f)}, {.restitution = 0.4f},
                    velocity);
    }
    std::map<std::pair<ShapeId, ShapeId>, int> open;
    const auto key = [](ShapeId a, ShapeId b) { return std::pair(std::min(a, b), std::max(a, b)); };
    for (int i = 0; i < 400; ++i)
    {
        scene.step(1.0f / 60);
        for (std::size_t k = 1; k < scene.contact_begins().size(); ++k)
            EXPECT_LE(scene.contact_begins()[k - 1].time, scene.contact_begins()[k].time);
        for (std::size_t k = 1; k < scene.impacts().size(); ++k)
            EXPECT_LE(scene.impacts()[k - 1].time, scene.impacts()[k].time);
        for (const ContactBeginEvent& e : scene.contact_begins())
            ++open[key(e.shape_a, e.shape_b)];
        for (const ContactEndEvent& e : scene.contact_ends())
            --open[key(e.shape_a, e.shape_b)];
        for (const auto& [pair, count] : open)
            ASSERT_TRUE(count == 0 || count == 1)
                << "step " << i << " count " << count << " of " << pair.first.slot << ", " << pair.second.slot;
    }
    for (const BodyId id : scene.bodies())
        scene.destroy(id);
    scene.step(1.0f / 60);
    for (const ContactEndEvent& e : scene.contact_ends())
        --open[key(e.shape_a, e.shape_b)];
    for (const auto& [pair, count] : open)
        EXPECT_EQ(count, 0);
}
