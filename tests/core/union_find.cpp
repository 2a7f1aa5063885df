// Sets against labels that are spread until nothing changes; by several threads at once as by one.

#include "core/union_find.h"
#include "support/test_scene.h"

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
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < 4; ++t)
            threads.emplace_back(
                [&, t]
                {
                    for (std::size_t i = t; i < links.size(); i += 4)
                        sets.link(links[i].first, links[i].second, true);
                });
        for (std::thread& thread : threads)
            thread.join();
        EXPECT_EQ(roots(sets), spread(links));
    }
}
