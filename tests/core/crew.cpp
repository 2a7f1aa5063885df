// Every part of every round is done once, and before the round is over; so is what is to be done aside. With any number of members, and by job systems that run
// tasks one after the other.

#include "core/crew.h"
#include "support/test_scene.h"
#include "support/threads.h"

#include <atomic>
#include <vector>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

constexpr int rounds = 50;
constexpr int pieces = 37;

void expect_all_is_done_once(const TaskHooks& hooks, int aside)
{
    std::vector<std::atomic<int>> done(static_cast<std::size_t>(aside));
    int leads = 0;
    Crew::run(
        hooks,
        [&](Crew& crew)
        {
            ++leads;
            for (int round = 0; round < rounds; ++round)
            {
                std::vector<std::atomic<int>> pieces_done(pieces);
                crew.in_pieces(pieces, round % 2 == 0, [&](int piece) { ++pieces_done[static_cast<std::size_t>(piece)]; });
                for (const std::atomic<int>& times : pieces_done)
                    ASSERT_EQ(times, 1);
                std::atomic<int> sum = 0;
                crew.share(1000, 10, [&](int first, int last) { sum += last - first; });
                ASSERT_EQ(sum, 1000);
            }
        },
        aside, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(leads, 1);
    for (const std::atomic<int>& times : done)
        EXPECT_EQ(times, 1);
}

} // namespace

TEST(CoreCrew, RoundsAndWhatIsAsideAreDoneOnce)
{
    for (const int aside : {0, 1, 200})
    {
        expect_all_is_done_once({}, aside);
        expect_all_is_done_once({.worker_count = 3, .run = run_backwards}, aside);
        for (const int count : {2, 3, 20}) // more than the members of a crew
        {
            Threads threads(count);
            expect_all_is_done_once(threads.hooks(), aside);
        }
    }
}

TEST(CoreCrew, WhoWaitsForTheLeaderDoesWhatIsAside)
{
    Threads threads(2);
    std::atomic<int> done = 0;
    Crew::run(
        threads.hooks(),
        [&](const Crew&)
        {
            while (done < 5)
            {
            }
        },
        5, [&](int) { ++done; });
    EXPECT_EQ(done, 5);
}
