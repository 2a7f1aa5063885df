// Turns the crossings of leaves into enter and exit events of shapes.

#include "dynamics/sensors/crossings.h"

#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace carom::internal {

namespace {

// The leaves of a chain are crossed one after the other. The pair enters with the first leaf and exits with the last.
class CrossingReporter
{
public:
    explicit CrossingReporter(StepContext& ctx) : m_ctx(ctx), m_state(ctx.state) {}

    void run()
    {
        std::vector<Crossing>& all = m_ctx.scratch.sensors.crossings;
        // At the same time, enters come before exits: a visitor that changes from leaf to leaf stays inside.
        std::sort(all.begin(), all.end(),
                  [](const Crossing& x, const Crossing& y)
                  {
                      return std::tie(x.trigger, x.visitor, x.time, y.enters, x.order) <
                             std::tie(y.trigger, y.visitor, y.time, x.enters, y.order);
                  });
        for (std::size_t i = 0; i < all.size();)
        {
            std::size_t end = i + 1;
            while (end < all.size() && all[end].trigger == all[i].trigger && all[end].visitor == all[i].visitor)
                ++end;
            report_pair(std::span(all).subspan(i, end - i));
            i = end;
        }
    }

private:
    void report_pair(std::span<const Crossing> crossings)
    {
        int depth = leaves_inside(crossings[0]);
        for (const Crossing& c : crossings)
            depth -= c.enters ? 1 : -1; // the depth when the step began
        for (const Crossing& c : crossings)
        {
            const int before = depth;
            depth += c.enters ? 1 : -1;
            if (std::min(before, depth) == 0)
                report(c);
        }
    }

    // The number of leaf pairs that touch at the end of the step.
    [[nodiscard]] int leaves_inside(const Crossing& pair) const
    {
        // The body without the chain has the shorter list of contacts.
        const int body = m_state.shapes[m_state.shapes[pair.trigger].has_leaf ? pair.trigger : pair.visitor].body;
        int count = 0;
        for (const int index : contacts_of(m_state, body))
        {
            const Contact& contact = m_state.contacts[index];
            count += touches(contact) && m_state.shapes[contact.shape_a].owner == pair.trigger &&
                     m_state.shapes[contact.shape_b].owner == pair.visitor;
        }
        return count;
    }

    void report(const Crossing& c)
    {
        const float time = std::clamp(static_cast<float>(c.time), 0.0f, m_ctx.dt);
        (c.enters ? m_ctx.scene.events.enters : m_ctx.scene.events.exits)
            .push_back(event_between<TriggerEvent>(m_state, c.trigger, c.visitor, time));
    }

    StepContext& m_ctx;
    SceneState& m_state;
};

} // namespace

void report_crossings(StepContext& ctx) { CrossingReporter(ctx).run(); }

} // namespace carom::internal
