// Manifolds that are followed in a crowd must say what the narrow phase would say, were it asked.

#include "dynamics/narrowphase/manifold_cache.h"
#include "core/index.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/state/scene_data.h"
#include "support/test_scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

namespace {

Geometry piece(int i)
{
    switch (i % 5)
    {
    case 0: return Circle{.radius = 0.2f};
    case 1: return box(0.2f, 0.15f);
    case 2: return Capsule{{-0.2f, 0}, {0.2f, 0}, 0.12f, 0.12f};
    case 3: return Capsule{{-0.15f, 0}, {0.15f, 0}, 0.15f, 0.1f};
    default: return Polygon{.vertices = {{-0.2f, -0.15f}, {0.2f, -0.15f}, {0.25f, 0.05f}, {0, 0.2f}}, .radius = 0.03f};
    }
}

// A square room that turns, a third full.
void build(Scene& scene, float turn_rate = 0.6f)
{
    const BodyId room = scene.create_body({.type = BodyType::Kinematic, .angular_velocity = turn_rate});
    for (const Vec2 side : {Vec2{3.2f, 0}, Vec2{-3.2f, 0}})
        scene.create_shape(room, box(0.2f, 3.4f, side), {.friction = 0.5f});
    for (const Vec2 side : {Vec2{0, 3.2f}, Vec2{0, -3.2f}})
        scene.create_shape(room, box(3.4f, 0.2f, side), {.friction = 0.5f});
    for (int i = 0; i < 120; ++i)
        add_dynamic(scene, {-2.4 + 0.53 * (i % 10), -2.4 + 0.42 * (i / 10)}, piece(i), {.friction = 0.5f});
}

BodyPose pose_before(const SceneState& state, int body)
{
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    if (state.bodies[body].type == BodyType::Static)
        return {sim.center, sim.rotation, sim.local_center};
    return {sim.previous_center, sim.previous_rotation, sim.local_center};
}

struct Tally
{
    int edges = 0;
    int corners = 0;
    int apart = 0; ///< without a point
    int off = 0;   ///< something else would be found
};

// For a contact that is kept: whether the last step followed it or found it. Where it was not solved in a crowd, within the step it may have been found again.
void compare(const SceneState& state, int index, Tally& tally)
{
    const Contact& contact = state.contacts[index];
    if (!is_cached(contact) || !caches_manifold(state, contact))
        return;
    const BodyPose a = pose_before(state, contact.body_a);
    const BodyPose b = pose_before(state, contact.body_b);
    if (contact.manifold.count == 0)
    {
        ++tally.apart;
        ASSERT_EQ(world_manifold(state, contact, a, b, 0.0199f).count, 0) << "a point that was not told"; // all within 2 cm are
        return;
    }
    const Manifold m = settled_manifold(state, index);
    const float near = least_separation(m);
    const Manifold found = world_manifold(state, contact, a, b, std::max(near, 0.0f) + 0.03f);
    ++(caches_nearest(contact) ? tally.corners : tally.edges);
    ASSERT_GT(found.count, 0) << "a point that is not there, apart by " << near;
    // For two points, or for one that is deeper than its corner is round, another edge or corner may be a little better, and is not looked for as long as
    // bodies have moved little.
    const float off = std::fabs(least_separation(found) - near);
    const bool is_surely_best =
        m.count == 1 && (caches_nearest(contact) || near + state.cached_manifolds[as_index(index)].radius > 0);
    ASSERT_LE(off, is_surely_best ? 1e-4f : 0.02f) << "found at " << least_separation(found) << ", followed at " << near << ", "
                                                   << m.count << " points, nearest corners: " << caches_nearest(contact);
    tally.off += off > 1e-4f ? 1 : 0;
}

} // namespace

TEST(DynamicsFollowedManifolds, AreWhatWouldBeFound)
{
    Tally tally;
    for (const float turn_rate : {0.36f, 0.48f, 0.6f, 0.72f})
    {
        Scene scene(sleepless());
        build(scene, turn_rate);
        for (int i = 0; i < 400; ++i)
        {
            SCOPED_TRACE("step " + std::to_string(i) + " of the room that turns at " + std::to_string(turn_rate));
            scene.step(1.0f / 60);
            const SceneState& state = scene.data().state;
            for (const std::int32_t contact : state.awake_contacts)
            {
                compare(state, contact, tally);
                if (HasFatalFailure())
                    return;
            }
        }
    }
    EXPECT_GT(tally.corners, 1000);
    EXPECT_GT(tally.apart, 10000);
    EXPECT_GT(tally.edges, 10000);
    EXPECT_LT(tally.off, tally.edges / 50);
}

// A kernel says it of eight pairs at once, for itself: what it is sure of must be what the narrow phase, asked by itself, leaves as it is.
TEST(DynamicsFollowedManifolds, WithoutAPointAreToldEightAtATime)
{
    Scene scene(sleepless());
    build(scene);
    int sure = 0;
    int all = 0;
    for (int i = 0; i < 200; ++i)
    {
        SCOPED_TRACE("step " + std::to_string(i));
        scene.step(1.0f / 60);
        SceneData& data = scene.data();
        const StepContext ctx{data, data.state, data.scratch, data.report, 1.0f / 60, 1.0f / 240, 4};
        const SceneState before = data.state;
        std::vector<std::int32_t> apart;
        std::ranges::copy_if(before.awake_contacts, std::back_inserter(apart),
                             [&](std::int32_t contact)
                             {
                                 const Contact& c = before.contacts[contact];
                                 return c.manifold.count == 0 && is_updated_with_others(before, c);
                             });
        for (std::size_t first = 0; first + lane_count <= apart.size(); first += lane_count)
        {
            LaneInts eight;
            std::copy_n(apart.begin() + static_cast<std::ptrdiff_t>(first), lane_count, std::begin(eight.v));
            const std::uint32_t stay = wide_kernels().stay_apart(eight, followed_scene(ctx));
            for (const WideKernels* kernels : all_wide_kernels())
                ASSERT_EQ(kernels->stay_apart(eight, followed_scene(ctx)), stay) << kernels->name;
            for (int k = 0; k < lane_count; ++k)
            {
                ++all;
                if ((stay >> k & 1u) == 0)
                    continue;
                ++sure;
                const auto slot = static_cast<std::size_t>(eight.v[k]);
                follow_manifold(ctx, eight.v[k]);
                ASSERT_EQ(data.state.contacts[eight.v[k]].manifold.count, 0);
                ASSERT_EQ(data.state.cached_manifolds[slot].reach, before.cached_manifolds[slot].reach) << "found anew";
                ASSERT_EQ(data.state.cached_manifolds[slot].center, before.cached_manifolds[slot].center) << "found anew";
            }
        }
        data.state = before;
    }
    EXPECT_GT(sure, 9 * all / 10);
    EXPECT_GT(all, 10000);
}
