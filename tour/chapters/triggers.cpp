// Areas that report who is inside and stop nobody; a booster, a bouncer; all that happens as a list that runs along.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <string>

namespace carom::tour {
namespace {


class Triggers : public Chapter
{
    static constexpr int most_steps = 210;
    static constexpr std::size_t most_lines = 9;

public:
    Triggers()
        : Chapter("06-triggers",
                  {{.name = "slow", .value = 3, .low = 0.5f, .high = 6, .format = "%.1f m/s", .restarts = true},
                   {.name = "fast", .value = 300, .low = 6, .high = 1000, .format = "%.0f m/s", .restarts = true, .logarithmic = true},
                   {.name = "boost", .value = 12, .low = -20, .high = 40, .format = "%.0f m/s²", .restarts = true},
                   {.name = "kick", .value = 4, .low = 0, .high = 10, .format = "%.1f m/s", .restarts = true}})
    {}

    void build() override
    {
        begin({.gravity = {0, 0}, .sleeping = false});
        for (std::size_t i = 0; i < 3; ++i)
            m_balls[i] = ball({-4.2, lanes[i]}, i == 1 ? control("fast") : control("slow"));
        m_gate = trigger({-1.2, (lanes[0] + lanes[1]) / 2}, box(0.7f, 1.0f), {});
        m_booster = trigger({-1.2, lanes[2]}, box(1.1f, 0.45f), {.acceleration = {control("boost"), 0}});
        const BodyId bouncer = scene().create_body({.position = {2.2, lanes[2]}});
        m_bouncer = scene().create_shape(bouncer, Circle{.radius = 0.45f},
                                         {.restitution = 0.5f, .kick = {.speed = control("kick"), .threshold = 0.5f}});
        m_lines.clear();
        m_steps = 0;
    }

    void step() override
    {
        Chapter::step();
        ++m_steps;
        m_struck = !scene().impacts().empty() || !scene().trigger_enters().empty() || !scene().trigger_exits().empty();
        const double start = scene().time() - static_cast<double>(h());
        for (const TriggerEvent& e : scene().trigger_enters())
            tell("enters", e.visitor_body, e.trigger, start + static_cast<double>(e.time));
        for (const TriggerEvent& e : scene().trigger_exits())
            tell("leaves", e.visitor_body, e.trigger, start + static_cast<double>(e.time));
        for (const ImpactEvent& e : scene().impacts())
            tell("hits", e.shape_a == m_bouncer ? e.body_b : e.body_a, m_bouncer, start + static_cast<double>(e.time));
    }

    [[nodiscard]] bool has_struck() const override { return m_struck; }
    [[nodiscard]] bool is_over() const override { return m_steps >= most_steps; }
    [[nodiscard]] int picture_steps() const override { return 62; }
    [[nodiscard]] Box view() const override { return {{-4.6, -5.2}, {4.6, 2.4}}; }

    [[nodiscard]] Values values() const override
    {
        const float way = control("fast") * h();
        return {{"fast", view::number(control("fast"))},
                {"way", view::number(way)},
                {"wide", view::number(1.4f)},
                {"inside", std::to_string(scene().inside(m_gate).size())},
                {"boost", view::number(control("boost"))},
                {"kick", view::number(control("kick"))}};
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        view::draw_scene(canvas, scene(), alpha);
        label(canvas, {-1.2, 2.05}, word("gate"), view::rgb(0xf783ac), 12);
        label(canvas, {-1.2, lanes[2] - 0.75}, word("booster"), view::rgb(0xf783ac), 12);
        label(canvas, {2.2, lanes[2] - 0.75}, word("bouncer"), yellow, 12);
        const Position bullet = scene().body(m_balls[1]).interpolated_pose(alpha).position;
        canvas.line({-4.2, lanes[1]}, {std::min(bullet.x, view().upper.x), lanes[1]}, {fade(yellow, 0.5f), 2});
        label(canvas, {-3.9, lanes[1] - 0.3}, word("way of ball 2"), fade(yellow, 0.8f), 12);
        named_arrow(canvas, {-1.7, lanes[2]}, {0.03f * control("boost"), 0}, "", good_color);
        for (std::size_t i = 0; i < 3; ++i)
        {
            const Position at = scene().body(m_balls[i]).interpolated_pose(alpha).position;
            if (std::abs(at.x) < view().upper.x)
                label(canvas, at, std::to_string(i + 1), view::rgb(0x10141c), 12);
        }
        draw_list(canvas);
    }

    [[nodiscard]] TableView table_view() const override { return {.triggers = true}; }

private:
    static constexpr std::array<double, 3> lanes{1.4, 0.3, -1.2};

    BodyId ball(Position at, float speed)
    {
        const BodyId body = scene().create_body({.type = BodyType::Dynamic, .position = at, .velocity = {speed, 0}});
        scene().create_shape(body, Circle{.radius = 0.25f}, {.restitution = 0.5f});
        return body;
    }

    ShapeId trigger(Position at, const Geometry& geometry, const Field& field)
    {
        return scene().create_shape(scene().create_body({.position = at}), geometry, {.trigger = true, .field = field});
    }

    void tell(const char* what, BodyId ball, ShapeId area, double time)
    {
        const auto number = static_cast<std::size_t>(std::ranges::find(m_balls, ball) - m_balls.begin()) + 1;
        const char* where = area == m_gate ? "the gate" : area == m_booster ? "the booster" : "the bouncer";
        m_lines.push_back(filled(word(what), {{"time", seconds(time)}, {"ball", std::to_string(number)}, {"area", word(where)}}));
        if (m_lines.size() > most_lines)
            m_lines.pop_front();
    }

    // With all the places that tell the events of a bullet apart.
    static std::string seconds(double time)
    {
        char text[32];
        std::snprintf(text, sizeof text, "%.5f", time);
        return text;
    }

    void draw_list(view::Canvas& canvas) const
    {
        double y = -2.35;
        for (const std::string& line : m_lines)
        {
            canvas.text({-4.3, y}, line, {.size = 13, .color = yellow, .face = view::Face::Mono});
            y -= static_cast<double>(canvas.camera().meters(17));
        }
        if (m_lines.empty())
            canvas.text({-4.3, y}, word("no events"), {.size = 13, .color = faint});
    }

    std::array<BodyId, 3> m_balls{};
    ShapeId m_gate{};
    ShapeId m_booster{};
    ShapeId m_bouncer{};
    std::deque<std::string> m_lines;
    int m_steps = 0;
    bool m_struck = false;
};

} // namespace

std::unique_ptr<Chapter> triggers() { return std::make_unique<Triggers>(); }

} // namespace carom::tour
