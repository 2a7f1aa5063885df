// In a crowd nineteen of twenty contacts are in the next step what they were: their lanes stay, and only those that go are taken out of them, and those
// that come put where one is free. So it is for the unit that has most links; where a lane stands changes no result, for a contact keeps its colour as
// long as it has a row, standing or not. All of it is laid out anew when contacts have moved in memory (tidy.cpp), or no lane is free where one is wanted.

#include "dynamics/standing_rows.h"

#include "core/crew.h"
#include "core/task_pool.h"
#include "dynamics/contact_store.h"
#include "dynamics/contact_update.h"
#include "dynamics/kept_manifold.h"
#include "dynamics/row_follower.h"
#include "dynamics/scene_data.h"
#include "dynamics/unit_bins.h"
#include "dynamics/unit_energy.h"
#include "dynamics/wide_prepare.h"

#include <algorithm>
#include <utility>

namespace carom::internal {

namespace {

constexpr std::size_t groups_per_task = 128;
constexpr int enough_links = 512; // in lanes

std::size_t as_index(std::int32_t i) { return static_cast<std::size_t>(i); }

template <class Visit>
void for_each_bit(std::uint32_t bits, const Visit& visit)
{
    for (; bits != 0; bits &= bits - 1)
        visit(std::countr_zero(bits));
}

// Calls visit(lane) for the bits of all groups.
template <class Visit>
void for_each_lane(const std::vector<std::uint8_t>& bits, const Visit& visit)
{
    for (std::size_t g = 0; g < bits.size(); ++g)
        for_each_bit(bits[g], [&](int i) { visit(static_cast<std::int32_t>(g) * lane_count + i); });
}

std::uint8_t bit_of(std::int32_t lane) { return static_cast<std::uint8_t>(1u << lane % lane_count); }

class Standing
{
public:
    explicit Standing(StepContext& ctx) : m_ctx(ctx), m_state(ctx.state), m_scratch(ctx.scratch), m_rows(ctx.scratch.standing) {}

    void follow()
    {
        m_rows.touched = false;
        place();
        const UnitBins bins(m_rows.bin_starts, 0, m_rows.bin_count(), m_rows.cells);
        Crew::run(m_ctx.scene.def.tasks,
                  [&](Crew& crew)
                  {
                      bins.all(crew,
                               [&](int first, int last)
                               {
                                   RowFollower follower(m_ctx);
                                   for (int g = first; g < last; ++g)
                                       follow_group(follower, g);
                               });
                  });
        for_each_lane(m_rows.gone, [&](std::int32_t lane) { release(lane); });
    }

    // Where bodies have come or gone.
    void place()
    {
        if (m_rows.bodies == m_state.awake_bodies)
            return;
        std::fill(m_rows.gone.begin(), m_rows.gone.end(), std::uint8_t{0});
        const auto place_now = [&](std::int32_t place)
        { return place == none ? none : place_of(m_rows.bodies[as_index(place >= 0 ? place : -2 - place)]); };
        for (std::size_t i = 0; i < m_rows.lanes.size(); ++i)
        {
            Link& l = m_rows.lanes[i];
            if (l.contact == none)
                continue;
            const auto lane = static_cast<std::int32_t>(i);
            const std::int32_t a = place_now(l.a);
            const std::int32_t b = place_now(l.b);
            const bool has_woken = (m_rows.watched[i / lane_count] & bit_of(lane)) != 0 && has_moving_rest(l);
            if (!is_alike(a, l.a) || !is_alike(b, l.b) || has_woken)
                m_rows.gone[i / lane_count] |= bit_of(lane);
            l.a = a;
            l.b = b;
        }
        m_rows.bodies = m_state.awake_bodies;
        m_rows.colors.assign(m_state.awake_bodies.size(), 0);
        for (const Link& l : m_rows.lanes)
        {
            if (l.contact != none)
                mark_color(l);
        }
        for_each_lane(m_rows.gone, [&](std::int32_t lane) { let_go(lane); });
    }

    // As of the step's units.
    void choose_unit()
    {
        const auto first =
            std::find_if(m_rows.lanes.begin(), m_rows.lanes.end(), [](const Link& l) { return l.contact != none; });
        if (first == m_rows.lanes.end() || m_scratch.has_uneven)
        {
            give_up();
            return;
        }
        m_rows.body = std::max(first->a, first->b);
        const std::int32_t unit = m_scratch.unit_of[as_index(m_rows.body)];
        if (m_scratch.tallies[as_index(unit)].bodies <= UnitEnergy::most_bodies)
        {
            give_up();
            return;
        }
        for_each_in_parts(m_ctx.scene.def.tasks, m_rows.gone.size(), groups_per_task,
                          [&](std::size_t g) { m_rows.gone[g] = strangers(g, unit); });
        make_links(m_rows.gone);
        const auto lanes =
            std::count_if(m_rows.lanes.begin(), m_rows.lanes.end(), [](const Link& l) { return l.contact != none; });
        if (lanes < enough_links)
            give_up();
    }

    void give_up()
    {
        for (std::size_t g = 0; g < m_rows.gone.size(); ++g)
            m_rows.gone[g] = filled(g);
        make_links(m_rows.gone);
        m_rows.valid = false;
    }

private:
    [[nodiscard]] std::uint8_t filled(std::size_t g) const
    {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < lane_count; ++i)
            bits |= m_rows.lanes[g * lane_count + i].contact != none ? 1u << i : 0;
        return static_cast<std::uint8_t>(bits);
    }

    // A flier has dropped its lanes; what has been changed by others, or is no more, has no mark.
    [[nodiscard]] bool stands(const WideRow& row, std::int32_t lane) const
    {
        const Link& l = m_rows.lanes[as_index(lane)];
        return row.contact.v[lane % lane_count] == l.contact && m_state.lane_marks[as_index(l.contact)] == LaneMark::Stands;
    }

    void follow_group(RowFollower& follower, int g) const
    {
        WideRow& row = m_scratch.wide_rows[as_index(g)];
        const std::int32_t first = g * lane_count;
        std::uint32_t gone = 0;
        for_each_bit(filled(as_index(g)),
                     [&](int i)
                     {
                         if (stands(row, first + i))
                             return;
                         gone |= 1u << i;
                         clear_lane(row, i, row.a.v[i]);
                     });
        const bool is_empty = (filled(as_index(g)) & ~gone) == 0;
        const FollowNews news = is_empty ? FollowNews{} : follower.follow(row, m_rows.watched[as_index(g)] & ~gone);
        for_each_bit(news.gone, [&](int i) { clear_lane(row, i, row.a.v[i]); });
        gone |= news.gone;
        m_rows.gone[as_index(g)] = static_cast<std::uint8_t>(gone);
        m_rows.told[as_index(g)] = static_cast<std::uint8_t>(news.told & ~gone);
        m_rows.touching[as_index(g)] = static_cast<std::uint8_t>(filled(as_index(g)) & ~gone & ~row.untold);
    }

    [[nodiscard]] static bool is_alike(std::int32_t a, std::int32_t b)
    {
        return (a >= 0) == (b >= 0) && (a == none) == (b == none);
    }

    [[nodiscard]] bool has_moving_rest(const Link& l) const
    {
        const Contact& contact = m_state.contacts[l.contact];
        return (l.a == none && place_of(contact.body_a) != none) || (l.b == none && place_of(contact.body_b) != none);
    }

    // As in Link.
    [[nodiscard]] std::int32_t place_of(int body) const
    {
        const BodyRecord& record = m_state.bodies[body];
        return record.awake_index == none || record.type == BodyType::Dynamic ? record.awake_index : -2 - record.awake_index;
    }

    void mark_color(const Link& l)
    {
        for (const std::int32_t place : {l.a, l.b})
        {
            if (place >= 0)
                m_rows.colors[as_index(place)] |= std::uint64_t{1} << l.color;
        }
    }

    // The lane is free.
    void release(std::int32_t lane)
    {
        Link& l = m_rows.lanes[as_index(lane)];
        const std::size_t g = as_index(lane / lane_count);
        for (const std::int32_t place : {l.a, l.b})
        {
            if (place >= 0)
                m_rows.colors[as_index(place)] &= ~(std::uint64_t{1} << l.color);
        }
        leave_lane(m_state, l.contact);
        give(m_rows.free_at(bin_of(l), lane), lane);
        l.contact = none;
        if (filled(g) == 0)
            m_scratch.wide_rows[g].count = 0;
        m_rows.cores[as_index(lane)] = 0;
        for (std::vector<std::uint8_t>* bits : {&m_rows.touching, &m_rows.watched, &m_rows.changed, &m_rows.told})
            (*bits)[g] &= static_cast<std::uint8_t>(~bit_of(lane));
        m_rows.touched = true;
    }

    // With what it knows of its contact.
    void let_go(std::int32_t lane)
    {
        const std::int32_t index = m_rows.lanes[as_index(lane)].contact;
        WideRow& row = m_scratch.wide_rows[as_index(lane / lane_count)];
        if (stands(row, lane))
        {
            catch_up(m_state, index);
            m_state.contacts[index].wide = none;
        }
        clear_lane(row, lane % lane_count, row.a.v[lane % lane_count]);
        release(lane);
    }

    // Of a group, lanes that another unit solves, or flight.
    [[nodiscard]] std::uint8_t strangers(std::size_t g, std::int32_t unit) const
    {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < lane_count; ++i)
        {
            const Link& l = m_rows.lanes[g * lane_count + i];
            const bool is_one =
                l.contact != none && (m_scratch.unit_of[as_index(std::max(l.a, l.b))] != unit || flies(l.a) || flies(l.b));
            bits |= is_one ? 1u << i : 0;
        }
        return static_cast<std::uint8_t>(bits);
    }

    [[nodiscard]] bool flies(std::int32_t place) const { return place >= 0 && m_scratch.flight[as_index(place)] != earthbound; }

    // In the order in which they would have been gathered.
    void make_links(const std::vector<std::uint8_t>& lanes)
    {
        std::vector<Link>& links = m_scratch.links;
        const std::size_t before = links.size();
        for_each_lane(lanes,
                      [&](std::int32_t lane)
                      {
                          Link& l = links.emplace_back(m_rows.lanes[as_index(lane)]);
                          l.touching = (m_rows.touching[as_index(lane / lane_count)] & bit_of(lane)) != 0;
                          l.bears = (m_state.contacts[l.contact].flags & contact_flag::loaded) != 0;
                          let_go(lane);
                      });
        if (links.size() == before)
            return;
        const auto place = [&](const Link& l) { return m_state.contacts[l.contact].awake_index; };
        std::sort(links.begin(), links.end(), [&](const Link& a, const Link& b) { return place(a) < place(b); });
    }

    StepContext& m_ctx;
    SceneState& m_state;
    Scratch& m_scratch;
    StandingRows& m_rows;
};

} // namespace

void follow_standing_rows(StepContext& ctx)
{
    if (ctx.scratch.standing.valid)
        Standing(ctx).follow();
}

void add_standing_news(const StepContext& ctx, std::vector<ContactNews>& news)
{
    const StandingRows& rows = ctx.scratch.standing;
    if (!rows.valid)
        return;
    const std::size_t before = news.size();
    for_each_lane(rows.told,
                  [&](std::int32_t lane)
                  {
                      const std::int32_t contact = rows.lanes[as_index(lane)].contact;
                      news.push_back({contact, news_of(ctx, ctx.state.contacts[contact])});
                  });
    if (news.size() == before)
        return;
    const auto place = [&](const ContactNews& n) { return ctx.state.contacts[n.contact].awake_index; };
    std::sort(news.begin(), news.end(), [&](const ContactNews& a, const ContactNews& b) { return place(a) < place(b); });
}

void note_standing_touches(StepContext& ctx)
{
    StandingRows& rows = ctx.scratch.standing;
    if (!rows.valid)
        return;
    for_each_lane(rows.told,
                  [&](std::int32_t lane)
                  {
                      const Contact& contact = ctx.state.contacts[rows.lanes[as_index(lane)].contact];
                      const std::size_t g = as_index(lane / lane_count);
                      const bool touches = (contact.flags & contact_flag::touching) != 0;
                      rows.touching[g] =
                          static_cast<std::uint8_t>(touches ? rows.touching[g] | bit_of(lane) : rows.touching[g] & ~bit_of(lane));
                      rows.changed[g] |= bit_of(lane);
                      rows.touched = true;
                  });
}

void place_standing_rows(StepContext& ctx)
{
    if (ctx.scratch.standing.valid)
        Standing(ctx).place();
}

void choose_standing_unit(StepContext& ctx)
{
    if (ctx.scratch.standing.valid)
        Standing(ctx).choose_unit();
}

void give_up_standing_rows(StepContext& ctx)
{
    if (ctx.scratch.standing.valid)
        Standing(ctx).give_up();
}

} // namespace carom::internal
