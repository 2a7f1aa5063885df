// The same shot four times: looked at once, twice and four times a step, and followed along its whole way.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace carom::tour {
namespace {


class TooFast : public Chapter
{
    static constexpr int lanes = 4;
    static constexpr float radius = 0.15f;
    static constexpr float thickness = 0.06f;
    static constexpr float frame = 1.0f / 60;
    static constexpr double wall_x = 1.5;
    static constexpr double start_x = -4.3;

public:
    TooFast() : Chapter("10-too-fast", {{.name = "speed", .value = 60, .low = 2, .high = 1000, .format = "%.0f m/s", .restarts = true, .logarithmic = true}}) {}

    void build() override
    {
        begin({.gravity = {0, 0}, .sleeping = false});
        for (std::size_t i = 0; i < lanes; ++i)
        {
            Lane& lane = m_lanes[i];
            lane.at = {start_x, lane_y(i)};
            lane.velocity = control("speed");
            lane.seen.assign(1, lane.at);
            lane.bounced = false;
        }
        const BodyId wall = scene().create_body({.position = {wall_x, lane_y(lanes - 1)}});
        scene().create_shape(wall, box(thickness / 2, 0.5f), {.friction = 0, .restitution = 0.8f});
        m_ball = scene().create_body({.type = BodyType::Dynamic, .position = m_lanes[lanes - 1].at, .velocity = {control("speed"), 0}});
        scene().create_shape(m_ball, Circle{.radius = radius}, {.friction = 0, .restitution = 0.8f});
        m_steps = 0;
    }

    // Slow motion of its own: each look is to be seen.
    [[nodiscard]] float h() const override { return 0.1f; }

    // The last lane is the engine, the others what a simple engine does: move, then look whether the ball is in the wall.
    void step() override
    {
        const bool frame_is_over = ++m_steps % 4 == 0;
        look(m_lanes[2], frame / 4);
        if (m_steps % 2 == 0)
            look(m_lanes[1], frame / 2);
        if (!frame_is_over)
            return;
        look(m_lanes[0], frame);
        scene().step(frame);
        Lane& exact = m_lanes[lanes - 1];
        exact.at = scene().body(m_ball).position();
        for (const ImpactEvent& e : scene().impacts())
        {
            exact.bounced = true;
            exact.seen.push_back(e.point - e.normal * (e.body_b == m_ball ? -radius : radius));
        }
        exact.seen.push_back(exact.at);
    }

    [[nodiscard]] bool is_over() const override
    {
        const bool slowest_is_out = std::abs(m_lanes[0].at.x) > 5 && std::abs(m_lanes[lanes - 1].at.x) > 5;
        return m_steps >= 40 && slowest_is_out;
    }
    [[nodiscard]] bool has_struck() const override { return !scene().impacts().empty() && m_steps % 4 == 0; }
    [[nodiscard]] int picture_steps() const override { return 32; }
    [[nodiscard]] Box view() const override { return {{-4.7, -3.0}, {4.7, 3.1}}; }

    [[nodiscard]] Values values() const override
    {
        const float way = control("speed") * frame;
        return {{"speed", view::number(control("speed"))},
                {"way", view::number(way)},
                {"half", view::number(way / 2)},
                {"quarter", view::number(way / 4)},
                {"width", view::number(2 * radius + thickness)},
                {"looks", std::to_string(static_cast<int>(std::ceil(way / (2 * radius + thickness))))},
                {"distance", view::number(static_cast<float>(wall_x - start_x - static_cast<double>(radius + thickness / 2)))},
                {"time", view::number(static_cast<float>(wall_x - start_x - static_cast<double>(radius + thickness / 2)) / control("speed"))}};
    }

    void draw(view::Canvas& canvas, float) const override
    {
        static constexpr std::array<const char*, lanes> names{"whole", "half", "quarter", "impact"};
        for (std::size_t i = 0; i < lanes; ++i)
        {
            const double y = lane_y(i);
            const Lane& lane = m_lanes[i];
            canvas.fill_box({{wall_x - static_cast<double>(thickness / 2), y - 0.5}, {wall_x + static_cast<double>(thickness / 2), y + 0.5}}, view::rgb(0x7f90ad));
            for (std::size_t k = 0; k + 1 < lane.seen.size(); ++k)
                canvas.line(lane.seen[k], lane.seen[k + 1], {fade(first_color, 0.35f), 1});
            bool returns = false;
            for (std::size_t k = 0; k < lane.seen.size(); ++k)
            {
                returns = returns || (k > 0 && lane.seen[k].x < lane.seen[k - 1].x);
                canvas.stroke_circle(lane.seen[k], radius, {fade(returns ? good_color : first_color, 0.6f), 1.5f});
            }
            canvas.fill_circle(lane.at, radius, lane.bounced ? good_color : first_color);
            const bool through = !lane.bounced && lane.at.x > wall_x;
            label(canvas, {-2.2, y + 0.48}, word(names[i]) + (lane.bounced ? ": " + word("bounced") : through ? ": " + word("through") : ""),
                  lane.bounced ? good_color : through ? bad_color : faint, 12);
        }
    }

private:
    struct Lane
    {
        Position at{};
        float velocity = 0;
        std::vector<Position> seen{}; ///< where it was looked at
        bool bounced = false;
    };

    static double lane_y(std::size_t i) { return 2.1 - 1.5 * static_cast<double>(i); }

    static void look(Lane& lane, float time)
    {
        lane.at.x += static_cast<double>(lane.velocity * time);
        const double reach = static_cast<double>(radius + thickness / 2);
        if (lane.velocity > 0 && std::abs(lane.at.x - wall_x) < reach)
        {
            lane.at.x = wall_x - reach;
            lane.velocity *= -0.8f;
            lane.bounced = true;
        }
        lane.seen.push_back(lane.at);
    }

    std::array<Lane, lanes> m_lanes{};
    BodyId m_ball{};
    int m_steps = 0;
};

} // namespace

std::unique_ptr<Chapter> too_fast() { return std::make_unique<TooFast>(); }

} // namespace carom::tour
