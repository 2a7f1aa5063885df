// Search for the next event of a flier, by the time of impact with each candidate.

#include "dynamics/continuous/next_impact.h"

#include "dynamics/broadphase/half_space_box.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/narrowphase/flush_pair.h"
#include "dynamics/narrowphase/material.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "geometry/leaf_traits.h"
#include "geometry/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

// Looks per search; a body that turns by thousands of radians in a sub-step needs them. Candidates left then are not met in this sub-step.
constexpr std::int64_t most_looks = 50'000;

// Corners of a pair that rest already. The other corners may still come down: held at one corner, a body turns about it.
ProbeSet resting_corners(std::span<const RestingContact> holds, std::int32_t own, std::int32_t other)
{
    ProbeSet resting;
    for (const RestingContact& h : holds)
    {
        if (h.own != own || h.other != other)
            continue;
        resting.of_a |= h.other_corners;
        resting.of_b |= h.own_corners;
    }
    return resting;
}

// Candidates are considered in the order in which they could be met: after the first hit most of a crowd is too late.
class Search
{
public:
    Search(const FlightSpan& span, Flier& f) : m_span(span), m_flier(f), m_origin(span.sim_of(f.body).center) {}

    void run()
    {
        consider_limits();
        for (const int index : contacts_of(m_span.state, m_flier.body))
            offer_contact(index);
        if (m_flier.is_deflected())
            look_beyond_boxes();
        look_at_deflected();
        consider_offers();
    }

    void run_for_contact(int index)
    {
        offer_contact(index);
        consider_offers();
    }

private:
    struct Sweep
    {
        FramePath path;
        Reach reach;
    };

    struct Offer
    {
        double time; ///< the two cannot meet before
        int order;
        int own;
        int shape;
        int contact;
    };

    static constexpr std::size_t most_offers = 64; // more than these are considered in batches
    static constexpr int offers_of_a_look = 8;     // an offer costs an eighth of a look

    // Computed on demand: most fliers of a crowd do not need it.
    [[nodiscard]] const Sweep& own_displacement()
    {
        if (!m_own)
            m_own = Sweep{path_from(m_span, m_flier.body, m_flier.time, m_origin), reach_of(m_span, m_flier.body)};
        return *m_own;
    }

    void offer_contact(int index)
    {
        const Contact& contact = m_span.state.contacts[index];
        if ((contact.flags & (contact_flag::trigger | contact_flag::passing)) != 0)
            return;
        const bool is_a = contact.body_a == m_flier.body;
        const int body = is_a ? contact.body_b : contact.body_a;
        if (!was_found_apart(index, body))
            offer(is_a ? contact.shape_a : contact.shape_b, is_a ? contact.shape_b : contact.shape_a, index, meeting_with(body));
    }

    void offer(int own, int shape, int contact, double time)
    {
        ++m_made;
        if (time > m_span.h || time >= m_flier.event_time || is_wall_out_of_reach(shape))
            return;
        if (m_count == most_offers)
            consider_offers();
        m_offers[m_count++] = {time, m_made, own, shape, contact};
    }

    void consider_offers()
    {
        const auto is_later = [](const Offer& a, const Offer& b)
        { return a.time != b.time ? a.time > b.time : a.order > b.order; };
        const auto end = [&] { return m_offers.begin() + static_cast<std::ptrdiff_t>(m_count); };
        std::make_heap(m_offers.begin(), end(), is_later);
        for (; m_count > 0 && m_offers.front().time < m_flier.event_time; --m_count)
        {
            std::pop_heap(m_offers.begin(), end(), is_later);
            consider(m_offers[m_count - 1]);
        }
        m_count = 0;
        m_flier.looks += std::exchange(m_made, 0) / offers_of_a_look;
    }

    // Time before which the bodies cannot meet. Only dynamic bodies that are awake in this island have a known path.
    [[nodiscard]] double meeting_with(int body)
    {
        return m_span.state_in_island(body) == none ? 0 : first_meeting(own_displacement().reach, reach_of(m_span, body));
    }

    // The angle reaches a limit of the hinge: the first root of angle + w t + alpha t²/2.
    void consider_limits()
    {
        if (m_flier.joint == none || m_flier.constrained)
            return;
        consider_limit(m_flier.upper - m_flier.angle, m_flier.w, m_flier.alpha);
        consider_limit(m_flier.angle - m_flier.lower, -m_flier.w, -m_flier.alpha);
    }

    // The room d >= 0 shrinks at speed u and acceleration a.
    void consider_limit(double d, double u, double a)
    {
        if (d > 1e200)
            return;
        d = std::max(d, 0.0);
        const double tiny = m_span.least_approach;
        if (d == 0 && u <= tiny && a <= 0)
            return;
        double t = 0;
        if (d > 0 || u <= tiny)
        {
            const double discriminant = u * u + 2 * a * d;
            if (discriminant < 0)
                return;
            const double root = std::sqrt(discriminant);
            // A body that leaves the limit returns later; the least wait is that of contacts.
            t = u + root > 0 ? 2 * d / (u + root) : 1e300;
            if (d == 0)
                t = a > 0 ? std::max(2 * (tiny - u) / a, 1e-6 * m_span.h) : 1e300;
        }
        if (m_flier.time + t >= m_flier.event_time || m_flier.time + t > m_span.h)
            return;
        m_flier.event_time = m_flier.time + t;
        m_flier.event_own = none;
        m_flier.event_shape = none;
        m_flier.event_state = none;
        m_flier.event_version = 0;
    }

    // An impact or a kick leads a body away from the contacts that were made for this step.
    void look_beyond_boxes()
    {
        Flier end = m_flier;
        advance(m_span, end, m_span.h);
        const CenterMotion from = center_of(m_flier);
        const CenterMotion to = center_of(end);
        const double r = m_span.sim_of(m_flier.body).extent;
        const FloatBox path = round_outwards(m_origin.x + std::min(from.x, to.x) - r, m_origin.y + std::min(from.y, to.y) - r,
                                             m_origin.x + std::max(from.x, to.x) + r, m_origin.y + std::max(from.y, to.y) + r);
        for_each_leaf(m_span.state, m_flier.body, [&](int own) { look_beyond_box(own, path); });
    }

    // A deflected body may be anywhere, whether it still flies or has come to rest.
    void look_at_deflected()
    {
        if (m_span.output.deflected.empty())
            return;
        const int near = m_span.output.deflected.for_each_near(
            own_displacement().reach,
            [&](std::int32_t flier)
            {
                const double time = first_meeting(own_displacement().reach, reach_in_list(m_span, flier));
                const int body = m_span.scratch.flight.fliers[static_cast<std::size_t>(flier)].body;
                if (time <= m_span.h && time < m_flier.event_time && body != m_flier.body)
                    offer_all(body, time);
            });
        m_made += near;
    }

    void offer_all(int body, double time)
    {
        const SceneState& state = m_span.state;
        for_each_leaf(state, m_flier.body,
                      [&](int own) { for_each_leaf(state, body, [&](int shape) { offer(own, shape, none, time); }); });
    }

    void look_beyond_box(int own, const FloatBox& path)
    {
        const SceneState& state = m_span.state;
        if (state.shapes[own].trigger)
            return;
        const auto visit = [&](int shape)
        {
            if (state.shapes[shape].body != m_flier.body)
                offer(own, shape, none, meeting_with(state.shapes[shape].body));
            return true;
        };
        state.broad_phase.query(Layer::Moving, path, visit);
        state.broad_phase.query(Layer::Resting, path, visit);
        for (const std::int32_t half_space : state.broad_phase.unbounded())
        {
            if (reaches_half_space(state, half_space, path, 0))
                visit(half_space);
        }
    }

    // True for two shapes that may touch and have no contact.
    [[nodiscard]] bool is_new(int own, int shape) const
    {
        const SceneState& state = m_span.state;
        return !state.shapes[own].trigger && !state.shapes[shape].trigger && !has_contact(state, own, shape) &&
               may_collide(state, own, shape);
    }

    void consider(const Offer& offer)
    {
        const auto [time, order, own, shape, contact] = offer;
        SceneState& state = m_span.state;
        const int body = state.shapes[shape].body;
        const Flier* other = m_span.flier_at(m_span.state_in_island(body));
        if (m_flier.looks > most_looks)
        {
            m_flier.needs_wall_check = true; // its path is checked against walls
            return;
        }
        // Before its last change the other body had another path; until then the two have not met.
        const double start = other != nullptr ? std::max(m_flier.time, other->time) : m_flier.time;
        const double left = std::min(m_span.h, m_flier.event_time) - start;
        if (left < 0)
            return;
        const FramePath target = path_from(m_span, body, start, m_origin);
        const FramePath own_path =
            start > m_flier.time ? path_after(own_displacement().path, start - m_flier.time) : own_displacement().path;
        const LeafView a = leaf_view(state, shape);
        const LeafView b = leaf_view(state, own);
        ++m_flier.looks;
        const Axis line = line_of_centers(target, own_path);
        const Axis normal = normal_at_start(shape, contact);
        if (stays_apart_along(line, a, target, b, own_path, left) || stays_apart_along(normal, a, target, b, own_path, left))
            return;
        if (contact == none && !is_new(own, shape))
            return;
        const auto find = [&](const Flush& flush)
        {
            return first_touch(a, target, b, own_path, left, m_span.least_approach,
                               state.bodies[body].type == BodyType::Dynamic ? m_span.press(body, m_flier.body) : MicroCollision{},
                               resting_corners(m_span.resting_contacts_of(m_flier), own, shape), normal.is_none() ? line : normal,
                               flush, &m_flier.looks);
        };
        std::optional<Touch> hit = find({});
        if (hit)
        {
            if (const FlushPair flush(state, shape, own); !flush.is_empty())
            {
                const std::int64_t before = m_flier.looks;
                hit = find(flush.flush());
                m_flier.union_looks += m_flier.looks - before;
            }
        }
        if (!hit || start + hit->time >= m_flier.event_time)
            return;
        // Materials see the flier as b: the normal runs from the shape to the flier.
        if (lets_pass(m_span.ctx.scene, shape, own, {static_cast<float>(hit->nx), static_cast<float>(hit->ny)}))
        {
            m_flier.passes = contact;
            return;
        }
        m_flier.event_time = start + hit->time;
        m_flier.event_own = own;
        m_flier.event_shape = shape;
        m_flier.event_state = m_span.state_in_island(body);
        m_flier.event_version = version_of(m_span, m_flier.event_state);
    }

    // True if the two do not meet within the step on their initial paths.
    [[nodiscard]] bool was_found_apart(int contact, int body) const
    {
        if (m_flier.is_deflected())
            return false;
        const Flier* other = m_span.flier_at(m_span.state_in_island(body));
        if (m_span.state.bodies[body].type == BodyType::Dynamic && (other == nullptr || other->is_deflected()))
            return false;
        return stays_apart(m_span.ctx, m_span.state.contacts[contact]);
    }

    // A look at every corner is expensive: most pairs are excluded by the line of their centers, or by the normal at the start of the step.
    [[nodiscard]] static bool stays_apart_along(Axis axis, const LeafView& a, const FramePath& path_a, const LeafView& b,
                                                const FramePath& path_b, double left)
    {
        return !axis.is_none() && stay_apart(a, path_a, b, path_b, axis, left);
    }

    // The normal runs from the shape to the flier.
    [[nodiscard]] Axis normal_at_start(int shape, int contact) const
    {
        if (contact == none || m_span.state.contacts[contact].manifold.count == 0)
            return {};
        const Contact& c = m_span.state.contacts[contact];
        const double sign = c.shape_a == shape ? 1 : -1;
        return {sign * static_cast<double>(c.manifold.normal.x), sign * static_cast<double>(c.manifold.normal.y)};
    }

    // Excludes most pieces of a wall that lie in the box of a path.
    [[nodiscard]] bool is_wall_out_of_reach(int shape)
    {
        const SceneState& state = m_span.state;
        const int body = state.shapes[shape].body;
        if (state.bodies[body].type != BodyType::Static || !traits_of(state.shapes[shape].leaf).is_line)
            return false;
        const Reach& own = own_displacement().reach;
        const BodySim& sim = m_span.sim_of(body);
        const double x = own.x - sim.center.x;
        const double y = own.y - sim.center.y;
        const auto c = static_cast<double>(sim.rotation.c);
        const auto s = static_cast<double>(sim.rotation.s);
        return distance_to_line(leaf_view(state, shape), c * x + s * y + static_cast<double>(sim.local_center.x),
                                c * y - s * x + static_cast<double>(sim.local_center.y)) >
               own.radius + (m_span.h - own.time) * length_of(own.vx, own.vy);
    }

    const FlightSpan& m_span;
    Flier& m_flier;
    Position m_origin;
    std::optional<Sweep> m_own;
    std::array<Offer, most_offers> m_offers;
    std::size_t m_count = 0;
    int m_made = 0;
};

} // namespace

Tournament events_of(const FlightSpan& span)
{
    const auto first = static_cast<std::size_t>(span.island.first_flier);
    const auto count = static_cast<std::size_t>(span.island.flier_count);
    FlightWorkspace& flight = span.scratch.flight;
    return {std::span<const double>(flight.event_times).subspan(first, count),
            std::span(flight.first_of_events).subspan(2 * first, 2 * count)};
}

namespace {

bool looks_for_none(const FlightSpan& span, const Flier& f) { return f.landed || is_capped(span, f) || f.time >= span.h; }

double& time_in_list(const FlightSpan& span, const Flier& f)
{
    return span.scratch.flight.event_times[static_cast<std::size_t>(&f - span.scratch.flight.fliers.data())];
}

} // namespace

bool try_find_next_event(const FlightSpan& span, Flier& f)
{
    f.passes = none;
    f.event_time = time_in_list(span, f) = 1e300;
    if (looks_for_none(span, f))
        return true;
    if (f.resting_count > 0 && f.rests_until < span.h)
    { // its path follows the resting contact until then
        f.event_time = f.rests_until;
        f.event_own = f.event_shape = f.event_state = none;
        f.event_version = 0;
    }
    Search(span, f).run();
    time_in_list(span, f) = f.event_time;
    return f.passes == none;
}

namespace {

void replay_event(const FlightSpan& span, const Flier& f)
{
    events_of(span).replay(static_cast<std::size_t>(&f - span.fliers().data()));
}

constexpr std::int64_t dearness_of_unions = 4; // least cost, in looks, of a look that asks neighbors for their cone

void spend_looks(const FlightSpan& span, Flier& f)
{
    span.output.looks_left -= std::exchange(f.looks, 0) + (dearness_of_unions - 1) * std::exchange(f.union_looks, 0);
}

} // namespace

void find_next_event(const FlightSpan& span, Flier& f)
{
    while (!try_find_next_event(span, f))
        span.state.contacts[f.passes].flags |= contact_flag::passing;
    replay_event(span, f);
    spend_looks(span, f);
}

void reconsider(const FlightSpan& span, Flier& f, std::int32_t struck, int contact)
{
    if (looks_for_none(span, f))
        return;
    f.passes = none;
    const bool was_to_meet_it = f.event_state == struck;
    if (!was_to_meet_it)
        Search(span, f).run_for_contact(contact);
    time_in_list(span, f) = f.event_time;
    replay_event(span, f);
    spend_looks(span, f);
    if (was_to_meet_it || f.passes != none)
        find_next_event(span, f);
}

} // namespace carom::internal
