// Every part of every round is done once, and before the round is over; so is what is to be done aside. With any number of members, and by job systems that run
// tasks one after the other.

#include "core/worker_team.h"
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

void expect_all_is_done_once(const TaskHooks& hooks, int background)
{
    std::vector<std::atomic<int>> done(static_cast<std::size_t>(background));
    int leads = 0;
    WorkerTeam::run(
        hooks,
        [&](WorkerTeam& team)
        {
            ++leads;
            for (int round = 0; round < rounds; ++round)
            {
                std::vector<std::atomic<int>> pieces_done(pieces);
                team.in_pieces(pieces, round % 2 == 0, [&](int piece) { ++pieces_done[static_cast<std::size_t>(piece)]; });
                for (const std::atomic<int>& times : pieces_done)
                    ASSERT_EQ(times, 1);
                std::atomic<int> sum = 0;
                team.share(1000, 10, [&](int first, int last) { sum += last - first; });
                ASSERT_EQ(sum, 1000);
            }
        },
        background, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(leads, 1);
    for (const std::atomic<int>& times : done)
        EXPECT_EQ(times, 1);
}

} // namespace

TEST(CoreWorkerTeam, RoundsAndWhatIsAsideAreDoneOnce)
{
    for (const int background : {0, 1, 200})
    {
        expect_all_is_done_once({}, background);
        expect_all_is_done_once({.worker_count = 3, .run = run_backwards}, background);
        for (const int count : {2, 3, 20}) // more than the members of a worker team
        {
            Threads threads(count);
            expect_all_is_done_once(threads.hooks(), background);
        }
    }
}

TEST(CoreWorkerTeam, WhoWaitsForTheLeaderDoesWhatIsAside)
{
    Threads threads(2);
    std::atomic<int> done = 0;
    WorkerTeam::run(
        threads.hooks(),
        [&](const WorkerTeam&)
        {
            while (done < 5)
            {
            }
        },
        5, [&](int) { ++done; });
    EXPECT_EQ(done, 5);
}
