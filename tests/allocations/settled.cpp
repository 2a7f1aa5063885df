// Stepping a scene that has come to rest takes no memory, whatever lies on what.

#include "support/test_scene.h"

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

// Stacks of three on a body of that type that does not move, all awake.
long allocations_at_rest(BodyType floor, int stacks)
{
    Scene scene(sleepless());
    scene.create_shape(scene.create_body({.type = floor}), box(100, 0.5f, {0, -0.5f}));
    for (int i = 0; i < stacks; ++i)
        for (int k = 0; k < 3; ++k)
            add_dynamic(scene, {2.5 * i - 90, 0.5 + k}, box(0.5f, 0.5f));
    for (int i = 0; i < 300; ++i)
        scene.step(1.0f / 60);
    const long before = allocations;
    for (int i = 0; i < 100; ++i)
        scene.step(1.0f / 60);
    return allocations - before;
}

} // namespace

TEST(Allocations, NoneInSmallUnitsAtRest)
{
    EXPECT_EQ(allocations_at_rest(BodyType::Static, 40), 0);
    EXPECT_EQ(allocations_at_rest(BodyType::Kinematic, 40), 0);
}
