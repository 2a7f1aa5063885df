#pragma once

/// @file
/// A rule is a small state machine that hears events and buttons and writes on the desk. It never sees the physics.

#include "pinball/rules/desk.h"

#include <memory>

namespace carom::pinball {

class Rule
{
public:
    Rule() = default;
    virtual ~Rule() = default;
    Rule(const Rule&) = delete;
    Rule& operator=(const Rule&) = delete;

    /// Whether it goes on when the machine has tilted; the others hear and do nothing until the ball is over.
    [[nodiscard]] virtual bool works_tilted() const { return false; }
    virtual void start_game(Desk&) {}
    /// Another player's turn begins, in a game of several: the table must stand as this one left it.
    virtual void begin_turn(Desk&) {}
    virtual void start_ball(Desk&) {}
    virtual void on_event(Desk&, const GameEvent&) {}
    virtual void on_press(Desk&, Side) {}
    virtual void on_step(Desk&) {}
    virtual void add_to(Hash&) const {}
};

using RulePtr = std::unique_ptr<Rule>;

// Each stands in the file of its name.
RulePtr make_groups(const Table&);
RulePtr make_scoring(const Table&);
RulePtr make_lanes(const Table&, const LaneRule&);
RulePtr make_bank(const BankRule&);
RulePtr make_skill_shot(const SkillShotRule&);
RulePtr make_combo(const ComboRule&);
RulePtr make_multiball(const MultiballRule&);
RulePtr make_kickback(const Table&, bool on);
RulePtr make_more_balls(int balls);
RulePtr make_ball_save(const BallSaveRule&);
RulePtr make_tilt(int warnings);
RulePtr make_replay(const ReplayRule&);
RulePtr make_extra_ball(const ExtraBallRule&);
RulePtr make_ball_search(float time);

} // namespace carom::pinball
