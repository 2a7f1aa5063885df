// Compares the numbers of the chapters with the engine's.

#include "tour/chapters/school_geometry.h"
#include "tour/lesson.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom::tour {
namespace {

std::unique_ptr<Chapter> chapter(std::string_view name)
{
    for (auto& c : all_chapters())
    {
        if (c->name() == name)
            return std::move(c);
    }
    throw std::logic_error("no such chapter");
}

void set(Chapter& chapter, std::string_view control, float value)
{
    std::ranges::find(chapter.controls(), control, &Control::name)->value = value;
}

// As it is read: −1.50, or 3.2·10⁻⁶.
float number_of(const Chapter& chapter, const std::string& name)
{
    std::string text = chapter.values().at(name);
    if (text.starts_with("−"))
        text.replace(0, std::string_view("−").size(), "-");
    const bool is_tiny = text.find("·10⁻") != std::string::npos;
    return is_tiny ? 0 : std::stof(text);
}

} // namespace

TEST(Chapters, SayNothingThatHasNoNumber)
{
    for (auto& c : all_chapters())
    {
        SCOPED_TRACE(c->name());
        c->build();
        for (int i = 0; i < 30; ++i)
            c->step();
        const Values values = c->values();
        for (const Block& block : c->text().blocks)
        {
            for (const std::string& name : placeholders(block.text))
                EXPECT_TRUE(name == "story" || values.contains(name)) << name;
            EXPECT_EQ(filled(filled(block.text, values), {{"story", ""}}).find('{'), std::string::npos)
                << filled(block.text, values);
        }
        for (const Control& control : c->controls())
            EXPECT_TRUE(c->text().controls.contains(control.name)) << control.name;
        EXPECT_EQ(c->text().controls.size(), c->controls().size());
        EXPECT_GE(c->text().blocks.size(), 5u);
    }
}

TEST(Chapters, GoBackStepByStep)
{
    for (auto& c : all_chapters())
    {
        SCOPED_TRACE(c->name());
        Lesson lesson(std::move(c));
        for (int i = 0; i < 25; ++i)
            lesson.step();
        const std::uint64_t there = lesson.chapter().scene().state_hash();
        lesson.step();
        lesson.back();
        EXPECT_EQ(lesson.chapter().scene().state_hash(), there);
        EXPECT_EQ(lesson.steps(), 25);
        EXPECT_TRUE(lesson.paused);
    }
}

TEST(Chapters, GoBackOverWhatTheHandHasDone)
{
    Lesson lesson(chapter("01-one-step"));
    const Position ball{-3.6, 1.6};
    lesson.grab(ball, 0.1f);
    ASSERT_TRUE(lesson.holds());
    for (int i = 0; i < 20; ++i)
    {
        lesson.drag(ball + Vec2{0.05f * static_cast<float>(i), 0});
        lesson.step();
    }
    lesson.let_go();
    lesson.step();
    const std::uint64_t there = lesson.chapter().scene().state_hash();
    lesson.step();
    lesson.back();
    EXPECT_EQ(lesson.chapter().scene().state_hash(), there);
}

TEST(Chapters, StopAtTheNextImpact)
{
    Lesson lesson(chapter("04-the-blow"));
    lesson.run_to_next();
    for (int i = 0; i < 300 && !lesson.paused; ++i)
        lesson.advance(1.0 / 60);
    EXPECT_TRUE(lesson.paused);
    EXPECT_FALSE(lesson.chapter().scene().impacts().empty());
    EXPECT_GT(lesson.chapter().story().size(), 8u);
}

TEST(OneStep, PathIsThatOfSchool)
{
    const auto c = chapter("01-one-step");
    for (const float rate : {5.0f, 60.0f, 240.0f})
    {
        set(*c, "steps", rate);
        c->build();
        c->step();
        const float h = 1 / rate;
        EXPECT_NEAR(number_of(*c, "v after"), 4.2f - 9.81f * h, 0.006f);
        EXPECT_NEAR(number_of(*c, "y after"), 1.6f + 4.2f * h - 0.5f * 9.81f * h * h, 0.006f);
    }
}

// Every entry of the table: whether the engine makes two overlapping shapes touch.
TEST(WhoCanTouchWhom, IsWhatTheEngineDoes)
{
    const auto c = chapter("02-who-can-touch-whom");
    for (int a = 0; a < 6; ++a)
    {
        for (int b = 0; b < 6; ++b)
        {
            set(*c, "first", static_cast<float>(a));
            set(*c, "second", static_cast<float>(b));
            c->build();
            const std::vector<BodyId> bodies = c->scene().bodies();
            ASSERT_EQ(bodies.size(), 2u);
            bool touches = false;
            for (const float x : {-0.3f, 0.0f, 0.3f})
            {
                for (float y = -1.2f; y <= 1.2f; y += 0.1f)
                {
                    c->scene().body(bodies[1]).teleport(c->scene().body(bodies[0]).position() + Vec2{x, y}, 0.3f);
                    for (const BodyId body : bodies)
                        touches |= !c->scene().body(body).touches_now().empty();
                }
            }
            const bool never = (a == 0 || a == 5) && (b == 0 || b == 5);
            EXPECT_EQ(touches, !never) << a << " and " << b;
            EXPECT_EQ(c->values().at("place"), std::to_string(a * 6 + b));
            EXPECT_EQ(c->values().at("mirror"), std::to_string(b * 6 + a));
            EXPECT_EQ(c->values().at("function") == c->text().words.at("never"), never);
        }
    }
}

// The distances that are drawn are those of the engine's contacts.
TEST(FivePairs, AreMeasuredAsTheEngineDoes)
{
    const auto c = chapter("03-five-pairs");
    int compared = 0;
    for (int pair = 1; pair <= 5; ++pair)
    {
        set(*c, "pair", static_cast<float>(pair));
        for (const float turn : {-1.1f, 0.0f, 0.35f, 0.8f})
        {
            set(*c, "turn", turn);
            c->build();
            const std::vector<BodyId> bodies = c->scene().bodies();
            for (float y = 1.5f; y > -0.6f; y -= 0.05f)
            {
                c->scene().body(bodies[1]).teleport({0.5, static_cast<double>(y)}, c->scene().body(bodies[1]).angle());
                const auto contacts = c->scene().body(bodies[1]).touches_now();
                const bool apart = c->values().at("result").find("apart") != std::string::npos;
                if (contacts.empty())
                    continue;
                float deepest = 1;
                for (const ContactInfo& contact : contacts)
                    for (int i = 0; i < contact.point_count; ++i)
                        deepest = std::min(deepest, contact.points[i].separation);
                if (pair == 4 && deepest < -0.5f)
                    continue; // the centre is inside the box
                EXPECT_NEAR(number_of(*c, "gap"), deepest, 0.006f + 0.006f * std::abs(deepest))
                    << "pair " << pair << ", turn " << turn << ", y " << y;
                EXPECT_TRUE(apart == (number_of(*c, "gap") > 0) || number_of(*c, "gap") == 0);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 100);
}

TEST(SinkingIn, IsSharedByTheMasses)
{
    const auto c = chapter("05-sinking-in");
    for (const float mass : {0.5f, 3.0f, 10.0f})
    {
        set(*c, "mass 2", mass);
        c->build();
        for (int i = 0; i < 120; ++i)
            c->step();
        const float way = number_of(*c, "way1") + number_of(*c, "way2");
        EXPECT_NEAR(100 * number_of(*c, "way1") / way, number_of(*c, "share1"), 1) << mass;
        EXPECT_LT(number_of(*c, "overlap"), 0.01f);
    }
}

TEST(SinkingIn, DoesNotThrowApartWhatIsPushedHard)
{
    const auto c = chapter("05-sinking-in");
    set(*c, "push", 60);
    c->build();
    for (int i = 0; i < 120; ++i)
        c->step();
    const float way = number_of(*c, "way1") + number_of(*c, "way2");
    EXPECT_LT(way, 0.4f * 1.05f);
}

TEST(Triggers, SeeTheBulletAtAnySpeed)
{
    const auto c = chapter("06-triggers");
    for (const float speed : {6.0f, 50.0f, 300.0f, 1000.0f})
    {
        set(*c, "fast", speed);
        c->build();
        const BodyId bullet = c->scene().bodies()[1];
        int enters = 0;
        int exits = 0;
        for (int i = 0; i < 100; ++i)
        {
            c->step();
            for (const TriggerEvent& e : c->scene().trigger_enters())
                enters += e.visitor_body == bullet ? 1 : 0;
            for (const TriggerEvent& e : c->scene().trigger_exits())
                exits += e.visitor_body == bullet ? 1 : 0;
        }
        EXPECT_EQ(enters, 1) << speed;
        EXPECT_EQ(exits, 1) << speed;
    }
}

TEST(Springs, LaunchAsTheSumSays)
{
    const auto c = chapter("07-springs");
    for (const float pull : {0.3f, 0.7f, 1.0f})
    {
        set(*c, "pull", pull);
        c->build();
        for (int i = 0; i < 200; ++i)
            c->step();
        EXPECT_NEAR(number_of(*c, "launch"), number_of(*c, "speed"), 0.01f * number_of(*c, "speed")) << pull;
    }
}

TEST(Springs, StayCalmHoweverStiff)
{
    const auto c = chapter("07-springs");
    set(*c, "k", 2000);
    set(*c, "c", 0);
    c->build();
    for (int i = 0; i < 1200; ++i)
        c->step();
    EXPECT_LT(std::abs(number_of(*c, "length") - 2), 1.01f);
}

TEST(ChangingTheWorld, LosesNothing)
{
    const auto c = chapter("09-changing-the-world");
    set(*c, "balls", 8);
    c->build();
    for (int i = 0; i < 240; ++i)
    {
        c->step();
        EXPECT_EQ(c->scene().bodies().size(), 4 + static_cast<std::size_t>(number_of(*c, "left")));
    }
    EXPECT_GT(number_of(*c, "gone"), 8);
    EXPECT_EQ(c->values().at("missed"), "2");
}

TEST(TooFast, TheExactLaneAlwaysBounces)
{
    const auto c = chapter("10-too-fast");
    for (const float speed : {2.0f, 9.0f, 60.0f, 217.0f, 1000.0f})
    {
        set(*c, "speed", speed);
        c->build();
        for (int i = 0; i < 800 && !c->is_over(); ++i)
            c->step();
        EXPECT_LT(c->scene().body(c->scene().bodies().back()).velocity().x, 0) << speed;
    }
}

TEST(ManyAtOnce, ForgettingLetsTowersSink)
{
    const auto c = chapter("11-many-at-once");
    const auto sunk = [&](float substeps, bool remember)
    {
        set(*c, "substeps", substeps);
        set(*c, "remember", remember ? 1.0f : 0.0f);
        c->build();
        for (int i = 0; i < 120; ++i)
            c->step();
        return number_of(*c, "sink");
    };
    EXPECT_GT(sunk(4, false), 1.5f * sunk(4, true));
    EXPECT_GT(sunk(1, true), 2 * sunk(4, true));
}

} // namespace carom::tour
