// Keeps several balls in play at once, whatever the table's own rules: as soon as one is lost, the machine launches another. Such a
// ball never ends.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

class MoreBalls final : public Rule
{
public:
    explicit MoreBalls(int balls) : m_balls(balls) {}

    void on_step(Desk& desk) override
    {
        if (desk.phase != Phase::InPlay)
            return;
        for (int i = desk.balls_out(); i < m_balls; ++i)
            desk.serve(true);
    }

private:
    int m_balls;
};

} // namespace

RulePtr make_more_balls(int balls) { return std::make_unique<MoreBalls>(balls); }

} // namespace carom::pinball
