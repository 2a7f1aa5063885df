#pragma once

/// @file
/// A scene by its name, in one line, and what tests ask of it.

#include "scenes/scenes.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace carom::scenes {

class SceneRun
{
public:
    explicit SceneRun(std::string_view name, const SceneDef& base = {}) : m_entry(find(name)), m_built(m_entry.create(base)) {}

    Scene& scene() { return m_built.scene; }
    [[nodiscard]] float h() const { return m_entry.h; }

    void steps(int count)
    {
        for (int i = 0; i < count; ++i)
            m_built.step(m_entry.h);
    }
    void seconds(double time) { steps(static_cast<int>(time / static_cast<double>(m_entry.h) + 0.5)); }

    [[nodiscard]] std::vector<BodyId> bodies_of(BodyType type)
    {
        std::vector<BodyId> found;
        for (const BodyId id : scene().bodies())
            if (scene().body(id).type() == type)
                found.push_back(id);
        return found;
    }
    [[nodiscard]] std::vector<BodyId> dynamic() { return bodies_of(BodyType::Dynamic); }
    [[nodiscard]] int awake()
    {
        int count = 0;
        for (const BodyId id : dynamic())
            count += scene().body(id).is_awake();
        return count;
    }

private:
    static const SceneEntry& find(std::string_view name)
    {
        const SceneEntry* entry = find_scene(name);
        if (entry == nullptr)
            throw std::runtime_error("no scene named " + std::string(name));
        return *entry;
    }

    const SceneEntry& m_entry;
    BuiltScene m_built;
};

} // namespace carom::scenes
