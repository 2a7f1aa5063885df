// Stepping a scene that has come to rest takes no memory, whatever lies on what.

#include "support/test_scene.h"
#include "support/threads.h"

#include <cstdlib>
#include <new>

using namespace carom;
using namespace carom::test;

namespace {

long allocations = 0;

void* allocate(std::size_t size, std::size_t alignment)
{
    ++allocations;
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

constexpr std::size_t usual = alignof(std::max_align_t);

} // namespace

// All of the program's, arrays too; those that do not throw are what std::stable_sort asks for its buffer. Not inlined: g++ would take free() for a
// mistake there.
void* operator new(std::size_t size) { return allocate(size, usual); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, usual); }
void* operator new(std::size_t size, std::align_val_t alignment) { return allocate(size, static_cast<std::size_t>(alignment)); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace {

SceneDef awake(TaskHooks tasks)
{
    SceneDef def = sleepless();
    def.tasks = tasks;
    return def;
}

// In the second half of so many steps.
long allocations_late(Scene& scene, int steps)
{
    long before = 0;
    for (int i = 0; i < steps; ++i)
    {
        if (i == steps / 2)
            before = allocations;
        scene.step(1.0f / 60);
    }
    return allocations - before;
}

const Geometry ground = box(100, 0.5f, {0, -0.5f});

// Stacks of three on a body of that type that does not move, all awake.
long allocations_at_rest(BodyType floor, int stacks)
{
    Scene scene(sleepless());
    add(scene, {.type = floor}, ground);
    for (int i = 0; i < stacks; ++i)
        for (int k = 0; k < 3; ++k)
            add_dynamic(scene, {2.5 * i - 90, 0.5 + k}, box(0.5f, 0.5f));
    return allocations_late(scene, 600);
}

// One island of so many contacts that it is solved in lanes and by parts of the plane.
long allocations_in_pyramid(TaskHooks tasks, int rows)
{
    Scene scene(awake(tasks));
    add_static(scene, ground);
    for (int row = 0; row < rows; ++row)
        for (int i = row; i < rows; ++i)
            add_dynamic(scene, {i - 0.5 * (row + rows), 0.5 + row}, box(0.5f, 0.5f));
    const long late = allocations_late(scene, 400);
    EXPECT_GT(scene.report().touching, 4'096);
    return late;
}

// Hinges in lanes, their contacts filtered away: a net that hangs from its corners, and has swung out.
long allocations_in_net(TaskHooks tasks, int size)
{
    Scene scene(awake(tasks));
    std::vector<BodyId> bodies;
    for (int i = 0; i < size * size; ++i)
    {
        const bool held = i == 0 || i == size - 1;
        const BodyDef body{.type = held ? BodyType::Static : BodyType::Dynamic,
                           .position = {i % size * 1.0, i / size * -1.0},
                           .linear_damping = 2};
        bodies.push_back(add(scene, body, Circle{.radius = 0.3f}, {.filter = {.group = -1}}).body);
    }
    const auto hinge = [&](int a, int b, Vec2 to)
    {
        scene.create_joint(RevoluteDef{.body_a = bodies[static_cast<std::size_t>(a)],
                                       .body_b = bodies[static_cast<std::size_t>(b)],
                                       .anchor_a = 0.5f * to,
                                       .anchor_b = -0.5f * to});
    };
    for (int i = 0; i < size * size; ++i)
    {
        if (i % size + 1 < size)
            hinge(i, i + 1, {1, 0});
        if (i + size < size * size)
            hinge(i, i + size, {0, -1});
    }
    return allocations_late(scene, 1000);
}

constexpr TaskHooks many_tasks{.worker_count = 8, .run = run_backwards};

} // namespace

TEST(Allocations, NoneInSmallIslandsAtRest)
{
    EXPECT_EQ(allocations_at_rest(BodyType::Static, 40), 0);
    EXPECT_EQ(allocations_at_rest(BodyType::Kinematic, 40), 0);
}

TEST(Allocations, NoneInALargeIslandAtRest)
{
    EXPECT_EQ(allocations_in_pyramid({}, 60), 0);
    EXPECT_EQ(allocations_in_pyramid(many_tasks, 60), 0);
}

TEST(Allocations, NoneInManyHingesAtRest)
{
    EXPECT_EQ(allocations_in_net({}, 24), 0);
    EXPECT_EQ(allocations_in_net(many_tasks, 24), 0);
}
