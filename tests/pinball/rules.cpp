// The rules, fed with events as if a table had told them.

#include "pinball/rules/rule_book.h"

#include "bench_table.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace carom::pinball::test {
namespace {

/// A table of parts that need no place, with all rules, and the rules of it at work.
struct Machine
{
    Machine() : table(make_table()), book(table) { step({}, 0); }
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    Table make_table()
    {
        Table t = bare_table();
        for (Index& lane : lanes)
            lane = add(t, Sensor{}, 250);
        for (Index& target : bank)
            target = add(t, DropTarget{}, 500);
        bumper = add(t, Bumper{}, 100);
        spinner = add(t, Spinner{}, 100);
        inlane = add(t, Sensor{}, 100);
        orbit = add(t, Sensor{});
        bash = add(t, SprungTarget{.min_impulse = 0.02f}, 1000);
        saucer = add(t, Saucer{}, 1000);
        kicker = add(t, Kicker{.lit = true});
        shooter = add(t, Sensor{});
        plunger = add(t, Plunger{.lane = shooter});
        drain = add(t, Sensor{.kills = true});
        flipper = add(t, Flipper{});
        t.groups = {
            {.id = "lanes",
             .members = {lanes[0], lanes[1], lanes[2]},
             .reset = GroupReset::WhenComplete,
             .reset_delay = 0.5f,
             .lane_change = true},
            {.id = "bank", .members = {bank[0], bank[1]}, .reset = GroupReset::WhenComplete, .reset_delay = 1, .score = 10'000}};
        for (const Index lane : lanes)
            t.elements[lane].group = 0;
        for (const Index target : bank)
            t.elements[target].group = 1;
        t.rules = {.balls = 3,
                   .bonus_per_switch = 10,
                   .bonus_multiplier_max = 3,
                   .ball_save = BallSaveRule{.time = 12, .grace = 2, .per_ball = 1},
                   .skill_shot = SkillShotRule{.group = 0, .score = 25'000, .increase = 5000},
                   .lanes = LaneRule{.group = 0, .kicker = kicker},
                   .bank = BankRule{.group = 1, .letters = "MASS", .score = 50'000},
                   .bumpers = BumperRule{.hits_per_level = 3, .scores = {100, 200, 500}},
                   .spinner = SpinnerRule{.spinner = spinner, .trigger = inlane, .factor = 5, .time = 10},
                   .combo = ComboRule{.shots = {orbit, bash}, .window = 4, .score = 1000, .max = 3},
                   .multiball = MultiballRule{.target = bash,
                                              .hits = 3,
                                              .saucer = saucer,
                                              .locks = 2,
                                              .balls = 3,
                                              .ball_save = 15,
                                              .jackpot = 20'000,
                                              .jackpots = {bash, orbit}}};
        return t;
    }

    void step(const std::vector<GameEvent>& events, int in_play = 1, const Presses& presses = {})
    {
        book.step(++now, presses, events, {.balls_in_play = in_play, .all_known = all_known, .flipper_is_held = flipper_is_held});
        for (const Order& order : book.desk().take_orders())
            orders.push_back(order);
        while (book.desk().to_serve > 0)
        {
            book.desk().ball_served();
            ++served;
        }
    }

    void wait(float seconds, int in_play = 1)
    {
        for (std::int64_t steps = book.desk().steps(seconds); steps > 0; --steps)
            step({}, in_play);
    }

    void start() { step({}, 0, {.start = true}); }
    void tell(EventKind kind, Index element, float impulse = 0)
    {
        step({{.kind = kind, .element = element, .impulse = impulse}});
    }
    void flip() { tell(EventKind::Impact, flipper); }
    void drain_ball(int left = 0) { step({{.kind = EventKind::Drained, .element = drain}}, left); }
    /// Uses up the save of this ball and gets past the skill shot.
    void use_up_save()
    {
        tell(EventKind::Entered, orbit);
        wait(15);
    }
    /// Past its save, somewhere on the playfield, and nothing has been ordered yet.
    void lose_the_ball()
    {
        all_known = true;
        use_up_save();
        all_known = false;
        orders.clear();
    }
    [[nodiscard]] bool announced(EventKind kind) const { return count(book.announced(), kind) > 0; }
    [[nodiscard]] bool ordered(Index element, Command command) const
    {
        return std::ranges::any_of(orders, [&](const Order& o) { return o.element == element && o.command == command; });
    }
    [[nodiscard]] const Desk& desk() const { return book.desk(); }

    Index lanes[3]{};
    Index bank[2]{};
    Index bumper{}, spinner{}, inlane{}, orbit{}, bash{}, saucer{}, kicker{}, shooter{}, plunger{}, drain{}, flipper{};
    Table table;
    RuleBook book;
    std::vector<Order> orders{};
    std::int64_t now = 0;
    bool all_known = false; ///< where the balls are
    bool flipper_is_held = false;
    int served = 0;
};

TEST(Rules, StartServesTheFirstBallAndGivesPower)
{
    Machine m;
    EXPECT_EQ(m.desk().phase, Phase::Attract);
    EXPECT_TRUE(m.ordered(m.bumper, Command::Disable));
    m.start();
    EXPECT_EQ(m.desk().phase, Phase::Ready);
    EXPECT_EQ(m.desk().player.ball, 1);
    EXPECT_EQ(m.served, 1);
    EXPECT_TRUE(m.ordered(m.bumper, Command::Enable));
    EXPECT_TRUE(m.ordered(m.kicker, Command::Light));
}

TEST(Rules, PlayBeginsWithTheFirstSwitchOfThePlayfield)
{
    Machine m;
    m.start();
    m.tell(EventKind::Entered, m.shooter);
    EXPECT_EQ(m.desk().phase, Phase::Ready) << "the plunger's lane is none";
    EXPECT_EQ(m.book.ball_save_steps(), 0);
    m.tell(EventKind::Entered, m.orbit);
    EXPECT_EQ(m.desk().phase, Phase::InPlay);
    EXPECT_EQ(m.book.ball_save_steps(), 12'000);
}

TEST(Rules, NothingScoresBeforeAndAfterAGame)
{
    Machine m;
    m.tell(EventKind::Fired, m.bumper);
    EXPECT_EQ(m.desk().player.score, 0);
}

TEST(Rules, AnEarlyDrainIsSavedOnce)
{
    Machine m;
    m.start();
    m.tell(EventKind::Entered, m.orbit);
    m.wait(5);
    m.drain_ball();
    EXPECT_TRUE(m.announced(EventKind::BallSaved));
    EXPECT_EQ(m.served, 2);
    EXPECT_EQ(m.desk().player.ball, 1);
    EXPECT_EQ(m.book.ball_save_steps(), 0) << "its light is out";
    m.wait(1);
    m.drain_ball();
    EXPECT_EQ(m.desk().phase, Phase::Bonus);
}

TEST(Rules, TheSaveHasAGraceAfterItsLightIsOut)
{
    Machine m;
    m.start();
    m.tell(EventKind::Entered, m.orbit);
    m.wait(13);
    EXPECT_EQ(m.book.ball_save_steps(), 0);
    m.drain_ball();
    EXPECT_TRUE(m.announced(EventKind::BallSaved));
}

TEST(Rules, ALateDrainEndsTheBall)
{
    Machine m;
    m.start();
    m.use_up_save();
    m.drain_ball();
    EXPECT_FALSE(m.announced(EventKind::BallSaved));
    EXPECT_EQ(m.desk().phase, Phase::Bonus);
    m.wait(2, 0);
    EXPECT_EQ(m.desk().player.ball, 2);
    EXPECT_EQ(m.desk().phase, Phase::Ready);
    EXPECT_EQ(m.served, 2);
}

TEST(Rules, WithTheSaveSwitchedOffEveryDrainCounts)
{
    Machine m;
    m.book = RuleBook(m.table, {.ball_save = false});
    m.start();
    m.tell(EventKind::Entered, m.orbit);
    m.drain_ball();
    EXPECT_EQ(m.desk().phase, Phase::Bonus);
}

TEST(Rules, AfterThreeBallsTheGameIsOver)
{
    Machine m;
    m.start();
    for (int ball = 1; ball <= 3; ++ball)
    {
        EXPECT_EQ(m.desk().player.ball, ball);
        m.use_up_save();
        m.drain_ball();
        for (int i = 0; i < 3000 && m.desk().phase == Phase::Bonus; ++i)
            m.step({}, 0);
    }
    EXPECT_EQ(m.desk().phase, Phase::GameOver);
    EXPECT_TRUE(m.announced(EventKind::GameEnded));
    m.start();
    EXPECT_EQ(m.desk().player.ball, 1);
    EXPECT_EQ(m.desk().player.score, 0);
}

TEST(Rules, TheBonusIsCountedTimesTheMultiplier)
{
    Machine m;
    m.start();
    m.use_up_save();
    for (const Index lane : m.lanes)
        m.tell(EventKind::Entered, lane);
    for (int i = 0; i < 5; ++i)
        m.tell(EventKind::Entered, m.inlane);
    EXPECT_EQ(m.desk().player.bonus, 80) << "eight switches";
    EXPECT_EQ(m.desk().player.multiplier, 2);
    const std::int64_t before = m.desk().player.score;
    m.drain_ball();
    m.wait(2, 0);
    EXPECT_EQ(m.desk().player.score - before, 160);
    EXPECT_EQ(m.desk().player.bonus, 0) << "the next ball starts anew";
    EXPECT_EQ(m.desk().player.multiplier, 1);
}

TEST(Rules, StartSkipsTheBonusCountAndLosesNothing)
{
    Machine m;
    m.start();
    m.use_up_save();
    for (int i = 0; i < 100; ++i)
        m.tell(EventKind::Entered, m.inlane);
    const std::int64_t before = m.desk().player.score;
    m.drain_ball();
    m.wait(0.3f, 0);
    m.step({}, 0, {.start = true});
    m.wait(0.2f, 0);
    EXPECT_EQ(m.desk().phase, Phase::Ready);
    EXPECT_EQ(m.desk().player.score - before, 1000);
}

TEST(Rules, FlippersTurnTheLitLanesRound)
{
    Machine m;
    m.start();
    m.use_up_save();
    m.tell(EventKind::Entered, m.lanes[0]);
    EXPECT_EQ(m.desk().player.lamps[m.lanes[0]], LampState::On);
    m.step({}, 1, {.right = true});
    EXPECT_EQ(m.desk().player.lamps[m.lanes[0]], LampState::Off);
    EXPECT_EQ(m.desk().player.lamps[m.lanes[1]], LampState::On);
    m.step({}, 1, {.left = true});
    m.step({}, 1, {.left = true});
    EXPECT_EQ(m.desk().player.lamps[m.lanes[2]], LampState::On);
}

TEST(Rules, CompleteLanesRaiseTheMultiplierUpToItsLimitAndRelightTheKickback)
{
    Machine m;
    m.start();
    m.use_up_save();
    m.orders.clear();
    for (int round = 0; round < 4; ++round)
    {
        for (const Index lane : m.lanes)
            m.tell(EventKind::Entered, lane);
        m.wait(0.6f);
        EXPECT_EQ(m.desk().player.lamps[m.lanes[0]], LampState::Off) << "they start anew";
    }
    EXPECT_EQ(m.desk().player.multiplier, 3);
    EXPECT_TRUE(m.ordered(m.kicker, Command::Light));
}

TEST(Rules, TheKickbackWorksOnce)
{
    Machine m;
    m.start();
    m.tell(EventKind::Fired, m.kicker);
    EXPECT_TRUE(m.ordered(m.kicker, Command::Unlight));
}

TEST(Rules, TheBankSpellsALetterAndIsRaisedAfterASecond)
{
    Machine m;
    m.start();
    m.use_up_save();
    m.orders.clear();
    const std::int64_t before = m.desk().player.score;
    m.tell(EventKind::Fell, m.bank[0]);
    EXPECT_FALSE(m.announced(EventKind::GroupCompleted));
    m.tell(EventKind::Fell, m.bank[1]);
    EXPECT_TRUE(m.announced(EventKind::GroupCompleted));
    EXPECT_TRUE(m.announced(EventKind::LetterLit));
    EXPECT_EQ(m.desk().player.letters, 1);
    EXPECT_EQ(m.desk().player.score - before, 2 * 500 + 10'000);
    EXPECT_FALSE(m.ordered(m.bank[0], Command::Raise));
    m.wait(0.9f);
    EXPECT_FALSE(m.ordered(m.bank[0], Command::Raise));
    m.wait(0.2f);
    EXPECT_TRUE(m.ordered(m.bank[0], Command::Raise));
    EXPECT_TRUE(m.ordered(m.bank[1], Command::Raise));
}

TEST(Rules, TheWordPaysAndBeginsAgain)
{
    Machine m;
    m.start();
    m.use_up_save();
    const std::int64_t before = m.desk().player.score;
    for (int letter = 1; letter <= 5; ++letter)
    {
        m.tell(EventKind::Fell, m.bank[0]);
        m.tell(EventKind::Fell, m.bank[1]);
        EXPECT_EQ(m.desk().player.letters, letter == 5 ? 1 : letter);
        m.wait(1.1f);
    }
    EXPECT_EQ(m.desk().player.score - before, 5 * 11'000 + 50'000);
}

TEST(Rules, BumpersRiseALevelWithTheirHits)
{
    Machine m;
    m.start();
    m.use_up_save();
    const std::int64_t before = m.desk().player.score;
    for (int i = 0; i < 8; ++i)
        m.tell(EventKind::Fired, m.bumper);
    EXPECT_EQ(m.desk().player.bumper_level, 2);
    EXPECT_EQ(m.desk().player.score - before, 3 * 100 + 3 * 200 + 2 * 500);
}

TEST(Rules, TheSpinnerPaysMoreForAWhileAfterTheInlane)
{
    Machine m;
    m.start();
    m.use_up_save();
    std::int64_t before = m.desk().player.score;
    m.tell(EventKind::Spun, m.spinner);
    EXPECT_EQ(m.desk().player.score - before, 100);
    m.tell(EventKind::Entered, m.inlane);
    before = m.desk().player.score;
    m.tell(EventKind::Spun, m.spinner);
    EXPECT_EQ(m.desk().player.score - before, 500);
    m.wait(10.1f);
    before = m.desk().player.score;
    m.tell(EventKind::Spun, m.spinner);
    EXPECT_EQ(m.desk().player.score - before, 100);
}

TEST(Rules, TheBashTargetPaysByHowHardItWasHit)
{
    Machine m;
    m.start();
    m.use_up_save();
    for (const auto& [impulse, points] : {std::pair{0.03f, 1000}, {0.07f, 2000}, {0.2f, 3000}})
    {
        m.wait(5); // no combo
        const std::int64_t before = m.desk().player.score;
        m.tell(EventKind::Hit, m.bash, impulse);
        EXPECT_EQ(m.desk().player.score - before, points);
    }
}

TEST(Rules, TheSkillShotPaysOnlyAsTheFirstThing)
{
    Machine m;
    m.start();
    const Index lane = m.desk().flashing;
    ASSERT_NE(lane, none);
    m.tell(EventKind::Entered, m.shooter);
    m.tell(EventKind::Entered, m.orbit);
    m.tell(EventKind::Entered, m.inlane);
    EXPECT_EQ(m.desk().flashing, lane) << "rollovers on the way do not end it";
    m.tell(EventKind::Entered, lane);
    EXPECT_TRUE(m.announced(EventKind::SkillShot));
    EXPECT_EQ(m.desk().player.score, 25'000 + 250 + 100);
    EXPECT_EQ(m.desk().flashing, none);

    Machine other;
    other.start();
    const Index flashing = other.desk().flashing;
    other.step({}, 1, {.right = true});
    EXPECT_NE(other.desk().flashing, flashing) << "the flippers move it";
    other.tell(EventKind::Fired, other.bumper);
    EXPECT_EQ(other.desk().flashing, none) << "missed";
}

TEST(Rules, CombosPayForDifferentShotsInTime)
{
    Machine m;
    m.start();
    m.use_up_save();
    m.tell(EventKind::Entered, m.orbit);
    m.tell(EventKind::Hit, m.bash, 0.02f);
    EXPECT_FALSE(m.announced(EventKind::Combo)) << "no flipper made these";
    m.flip();
    m.tell(EventKind::Entered, m.orbit);
    m.wait(1);
    m.flip();
    m.tell(EventKind::Entered, m.orbit);
    EXPECT_FALSE(m.announced(EventKind::Combo)) << "the same one again";
    m.flip();
    std::int64_t before = m.desk().player.score;
    m.tell(EventKind::Hit, m.bash, 0.02f);
    EXPECT_TRUE(m.announced(EventKind::Combo));
    EXPECT_EQ(m.desk().player.score - before, 1000 + 2 * 1000);
    m.wait(5);
    m.flip();
    m.tell(EventKind::Entered, m.orbit);
    EXPECT_FALSE(m.announced(EventKind::Combo)) << "too late";
}

void start_multiball(Machine& m)
{
    for (int lock = 0; lock < 2; ++lock)
    {
        for (int hit = 0; hit < 3; ++hit)
        {
            EXPECT_FALSE(m.desk().player.lock_is_lit);
            m.tell(EventKind::Hit, m.bash, 0.02f);
        }
        EXPECT_TRUE(m.desk().player.lock_is_lit);
        EXPECT_FALSE(m.desk().multiball);
        m.tell(EventKind::Captured, m.saucer);
    }
}

TEST(Rules, TwoLocksStartAMultiballOfThree)
{
    Machine m;
    m.start();
    m.use_up_save();
    const int before = m.served;
    start_multiball(m);
    EXPECT_TRUE(m.desk().multiball);
    EXPECT_EQ(m.served - before, 2) << "the third one is in the saucer";
    EXPECT_EQ(m.desk().to_launch, 2) << "the machine launches them";
}

TEST(Rules, InMultiballJackpotsPayInTurnAndEveryBallIsSavedForAWhile)
{
    Machine m;
    m.start();
    m.use_up_save();
    start_multiball(m);
    std::int64_t before = m.desk().player.score;
    m.step({{.kind = EventKind::Entered, .element = m.orbit}}, 3);
    EXPECT_LT(m.desk().player.score - before, 20'000) << "it is the other one's turn";
    before = m.desk().player.score;
    m.step({{.kind = EventKind::Hit, .element = m.bash, .impulse = 0.02f}}, 3);
    EXPECT_GE(m.desk().player.score - before, 20'000);
    EXPECT_TRUE(m.announced(EventKind::Jackpot));
    before = m.desk().player.score;
    m.step({{.kind = EventKind::Entered, .element = m.orbit}}, 3);
    EXPECT_GE(m.desk().player.score - before, 20'000);
    const int served = m.served;
    m.drain_ball(2);
    EXPECT_EQ(m.served, served + 1);
}

TEST(Rules, MultiballEndsWithTheLastButOneBall)
{
    Machine m;
    m.start();
    m.use_up_save();
    start_multiball(m);
    m.wait(20, 3);
    m.drain_ball(2);
    EXPECT_TRUE(m.desk().multiball);
    m.drain_ball(1);
    EXPECT_FALSE(m.desk().multiball);
    EXPECT_EQ(m.desk().phase, Phase::InPlay);
    m.drain_ball(0);
    EXPECT_EQ(m.desk().phase, Phase::Bonus);
}

TEST(Rules, EqualEventsGiveEqualHashes)
{
    Machine a;
    Machine b;
    for (Machine* m : {&a, &b})
    {
        m->start();
        m->tell(EventKind::Fired, m->bumper);
    }
    Hash ha;
    Hash hb;
    a.book.add_to(ha);
    b.book.add_to(hb);
    EXPECT_EQ(ha.value(), hb.value());
    b.tell(EventKind::Fired, b.bumper);
    a.step({});
    Hash hc;
    Hash hd;
    a.book.add_to(hc);
    b.book.add_to(hd);
    EXPECT_NE(hc.value(), hd.value());
}

TEST(Tilt, WarnsTwiceThenEndsTheBallWithoutItsBonus)
{
    Machine m;
    m.start();
    m.use_up_save();
    const auto shake = [&]
    {
        m.step({{.kind = EventKind::BobTouched}});
        const bool told = m.announced(EventKind::Warned) || m.announced(EventKind::Tilted);
        m.wait(1);
        return told;
    };
    EXPECT_TRUE(shake());
    EXPECT_TRUE(shake());
    EXPECT_FALSE(m.desk().tilted);
    EXPECT_TRUE(shake());
    EXPECT_TRUE(m.desk().tilted);
    EXPECT_TRUE(m.ordered(m.kicker, Command::Disable));
    const std::int64_t score = m.desk().player.score;
    m.tell(EventKind::Entered, m.orbit);
    m.tell(EventKind::Fired, m.bumper);
    EXPECT_EQ(m.desk().player.score, score) << "a tilted machine counts nothing";
    m.orders.clear();
    m.drain_ball();
    EXPECT_EQ(m.desk().phase, Phase::Bonus);
    m.wait(3, 0);
    EXPECT_EQ(m.desk().player.score, score) << "nor the bonus";
    EXPECT_EQ(m.desk().player.ball, 2);
    EXPECT_FALSE(m.desk().tilted);
    EXPECT_TRUE(m.ordered(m.kicker, Command::Enable));
    EXPECT_EQ(m.served, 2);
}

TEST(Tilt, OneSwingWarnsOnceAndBeforeTheFirstSwitchNever)
{
    Machine m;
    m.start();
    for (int i = 0; i < 5; ++i)
        m.step({{.kind = EventKind::BobTouched}});
    m.tell(EventKind::Entered, m.orbit);
    for (int i = 0; i < 5; ++i)
        m.step({{.kind = EventKind::BobTouched}});
    EXPECT_FALSE(m.desk().tilted);
}

TEST(Tilt, EndsTheBallInEveryKindOfPlay)
{
    for (const int balls : {1, 3})
    {
        Machine m;
        m.start();
        m.use_up_save();
        for (int i = 0; i < 3; ++i)
        {
            m.step({{.kind = EventKind::BobTouched}}, balls);
            m.wait(1, balls);
        }
        for (int others = balls - 1; others >= 0; --others)
        {
            EXPECT_EQ(m.desk().phase, Phase::InPlay);
            m.drain_ball(others);
        }
        EXPECT_EQ(m.desk().phase, Phase::Bonus) << balls;
    }
}

TEST(BallSearch, FiresTheCoilsWhenNoSwitchClosesAndGivesUpAtLast)
{
    Machine m;
    m.start();
    m.lose_the_ball();
    m.wait(7.9f);
    EXPECT_FALSE(m.ordered(m.bumper, Command::Pulse));
    m.wait(0.2f);
    EXPECT_TRUE(m.ordered(m.bumper, Command::Pulse));
    m.orders.clear();
    m.wait(4);
    EXPECT_TRUE(m.ordered(m.bumper, Command::Pulse)) << "again";
    m.wait(8);
    EXPECT_TRUE(m.desk().recalls) << "the ball is written off";
    EXPECT_EQ(m.desk().player.ball, 1) << "and the game goes on";
}

TEST(BallSearch, LeavesABallAloneThatIsWhereItBelongs)
{
    Machine m;
    m.start();
    m.use_up_save();
    m.all_known = true; // held by a saucer
    m.orders.clear();
    m.wait(60);
    EXPECT_FALSE(m.ordered(m.bumper, Command::Pulse));
    m.all_known = false;
    m.wait(5);
    m.tell(EventKind::Entered, m.orbit);
    m.wait(5);
    EXPECT_FALSE(m.ordered(m.bumper, Command::Pulse)) << "a switch closed meanwhile";
}

/// Plays the ball out, with the points that its orbit was made, and waits for the next one.
void play_ball(Machine& m, int orbits)
{
    m.tell(EventKind::Entered, m.inlane);
    for (int i = 0; i < orbits; ++i)
        m.tell(EventKind::Entered, m.inlane);
    m.drain_ball();
    m.wait(0.1f, 0);
    m.wait(3, 0);
}

struct WithoutSave : Machine
{
    WithoutSave() { rebuild({}); }
    void rebuild(const RuleOptions& options)
    {
        table.rules.ball_save.reset();
        book = RuleBook(table, options);
        step({}, 0);
    }
};

void press_start(Machine& m) { m.step({}, 1, {.start = true}); }

TEST(Players, TakeTurnsAndKeepTheirOwnScores)
{
    WithoutSave m;
    m.start();
    press_start(m);
    press_start(m);
    EXPECT_EQ(m.desk().players, 3);
    std::vector<int> turns;
    for (int ball = 1; ball <= 3; ++ball)
        for (int player = 0; player < 3; ++player)
        {
            turns.push_back(m.desk().player_up);
            EXPECT_EQ(m.desk().player.ball, ball);
            play_ball(m, player);
        }
    EXPECT_EQ(turns, (std::vector<int>{0, 1, 2, 0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(m.desk().phase, Phase::GameOver);
    // A switch pays 100 and 10 of bonus; each ball has one more than the player's number.
    for (int player = 0; player < 3; ++player)
        EXPECT_EQ(m.book.score(player), 3 * (player + 1) * 110);
}

TEST(Players, JoinDuringTheFirstBallOnly)
{
    WithoutSave m;
    m.start();
    play_ball(m, 0);
    press_start(m);
    EXPECT_EQ(m.desk().players, 1);
    WithoutSave n;
    n.start();
    for (int i = 0; i < 6; ++i)
        press_start(n);
    EXPECT_EQ(n.desk().players, 4) << "no more than four";
}

TEST(Players, FindTheTableAsTheyLeftIt)
{
    WithoutSave m;
    m.start();
    press_start(m);
    m.tell(EventKind::Fell, m.bank[0]);
    m.tell(EventKind::Entered, m.lanes[1]);
    m.tell(EventKind::Fired, m.kicker);
    m.orders.clear();
    m.drain_ball();
    m.wait(3, 0);
    ASSERT_EQ(m.desk().player_up, 1);
    EXPECT_TRUE(m.ordered(m.bank[0], Command::Raise)) << "a new player's targets stand";
    EXPECT_TRUE(m.ordered(m.kicker, Command::Light));
    EXPECT_EQ(m.desk().player.lamps[m.lanes[1]], LampState::Off);
    m.orders.clear();
    play_ball(m, 0);
    ASSERT_EQ(m.desk().player_up, 0);
    EXPECT_TRUE(m.ordered(m.bank[0], Command::Drop));
    EXPECT_TRUE(m.ordered(m.bank[1], Command::Raise));
    EXPECT_TRUE(m.ordered(m.kicker, Command::Unlight));
    EXPECT_EQ(m.desk().player.lamps[m.lanes[1]], LampState::On);
}

TEST(ExtraBall, IsLitByTheGroupWonByTheShotAndPlayedNext)
{
    WithoutSave m;
    m.table.rules.extra_ball = ExtraBallRule{.group = 1, .completions = 2, .shot = m.orbit, .per_game = 1};
    m.rebuild({});
    m.start();
    press_start(m);
    m.tell(EventKind::Entered, m.orbit);
    const auto complete = [&]
    {
        m.tell(EventKind::Fell, m.bank[0]);
        m.tell(EventKind::Fell, m.bank[1]);
        m.wait(1.5f);
    };
    complete();
    EXPECT_FALSE(m.desk().player.extra_ball_is_lit);
    complete();
    EXPECT_TRUE(m.desk().player.extra_ball_is_lit);
    m.tell(EventKind::Entered, m.orbit);
    EXPECT_TRUE(m.announced(EventKind::ExtraBall));
    EXPECT_EQ(m.desk().player.extra_balls, 1);
    m.drain_ball();
    m.wait(3, 0);
    EXPECT_EQ(m.desk().player_up, 0) << "the same player shoots again";
    EXPECT_EQ(m.desk().player.ball, 1);
    EXPECT_EQ(m.desk().player.extra_balls, 0);
    complete();
    complete();
    EXPECT_FALSE(m.desk().player.extra_ball_is_lit) << "one a game";
    play_ball(m, 0);
    EXPECT_EQ(m.desk().player_up, 1);
}

TEST(Replay, IsWonOnceAGame)
{
    for (const bool ball : {false, true})
    {
        WithoutSave m;
        m.table.rules.replay = ReplayRule{.score = 300, .wins_a_ball = ball};
        m.rebuild({});
        m.start();
        m.tell(EventKind::Entered, m.inlane);
        m.tell(EventKind::Entered, m.inlane);
        EXPECT_FALSE(m.announced(EventKind::Replay));
        m.tell(EventKind::Entered, m.inlane);
        EXPECT_TRUE(m.announced(EventKind::Replay));
        m.tell(EventKind::Entered, m.inlane);
        EXPECT_FALSE(m.announced(EventKind::Replay));
        EXPECT_EQ(m.desk().credits, ball ? 0 : 1);
        EXPECT_EQ(m.desk().player.extra_balls, ball ? 1 : 0);
    }
}

TEST(Match, DrawsANumberAndGivesAGameToWhoEndsInIt)
{
    int won = 0;
    std::set<int> drawn;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        WithoutSave m;
        m.table.rules.match = true;
        m.table.rules.balls = 1;
        m.rebuild({.seed = seed});
        m.start();
        m.tell(EventKind::Entered, m.inlane);
        m.drain_ball();
        m.wait(1, 0);
        EXPECT_EQ(m.desk().phase, Phase::Match);
        int number = -1;
        for (int i = 0; i < 4000 && m.desk().phase == Phase::Match; ++i)
        {
            m.step({}, 0);
            for (const GameEvent& event : m.book.announced())
                if (event.kind == EventKind::Match)
                    number = event.value;
        }
        EXPECT_EQ(m.desk().phase, Phase::GameOver);
        drawn.insert(number);
        EXPECT_EQ(m.desk().credits, number == 10 ? 1 : 0) << "the score is 110";
        won += m.desk().credits;
    }
    EXPECT_GE(drawn.size(), 8u);
    EXPECT_GE(won, 1);
}

TEST(Tilt, LetsTheBobSettleBeforeTheNextBall)
{
    Machine m;
    m.start();
    m.use_up_save();
    for (int i = 0; i < 3; ++i)
    {
        m.step({{.kind = EventKind::BobTouched}});
        m.wait(1);
    }
    ASSERT_TRUE(m.desk().tilted);
    m.step({{.kind = EventKind::BobTouched}}); // still shaking
    m.drain_ball();
    m.wait(1.4f, 0);
    EXPECT_EQ(m.served, 1);
    m.wait(1, 0);
    EXPECT_EQ(m.served, 2);
}

TEST(Tilt, EndsABallThatMoreBallsWouldReplace)
{
    WithoutSave m;
    m.rebuild({.balls_at_once = 2});
    m.start();
    m.tell(EventKind::Entered, m.orbit);
    for (int i = 0; i < 3; ++i)
    {
        m.step({{.kind = EventKind::BobTouched}}, 2);
        m.wait(1, 2);
    }
    ASSERT_TRUE(m.desk().tilted);
    m.drain_ball(1);
    m.drain_ball(0);
    EXPECT_EQ(m.desk().phase, Phase::Bonus);
}

TEST(BallSearch, IsHeldUpByAHeldFlipperAndNotByTaps)
{
    Machine m;
    m.start();
    m.lose_the_ball();
    m.flipper_is_held = true;
    m.wait(20);
    EXPECT_FALSE(m.ordered(m.bumper, Command::Pulse)) << "a cradled ball";
    for (int i = 0; i < 10; ++i)
    {
        m.flipper_is_held = false;
        m.wait(0.9f);
        m.flipper_is_held = true;
        m.wait(0.1f);
    }
    EXPECT_TRUE(m.ordered(m.bumper, Command::Pulse));
}

TEST(BallSearch, LeavesAloneWhatIsNotInTheGame)
{
    Machine m;
    m.table.elements[m.bumper].enabled = false;
    m.book = RuleBook(m.table);
    m.start();
    m.wait(30);
    EXPECT_FALSE(m.ordered(m.bumper, Command::Pulse));
    EXPECT_TRUE(m.ordered(m.saucer, Command::Pulse));
}

TEST(Players, FindDropTargetsOfNoGroupAsTheyLeftThem)
{
    WithoutSave m;
    m.table.groups.pop_back();
    for (const Index target : m.bank)
        m.table.elements[target].group = none;
    m.table.rules.bank.reset();
    m.rebuild({});
    m.start();
    press_start(m);
    EXPECT_TRUE(m.ordered(m.bank[0], Command::Raise)) << "a game begins with them up";
    m.tell(EventKind::Fell, m.bank[0]);
    m.orders.clear();
    play_ball(m, 0);
    EXPECT_TRUE(m.ordered(m.bank[0], Command::Raise));
    m.orders.clear();
    play_ball(m, 0);
    EXPECT_TRUE(m.ordered(m.bank[0], Command::Drop));
    EXPECT_TRUE(m.ordered(m.bank[1], Command::Raise));
}

void tilt(Machine& m)
{
    for (int i = 0; i < 3; ++i)
    {
        m.step({{.kind = EventKind::BobTouched}});
        m.wait(1);
    }
    ASSERT_TRUE(m.desk().tilted);
}

TEST(Tilt, LeavesNoDropTargetLying)
{
    WithoutSave m;
    m.start();
    m.tell(EventKind::Entered, m.orbit);
    tilt(m);
    m.tell(EventKind::Fell, m.bank[0]); // unheard
    m.orders.clear();
    m.drain_ball();
    m.wait(4, 0);
    ASSERT_EQ(m.desk().player.ball, 2);
    EXPECT_TRUE(m.ordered(m.bank[0], Command::Raise));
}

TEST(Tilt, EndsWithTheGame)
{
    WithoutSave m;
    m.table.rules.balls = 1;
    m.rebuild({});
    m.start();
    m.tell(EventKind::Entered, m.orbit);
    tilt(m);
    m.drain_ball();
    m.wait(4, 0);
    EXPECT_EQ(m.desk().phase, Phase::GameOver);
    EXPECT_FALSE(m.desk().tilted);
}

TEST(Tilt, InAMultiballIsNoneOfTheNextPlayers)
{
    WithoutSave m;
    m.start();
    press_start(m);
    start_multiball(m);
    ASSERT_TRUE(m.desk().multiball);
    tilt(m);
    m.drain_ball();
    m.wait(4, 0);
    ASSERT_EQ(m.desk().player_up, 1);
    EXPECT_FALSE(m.desk().multiball);
    for (const LampState lamp : m.desk().player.lamps)
        EXPECT_NE(lamp, LampState::Blink);
}

} // namespace
} // namespace carom::pinball::test
