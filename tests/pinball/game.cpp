// The whole machine with the table that is shipped: it plays, and the same inputs give the same game.

#include "pinball/game/game.h"

#include "pinball/autoplay/reflex.h"
#include "pinball/headless/headless.h"
#include "pinball/headless/run.h"
#include "pinball/table/loader.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace carom::pinball::test {
namespace {

const Table& momentum()
{
    static const Table table = []
    {
        LoadResult result = load_table_file(CAROM_TABLES_DIR "/momentum.table.json");
        for (const LoadError& error : result.errors)
            ADD_FAILURE() << to_string(error);
        return result.table.value();
    }();
    return table;
}

std::vector<Input> recorded_inputs(std::uint64_t seed, int steps)
{
    Game game(momentum(), {.seed = seed});
    ReflexPlayer player(momentum(), seed);
    std::vector<Input> inputs;
    for (int i = 0; i < steps; ++i)
    {
        inputs.push_back(player.play(game));
        game.step(inputs.back());
    }
    return inputs;
}

std::uint64_t hash_after(Game& game, const std::vector<Input>& inputs)
{
    for (const Input& input : inputs)
        game.step(input);
    return game.state_hash();
}

TEST(Game, WaitsForStartThenServesABallBeforeThePlunger)
{
    Game game(momentum());
    const std::size_t captive = game.balls().size();
    for (int i = 0; i < 100; ++i)
        game.step({});
    EXPECT_EQ(game.phase(), Phase::Attract);
    EXPECT_EQ(game.balls_served(), 0);
    game.step({.start = true});
    for (int i = 0; i < 500; ++i)
        game.step({});
    EXPECT_EQ(game.phase(), Phase::Ready);
    ASSERT_EQ(game.balls().size(), captive + 1);
    EXPECT_LT(length(game.balls().back().velocity), 0.01f) << "it lies still";
    EXPECT_EQ(game.ball_number(), 1);
}

TEST(Game, APlungeBringsTheBallIntoPlay)
{
    Game game(momentum());
    game.step({.start = true});
    for (int i = 0; i < 300; ++i)
        game.step({});
    for (int i = 0; i < 700; ++i)
        game.step({.plunger = true});
    for (int i = 0; i < 3000 && game.phase() == Phase::Ready; ++i)
        game.step({});
    EXPECT_EQ(game.phase(), Phase::InPlay);
    EXPECT_GT(game.ball_save_steps(), 0);
}

Table at_rate(int rate)
{
    Table table = momentum();
    table.physics.step = 1 / static_cast<float>(rate);
    return table;
}

TEST(Game, WhatRestsSleepsUntilAButtonIsPressed)
{
    Game game(momentum());
    game.step({.start = true});
    for (int i = 0; i < 3000; ++i)
        game.step({});
    ASSERT_EQ(game.phase(), Phase::Ready);
    EXPECT_EQ(game.scene().report().awake_bodies, 0) << "devices, captive balls and the one that waits";
    game.step({.left = true});
    EXPECT_EQ(game.scene().report().awake_bodies, 1);
    for (int i = 0; i < 700; ++i)
        game.step({.plunger = true});
    for (int i = 0; i < 3000 && game.phase() == Phase::Ready; ++i)
        game.step({});
    EXPECT_EQ(game.phase(), Phase::InPlay);
}

TEST(Game, KeepsAsManyBallsInPlayAsAskedFor)
{
    HeadlessRun run(momentum(), 3, 4);
    int steps_of_four = 0;
    constexpr int steps = 60'000;
    for (int i = 0; i < steps; ++i)
    {
        run.step();
        const auto in_play = std::ranges::count(run.game().balls(), false, &BallState::captive);
        steps_of_four += in_play >= 4 ? 1 : 0;
    }
    EXPECT_GT(run.stats().balls(), 3) << "some have been lost";
    EXPECT_GT(steps_of_four, steps * 3 / 4);
}

TEST(Game, OneInputIsAChangeAtTheStartOfTheStep)
{
    Game by_input(momentum(), {.seed = 3});
    Game by_change(momentum(), {.seed = 3});
    for (const Input& input : recorded_inputs(3, 3000))
    {
        by_input.step(input);
        const InputChange change{.input = input};
        by_change.step_through({&change, 1});
    }
    EXPECT_EQ(by_input.state_hash(), by_change.state_hash());
}

TEST(Game, FeelsWhatIsPressedAndLetGoWithinOneStep)
{
    Game game(at_rate(120));
    game.step({});
    game.step_through(std::vector<InputChange>{{0.002, {.start = true}}, {0.005, {}}});
    EXPECT_NE(game.phase(), Phase::Attract);
    game.step_through(std::vector<InputChange>{{0.001, {.left = true}}, {0.004, {}}});
    EXPECT_EQ(std::ranges::count(game.events(), EventKind::FlipperCoil, &GameEvent::kind), 2);
    for (Index i = 0; i < game.table().elements.size(); ++i)
    {
        const auto* flipper = std::get_if<Flipper>(&game.table().elements[i].part);
        if (!flipper || flipper->input != Side::Left)
            continue;
        EXPECT_GT(game.element(i).speed, 0.1f) << "three milliseconds of a rising coil";
    }
}

TEST(Game, PlaysAtLongSteps)
{
    for (const int rate : {120, 240})
    {
        Game game(at_rate(rate));
        game.step({.start = true});
        for (int i = 0; i < rate / 2; ++i)
            game.step({});
        for (int i = 0; i < rate * 7 / 10; ++i)
            game.step({.plunger = true});
        int steps = 0;
        for (; steps < 3 * rate && game.phase() == Phase::Ready; ++steps)
            game.step({});
        EXPECT_EQ(game.phase(), Phase::InPlay) << rate;
        for (int i = 0; i < 2 * rate; ++i)
            game.step({.left = i % rate < rate / 4});
        for (const BallState& ball : game.balls())
        {
            EXPECT_GT(ball.position.y, 0) << rate;
            EXPECT_LT(ball.position.y, 1.07) << rate;
        }
    }
}

TEST(Game, RefusesChangesOutOfTheStepOrOutOfOrder)
{
    Game game(momentum());
    game.step({});
    const std::uint64_t before = game.state_hash();
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    for (const std::vector<InputChange>& bad :
         {std::vector<InputChange>{{-0.0001, {}}}, {{0.0011, {}}}, {{not_a_number, {}}}, {{0.0005, {}}, {0.0004, {}}}})
        EXPECT_THROW(game.step_through(bad), Error);
    EXPECT_EQ(game.state_hash(), before);
}

/// How far up the table a ball comes that is launched with this share of a full pull.
double height_of_plunge(float share)
{
    Game game(momentum());
    game.step({.start = true});
    for (int i = 0; i < 300; ++i)
        game.step({});
    const int pull = static_cast<int>(share * 0.05f / 0.09f * 1000);
    for (int i = 0; i < pull; ++i)
        game.step({.plunger = true});
    double highest = 0;
    for (int i = 0; i < 1500; ++i)
    {
        game.step({});
        highest = std::max(highest, game.balls().back().position.y);
    }
    return highest;
}

TEST(Game, APlungeReachesTheTopFromSixTenthsOfAPull)
{
    EXPECT_LT(height_of_plunge(0.2f), 0.8);
    EXPECT_GT(height_of_plunge(0.6f), 0.95);
    EXPECT_GT(height_of_plunge(1.0f), 0.99);
}

TEST(Game, ABallThatFallsBackCanBePlungedAgain)
{
    Game game(momentum());
    game.step({.start = true});
    for (int i = 0; i < 300; ++i)
        game.step({});
    for (int i = 0; i < 150; ++i)
        game.step({.plunger = true});
    for (int i = 0; i < 5000; ++i)
        game.step({});
    EXPECT_EQ(game.phase(), Phase::Ready);
    EXPECT_LT(game.balls().back().position.y, 0.08) << "it lies on the rod again";
    for (int i = 0; i < 700; ++i)
        game.step({.plunger = true});
    for (int i = 0; i < 1500; ++i)
        game.step({});
    EXPECT_EQ(game.phase(), Phase::InPlay);
}

TEST(Game, TheSameInputsGiveTheSameGame)
{
    const std::vector<Input> inputs = recorded_inputs(5, 20'000);
    Game a(momentum(), {.seed = 9});
    Game b(momentum(), {.seed = 9});
    const std::uint64_t hash = hash_after(a, inputs);
    EXPECT_EQ(hash_after(b, inputs), hash);
    a.restart();
    EXPECT_EQ(a.step_count(), 0);
    EXPECT_EQ(hash_after(a, inputs), hash) << "also after a restart";
}

TEST(Game, OtherInputsGiveAnotherGame)
{
    std::vector<Input> inputs = recorded_inputs(5, 5000);
    Game a(momentum());
    Game b(momentum());
    const std::uint64_t hash = hash_after(a, inputs);
    inputs[2000].left = !inputs[2000].left;
    EXPECT_NE(hash_after(b, inputs), hash);
}

TEST(Game, EveryElementHasAStateAndALamp)
{
    const Game game(momentum());
    for (Index i = 0; i < momentum().elements.size(); ++i)
    {
        (void)game.element(i);
        EXPECT_EQ(game.lamp(i) == LampState::Blink, false) << momentum().elements[i].id << " blinks before a game";
    }
}

// Nobody flips, so that it is soon over.
TEST(Game, AFinishedGameEntersTheHighScores)
{
    Game game(momentum());
    ReflexPlayer player(momentum(), 3);
    bool ended = false;
    for (int i = 0; i < 600'000 && !ended; ++i)
    {
        Input input = player.play(game);
        input.left = input.right = false;
        game.step(input);
        for (const GameEvent& event : game.events())
            ended = ended || event.kind == EventKind::GameEnded;
    }
    ASSERT_TRUE(ended);
    EXPECT_GT(game.score(), 0);
    EXPECT_EQ(game.high_scores().best(), game.score());
    ASSERT_EQ(game.last_ranks().size(), 1u);
    EXPECT_EQ(game.last_ranks()[0], 0);
    game.rename_score(0, "CRM");
    EXPECT_EQ(game.high_scores().entries()[0].name, "CRM");
    game.restart();
    EXPECT_EQ(game.high_scores().best() > 0, true) << "they stay";
}

TEST(Headless, TenBallsNeitherEscapeNorGetStuck)
{
    HeadlessRun run(momentum(), 11);
    while (run.stats().balls() < 10)
        run.step();
    EXPECT_EQ(run.stats().escaped(), 0);
    EXPECT_EQ(run.stats().stuck(), 0);
    EXPECT_GT(run.stats().mean_ball_time(), 5);
}

TEST(Headless, TheSameSeedGivesTheSameNumbers)
{
    std::string numbers[2];
    for (std::string& text : numbers)
    {
        HeadlessRun run(momentum(), 12);
        while (run.stats().balls() < 3)
            run.step();
        run.finish();
        text = run.stats().to_json("momentum", 12);
        text = text.substr(text.find("final_hash"));
    }
    EXPECT_EQ(numbers[0], numbers[1]);
    EXPECT_EQ(numbers[0].find("cbf29ce484222325"), std::string::npos) << "nothing was hashed";
}

BallState ball_at(Position p, int serial = 7) { return {.serial = serial, .position = p}; }

TEST(Judge, SeesBallsOutsideTheOutline)
{
    Judge judge(momentum());
    EXPECT_EQ(judge.look(ball_at({0.25, 0.5}), 1), Verdict::Fine);
    EXPECT_EQ(judge.look(ball_at({0.25, 1.03}), 1), Verdict::Fine);
    EXPECT_EQ(judge.look(ball_at({-0.01, 0.5}), 1), Verdict::Escaped);
    EXPECT_EQ(judge.look(ball_at({0.25, -0.01}), 1), Verdict::Escaped);
    EXPECT_EQ(judge.look(ball_at({0.02, 1.0}), 1), Verdict::Escaped) << "behind the arch";
    EXPECT_EQ(judge.look(ball_at({0.25, 1.045}), 1), Verdict::Escaped) << "above it";
}

TEST(Judge, SeesABallThatDoesNotMoveForTenSeconds)
{
    Judge judge(momentum());
    for (std::int64_t step = 0; step < 9999; ++step)
        ASSERT_EQ(judge.look(ball_at({0.25 + 0.00001 * static_cast<double>(step % 100), 0.5}), step), Verdict::Fine);
    EXPECT_EQ(judge.look(ball_at({0.25, 0.5}), 10'000), Verdict::Stuck);
}

TEST(Judge, DoesNotMindABallThatIsHeldOrWaitsInTheLane)
{
    Judge judge(momentum());
    BallState held = ball_at({0.25, 0.5}, 1);
    held.held = true;
    const BallState waiting = ball_at(momentum().ball.spawn, 2);
    for (std::int64_t step = 0; step < 20'000; ++step)
    {
        ASSERT_EQ(judge.look(held, step), Verdict::Fine);
        ASSERT_EQ(judge.look(waiting, step), Verdict::Fine);
    }
}

constexpr const char* cup = R"(
    {"id": "cup", "type": "wall", "material": "wood", "radius": 0.002, "path": [["M", 0.17, 0.32], ["L", 0.19, 0.28], ["L", 0.21, 0.28], ["L", 0.23, 0.32]]},)";
// A bumper that a ball never comes at fast enough, and two posts that hold the ball on it.
constexpr const char* slow_bumper = R"(
    {"id": "bumper", "type": "bumper", "material": "wood", "pos": [0.2, 0.3], "radius": 0.02, "kick_speed": 1.5, "threshold": 3, "cooldown": 0.05},
    {"id": "post_a", "type": "post", "material": "wood", "pos": [0.182, 0.335], "radius": 0.003},
    {"id": "post_b", "type": "post", "material": "wood", "pos": [0.218, 0.335], "radius": 0.003},)";

/// A box in which a ball falls into a pocket.
std::string pocket_table(const std::string& pocket)
{
    return R"({"format": "pinball-table", "version": 1, "name": "pocket", "size": [0.4, 0.6], "outline": "outer",
  "ball": {"radius": 0.0135, "mass": 0.08, "spawn": [0.2, 0.4], "material": "wood"},
  "physics": {"slope_deg": 6.5, "mu_playfield": 0.12},
  "materials": {"wood": {"restitution": 0.3, "friction": 0.3}},
  "elements": [
    {"id": "outer", "type": "wall", "material": "wood", "path": [["M", 0.01, 0], ["L", 0.01, 0.59], ["L", 0.39, 0.59], ["L", 0.39, 0]]},)" +
           pocket + R"(
    {"id": "lane", "type": "sensor", "pos": [0.2, 0.36], "half": [0.1, 0.005], "score": 10},
    {"id": "drain", "type": "sensor", "pos": [0.2, 0.02], "half": [0.19, 0.02], "kills": true}]})";
}

struct Search
{
    int rounds = 0;
    int missing = 0;
    bool freed = false; ///< out of the pocket
    int ball = 0;
};

Search search(const std::string& pocket)
{
    LoadResult result = load_table(pocket_table(pocket));
    for (const LoadError& error : result.errors)
        ADD_FAILURE() << to_string(error);
    Game game(result.table.value());
    Search seen;
    game.step({.start = true});
    for (int i = 0; i < 25'000; ++i)
    {
        game.step({});
        for (const GameEvent& event : game.events())
        {
            seen.rounds += event.kind == EventKind::BallSearch ? 1 : 0;
            seen.missing += event.kind == EventKind::BallMissing ? event.value : 0;
        }
        if (!game.balls().empty())
            seen.freed |= game.balls()[0].position.y < 0.25;
        seen.ball = game.ball_number();
    }
    return seen;
}

TEST(Game, ABallThatNoCoilReachesIsReplaced)
{
    const Search seen = search(cup);
    EXPECT_EQ(seen.rounds, 3);
    EXPECT_EQ(seen.missing, 1);
    EXPECT_EQ(seen.ball, 1) << "it costs no ball";
    EXPECT_FALSE(seen.freed);
}

std::string bumper_at(const char* x)
{
    std::string text = slow_bumper;
    return text.replace(text.find("0.2,"), 4, std::string(x) + ",");
}

TEST(Game, ABallThatLiesAgainstACoilIsThrownOut)
{
    const Search seen = search(bumper_at("0.203"));
    EXPECT_GE(seen.rounds, 1);
    EXPECT_EQ(seen.missing, 0);
    EXPECT_TRUE(seen.freed);
}

TEST(Game, ABallThatFallsBackAgainAndAgainIsReplaced)
{
    const Search seen = search(slow_bumper);
    EXPECT_EQ(seen.rounds, 3);
    EXPECT_EQ(seen.missing, 1);
    EXPECT_EQ(seen.ball, 1);
}

TEST(Game, WonGamesOutlastARestart)
{
    Game game(momentum(), {.credits = 2});
    game.restart();
    EXPECT_EQ(game.credits(), 2);
    game.step({.start = true});
    EXPECT_EQ(game.credits(), 1);
    game.restart();
    EXPECT_EQ(game.credits(), 1) << "the game was begun";
}

/// Momentum with something that holds a ball in the plunger's lane.
Game with_lane_blocked(const std::vector<Part>& parts)
{
    Table table = momentum();
    table.rules.ball_search = 3;
    for (const Part& part : parts)
        table.elements.push_back({.id = "block", .part = part, .material = 0});
    return Game(std::move(table));
}

Wall across_the_lane(float y) { return {Chain{.start = {0.46f, y}, .pieces = {{{0.5f, y}}}}}; }

int missing_within(Game& game, double seconds)
{
    int missing = 0;
    game.step({.start = true});
    const auto steps = static_cast<int>(seconds * 1000);
    for (int i = 0; i < steps && missing == 0; ++i)
    {
        game.step({.plunger = i % 3000 > 2000});
        for (const GameEvent& event : game.events())
            missing += event.kind == EventKind::BallMissing ? event.value : 0;
    }
    return missing;
}

TEST(Game, ABallThatSticksInThePlungersLaneIsReplaced)
{
    // A flap that lets it by on its way up and holds it on its way down, and a wall just before the rod.
    Game high = with_lane_blocked(
        {Gate{.a = {0.462f, 0.5f}, .b = {0.5f, 0.505f}, .radius = 0.001f, .open_dir = {0, 1}}, across_the_lane(0.7f)});
    EXPECT_EQ(missing_within(high, 60), 1);
    Game low = with_lane_blocked({across_the_lane(0.11f)});
    EXPECT_EQ(missing_within(low, 90), 1);
}

TEST(Game, OnlyWhatWasOrderedIsLaunchedByItself)
{
    // A ball that the machine should launch and the player did: the next one waits for the player.
    Table table = momentum();
    table.rules.ball_search = 1;
    table.rules.ball_save.reset();
    table.elements.push_back(
        {.id = "ledge", .part = Wall{Chain{.start = {0.1f, 0.5f}, .pieces = {{{0.4f, 0.5f}}}}}, .material = 0});
    Game game(std::move(table));
    game.step({.start = true});
    int launched_alone = 0;
    int since_touch = 0;
    for (int i = 0; i < 60'000 && game.ball_number() < 3; ++i)
    {
        const bool pulls = i % 1500 < 700 && game.ball_number() == 1;
        since_touch = pulls ? 0 : since_touch + 1;
        // Shaken until the ball is over, so that no other ball of this turn comes.
        game.step({.plunger = pulls, .nudge_up = i > 12'000 && i % 350 < 20});
        for (const GameEvent& event : game.events())
            launched_alone +=
                event.kind == EventKind::Launched && game.ball_number() == 2 && since_touch > 3000 && game.phase() == Phase::Ready
                    ? 1
                    : 0;
    }
    EXPECT_EQ(launched_alone, 0);
}

} // namespace
} // namespace carom::pinball::test
