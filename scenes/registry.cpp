#include "scenes/families.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace carom::scenes {

namespace {

using Family = std::span<const SceneEntry>;

struct Registry
{
    std::vector<SceneEntry> all{};
    std::size_t small = 0;

    void add(std::initializer_list<Family> families)
    {
        for (const Family family : families)
            all.insert(all.end(), family.begin(), family.end());
    }
};

const Registry& registry()
{
    static const Registry whole = []
    {
        Registry made;
        made.add({stacking_scenes(), joint_scenes(), surface_scenes(), motion_scenes(), pile_scenes()});
        made.small = made.all.size();
        made.add({benchmark_pile_scenes(), benchmark_joint_scenes(), benchmark_drum_scenes()});
        std::sort(made.all.begin() + static_cast<std::ptrdiff_t>(made.small), made.all.end(),
                  [](const SceneEntry& a, const SceneEntry& b) { return a.name < b.name; });
        return made;
    }();
    return whole;
}

} // namespace

std::span<const SceneEntry> all_scenes() { return registry().all; }
std::span<const SceneEntry> small_scenes() { return all_scenes().first(registry().small); }
std::span<const SceneEntry> benchmark_scenes() { return all_scenes().subspan(registry().small); }

const SceneEntry* find_scene(std::string_view name)
{
    const auto all = all_scenes();
    const auto found = std::ranges::find(all, name, &SceneEntry::name);
    return found == all.end() ? nullptr : &*found;
}

} // namespace carom::scenes
