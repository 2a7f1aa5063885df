// The box tree and the broad phase against brute force; the work per query stays small.

#include "collision/broad_phase.h"
#include "support/test_scene.h"

#include <algorithm>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

FloatBox random_box(Random& random, double world)
{
    const double size = 0.01 * std::pow(1000, random.unit());
    const double x = random.range(-world, world);
    const double y = random.range(-world, world);
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(x + size * random.unit()),
            static_cast<float>(y + size * random.unit())};
}

} // namespace

TEST(CollisionBoxTree, QueriesAgreeWithBruteForce)
{
    Random random(1);
    for (const int n : {0, 1, 2, 7, 8, 9, 63, 64, 65, 1000, 5000})
    {
        std::vector<TreeLeaf> leaves;
        for (int i = 0; i < n; ++i)
            leaves.push_back({random_box(random, 20), i});
        BoxTree tree;
        tree.build({}, leaves);
        EXPECT_EQ(tree.live_count(), n);
        for (int q = 0; q < 300; ++q)
        {
            const FloatBox box = random_box(random, 20);
            std::vector<int> got;
            tree.query(box,
                       [&](int item)
                       {
                           got.push_back(item);
                           return true;
                       });
            std::vector<int> want;
            for (const TreeLeaf& leaf : leaves)
                if (leaf.box.lx <= box.ux && box.lx <= leaf.box.ux && leaf.box.ly <= box.uy && box.ly <= leaf.box.uy)
                    want.push_back(leaf.item);
            std::sort(got.begin(), got.end());
            ASSERT_EQ(got, want);
        }
    }
}

TEST(CollisionBoxTree, AQueryLooksAtFewNodes)
{
    Random random(2);
    const auto looks = [&](int n)
    {
        std::vector<TreeLeaf> leaves;
        const double world = std::sqrt(static_cast<double>(n));
        for (int i = 0; i < n; ++i)
        {
            const double x = random.range(0, world);
            const double y = random.range(0, world);
            leaves.push_back(
                {{static_cast<float>(x), static_cast<float>(y), static_cast<float>(x + 0.5), static_cast<float>(y + 0.5)}, i});
        }
        BoxTree tree;
        tree.build({}, leaves);
        long tests = 0;
        for (const TreeLeaf& leaf : leaves)
            tree.descend(
                [&](const FloatBox& box)
                {
                    ++tests;
                    return overlaps(box, leaf.box);
                },
                [](int) { return true; });
        return static_cast<double>(tests) / n;
    };
    const double small = looks(1000);
    const double large = looks(64000);
    EXPECT_LT(large, 2.5 * small) << "64 times the boxes: two more levels of eight";
    EXPECT_LT(large, 300);
}

TEST(CollisionBroadPhase, StaysRightUnderTenThousandChanges)
{
    Random random(3);
    BroadPhase broad;
    struct Entry
    {
        FloatBox box{};
        Layer layer = Layer::None;
        bool unbounded = false;
    };
    std::vector<Entry> want(400);
    for (int k = 0; k < 10000; ++k)
    {
        const int item = random.below(400);
        Entry& entry = want[static_cast<std::size_t>(item)];
        if (entry.layer == Layer::None)
        {
            entry = {random_box(random, 10), random.chance(0.5) ? Layer::Moving : Layer::Resting, random.chance(0.02)};
            broad.insert(item, entry.box, entry.layer, {.unbounded = entry.unbounded});
        }
        else
        {
            switch (random.below(5))
            {
            case 0:
                broad.remove(item);
                entry.layer = Layer::None;
                break;
            case 1:
                entry.layer = entry.layer == Layer::Moving ? Layer::Resting : Layer::Moving;
                broad.move_to(item, entry.layer);
                break;
            case 2:
                entry.box = random_box(random, 10);
                broad.set_box(item, entry.box);
                break;
            default:
            {
                // A batch of moving ones, few or nearly all.
                std::vector<std::int32_t> items;
                std::vector<FloatBox> boxes;
                const double share = random.chance(0.5) ? 0.05 : 0.9;
                for (int i = 0; i < 400; ++i)
                {
                    Entry& e = want[static_cast<std::size_t>(i)];
                    if (e.layer == Layer::Moving && !e.unbounded && random.chance(share))
                    {
                        e.box = random_box(random, 10);
                        items.push_back(i);
                        boxes.push_back(e.box);
                    }
                }
                if (k % 10 == 0)
                    broad.update_moving({}, items, boxes);
                else
                    for (std::size_t i = 0; i < items.size(); ++i)
                        broad.set_box(items[i], boxes[i]);
                break;
            }
            }
        }
        if (k % 5 != 0)
            continue;
        const FloatBox box = random_box(random, 10);
        for (const Layer layer : {Layer::Moving, Layer::Resting})
        {
            std::vector<int> got;
            broad.query(layer, box,
                        [&](int i)
                        {
                            got.push_back(i);
                            return true;
                        });
            std::sort(got.begin(), got.end());
            std::vector<int> expected;
            for (int i = 0; i < 400; ++i)
            {
                const Entry& e = want[static_cast<std::size_t>(i)];
                if (e.layer == layer && !e.unbounded && overlaps(e.box, box))
                    expected.push_back(i);
            }
            ASSERT_EQ(got, expected) << "change " << k;
        }
    }
}
