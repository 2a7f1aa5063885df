#pragma once

/// @file
/// A Carom scene in the terms that every engine understands: the one translation that peers are fed by.

#include "carom/scene.h"
#include "truth/world.h"

#include <map>
#include <utility>
#include <vector>

namespace speed {

[[nodiscard]] inline truth::Vec widen(carom::Vec2 v) { return {v.x, v.y}; }
[[nodiscard]] inline truth::Vec widen(carom::Position p) { return {p.x, p.y}; }

/// A body and its shapes, ready to be made.
struct BodyPlan
{
    truth::BodyDef def{};
    std::vector<std::pair<truth::Shape, truth::Material>> shapes{};
    std::vector<std::pair<std::vector<truth::Vec>, truth::Material>> rings{};

    void make(truth::World& world) const;
};

/// Throws truth::Missing where a shape or its material has no counterpart.
[[nodiscard]] BodyPlan plan_body(const carom::ConstBody& body, const carom::Scene& scene);

/// Differences of a scene since it was looked at last.
struct Changes
{
    std::vector<truth::Body> gone{};
    std::vector<BodyPlan> bodies{};
    std::vector<truth::Hinge> hinges{};

    void make(truth::World& world) const;
};

/// Keeps the numbers that a scene's bodies have in a World.
class Translator
{
public:
    /// All that is new or gone since the last call; everything at the first.
    [[nodiscard]] Changes look(const carom::Scene& scene);
    [[nodiscard]] truth::Body number(carom::BodyId body) const { return body ? m_bodies.at(body) : truth::ground; }

private:
    void look_for_gone(const carom::Scene& scene, Changes& changes);

    std::map<carom::BodyId, truth::Body> m_bodies{};
    std::map<carom::JointId, bool> m_joints{};
    truth::Body m_next = 0;
};

} // namespace speed
