// Contacts that move in memory: every list that names them must go along.

#include "support/test_scene.h"
#include "support/threads.h"

#include "dynamics/contact_store.h"
#include "dynamics/scene_data.h"
#include "dynamics/step_context.h"

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

// Balls side by side, of which each goes its own way.
Scene stirred_balls(const TaskHooks& tasks)
{
    constexpr int across = 600;
    constexpr int high = 100;
    SceneDef def = sleepless();
    def.tasks = tasks;
    Scene scene(def);
    add_static(scene, HalfSpace{}, {.friction = 0.6f});
    Random random(5);
    for (int i = 0; i < across * high; ++i)
    {
        const int row = i / across;
        add_dynamic(scene, {0.23 * (i % across) + 0.115 * (row % 2), 0.1 + 0.2 * row}, Circle{.radius = 0.1f}, {},
                    {random.rangef(-4, 4), random.rangef(-4, 4)});
    }
    return scene;
}

// Contacts, pairs and the list of awake contacts name each other.
void expect_contacts_are_listed_once(const internal::SceneState& state)
{
    ASSERT_EQ(state.awake_contacts.size(), static_cast<std::size_t>(state.contacts.count()));
    for (std::size_t i = 0; i < state.awake_contacts.size(); ++i)
    {
        const int index = state.awake_contacts[i];
        ASSERT_TRUE(state.contacts.is_live(index));
        const internal::Contact& contact = state.contacts[index];
        ASSERT_EQ(contact.awake_index, static_cast<std::int32_t>(i));
        const internal::BoxPair& pair = state.box_pairs[static_cast<std::size_t>(contact.pair)];
        ASSERT_EQ(pair.contact, index);
        ASSERT_EQ(std::minmax(pair.a, pair.b), std::minmax(contact.shape_a, contact.shape_b));
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

// Of many, what is made takes the slots of what goes.
TEST(DynamicsTidy, ManyContactsStayInTheOrderOfMemory)
{
    Threads three(3);
    Scene scene = stirred_balls({});
    Scene on_three = stirred_balls(three.hooks());
    const internal::SceneState& state = scene.data().state;
    std::size_t made = 0;
    std::size_t destroyed = 0;
    for (int i = 0; i < 10; ++i)
    {
        ASSERT_TRUE(i == 0 || state.awake_contacts.size() > internal::most_near_pairs);
        scene.step(1.0f / 60);
        on_three.step(1.0f / 60);
        ASSERT_EQ(on_three.state_hash(), scene.state_hash()) << "step " << i;
        expect_contacts_are_listed_once(state);
        if (HasFatalFailure())
            return;
        made += i > 1 ? scene.data().scratch.made_contacts.size() : 0;
        destroyed += i > 1 ? scene.data().scratch.destroyed_contacts.size() : 0;
    }
    expect_lists_agree(scene);
    EXPECT_GT(made, 10'000u);
    EXPECT_GT(destroyed, 10'000u);
    std::size_t backwards = 0;
    for (std::size_t i = 1; i < state.awake_contacts.size(); ++i)
        backwards += state.awake_contacts[i] < state.awake_contacts[i - 1] ? 1 : 0;
    EXPECT_LT(backwards, state.awake_contacts.size() / 100);
}
