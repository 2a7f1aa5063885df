// Contacts that move in memory: every list that names them must go along.

#include "support/test_scene.h"

#include <map>
#include <set>
#include <utility>

using namespace carom;
using namespace carom::test;

namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>; // slots of the shapes

Pair pair_of(const ContactInfo& c) { return std::minmax(c.shape_a.slot, c.shape_b.slot); }

// What each body lists is what the scene lists, no more and no less.
void expect_lists_agree(const Scene& scene)
{
    std::map<BodyId, std::multiset<Pair>> of_scene;
    for (const ContactInfo& c : scene.contacts())
    {
        if (!c.touching)
            continue;
        for (const ShapeId shape : {c.shape_a, c.shape_b})
            of_scene[scene.shape(shape).body()].insert(pair_of(c));
    }
    for (const BodyId body : scene.bodies())
    {
        std::multiset<Pair> of_body;
        for (const ContactInfo& c : scene.body(body).contacts())
            of_body.insert(pair_of(c));
        ASSERT_EQ(of_body, of_scene[body]) << "body " << body.slot;
    }
}

} // namespace

TEST(DynamicsTidy, ListsKeepWhileBodiesComeAndGo)
{
    Scene scene(sleepless());
    Random random(11);
    add_static(scene, box(8, 0.5f, {0, -0.5f}));
    add_static(scene, box(0.5f, 20, {-7.5f, 20}));
    add_static(scene, box(0.5f, 20, {7.5f, 20}));
    std::vector<BodyId> heap;
    for (int i = 0; i < 600; ++i)
        heap.push_back(add_dynamic(scene, {-6.5 + 0.52 * (i % 25), 0.3 + 0.52 * (i / 25)}, box(0.25f, 0.25f)).body);
    std::size_t most = 0;
    for (int i = 0; i < 100; ++i)
    {
        scene.step(1.0f / 60);
        most = std::max(most, scene.contacts().size());
        expect_lists_agree(scene);
        if (HasFatalFailure())
            return;
        BodyId& chosen = heap[static_cast<std::size_t>(random.below(600))];
        scene.destroy(chosen);
        chosen = add_dynamic(scene, {random.range(-6, 6), random.range(14, 16)}, Circle{.radius = 0.25f}).body;
    }
    EXPECT_GT(most, 1000u) << "too few contacts to be moved";
    for (const BodyId body : heap)
        scene.destroy(body);
    EXPECT_TRUE(scene.contacts().empty());
}
