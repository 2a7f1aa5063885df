// A ball strikes a box: how heavy each feels where it is hit, how fast they approach, and what follows.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/impact_panel.h"
#include "view/shape_art.h"

#include <cmath>

namespace carom::tour {
namespace {


class TheBlow : public Chapter
{
    static constexpr float ball_radius = 0.3f;
    static constexpr Vec2 half_box{0.35f, 1.0f};
    static constexpr int most_steps = 200;

public:
    TheBlow()
        : Chapter("04-the-blow", {{.name = "e", .value = 0.8f},
                                  {.name = "mass 1", .value = 1, .low = 0.2f, .high = 10, .format = "%.1f kg", .logarithmic = true},
                                  {.name = "mass 2", .value = 2, .low = 0.2f, .high = 10, .format = "%.1f kg", .logarithmic = true},
                                  {.name = "height", .value = 0.6f, .low = -0.95f, .high = 0.95f, .format = "%.2f m"},
                                  {.name = "friction", .value = 0},
                                  {.name = "spin", .value = 0, .low = -40, .high = 40, .format = "%.0f rad/s"},
                                  {.name = "pivot", .is_switch = true}}),
          m_watch([this](const Scene& scene, ShapeId shape)
                  { return scene.shape(shape).body() == m_ball ? word("ball") : word("box"); })
    {
        for (Control& c : controls())
            c.restarts = true;
    }

    void build() override
    {
        begin({.gravity = {0, 0}, .sleeping = false});
        const float radius2 = ball_radius * ball_radius;
        const ShapeDef material{.friction = control("friction"), .restitution = control("e")};
        ShapeDef of_ball = material;
        of_ball.density = control("mass 1") / (pi * radius2);
        ShapeDef of_box = material;
        of_box.density = control("mass 2") / (4 * half_box.x * half_box.y);
        m_ball = scene().create_body(
            {.type = BodyType::Dynamic, .position = {-3, static_cast<double>(control("height"))}, .velocity = {4, 0}, .angular_velocity = control("spin")});
        scene().create_shape(m_ball, Circle{.radius = ball_radius}, of_ball);
        m_box = scene().create_body({.type = BodyType::Dynamic, .position = {0, 0}});
        scene().create_shape(m_box, box(half_box.x, half_box.y), of_box);
        if (is_on("pivot"))
            scene().create_joint(RevoluteDef{.body_b = m_box, .anchor_a = pivot, .anchor_b = pivot});
        m_watch.clear();
        m_steps = 0;
    }

    void step() override
    {
        Chapter::step();
        m_watch.observe(scene());
        ++m_steps;
    }

    [[nodiscard]] bool is_over() const override { return m_steps >= most_steps; }
    [[nodiscard]] int picture_steps() const override { return 36; }
    [[nodiscard]] Box view() const override { return {{-3.4, -2.3}, {3.4, 2.3}}; }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        view::draw_scene(canvas, scene(), alpha, quiet_palette());
        if (is_on("pivot"))
        {
            canvas.fill_circle(pivot, 0.07f, ink);
            label(canvas, Position(pivot) + Vec2{0, -0.25f}, word("pivot"), faint);
        }
        if (!m_watch.last())
            return;
        view::draw_impact(canvas, *m_watch.last());
        const float arm = view::lever_arm(m_watch.last()->b, m_watch.last()->event.effective_mass_b);
        if (arm > 0 && !is_on("pivot") && scene().time() - m_watch.last()->time < 0.2)
            draw_arm(canvas, m_watch.last()->event);
    }

    [[nodiscard]] std::vector<view::StoryLine> story() const override
    {
        if (!m_watch.last())
            return {{view::StoryLine::Kind::Text, word("nothing yet")}};
        return view::impact_story(*m_watch.last());
    }

    [[nodiscard]] TableView table_view() const override { return {.contacts = true}; }

private:
    // From the centre of the box, at a right angle to the line of the blow.
    void draw_arm(view::Canvas& canvas, const ImpactEvent& event) const
    {
        const Position center = scene().body(m_box).center_of_mass();
        const Position foot = event.point + event.normal * dot(center - event.point, event.normal);
        canvas.line(center, foot, {yellow, 2});
        canvas.fill_circle(center, canvas.camera().meters(3.5f), yellow);
        label(canvas, center + (foot - center) * 0.5f + Vec2{0.15f, 0}, "r", yellow);
    }

    static constexpr Vec2 pivot{0, -0.7f};

    BodyId m_ball{};
    BodyId m_box{};
    view::ImpactWatch m_watch;
    int m_steps = 0;
};

} // namespace

std::unique_ptr<Chapter> the_blow() { return std::make_unique<TheBlow>(); }

} // namespace carom::tour
