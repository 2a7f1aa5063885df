// Bumpers, slings, targets, spinner, gate, saucer, kickback, booster, sensors: what each does to a ball and reports.

#include "bench_table.h"

#include <cmath>
#include <gtest/gtest.h>

namespace carom::pinball::test {
namespace {

const BallState& ball(const Playfield& field) { return field.balls().front().state; }

TEST(Bumper, KicksWhatArrivesFastEnough)
{
    Table table = bare_table(0, 0);
    table.materials[wall_material] = {.name = "ring", .restitution = 0.3f, .friction = 0};
    const Index bumper =
        add(table, Bumper{.pos = {1, 1}, .radius = 0.0245f, .kick_speed = 1, .threshold = 0.06f, .cooldown = 0.05f});
    Playfield field(table, 1);
    shoot(field, {1, 1.1f}, {0, -1});
    ASSERT_TRUE(run_until(field, EventKind::Fired, 100));
    run(field, 1);
    EXPECT_NEAR(ball(field).velocity.y, 0.3f + 1, 0.01f);
    EXPECT_EQ(field.state(bumper).hits, 1);
}

TEST(Bumper, AddsNoMoreEnergyThanItsKickBrings)
{
    Table table = bare_table(0, 0);
    table.materials[wall_material] = {.name = "ring", .restitution = 0.3f, .friction = 0.3f};
    add(table, Bumper{.pos = {1, 1}, .radius = 0.0245f, .kick_speed = 1, .threshold = 0.06f, .cooldown = 0.05f});
    for (const float speed : {0.1f, 0.5f, 1.0f, 2.0f, 4.0f})
        for (const float offset : {0.0f, 0.01f, 0.02f, 0.03f})
        {
            Playfield field(table, 1);
            shoot(field, {1 + offset, 1.1f}, {0, -speed});
            if (!run_until(field, EventKind::Fired, 1500))
                continue; // a graze
            run(field, 2);
            const float after = dot(ball(field).velocity, ball(field).velocity);
            EXPECT_LE(after, speed * speed + 1 + 2 * speed) << speed << " at " << offset;
            EXPECT_GE(std::sqrt(after), 0.5f) << speed << " at " << offset;
        }
}

TEST(Bumper, LeavesASlowBallAlone)
{
    Table table = bare_table(0, 0);
    table.materials[wall_material] = {.name = "ring", .restitution = 0.3f, .friction = 0};
    const Index bumper =
        add(table, Bumper{.pos = {1, 1}, .radius = 0.0245f, .kick_speed = 1, .threshold = 0.2f, .cooldown = 0.05f});
    Playfield field(table, 1);
    shoot(field, {1, 1.05f}, {0, -0.15f});
    run(field, 200);
    EXPECT_LT(ball(field).velocity.y, 0.1f);
    EXPECT_EQ(field.state(bumper).hits, 0);
}

TEST(Slingshot, KicksInTheMiddleOfItsFaceOnly)
{
    Table table = bare_table(0, 0);
    table.materials[wall_material] = {.name = "band", .restitution = 0.5f, .friction = 0};
    const Index sling = add(table, Slingshot{.corners = {{{1, 1.1f}, {1, 1}, {1.05f, 1.05f}}},
                                             .radius = 0.006f,
                                             .kick_speed = 1.1f,
                                             .threshold = 0.15f,
                                             .cooldown = 0.08f});
    for (const auto& [y, kicks] : {std::pair{1.05f, true}, {1.004f, false}, {1.096f, false}})
    {
        Playfield field(table, 1);
        shoot(field, {0.9f, y}, {1, 0});
        run(field, 150);
        EXPECT_EQ(field.state(sling).hits, kicks ? 1 : 0) << y;
        EXPECT_NEAR(ball(field).velocity.x, kicks ? -1.6f : -0.5f, 0.02f) << y;
    }
}

TEST(DropTarget, FallsWhenHitHardEnough)
{
    Table table = bare_table(0, 0);
    const Index target = add(table, DropTarget{.a = {0.99f, 1}, .b = {1.01f, 1}, .radius = 0.0015f, .min_speed = 0.11f});
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 0.1f});
    run(field, 600);
    EXPECT_FALSE(field.state(target).down);
    field.scene().body(ball(field).body).set_velocity({0, 0.5f});
    ASSERT_TRUE(run_until(field, EventKind::Fell, 300));
    EXPECT_TRUE(field.state(target).down);
    EXPECT_LT(ball(field).velocity.y, 0) << "the blow itself is a bounce";
    field.scene().body(ball(field).body).set_velocity({0, 0.5f});
    run(field, 400);
    EXPECT_GT(ball(field).position.y, 1.05) << "nothing is in the way now";
}

TEST(DropTarget, NeverRisesIntoABall)
{
    Table table = bare_table(0, 0);
    const Index target = add(table, DropTarget{.a = {0.99f, 1}, .b = {1.01f, 1}, .radius = 0.0015f, .min_speed = 0.11f});
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 0.6f});
    ASSERT_TRUE(run_until(field, EventKind::Fell, 300));
    const BodyId body = ball(field).body;
    field.scene().body(body).set_velocity({});
    field.scene().body(body).teleport({1, 1.005}, 0);
    field.command(target, Command::Raise);
    run(field, 500);
    EXPECT_TRUE(field.state(target).down) << "a ball lies on it";
    EXPECT_NEAR(ball(field).position.y, 1.005, 1e-4) << "and is left in peace";
    field.scene().body(body).teleport({1, 1.2}, 0);
    ASSERT_TRUE(run_until(field, EventKind::Raised, 5));
    EXPECT_FALSE(field.state(target).down);
    field.scene().body(body).set_velocity({0, -1});
    run(field, 300);
    EXPECT_GT(ball(field).position.y, 1.0) << "it stands again";
}

TEST(Standup, CountsHitsAboveItsSpeed)
{
    Table table = bare_table(0, 0);
    const Index target = add(table, Standup{.a = {0.98f, 1}, .b = {1.02f, 1}, .radius = 0.0015f, .min_speed = 0.2f});
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 0.15f});
    run(field, 400);
    EXPECT_EQ(field.state(target).hits, 0);
    field.scene().body(ball(field).body).set_velocity({0, 0.5f});
    run(field, 300);
    EXPECT_EQ(field.state(target).hits, 1);
}

TEST(SprungTarget, GivesWayOnItsSliderAndComesBack)
{
    Table table = bare_table(0, 0);
    const Index bash = add(table, SprungTarget{.pos = {1, 1},
                                               .half = {0.018f, 0.004f},
                                               .axis = {0, 1},
                                               .mass = 0.15f,
                                               .max_travel = 0.006f,
                                               .min_impulse = 0.02f,
                                               .springs = {{{0.988f, 1.012f}, {-0.012f, 0.004f}, 900, 6, 0.008f},
                                                           {{1.012f, 1.012f}, {0.012f, 0.004f}, 900, 6, 0.008f}}});
    Playfield field(table, 1);
    shoot(field, {1.012f, 0.95f}, {0, 1});
    ASSERT_TRUE(run_until(field, EventKind::Hit, 100));
    float deepest = 0;
    for (int i = 0; i < 1000; ++i)
    {
        field.step({});
        deepest = std::max(deepest, field.state(bash).travel);
        ASSERT_LT(std::abs(field.scene().body(field.state(bash).body).angle()), 1e-3f) << "the slider does not turn";
    }
    EXPECT_GT(deepest, 0.002f);
    EXPECT_LT(deepest, 0.0065f);
    EXPECT_NEAR(field.state(bash).travel, 0, 0.0002f);
    EXPECT_LT(ball(field).velocity.y, -0.05f) << "the ball is thrown back";
}

Table spinner_table()
{
    Table table = bare_table(0, 0);
    add(table, Spinner{.a = {0.98f, 1}, .b = {1.02f, 1}, .inertia = 4e-6f, .damping = 0.35f, .drag_on_ball = 0.04f});
    return table;
}

TEST(Spinner, TakesFromTheBallWhatItGets)
{
    const Table table = spinner_table();
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 2});
    run(field, 30);
    const float after = ball(field).velocity.y;
    EXPECT_NEAR(after, 2 * (1 - 0.04f), 0.002f) << "the share of the speed that a still flag takes";
    // The flag's arm s: I / s² is the mass that takes this share of an 80 g ball's momentum.
    const float flag_mass = 0.08f * 0.04f / 0.96f;
    const float arm = std::sqrt(4e-6f / flag_mass);
    const float given = 0.08f * (2 - after) * arm;
    EXPECT_NEAR(given, 4e-6f * after / arm, 1e-7f) << "angular momentum is kept";
    EXPECT_NEAR(field.state(0).speed, after / arm, 2.5f) << "a few milliseconds of swing later";
}

TEST(Spinner, AFlagThatRunsAheadIsNotTouched)
{
    const Table table = spinner_table();
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 2});
    run(field, 40);
    shoot(field, {1, 0.97f}, {0, 1});
    run(field, 40);
    EXPECT_NEAR(field.balls()[1].state.velocity.y, 1, 1e-5f);
}

TEST(Spinner, CountsHalfTurnsAndComesToRestHanging)
{
    const Table table = spinner_table();
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 1.5f});
    run(field, 20'000);
    EXPECT_GT(field.state(0).hits, 10);
    EXPECT_LT(field.state(0).hits, 80);
    run(field, 10'000);
    EXPECT_NEAR(field.state(0).angle, 0, 0.1f);
}

TEST(Gate, OpensOneWay)
{
    Table table = bare_table(0, 0);
    const Index gate = add(table, Gate{.a = {0.98f, 1}, .b = {1.02f, 1}, .radius = 0.001f, .open_dir = {0, 1}});
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 1});
    ASSERT_TRUE(run_until(field, EventKind::Passed, 200));
    EXPECT_NEAR(ball(field).velocity.y, 1, 1e-4f) << "unhindered";
    EXPECT_GT(field.state(gate).angle, 0.5f) << "the wire is lifted";
    field.scene().body(ball(field).body).set_velocity({0, -1});
    run(field, 200);
    EXPECT_GT(ball(field).position.y, 1.0) << "no way back";
    EXPECT_EQ(field.state(gate).hits, 1);
}

TEST(Saucer, CatchesHoldsAndThrows)
{
    Table table = bare_table(0, 0);
    const Index saucer =
        add(table, Saucer{.pos = {1, 1}, .radius = 0.011f, .max_capture_speed = 2, .hold = 0.8f, .kick = {-0.6f, -1.2f}});
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 1});
    ASSERT_TRUE(run_until(field, EventKind::Captured, 200));
    EXPECT_TRUE(ball(field).held);
    EXPECT_TRUE(field.state(saucer).down);
    run(field, 790);
    EXPECT_NEAR(ball(field).position.x, 1, 1e-6);
    EXPECT_NEAR(ball(field).position.y, 1, 1e-6);
    ASSERT_TRUE(run_until(field, EventKind::Ejected, 20));
    run(field, 100);
    EXPECT_FALSE(ball(field).held);
    EXPECT_NEAR(ball(field).velocity.x, -0.6f, 0.01f);
    EXPECT_NEAR(ball(field).velocity.y, -1.2f, 0.01f);
    EXPECT_EQ(field.state(saucer).hits, 1) << "its own throw is not caught again";
}

TEST(Saucer, LetsAFastBallPass)
{
    Table table = bare_table(0, 0);
    const Index saucer =
        add(table, Saucer{.pos = {1, 1}, .radius = 0.011f, .max_capture_speed = 2, .hold = 0.8f, .kick = {0, -1}});
    Playfield field(table, 1);
    shoot(field, {1, 0.9f}, {0, 2.5f});
    run(field, 200);
    EXPECT_EQ(field.state(saucer).hits, 0);
    EXPECT_GT(ball(field).position.y, 1.2);
}

TEST(Saucer, KeepsItsBallWhileTheRulesWantIt)
{
    Table table = bare_table(0, 0);
    const Index saucer =
        add(table, Saucer{.pos = {1, 1}, .radius = 0.011f, .max_capture_speed = 2, .hold = 0.1f, .kick = {0, -1}});
    Playfield field(table, 1);
    shoot(field, {1, 0.95f}, {0, 1});
    ASSERT_TRUE(run_until(field, EventKind::Captured, 200));
    field.command(saucer, Command::Hold);
    run(field, 1000);
    EXPECT_TRUE(ball(field).held);
    field.command(saucer, Command::Eject);
    EXPECT_TRUE(run_until(field, EventKind::Ejected, 3));
}

TEST(Kicker, ThrowsTheBallBackWhileLit)
{
    Table table = bare_table();
    const Index kicker = add(table, Kicker{.pos = {1, 1}, .half = {0.017f, 0.008f}, .kick = {0, 2.3f}, .lit = true});
    Playfield field(table, 1);
    shoot(field, {1, 1.1f}, {0, -0.5f});
    ASSERT_TRUE(run_until(field, EventKind::Fired, 300));
    EXPECT_NEAR(ball(field).velocity.y, 2.3f, 0.01f);
    run(field, 50);
    EXPECT_EQ(field.state(kicker).hits, 1) << "once, though the ball is still over it";
}

TEST(Kicker, UnlitItLetsTheBallPass)
{
    Table table = bare_table();
    const Index kicker = add(table, Kicker{.pos = {1, 1}, .half = {0.017f, 0.008f}, .kick = {0, 2.3f}, .lit = true});
    Playfield field(table, 1);
    field.command(kicker, Command::Unlight);
    shoot(field, {1, 1.1f}, {0, -0.5f});
    run(field, 500);
    EXPECT_LT(ball(field).position.y, 0.95);
    EXPECT_EQ(field.state(kicker).hits, 0);
}

TEST(Booster, PushesWhatMovesItsWay)
{
    Table table = bare_table(0, 0);
    add(table, Booster{.pos = {1, 1}, .half = {0.02f, 0.035f}, .force = {0, 0.64f}, .only_if_moving_along = true});
    Playfield field(table, 1);
    shoot(field, {1, 0.9f}, {0, 1});
    run(field, 300);
    // Work of the force over the box, and over the radius of the ball at either end: it counts from touch to touch.
    const float most = std::sqrt(1 + 2 * 0.64f * (0.07f + 2 * 0.0135f) / 0.08f);
    EXPECT_GT(ball(field).velocity.y, std::sqrt(1 + 2 * 0.64f * 0.07f / 0.08f) - 0.02f);
    EXPECT_LT(ball(field).velocity.y, most + 0.02f);
    Playfield down(table, 1);
    shoot(down, {1, 1.1f}, {0, -1});
    run(down, 300);
    EXPECT_NEAR(ball(down).velocity.y, -1, 0.001f);
}

TEST(Sensor, ReportsEnterAndLeaveAndSlowsNothing)
{
    Table table = bare_table(0, 0);
    const Index sensor = add(table, Sensor{.pos = {1, 1}, .half = {0.015f, 0.005f}});
    Playfield field(table, 1);
    shoot(field, {1, 0.9f}, {0, 1});
    ASSERT_TRUE(run_until(field, EventKind::Entered, 200));
    EXPECT_TRUE(field.state(sensor).occupied);
    ASSERT_TRUE(run_until(field, EventKind::Left, 200));
    EXPECT_FALSE(field.state(sensor).occupied);
    EXPECT_NEAR(ball(field).velocity.y, 1, 1e-6f);
}

TEST(Drain, TakesTheBall)
{
    Table table = bare_table();
    const Index drain = add(table, Sensor{.pos = {1, 0.9f}, .half = {0.2f, 0.01f}, .kills = true});
    Playfield field(table, 1);
    shoot(field, {1, 1}, {});
    ASSERT_TRUE(run_until(field, EventKind::Drained, 1000));
    EXPECT_TRUE(field.balls().empty());
    run(field, 10);
    EXPECT_FALSE(field.state(drain).occupied) << "every enter has its exit";
}

TEST(CaptiveBall, IsNeitherDrainedNorCountedInPlay)
{
    Table table = bare_table();
    add(table, CaptiveBall{{1, 1}});
    add(table, Sensor{.pos = {1, 0.9f}, .half = {0.2f, 0.01f}, .kills = true});
    Playfield field(table, 1);
    EXPECT_EQ(field.balls_in_play(), 0);
    run(field, 1000);
    EXPECT_EQ(field.balls().size(), 1u);
}

} // namespace
} // namespace carom::pinball::test
