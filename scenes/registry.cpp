#include "scenes/families.h"

#include <algorithm>
#include <vector>

namespace carom::scenes {

std::span<const SceneEntry> all_scenes()
{
    static const std::vector<SceneEntry> all = []
    {
        std::vector<SceneEntry> list;
        for (const auto family : {stacking_scenes(), joint_scenes(), surface_scenes(), motion_scenes(), pile_scenes()})
            list.insert(list.end(), family.begin(), family.end());
        return list;
    }();
    return all;
}

const SceneEntry* find_scene(std::string_view name)
{
    const auto all = all_scenes();
    const auto found = std::ranges::find(all, name, &SceneEntry::name);
    return found == all.end() ? nullptr : &*found;
}

} // namespace carom::scenes
