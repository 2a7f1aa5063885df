// Overlap: how it is shared by the masses and taken away softly, and what a pile does when contacts are too soft.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom::tour {
namespace {


class SinkingIn : public Chapter
{
    static constexpr float half = 0.6f;
    static constexpr double left = -2.6;
    static constexpr double middle_y = 2.6;
    static constexpr int pile = 6;
    static constexpr std::size_t window_steps = 180;

public:
    SinkingIn()
        : Chapter("05-sinking-in",
                  {{.name = "mass 1", .value = 1, .low = 0.5f, .high = 10, .format = "%.1f kg", .logarithmic = true},
                   {.name = "mass 2", .value = 3, .low = 0.5f, .high = 10, .format = "%.1f kg", .logarithmic = true},
                   {.name = "overlap", .value = 0.4f, .low = 0.05f, .high = 0.8f, .format = "%.2f m"},
                   {.name = "stiffness", .value = 60, .low = 2, .high = 60, .format = "%.0f /s", .logarithmic = true},
                   {.name = "push", .value = 3, .low = 0.2f, .high = 60, .format = "%.1f m/s", .logarithmic = true}})
    {
        for (Control& c : controls())
            c.restarts = true;
    }

    void build() override
    {
        begin({.gravity = {0, 0}, .contact_hertz = control("stiffness"), .contact_push_speed = control("push"), .sleeping = false});
        m_start[0] = {left - static_cast<double>(half - 0.5f * control("overlap")), middle_y};
        m_start[1] = {left + static_cast<double>(half - 0.5f * control("overlap")), middle_y};
        m_pair[0] = block(m_start[0], control("mass 1"));
        m_pair[1] = block(m_start[1], control("mass 2"));
        const BodyId floor = scene().create_body({});
        scene().create_shape(floor, Segment{.a = {0.2f, 0}, .b = {4.4f, 0}, .half_thickness = 0.05f});
        for (int i = 0; i < pile; ++i)
            m_pile[static_cast<std::size_t>(i)] = block({2.3, 0.05 + static_cast<double>(half) * (2 * i + 1)}, 4 * half * half);
        m_overlap.values.clear();
        m_sag.values.clear();
        m_overlap.add(control("overlap"), window_steps);
        m_sag.add(0, window_steps);
    }

    void step() override
    {
        for (const BodyId body : m_pile)
            scene().body(body).apply_force({0, -9.81f * scene().body(body).mass()}, scene().body(body).center_of_mass());
        Chapter::step();
        m_overlap.add(overlap(), window_steps);
        m_sag.add(1000 * sag(), window_steps);
    }

    [[nodiscard]] bool has_struck() const override { return !scene().contact_ends().empty(); }
    [[nodiscard]] bool is_over() const override { return scene().time() > 4; }
    [[nodiscard]] int picture_steps() const override { return 40; }
    [[nodiscard]] Box view() const override { return {{-4.6, -0.5}, {4.6, 8.0}}; }

    [[nodiscard]] Values values() const override
    {
        const float m1 = control("mass 1");
        const float m2 = control("mass 2");
        return {{"m1", view::number(m1)},
                {"m2", view::number(m2)},
                {"share1", view::number(100 * m2 / (m1 + m2))},
                {"share2", view::number(100 * m1 / (m1 + m2))},
                {"way1", view::number(shift(0))},
                {"way2", view::number(shift(1))},
                {"start", view::number(control("overlap"))},
                {"overlap", view::number(std::max(overlap(), 0.0f))},
                {"stiffness", view::number(control("stiffness"))},
                {"push", view::number(control("push"))},
                {"sag", view::number(1000 * sag())}};
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        view::draw_scene(canvas, scene(), alpha);
        for (std::size_t i = 0; i < 2; ++i)
        {
            const Position now = scene().body(m_pair[i]).position();
            view::draw_ghost(canvas, scene(), m_pair[i], {m_start[i], {}}, {faint, 1.2f});
            named_arrow(canvas, {m_start[i].x, middle_y + 1.0}, {static_cast<float>(now.x - m_start[i].x), 0}, "",
                        i == 0 ? first_color : second_color);
            label(canvas, now, std::to_string(i + 1) + ": " + view::number(control(i == 0 ? "mass 1" : "mass 2")) + " kg", view::rgb(0x10141c), 12);
        }
        const std::array<const Curve*, 1> overlaps{&m_overlap};
        draw_curves(canvas, {{-4.4, 4.6}, {-0.4, 6.4}}, word("overlap"), overlaps, window_steps * static_cast<double>(h()), window_steps);
        const std::array<const Curve*, 1> sags{&m_sag};
        draw_curves(canvas, {{-4.4, -0.2}, {-0.4, 1.5}}, word("sag"), sags, window_steps * static_cast<double>(h()), window_steps);
        label(canvas, {2.3, 7.5}, word("pile"), faint, 12);
    }

    [[nodiscard]] TableView table_view() const override { return {.contacts = true}; }

private:
    BodyId block(Position at, float mass)
    {
        const BodyId body = scene().create_body({.type = BodyType::Dynamic, .position = at});
        scene().create_shape(body, box(half, half), {.density = mass / (4 * half * half)});
        return body;
    }

    [[nodiscard]] float overlap() const
    {
        return 2 * half - static_cast<float>(scene().body(m_pair[1]).position().x - scene().body(m_pair[0]).position().x);
    }
    [[nodiscard]] float shift(std::size_t i) const { return std::abs(static_cast<float>(scene().body(m_pair[i]).position().x - m_start[i].x)); }
    // How much lower the top of the pile is than it would be of hard boxes.
    [[nodiscard]] float sag() const
    {
        return static_cast<float>(0.05 + static_cast<double>(half) * (2 * pile - 1) - scene().body(m_pile[pile - 1]).position().y);
    }

    std::array<BodyId, 2> m_pair{};
    std::array<Position, 2> m_start{};
    std::array<BodyId, pile> m_pile{};
    Curve m_overlap{first_color};
    Curve m_sag{second_color};
};

} // namespace

std::unique_ptr<Chapter> sinking_in() { return std::make_unique<SinkingIn>(); }

} // namespace carom::tour
