#pragma once

/// @file
/// One impact, written out for a reader with school physics: how heavy each party feels where it is hit, how fast the two
/// approach, and how the blow follows from that:
///     j = (1+e)·m₁·m₂/(m₁+m₂)·(v₁−v₂)    with point masses    m = 1 / (1/m + r²/I)

#include "carom/event.h"
#include "carom/scene.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom::view {

/// The data of one party, kept so that the story can be told after the body is gone.
struct ImpactParty
{
    std::string name;
    BodyType type = BodyType::Static;
    float mass = 0;    ///< kg
    float inertia = 0; ///< kg m²
    bool held = false; ///< cannot shift, only turn (a flipper on its pivot)
    bool jointed = false;
    float pivot_inertia = 0; ///< about the one hinge that it hangs on, kg m²; 0: it hangs on none, or on more than that
    float pivot_arm = 0;     ///< how far beside that hinge the line of the blow passes, m
};

struct ImpactRecord
{
    ImpactEvent event{};
    ImpactParty a{};
    ImpactParty b{};
    double time = 0; ///< of the scene, s, at the end of the step
};

/// Names a shape for the reader ("ball", "left flipper").
using ShapeNamer = std::function<std::string(const Scene&, ShapeId)>;

/// Names by what they are and, where they can be pushed, by which: "ball 12", "box 3", "floor".
[[nodiscard]] std::string kind_name(const Scene& scene, ShapeId shape);

/// Call right after the step in which the event happened.
[[nodiscard]] ImpactRecord record_impact(const Scene& scene, const ImpactEvent& event, const ShapeNamer& namer = {});

/// The impulse by the formula, from the terms in the record (kick included), N s.
[[nodiscard]] float impulse_by_formula(const ImpactRecord& record);

/// How far beside the centre the line of the blow passes, m, as the effective mass tells; 0 where the party is fixed.
[[nodiscard]] float lever_arm(const ImpactParty& party, float effective_mass);

struct StoryLine
{
    enum class Kind
    {
        Title,
        Step, ///< a question that the next lines answer
        Text,
        Formula,
        Result,
    };
    Kind kind = Kind::Text;
    std::string text;
};

[[nodiscard]] std::vector<StoryLine> impact_story(const ImpactRecord& record);

/// Three significant digits with a real minus sign: 0.0337, −1.50, 12.0, 3.2·10⁻⁶.
[[nodiscard]] std::string number(float value);

/// Remembers the strongest impact of late: a weaker one takes its place only after hold_s of scene time.
class ImpactWatch
{
public:
    explicit ImpactWatch(ShapeNamer namer = {}, double hold_s = 0.25) : m_namer(std::move(namer)), m_hold(hold_s) {}
    /// Call after every step.
    void observe(const Scene& scene);
    void clear() { m_last.reset(); }
    [[nodiscard]] const std::optional<ImpactRecord>& last() const { return m_last; }

private:
    ShapeNamer m_namer;
    double m_hold;
    std::optional<ImpactRecord> m_last;
};

} // namespace carom::view
