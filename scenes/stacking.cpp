#include "scenes/build.h"
#include "scenes/families.h"

namespace carom::scenes {
namespace {

BuiltScene box_stack(const SceneDef& base, int count)
{
    BuiltScene built{Scene(base)};
    add_floor(built.scene);
    for (int i = 0; i < count; ++i)
        add_dynamic(built.scene, {0, 0.5 + i}, box(0.5f, 0.5f));
    return built;
}

BuiltScene stack(const SceneDef& base) { return box_stack(base, 10); }

// A column of soft contacts buckles like a reed where n³ > 7.8 k w²/4 / (m g), with k = m (2 pi hertz)² for both points
// of a contact: at the default of 30 Hz from 20 boxes on, at 240 Hz from 77. Sub-steps must follow: a contact is no stiffer
// than a quarter of their rate.
BuiltScene tall_stack(const SceneDef& base)
{
    SceneDef def = base;
    def.contact_hertz = 240;
    def.substeps = 16;
    return box_stack(def, 50);
}

// Boxes of 1 m with gaps of 5 cm beside each other, so that neighbours in a row do not lean on each other.
BuiltScene box_pyramid(const SceneDef& base, int rows)
{
    BuiltScene built{Scene(base)};
    add_floor(built.scene);
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i)
            add_dynamic(built.scene, {1.05 * (i - 0.5 * (rows - row - 1)), 0.5 + row}, box(0.5f, 0.5f));
    return built;
}

BuiltScene small_pyramid(const SceneDef& base) { return box_pyramid(base, 5); }
BuiltScene pyramid(const SceneDef& base) { return box_pyramid(base, 20); }

constexpr SceneEntry entries[] = {
    {.name = "stack",
     .description = "Ten boxes on top of each other stand still and fall asleep.",
     .create = stack,
     .view = {{-8, -1}, {8, 11}}},
    {.name = "tall_stack",
     .description = "Fifty boxes: contacts must be stiff, or the column buckles like a reed.",
     .create = tall_stack,
     .view = {{-35, -2}, {35, 52}}},
    {.name = "small_pyramid", .description = "A pyramid of five rows.", .create = small_pyramid, .view = {{-6, -1}, {6, 6}}},
    {.name = "pyramid", .description = "A pyramid of twenty rows, 210 boxes.", .create = pyramid, .view = {{-17, -1}, {17, 21}}},
};

} // namespace

std::span<const SceneEntry> stacking_scenes() { return entries; }

} // namespace carom::scenes
