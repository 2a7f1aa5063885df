// Asking the scene: rays, shapes on their way, boxes, points, the nearest surface, and filters. Queries are const and do not disturb a simulation.
#include <carom/carom.h>
#include <cstdio>

namespace {

constexpr std::uint64_t walls = 1;
constexpr std::uint64_t crates = 2;

const char* name(const carom::Scene& scene, carom::ShapeId shape)
{
    return scene.shape(shape).def().filter.category == walls ? "wall" : "crate";
}

} // namespace

int main()
{
    carom::Scene scene;
    const carom::BodyId room = scene.create_body({});
    scene.create_shape(room, carom::Segment{.a = {5, -5}, .b = {5, 5}}, {.filter = {.category = walls}});
    scene.create_shape(room, carom::Arc{.center = {0, 0}, .radius = 4, .start_angle = 2, .sweep = 2},
                       {.filter = {.category = walls}});
    for (int i = 0; i < 3; ++i)
    {
        const carom::BodyId crate = scene.create_body({.position = {1.0 + i, 0}, .angle = 0.3f * static_cast<float>(i)});
        scene.create_shape(crate, carom::box(0.3f, 0.3f), {.filter = {.category = crates}});
    }

    int hits = 0;
    for (const carom::RayHit& hit : scene.raycast_all({0, 0}, {10, 0}))
    {
        std::printf("ray meets a %s at x = %.2f\n", name(scene, hit.shape), hit.point.x);
        ++hits;
    }
    const auto wall = scene.raycast_closest({0, 0}, {10, 0}, {.mask = walls});
    if (wall)
        std::printf("the nearest wall is %.2f m away\n", 10 * static_cast<double>(wall->fraction));

    // A box that turns by a quarter on its way; the filter asks about each shape.
    const auto only_walls = [&](carom::ShapeId shape) { return scene.shape(shape).def().filter.category == walls; };
    const auto cast = scene.shapecast_closest(carom::box(0.5f, 0.2f), {.translation = {10, 0}, .turn = 0.5f * carom::pi},
                                              {.accepts = only_walls});
    if (cast)
        std::printf("a box that turns gets %.2f m far\n", 10 * static_cast<double>(cast->fraction));

    const auto inside = scene.overlap_box({{0, -1}, {2.5, 1}}, {.mask = crates});
    std::printf("%zu crates in the box\n", inside.size());

    const auto near = scene.closest_point({-3, 0}, 2);
    if (near)
        std::printf("nearest surface: a %s, %.2f m away\n", name(scene, near->shape), static_cast<double>(near->distance));

    return hits == 4 && wall && cast && inside.size() == 2 && near ? 0 : 1;
}
