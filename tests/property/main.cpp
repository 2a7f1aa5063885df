// 101,300 random shots. Every arrangement is a test; every shot has a number.
//
//   carom-test-property --shot N    replays one shot, with its arrangement and the state after every step
//   carom-test-property --program N prints it as a program of its own
//   carom-test-property --survey [arrangement]
//                                   runs everything and prints how many fail; of one arrangement, all that fail
//
// CAROM_SHOT_SEED=n in the environment takes others; what it finds is replayed with the same n.
// CAROM_SHOT_DIVISOR=n in the environment runs every nth shot; builds with sanitizers or structure walks run every 16th.

#include "property/arrangements.h"
#include "support/effort.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <iostream>

using namespace carom;
using namespace carom::shots;

namespace {

constexpr int usual_divisor = carom::test::slow_build ? 16 : 1;

int divisor()
{
    const char* text = std::getenv("CAROM_SHOT_DIVISOR");
    return text ? std::max(1, std::atoi(text)) : usual_divisor;
}

std::uint64_t seed_of(int number)
{
    constexpr std::uint64_t apart = 1'000'000;
    const char* text = std::getenv("CAROM_SHOT_SEED");
    return static_cast<std::uint64_t>(number) + apart * (text ? std::strtoull(text, nullptr, 10) : 0);
}

struct Tally
{
    std::map<std::string, int> laws{};
    std::map<std::string, int> first{}; // number of the first shot that broke the law
    std::string details{};
    int shots = 0;
    int failed = 0;
    int met = 0; // shots in which something met something
    int slowest = 0;
    double slowest_ms = 0; // for the survey alone
};

// The number of an arrangement's first shot comes with it.
std::pair<const Arrangement*, int> arrangement_of(int number)
{
    int first = 0;
    for (const Arrangement& arrangement : arrangements())
    {
        if (number >= first && number < first + arrangement.shots)
            return {&arrangement, first};
        first += arrangement.shots;
    }
    return {nullptr, first};
}

std::optional<Failure> run_shot(Trial& trial, const Arrangement& arrangement, bool trace)
{
    trial.story.precision(9);
    try
    {
        arrangement.build(trial);
        if (trace)
            std::cout << arrangement.name << ", " << trial.steps << " steps: " << trial.story.str() << "\n";
        return trial.run(trace);
    }
    catch (const Error& error)
    {
        return Failure{"refused", 0, error.what()};
    }
}

std::string describe(const Arrangement& arrangement, int number, const Failure& failure, const std::string& story)
{
    return say(arrangement.name, " --shot ", number, ": ", failure.law, " in step ", failure.step, ": ", failure.sentence,
               "\n    ", story, "\n");
}

Tally run_all(const Arrangement& arrangement, int first, int most_told)
{
    Tally tally;
    for (int i = first; i < first + arrangement.shots; ++i)
    {
        if (i % divisor() != 0)
            continue;
        Trial trial(seed_of(i));
        const auto begin = std::chrono::steady_clock::now();
        const auto failure = run_shot(trial, arrangement, false);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        if (took.count() > tally.slowest_ms)
        {
            tally.slowest = i;
            tally.slowest_ms = took.count();
        }
        ++tally.shots;
        tally.met += trial.met();
        if (!failure)
            continue;
        ++tally.failed;
        tally.first.emplace(failure->law, i);
        if (++tally.laws[failure->law] <= most_told)
            tally.details += describe(arrangement, i, *failure, trial.story.str());
    }
    return tally;
}

std::string summary(const Tally& tally)
{
    std::string text = say(tally.failed, " of ", tally.shots, " shots fail, ", tally.met, " met something");
    for (const auto& [law, count] : tally.laws)
        text += say(", ", law, " ", count, " (first --shot ", tally.first.at(law), ")");
    return text;
}

class ShotTest : public ::testing::Test
{
public:
    ShotTest(const Arrangement& arrangement, int first) : m_arrangement(arrangement), m_first(first) {}
    void TestBody() override
    {
        const Tally tally = run_all(m_arrangement, m_first, 8);
        EXPECT_GT(tally.met, tally.shots / 2) << "too few shots meet anything to show much";
        if (tally.failed > 0)
            ADD_FAILURE() << summary(tally) << "\n" << tally.details;
    }

private:
    const Arrangement& m_arrangement;
    int m_first;
};

void register_tests()
{
    int first = 0;
    for (const Arrangement& arrangement : arrangements())
    {
        ::testing::RegisterTest("RandomShots", arrangement.name, nullptr, nullptr, __FILE__, __LINE__,
                                [&arrangement, first]() -> ::testing::Test* { return new ShotTest(arrangement, first); });
        first += arrangement.shots;
    }
}

int refuse_number(int shots)
{
    std::cerr << "shots are numbered 0 to " << shots - 1 << "\n";
    return 2;
}

int replay(int number)
{
    const auto [arrangement, first] = arrangement_of(number);
    if (!arrangement)
        return refuse_number(first);
    Trial trial(seed_of(number));
    const auto failure = run_shot(trial, *arrangement, true);
    std::cout << (failure ? describe(*arrangement, number, *failure, "") : std::string("nothing fails\n"));
    return failure ? 1 : 0;
}

int print_program(int number)
{
    const auto [arrangement, first] = arrangement_of(number);
    if (!arrangement)
        return refuse_number(first);
    Trial trial(seed_of(number));
    arrangement->build(trial);
    std::cout << "// carom-test-property --shot " << number << ", " << arrangement->name << "\n";
    trial.print_program(std::cout);
    return 0;
}

int survey(const char* only)
{
    int first = 0;
    int shots = 0;
    int failed = 0;
    for (const Arrangement& arrangement : arrangements())
    {
        const auto begin = std::chrono::steady_clock::now();
        if (!only || std::strcmp(only, arrangement.name) == 0)
        {
            const Tally tally = run_all(arrangement, first, arrangement.shots);
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
            std::cout << arrangement.name << ": " << summary(tally) << "; " << took.count() << " s, slowest --shot "
                      << tally.slowest << " " << tally.slowest_ms << " ms\n"
                      << (only ? tally.details : "");
            std::cout.flush();
            shots += tally.shots;
            failed += tally.failed;
        }
        first += arrangement.shots;
    }
    std::cout << failed << " of " << shots << " shots fail\n";
    return failed > 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc > 2 && std::strcmp(argv[1], "--shot") == 0)
        return replay(std::atoi(argv[2]));
    if (argc > 2 && std::strcmp(argv[1], "--program") == 0)
        return print_program(std::atoi(argv[2]));
    if (argc > 1 && std::strcmp(argv[1], "--survey") == 0)
        return survey(argc > 2 ? argv[2] : nullptr);
    ::testing::InitGoogleTest(&argc, argv);
    register_tests();
    return RUN_ALL_TESTS();
}
