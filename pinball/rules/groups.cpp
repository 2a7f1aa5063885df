// Groups: members are made one by one; when all are, the group is complete, pays and may start anew after a while.

#include "pinball/rules/rule.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace carom::pinball {

namespace {

struct GroupState
{
    std::vector<bool> made{};
    std::int64_t reset_at = -1; ///< step; -1: not waiting
};

class Groups final : public Rule
{
public:
    explicit Groups(const Table& table)
    {
        for (Index i = 0; i < table.elements.size(); ++i)
            if (std::holds_alternative<DropTarget>(table.elements[i].part) && table.elements[i].group == none &&
                table.elements[i].enabled)
                m_loose.emplace_back(i, false);
        for (const Group& group : table.groups)
            m_states.push_back({std::vector<bool>(group.members.size())});
    }

    void start_game(Desk& desk) override
    {
        for (std::size_t g = 0; g < m_states.size(); ++g)
            reset(desk, g);
        for (auto& [target, is_down] : m_loose)
        {
            is_down = false;
            desk.order(target, Command::Raise);
        }
    }

    void begin_turn(Desk& desk) override { restore(desk); }

    // The targets stand and lie as the group has them, also after a tilt, when it was deaf.
    void restore(Desk& desk) const
    {
        for (std::size_t g = 0; g < m_states.size(); ++g)
            for (std::size_t i = 0; i < m_states[g].made.size(); ++i)
                desk.order(desk.table().groups[g].members[i], m_states[g].made[i] ? Command::Drop : Command::Raise);
        for (const auto& [target, is_down] : m_loose)
            desk.order(target, is_down ? Command::Drop : Command::Raise);
    }

    void start_ball(Desk& desk) override
    {
        for (std::size_t g = 0; g < m_states.size(); ++g)
            if (desk.table().groups[g].reset == GroupReset::Never && is_complete(g))
                reset(desk, g);
        restore(desk);
    }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (!is_made(event) || event.element == none)
            return;
        for (auto& [target, is_down] : m_loose)
            is_down |= target == event.element && event.kind == EventKind::Fell;
        const Index g = desk.table().elements[event.element].group;
        if (g == none)
            return;
        const std::vector<Index>& members = desk.table().groups[g].members;
        const auto member = std::ranges::find(members, event.element);
        if (member != members.end())
            make(desk, g, static_cast<std::size_t>(member - members.begin()));
    }

    // A flipper turns the lit lanes round its way.
    void on_press(Desk& desk, Side side) override
    {
        for (std::size_t g = 0; g < m_states.size(); ++g)
        {
            auto& made = m_states[g].made;
            if (!desk.table().groups[g].lane_change || made.empty() || is_complete(g))
                continue;
            if (side == Side::Left)
                std::rotate(made.begin(), made.begin() + 1, made.end());
            else
                std::rotate(made.begin(), made.end() - 1, made.end());
            show(desk, g);
        }
    }

    void on_step(Desk& desk) override
    {
        for (std::size_t g = 0; g < m_states.size(); ++g)
            if (m_states[g].reset_at >= 0 && desk.now() >= m_states[g].reset_at)
                reset(desk, g);
    }

    void add_to(Hash& hash) const override
    {
        for (const GroupState& state : m_states)
        {
            hash.add(state.reset_at);
            for (const bool made : state.made)
                hash.add(made);
        }
        for (const auto& loose : m_loose)
            hash.add(loose.second);
    }

private:
    [[nodiscard]] bool is_complete(std::size_t g) const
    {
        return std::ranges::all_of(m_states[g].made, [](bool made) { return made; });
    }

    void make(Desk& desk, std::size_t g, std::size_t member)
    {
        GroupState& state = m_states[g];
        if (state.made[member])
            return;
        state.made[member] = true;
        show(desk, g);
        if (!is_complete(g))
            return;
        const Group& group = desk.table().groups[g];
        desk.add_score(group.score);
        desk.announce({.kind = EventKind::GroupCompleted, .element = group.members[member], .value = static_cast<int>(g)});
        if (group.reset == GroupReset::WhenComplete)
            state.reset_at = desk.now() + desk.steps(group.reset_delay);
    }

    void reset(Desk& desk, std::size_t g)
    {
        GroupState& state = m_states[g];
        std::fill(state.made.begin(), state.made.end(), false);
        state.reset_at = -1;
        show(desk, g);
        for (const Index member : desk.table().groups[g].members)
            desk.order(member, Command::Raise);
    }

    void show(Desk& desk, std::size_t g)
    {
        const std::vector<Index>& members = desk.table().groups[g].members;
        for (std::size_t i = 0; i < members.size(); ++i)
            desk.player.lamps[members[i]] = m_states[g].made[i] ? LampState::On : LampState::Off;
    }

    std::vector<GroupState> m_states{};
    std::vector<std::pair<Index, bool>> m_loose{}; ///< drop targets of no group, and whether each lies
};

} // namespace

RulePtr make_groups(const Table& table) { return std::make_unique<Groups>(table); }

} // namespace carom::pinball
