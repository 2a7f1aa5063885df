// What has come to overlap among moving boxes: every instruction set against brute force.

#include "collision/broad_phase.h"
#include "dynamics/wide_kernels.h"
#include "support/test_scene.h"

#include <algorithm>
#include <bit>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

using Pair = std::pair<int, int>;

FloatBox box_at(Random& random, double world)
{
    const double x = random.range(-world, world);
    const double y = random.range(-world, world);
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(x + 0.2 + random.unit()),
            static_cast<float>(y + 0.2 + random.unit())};
}

struct Found
{
    const BroadPhase& broad;
    int block;
    std::vector<Pair> pairs;

    void note(std::int32_t other, std::uint64_t boxes)
    {
        for (; boxes != 0; boxes &= boxes - 1)
        {
            const int bit = std::countr_zero(boxes);
            const int a = broad.moving_item(block * 8 + bit / 8);
            const int b = broad.moving_item(other * 8 + bit % 8);
            pairs.emplace_back(std::min(a, b), std::max(a, b));
        }
    }
};

std::vector<Pair> find_all(const BroadPhase& broad, const WideKernels& kernels)
{
    Found found{broad, 0, {}};
    const OverlapSink sink{&found, [](const void* context, std::int32_t other, std::uint64_t boxes)
                           { const_cast<Found*>(static_cast<const Found*>(context))->note(other, boxes); }};
    for (found.block = 0; found.block < broad.block_count(); ++found.block)
        kernels.new_overlaps(broad.moving_blocks(), found.block, sink);
    std::sort(found.pairs.begin(), found.pairs.end());
    return found.pairs;
}

} // namespace

TEST(NewOverlaps, AreThoseOfBruteForceEachOnce)
{
    Random random(11);
    for (const int n : {1, 2, 8, 9, 64, 65, 700})
    {
        BroadPhase broad;
        std::vector<FloatBox> before;
        const double world = 0.7 * std::sqrt(static_cast<double>(n));
        for (int i = 0; i < n; ++i)
        {
            before.push_back(box_at(random, world));
            broad.insert(i, before.back(), Layer::Moving, {});
            broad.settle(i);
        }
        for (int round = 0; round < 12; ++round)
        {
            if (n > 2 && round % 5 == 4)
            { // leaves a hole until the tree is built anew
                const int gone = random.below(n);
                broad.remove(gone);
                before[static_cast<std::size_t>(gone)] = {};
            }
            std::vector<FloatBox> now = before;
            std::vector<std::int32_t> items;
            std::vector<FloatBox> boxes;
            for (int i = 0; i < n; ++i)
            {
                if (!broad.has(i) || (n > 2 && random.chance(0.4)))
                    continue;
                items.push_back(i);
                boxes.push_back(now[static_cast<std::size_t>(i)] = box_at(random, world));
            }
            if (items.empty())
                continue;
            ASSERT_TRUE(broad.update_moving({}, items, boxes));
            for (int k = 0; k < broad.block_count(); ++k)
                broad.note_changes(k);
            std::vector<Pair> want;
            for (std::size_t i = 0; i < now.size(); ++i)
            {
                for (std::size_t j = i + 1; j < now.size(); ++j)
                {
                    if (overlaps(now[i], now[j]) && !overlaps(before[i], before[j]))
                        want.emplace_back(i, j);
                }
            }
            for (const WideKernels* kernels : all_wide_kernels())
                ASSERT_EQ(find_all(broad, *kernels), want) << kernels->name << ", " << n << " boxes, round " << round;
            for (const std::int32_t item : items)
                broad.settle(item);
            before = now;
        }
    }
}
