// New overlaps among moving boxes, and pairs that may meet in a step: every instruction set against one box, or pair, after the other.

#include "collision/broad_phase.h"
#include "dynamics/solver/simd/kernels.h"
#include "support/test_scene.h"

#include <algorithm>
#include <bit>
#include <iterator>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

using BoxNumbers = std::pair<int, int>;

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
    std::vector<BoxNumbers> pairs;

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

std::vector<BoxNumbers> find_all(const BroadPhase& broad, const WideKernels& kernels)
{
    Found found{broad, 0, {}};
    const OverlapSink sink{&found, [](const void* context, std::int32_t other, std::uint64_t boxes)
                           { const_cast<Found*>(static_cast<const Found*>(context))->note(other, boxes); }};
    for (found.block = 0; found.block < broad.block_count(); ++found.block)
        kernels.new_overlaps(broad.moving_blocks(), found.block, sink);
    std::sort(found.pairs.begin(), found.pairs.end());
    return found.pairs;
}

// Boxes of which some meet all but each other.
class FilteredCrowd
{
public:
    FilteredCrowd(int n, int debris_of_ten) : m_world(0.7 * std::sqrt(static_cast<double>(n))), m_before(boxes(n))
    {
        for (int i = 0; i < n; ++i)
        {
            m_items.push_back(i);
            m_filters.push_back(m_random.below(10) < debris_of_ten ? debris : all);
            m_broad.insert(i, m_before[static_cast<std::size_t>(i)], Layer::Moving, {}, m_filters.back());
            m_broad.settle(i);
        }
    }

    void let_some_meet_all()
    {
        for (std::size_t i = 0; i < m_filters.size(); i += 3)
            m_broad.set_filter(static_cast<int>(i), m_filters[i] = all);
    }

    // Everything goes elsewhere; how many pairs that may meet have come to overlap.
    int move()
    {
        std::vector<FloatBox> now = boxes(static_cast<int>(m_items.size()));
        EXPECT_TRUE(m_broad.update_moving({}, m_items, now));
        for (int k = 0; k < m_broad.block_count(); ++k)
            m_broad.note_changes(k);
        const std::vector<BoxNumbers> want = new_pairs(now);
        const bool none_meet = std::ranges::all_of(m_filters, [](const FilterBits& f) { return !may_meet(f, f); });
        for (const WideKernels* kernels : all_wide_kernels())
        {
            std::vector<BoxNumbers> found = find_all(m_broad, *kernels);
            EXPECT_TRUE(found.empty() || !none_meet) << kernels->name;
            std::erase_if(found, [&](const BoxNumbers& p) { return !meet(p.first, p.second); });
            EXPECT_EQ(found, want) << kernels->name;
        }
        for (const std::int32_t item : m_items)
            m_broad.settle(item);
        m_before = std::move(now);
        return static_cast<int>(want.size());
    }

private:
    static constexpr FilterBits debris{2, ~std::uint64_t{2}};
    static constexpr FilterBits all{};

    std::vector<FloatBox> boxes(int n)
    {
        std::vector<FloatBox> result;
        std::generate_n(std::back_inserter(result), n, [&] { return box_at(m_random, m_world); });
        return result;
    }

    [[nodiscard]] bool meet(int i, int j) const
    {
        return may_meet(m_filters[static_cast<std::size_t>(i)], m_filters[static_cast<std::size_t>(j)]);
    }

    [[nodiscard]] std::vector<BoxNumbers> new_pairs(const std::vector<FloatBox>& now) const
    {
        std::vector<BoxNumbers> pairs;
        for (std::size_t i = 0; i < now.size(); ++i)
        {
            for (std::size_t j = i + 1; j < now.size(); ++j)
            {
                if (may_meet(m_filters[i], m_filters[j]) && overlaps(now[i], now[j]) && !overlaps(m_before[i], m_before[j]))
                    pairs.emplace_back(i, j);
            }
        }
        return pairs;
    }

    Random m_random{12};
    double m_world;
    BroadPhase m_broad;
    std::vector<FloatBox> m_before;
    std::vector<FilterBits> m_filters;
    std::vector<std::int32_t> m_items;
};

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
            std::vector<BoxNumbers> want;
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

namespace {

// One in four rests, one in eight is set apart.
BroadPhase moving_boxes(Random& random, int n)
{
    BroadPhase broad;
    for (int i = 0; i < n; ++i)
    {
        const FloatBox fat = box_at(random, 3);
        const Layer layer = random.chance(0.25) ? Layer::Resting : Layer::Moving;
        broad.insert(i, fat, layer, {.trigger = random.chance(0.06), .unbounded = random.chance(0.06)});
        const FloatBox tight{fat.lx + 0.05f, fat.ly + 0.05f, fat.ux - 0.05f, fat.uy - 0.05f};
        const Vec2 shift = layer == Layer::Resting ? Vec2{} : Vec2{random.rangef(-0.3, 0.3), random.rangef(-0.3, 0.3)};
        broad.set_path(i, {tight, shift, layer == Layer::Resting ? 0 : random.rangef(0, 0.05)});
    }
    return broad;
}

// Where whole blocks cannot meet they are not looked at; what may meet is found, also when it may only since the tree was built.
TEST(NewOverlaps, OfWhatMayMeetAreFound)
{
    for (const int n : {8, 65, 700})
    {
        for (const int debris_of_ten : {10, 9, 5})
        {
            SCOPED_TRACE(std::to_string(n) + " boxes, of ten " + std::to_string(debris_of_ten) + " debris");
            FilteredCrowd crowd(n, debris_of_ten);
            for (int round = 0; round < 3; ++round)
                crowd.move();
            crowd.let_some_meet_all();
            EXPECT_GT(crowd.move(), 0);
        }
    }
}

} // namespace

TEST(SeenPairs, AreAsEachByItself)
{
    constexpr float margin = 0.1f;
    constexpr int boxes = 60;
    Random random(12);
    const BroadPhase broad = moving_boxes(random, boxes);
    int near_ones = 0;
    for (int round = 0; round < 1000; ++round)
    {
        BoxPair eight[lane_count];
        SeenPairs want{};
        for (unsigned i = 0; i < lane_count; ++i)
        {
            BoxPair& p = eight[i];
            p = {random.below(boxes), random.below(boxes), random.chance(0.5) ? 7 : none};
            const ItemTraits a = broad.traits(p.a);
            const ItemTraits b = broad.traits(p.b);
            const bool both_move = broad.moves(p.a) && broad.moves(p.b);
            const bool plain = !a.trigger && !a.unbounded && !b.trigger && !b.unbounded && (broad.moves(p.a) || broad.moves(p.b));
            const bool meet = overlaps(broad.box(p.a), broad.box(p.b));
            const float room = both_move && p.contact == none ? 0.5f * margin : margin;
            const bool near = least_gap(broad.path(p.a), broad.path(p.b)) <= room;
            want.plain |= plain ? 1u << i : 0;
            want.near |= plain && near ? 1u << i : 0;
            want.meet |= plain && meet ? 1u << i : 0;
            want.stay |= plain && meet && near == (p.contact != none) ? 1u << i : 0;
            near_ones += plain && near ? 1 : 0;
        }
        for (const WideKernels* kernels : all_wide_kernels())
        {
            SeenPairs seen{};
            kernels->look_at_pairs(eight, broad.places(), margin, seen);
            ASSERT_EQ(seen.plain, want.plain) << kernels->name << ", round " << round;
            ASSERT_EQ(seen.near & seen.plain, want.near) << kernels->name << ", round " << round;
            ASSERT_EQ(seen.meet & seen.plain, want.meet) << kernels->name << ", round " << round;
            ASSERT_EQ(seen.stay, want.stay) << kernels->name << ", round " << round;
        }
    }
    EXPECT_GT(near_ones, 100);
}
