// A mass on a spring: the force, how energy goes to and fro, and a launcher driven by it.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace carom::tour {
namespace {


class Springs : public Chapter
{
    static constexpr float rest_length = 2;
    static constexpr double wall_x = -3.6;
    static constexpr double rail_y = 1.3;
    static constexpr double launcher_y = -0.9;
    static constexpr float rod_mass = 0.5f;
    static constexpr float ball_mass = 1;
    static constexpr float rod_stiffness = 60;
    static constexpr std::size_t window_steps = 480;
    static constexpr double window_seconds = 4;
    static constexpr float burst_at = 20; ///< m: nobody needs to see the simple engine's mass any more

public:
    Springs()
        : Chapter("07-springs", {{.name = "k", .value = 100, .low = 1, .high = 2000, .format = "%.0f N/m", .logarithmic = true},
                                 {.name = "c", .value = 0.3f, .low = 0, .high = 40, .format = "%.2f N·s/m"},
                                 {.name = "mass", .value = 1, .low = 0.2f, .high = 5, .format = "%.1f kg", .restarts = true, .logarithmic = true},
                                 {.name = "stretch", .value = 1, .low = -1, .high = 1.2f, .format = "%.2f m", .restarts = true},
                                 {.name = "pull", .value = 0.7f, .low = 0.1f, .high = 1, .format = "%.2f m", .restarts = true}})
    {}

    void build() override
    {
        begin({.gravity = {0, 0}, .sleeping = false});
        m_mass = slider({wall_x + static_cast<double>(rest_length + control("stretch")), rail_y}, 0.35f, control("mass"));
        m_spring = scene().create_joint(spring(wall_x, rail_y, m_mass, control("k"), control("c"), rest_length));
        m_rod = slider({wall_x + 1.2 - static_cast<double>(control("pull")), launcher_y}, 0.15f, rod_mass);
        m_rod_spring = scene().create_joint(spring(wall_x, launcher_y, m_rod, rod_stiffness, 0, 1.2f));
        m_ball = scene().create_body(
            {.type = BodyType::Dynamic, .position = scene().body(m_rod).position() + Vec2{0.15f + 0.25f, 0}});
        scene().create_shape(m_ball, Circle{.radius = 0.25f}, {.density = ball_mass / (pi * 0.0625f)});
        for (Curve* curve : {&m_force, &m_kinetic, &m_potential, &m_sum})
            curve->values.clear();
        m_launch = 0;
        m_simple_x = control("stretch");
        m_simple_v = 0;
    }

    [[nodiscard]] float h() const override { return 1.0f / 120; }

    void step() override
    {
        auto def = std::get<SpringDef>(scene().joint(m_spring).def());
        def.stiffness = control("k");
        def.damping = control("c");
        scene().joint(m_spring).set_def(def);
        step_simple();
        Chapter::step();
        const float x = stretch();
        const float v = velocity();
        m_force.add(-control("k") * x - control("c") * v, window_steps);
        m_kinetic.add(0.5f * control("mass") * v * v, window_steps);
        m_potential.add(0.5f * control("k") * x * x, window_steps);
        m_sum.add(m_kinetic.values.back() + m_potential.values.back(), window_steps);
        m_launch = std::max(m_launch, scene().body(m_ball).velocity().x);
    }

    [[nodiscard]] bool has_struck() const override { return m_sum.values.size() > 1 && is_turning(); }
    [[nodiscard]] int picture_steps() const override { return 150; }
    [[nodiscard]] Box view() const override { return {{-4.2, -3.6}, {4.2, 2.8}}; }

    [[nodiscard]] Values values() const override
    {
        const float k = control("k");
        const float m = control("mass");
        const float critical = 2 * std::sqrt(k * m);
        const float s = control("pull");
        return {{"k", view::number(k)},
                {"c", fixed(control("c"))},
                {"rest", fixed(rest_length)},
                {"length", fixed(rest_length + stretch())},
                {"v", fixed(velocity())},
                {"force", fixed(-k * stretch() - control("c") * velocity(), 2)},
                {"period", view::number(2 * pi * std::sqrt(m / k))},
                {"limit", view::number(control("c") / h())},
                {"critical", view::number(critical)},
                {"damped", word(control("c") < 0.98f * critical ? "under" : control("c") > 1.02f * critical ? "over" : "just")},
                {"pull", view::number(s)},
                {"K", view::number(rod_stiffness)},
                {"M", view::number(rod_mass + ball_mass)},
                {"stored", view::number(0.5f * rod_stiffness * s * s)},
                {"speed", view::number(s * std::sqrt(rod_stiffness / (rod_mass + ball_mass)))},
                {"launch", view::number(m_launch)}};
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        canvas.line({wall_x, -1.4}, {wall_x, 1.9}, {faint, 4});
        for (const double y : {rail_y - 0.37, launcher_y - 0.27})
            canvas.line({wall_x, y}, {4.2, y}, {view::rgb(0x46536b), 3});
        const double rest_x = wall_x + static_cast<double>(rest_length);
        const std::array<Position, 2> mark{Position{rest_x, 0.5}, Position{rest_x, 2.3}};
        canvas.dashed(mark, {faint, 1.5f});
        label(canvas, {rest_x, 2.68}, word("rest"), faint, 12);
        view::draw_scene(canvas, scene(), alpha);
        draw_simple(canvas);
        const Position at = scene().body(m_mass).interpolated_pose(alpha).position;
        arrow_above(canvas, at + Vec2{0, 0.92f}, {-0.012f * control("k") * stretch(), 0}, word("spring force"), second_color);
        arrow_above(canvas, at + Vec2{0, 0.55f}, {-0.15f * control("c") * velocity(), 0}, word("damping force"), bad_color);
        arrow_above(canvas, at + Vec2{0, -0.75f}, {0.2f * velocity(), 0}, word("velocity"), good_color);
        const std::array<const Curve*, 1> force{&m_force};
        draw_curves(canvas, {{-4.1, -3.5}, {-0.1, -1.7}}, word("force"), force, window_seconds, window_steps);
        const std::array<const Curve*, 3> energies{&m_sum, &m_kinetic, &m_potential};
        draw_curves(canvas, {{0.1, -3.5}, {4.1, -1.7}}, word("energy"), energies, window_seconds, window_steps);
    }

    [[nodiscard]] TableView table_view() const override { return {.joints = true}; }

private:
    [[nodiscard]] float stretch() const
    {
        return static_cast<float>(scene().body(m_mass).position().x - wall_x) - rest_length;
    }
    // The simplest engine: force and velocity of the start of a step hold for all of it.
    void step_simple()
    {
        if (std::abs(m_simple_x) > burst_at)
            return;
        const float force = -control("k") * m_simple_x - control("c") * m_simple_v;
        m_simple_x += h() * m_simple_v;
        m_simple_v += h() * force / control("mass");
    }

    void draw_simple(view::Canvas& canvas) const
    {
        const Position at{wall_x + static_cast<double>(rest_length + m_simple_x), rail_y};
        if (at.x < wall_x || at.x > 4.2)
            return label(canvas, {2.6, 2.68}, word("burst"), bad_color, 12);
        canvas.stroke_box({{at.x - 0.35, at.y - 0.35}, {at.x + 0.35, at.y + 0.35}}, {ink, 2});
        if (std::abs(m_simple_x - stretch()) > 0.25f)
            label(canvas, at + Vec2{0, -0.5f}, word("simple"), faint, 11);
    }

    // Its name stands over its middle, where no head is in the way.
    static void arrow_above(view::Canvas& canvas, Position from, Vec2 way, std::string_view name, view::Color color)
    {
        named_arrow(canvas, from, way, "", color);
        const float pixel = canvas.camera().meters(1);
        if (length(way) > 4 * pixel)
            label(canvas, from + 0.5f * way + Vec2{0, 11 * pixel}, name, color, 12);
    }

    [[nodiscard]] float velocity() const { return scene().body(m_mass).velocity().x; }

    [[nodiscard]] bool is_turning() const
    {
        const auto& kinetic = m_kinetic.values;
        return kinetic.back() < 0.02f * m_sum.values.back() && kinetic[kinetic.size() - 2] > kinetic.back();
    }

    // Slides along x and does not turn.
    BodyId slider(Position at, float half, float mass)
    {
        const BodyId body = scene().create_body(
            {.type = BodyType::Dynamic, .position = at, .locks = {.linear_y = true, .angular = true}});
        scene().create_shape(body, box(half, half), {.density = mass / (4 * half * half)});
        return body;
    }

    static SpringDef spring(double x, double y, BodyId body, float k, float c, float length)
    {
        return {.body_b = body, .anchor_a = {static_cast<float>(x), static_cast<float>(y)}, .stiffness = k, .damping = c, .length = length};
    }

    BodyId m_mass{};
    BodyId m_rod{};
    BodyId m_ball{};
    JointId m_spring{};
    JointId m_rod_spring{};
    float m_launch = 0;
    float m_simple_x = 0; ///< stretch of the simple engine's spring
    float m_simple_v = 0;
    Curve m_force{second_color};
    Curve m_kinetic{good_color, word("kinetic")};
    Curve m_potential{second_color, word("potential")};
    Curve m_sum{yellow, word("sum")};
};

} // namespace

std::unique_ptr<Chapter> springs() { return std::make_unique<Springs>(); }

} // namespace carom::tour
