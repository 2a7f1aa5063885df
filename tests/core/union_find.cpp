// Sets against labels that are spread until nothing changes; by several threads at once as by one.

#include "core/union_find.h"
#include "support/test_scene.h"

#include <atomic>
#include <thread>
#include <utility>
#include <vector>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

using Links = std::vector<std::pair<std::int32_t, std::int32_t>>;

constexpr int size = 2000;

Links random_links(std::uint64_t seed, int count)
{
    Random random(seed);
    Links links;
    for (int i = 0; i < count; ++i)
        links.emplace_back(static_cast<int>(random.range(0, size)), static_cast<int>(random.range(0, size)));
    return links;
}

// The least of each set.
std::vector<std::int32_t> spread(const Links& links)
{
    std::vector<std::int32_t> least(size);
    for (int i = 0; i < size; ++i)
        least[static_cast<std::size_t>(i)] = i;
    for (bool changed = true; changed;)
    {
        changed = false;
        for (const auto& [a, b] : links)
        {
            std::int32_t& of_a = least[static_cast<std::size_t>(a)];
            std::int32_t& of_b = least[static_cast<std::size_t>(b)];
            changed |= of_a != of_b;
            of_a = of_b = std::min(of_a, of_b);
        }
    }
    return least;
}

std::vector<std::int32_t> roots(UnionFind& sets)
{
    std::vector<std::int32_t> all;
    for (int i = 0; i < size; ++i)
        all.push_back(sets.root(i));
    return all;
}

template <class Visit>
void on_four_threads(const Links& links, const Visit& visit)
{
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t)
        threads.emplace_back(
            [&, t]
            {
                for (std::size_t i = t; i < links.size(); i += 4)
                    visit(links[i].first, links[i].second);
            });
    for (std::thread& thread : threads)
        thread.join();
}

} // namespace

TEST(CoreUnionFind, RootsAreTheLeastOfTheirSets)
{
    for (const int count : {0, 300, 1000, 3000})
    {
        const Links links = random_links(static_cast<std::uint64_t>(count) + 1, count);
        UnionFind sets;
        sets.reset(size);
        int joined = 0;
        for (const auto& [a, b] : links)
            joined += sets.link(a, b, false) ? 1 : 0;
        const std::vector<std::int32_t> expected = spread(links);
        int least = 0;
        for (int i = 0; i < size; ++i)
            least += expected[static_cast<std::size_t>(i)] == i ? 1 : 0;
        EXPECT_EQ(roots(sets), expected);
        EXPECT_EQ(joined, size - least); // each that tells of a new link takes one set away
    }
}

TEST(CoreUnionFind, ThreadsSideBySideFindTheSameRoots)
{
    const Links links = random_links(7, 1500);
    for (int run = 0; run < 20; ++run)
    {
        UnionFind sets;
        sets.reset(size);
        on_four_threads(links, [&](std::int32_t a, std::int32_t b) { sets.link(a, b, true); });
        EXPECT_EQ(roots(sets), spread(links));
    }
}

TEST(CoreUnionFind, GuessesLeaveLessToLinkAndChangeNoRoot)
{
    const Links links = random_links(11, 1500);
    UnionFind sets;
    sets.reset(size);
    for (const auto& [a, b] : links)
        sets.guess(a, b);
    sets.flatten();
    std::atomic<int> joined = 0;
    on_four_threads(links, [&](std::int32_t a, std::int32_t b) { joined += sets.link(a, b, true) ? 1 : 0; });
    EXPECT_EQ(roots(sets), spread(links));
    EXPECT_LT(joined, 700);
}

TEST(CoreUnionFind, WhatOthersHaveLinkedIsTakenOver)
{
    const Links links = random_links(13, 1500);
    UnionFind sets[3];
    for (std::size_t part = 0; part < 3; ++part)
    {
        sets[part].reset(size);
        for (std::size_t i = part; i < links.size(); i += 3)
            sets[part].link(links[i].first, links[i].second, false);
        sets[part].flatten();
    }
    sets[0].join_all(sets[1]);
    sets[0].join_all(sets[2]);
    EXPECT_EQ(roots(sets[0]), spread(links));
}

TEST(CoreUnionFind, WhoIsLinkedToNobodyStaysAlone)
{
    UnionFind sets;
    sets.reset(3);
    sets.guess(1, -1);
    sets.guess(-3, 2);
    sets.flatten();
    EXPECT_FALSE(sets.link(1, -1, false));
    EXPECT_FALSE(sets.link(-3, 2, false));
    for (std::int32_t i = 0; i < 3; ++i)
        EXPECT_EQ(sets.root(i), i);
}
