#pragma once

/// @file
/// The cabinet on its legs and the bob that tells when it was shaken too hard. A nudge is a hand's push of some hundredths of a
/// second; the cabinet swings on its legs, in either direction as a damped spring. What lies on the table is not pushed: seen from the
/// table it feels the opposite of the cabinet's acceleration, and strikes walls that have come nearer.

#include "pinball/elements/hash.h"
#include "pinball/table/table.h"

#include <vector>

namespace carom::pinball {

/// A pendulum that hangs in a ring. Seen from the cabinet.
class TiltBob
{
public:
    explicit TiltBob(const CabinetDef& def);

    /// Moves on while the cabinet accelerates; true when the bob touches the ring that it had left.
    bool step(Vec2 cabinet_acceleration, float h);
    /// The bob's way off the middle, m.
    [[nodiscard]] Vec2 offset() const { return m_offset; }
    /// The ring's radius, m: the offset at which the bob touches it.
    [[nodiscard]] float ring() const { return m_ring; }
    /// Whether it hardly swings any more.
    [[nodiscard]] bool is_still() const;
    void rest();
    void add_to(Hash& hash) const;

private:
    float m_ring;
    float m_stiffness; ///< 1/s²
    Vec2 m_offset{};
    Vec2 m_velocity{};
    bool m_is_near = false; ///< has touched the ring and not yet swung back from it
};

class Cabinet
{
public:
    explicit Cabinet(const CabinetDef& def);

    /// A hand pushes this way (unit length), from a time within the next step on, s. False where the hand is not yet back from its last push.
    bool push(Vec2 direction, double time);
    /// Moves on by one step; true when the bob touched its ring.
    bool step(float h);

    /// Mean over the last step, m/s².
    [[nodiscard]] Vec2 acceleration() const { return m_acceleration; }
    /// How far it stands from where it stands at rest, m.
    [[nodiscard]] Vec2 offset() const { return m_offset; }
    [[nodiscard]] const TiltBob& bob() const { return m_bob; }
    void add_to(Hash& hash) const;

private:
    struct Push
    {
        Vec2 direction{};
        double age = 0; ///< s; negative before it begins
    };
    [[nodiscard]] Vec2 force_at(double time) const;
    [[nodiscard]] Vec2 acceleration_at(double time) const;
    void come_to_rest();

    CabinetDef m_def;
    TiltBob m_bob;
    std::vector<Push> m_pushes{};
    Vec2 m_offset{};
    Vec2 m_velocity{};
    Vec2 m_acceleration{};
};

} // namespace carom::pinball
