// Hinges by the thousands.

#include "scenes/benchmark.h"
#include "scenes/families.h"
#include "scenes/ragdoll.h"

#include <cmath>

namespace carom::scenes {
namespace {

/// A sheet of discs that do not touch each other, hung up at the middle of its upper edge.
BuiltScene joint_grid(const SceneDef& base)
{
    constexpr int count = 100;
    BuiltScene built{Scene(sleepless_def(base))};
    Scene& scene = built.scene;
    const ShapeDef disc{.filter = {.category = 2, .mask = ~std::uint32_t{2}}};
    std::vector<BodyId> bodies;
    for (int column = 0; column < count; ++column)
        for (int row = 0; row < count; ++row)
        {
            const bool held = row == 0 && std::abs(column - count / 2) <= 3;
            const BodyId body = scene.create_body({.type = held ? BodyType::Static : BodyType::Dynamic,
                                                   .position = {static_cast<double>(column), static_cast<double>(-row)}});
            scene.create_shape(body, Circle{.radius = 0.4f}, disc);
            if (row > 0)
                scene.create_joint(
                    RevoluteDef{.body_a = bodies.back(), .body_b = body, .anchor_a = {0, -0.5f}, .anchor_b = {0, 0.5f}});
            if (column > 0)
                scene.create_joint(RevoluteDef{
                    .body_a = bodies[bodies.size() - count], .body_b = body, .anchor_a = {0.5f, 0}, .anchor_b = {-0.5f, 0}});
            bodies.push_back(body);
        }
    return built;
}

/// Every eighth step of 1/60 s five figures appear above each of the five floors, in one of forty columns after the other; from the second
/// time round on those that fell there before go.
class Rain
{
public:
    static constexpr int floors = 5;
    static constexpr float floor_distance = 45;
    static constexpr float half_width = 125;

    void operator()(Scene& scene, float h)
    {
        const std::uint64_t interval = steps_in(8.0f / 60, h);
        if (scene.step_count() % interval != 0)
            return;
        const auto column = static_cast<int>(scene.step_count() / interval % columns);
        for (int floor = 0; floor < floors; ++floor)
        {
            Group& group = m_groups[static_cast<std::size_t>(floor * columns + column)];
            replace(scene, group, floor, column);
        }
    }

private:
    static constexpr int columns = 40;
    struct Group
    {
        std::array<Ragdoll, 5> figures{};
        bool there = false;
    };

    static void replace(Scene& scene, Group& group, int floor, int column)
    {
        Vec2 feet{half_width * (2 * static_cast<float>(column) + 1 - columns) / columns,
                  40 + floor_distance * static_cast<float>(floor)};
        if (group.there)
            for (const Ragdoll& figure : group.figures)
                destroy_ragdoll(scene, figure);
        group.there = true;
        int number = 1;
        for (Ragdoll& figure : group.figures)
        {
            figure = add_ragdoll(scene, feet, number++);
            feet.x += 0.5f;
        }
    }

    std::vector<Group> m_groups = std::vector<Group>(floors * columns);
};

BuiltScene rain(const SceneDef& base)
{
    constexpr float size = 0.5f;
    BuiltScene built{Scene(benchmark_def(base))};
    const BodyId ground = built.scene.create_body({});
    for (int floor = 0; floor < Rain::floors; ++floor)
        for (int i = 0; i <= 500; ++i)
            built.scene.create_shape(
                ground, box(size / 2, size / 2,
                            {size * static_cast<float>(i) - Rain::half_width, Rain::floor_distance * static_cast<float>(floor)}));
    built.before_step = Rain();
    return built;
}

constexpr SceneEntry entries[] = {
    {.name = "joint_grid",
     .description = "A sheet of ten thousand discs on 19,800 hinges swings.",
     .create = joint_grid,
     .frames = 500,
     .view = {{-60, -130}, {160, 10}}},
    {.name = "rain",
     .description = "A thousand figures of eleven bones rain on five floors.",
     .create = rain,
     .frames = 1000,
     .view = {{-130, -2}, {130, 225}}},
};

} // namespace

std::span<const SceneEntry> benchmark_joint_scenes() { return entries; }

} // namespace carom::scenes
