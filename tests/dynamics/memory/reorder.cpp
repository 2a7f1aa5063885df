// Contacts that move in memory: every list that names them must go along.

#include "support/effort.h"
#include "support/test_scene.h"
#include "support/threads.h"

#include "dynamics/state/contact_store.h"
#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

using namespace carom;
using namespace carom::test;

namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>; // slots of the shapes

Pair pair_of(const ContactInfo& c) { return std::minmax(c.shape_a.slot, c.shape_b.slot); }

// The bodies together list what the scene lists, no more and no less.
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

// Side by side in rows of 600 from a height on, each on its own way beside the common one.
void add_balls(Scene& scene, double height, int rows, Vec2 velocity)
{
    constexpr int across = 600;
    Random random(5);
    for (int i = 0; i < across * rows; ++i)
    {
        const int row = i / across;
        add_dynamic(scene, {0.23 * (i % across) + 0.115 * (row % 2), height + 0.2 * row}, Circle{.radius = 0.1f}, {},
                    velocity + Vec2{random.rangef(-4, 4), random.rangef(-4, 4)});
    }
}

Scene stirred_balls(const TaskHooks& tasks)
{
    SceneDef def = sleepless();
    def.tasks = tasks;
    Scene scene(def);
    add_static(scene, HalfSpace{}, {.friction = 0.6f});
    add_balls(scene, 0.1, 100, {});
    return scene;
}

// Contacts, pairs, bodies and the list of awake contacts name each other.
void expect_contacts_are_listed_once(const internal::SceneState& state)
{
    const auto count = static_cast<std::size_t>(state.contacts.count());
    ASSERT_EQ(state.awake_contacts.size(), count);
    for (std::size_t i = 0; i < count; ++i)
    {
        const int index = state.awake_contacts[i];
        ASSERT_TRUE(state.contacts.is_live(index));
        const internal::Contact& contact = state.contacts[index];
        ASSERT_EQ(contact.awake_index, static_cast<std::int32_t>(i));
        ASSERT_NE(contact.pair, internal::none);
        const internal::BoxPair& pair = state.box_pairs[static_cast<std::size_t>(contact.pair)];
        ASSERT_EQ(pair.contact, index);
        ASSERT_EQ(std::minmax(pair.a, pair.b), std::minmax(contact.shape_a, contact.shape_b));
    }
    const auto has_contact = [](const internal::BoxPair& pair) { return pair.contact != internal::none; };
    ASSERT_EQ(static_cast<std::size_t>(std::ranges::count_if(state.box_pairs, has_contact)), count);
    std::size_t edges = 0;
    for (int body = 0; body < state.bodies.capacity(); ++body)
    {
        for (int edge = state.bodies.is_live(body) ? state.bodies[body].first_contact : internal::none; edge != internal::none;
             edge = state.contacts[edge >> 1].next[edge & 1])
        {
            ASSERT_TRUE(state.contacts.is_live(edge >> 1));
            ++edges;
        }
    }
    ASSERT_EQ(edges, 2 * count);
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

// New bodies take the slots of those that go. Both are more by turns: balls fly apart, and others come.
TEST(DynamicsTidy, ManyContactsStayInTheOrderOfMemory)
{
    Threads three(3);
    std::vector<Scene> scenes;
    scenes.push_back(stirred_balls({}));
    scenes.push_back(stirred_balls(three.hooks()));
    const internal::SceneState& state = scenes[0].data().state;
    const internal::Scratch& scratch = scenes[0].data().scratch;
    const auto step_both = [&]
    {
        for (Scene& scene : scenes)
            scene.step(1.0f / 60);
        ASSERT_EQ(scenes[1].state_hash(), scenes[0].state_hash());
        expect_contacts_are_listed_once(state);
    };
    ASSERT_NO_FATAL_FAILURE(step_both()) << "all are made at once";
    int more_made = 0;
    int more_destroyed = 0;
    for (int i = 0; i < (does_whole_tests() ? 8 : 4); ++i)
    {
        if (i % 4 == 3)
        {
            for (Scene& scene : scenes)
                add_balls(scene, 20.5 + 4 * i, 40, {0, -10});
        }
        ASSERT_GT(state.awake_contacts.size(), internal::most_near_pairs);
        ASSERT_NO_FATAL_FAILURE(step_both()) << "step " << i;
        const bool more = scratch.broad.made_contacts.size() > scratch.broad.destroyed_contacts.size();
        ++(more ? more_made : more_destroyed);
        EXPECT_GT(std::min(scratch.broad.made_contacts.size(), scratch.broad.destroyed_contacts.size()), 100u);
    }
    EXPECT_GT(more_made, 0);
    EXPECT_GT(more_destroyed, 0);
    std::size_t backwards = 0;
    for (std::size_t i = 1; i < state.awake_contacts.size(); ++i)
        backwards += state.awake_contacts[i] < state.awake_contacts[i - 1] ? 1 : 0;
    EXPECT_LT(backwards, state.awake_contacts.size() / 30) << "an eighth of them where the last replaces what goes";
    for (Scene& scene : scenes)
    {
        const std::vector<BodyId> bodies = scene.bodies();
        for (std::size_t i = 2; i < bodies.size(); i += 2)
            scene.destroy(bodies[i]);
    }
    ASSERT_NO_FATAL_FAILURE(step_both()) << "half of them";
    EXPECT_LT(state.awake_contacts.size(), internal::most_near_pairs);
    ASSERT_NO_FATAL_FAILURE(step_both()) << "half of them";
}
