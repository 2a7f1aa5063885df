#pragma once

/// @file
/// Elements that a ball lies over instead of striking: they know which balls are there.

#include "pinball/elements/playfield.h"

#include <algorithm>
#include <vector>

namespace carom::pinball {

class Zone : public Device
{
public:
    using Device::Device;

    void on_enter(Playfield&, Ball& ball) override
    {
        m_inside.push_back(ball.state.body);
        state.occupied = true;
    }

    void on_exit(Playfield&, BodyId body, Ball*) override
    {
        std::erase(m_inside, body);
        state.occupied = !m_inside.empty();
    }

    void add_to(Hash& hash) const override
    {
        for (const BodyId body : m_inside)
            hash.add(body.slot);
    }

protected:
    [[nodiscard]] const std::vector<BodyId>& inside() const { return m_inside; }

private:
    std::vector<BodyId> m_inside{};
};

} // namespace carom::pinball
