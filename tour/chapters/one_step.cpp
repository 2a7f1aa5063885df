// The work of an engine, sixty times a second: the stages of a step, each drawn on the scene that is running, and the path of a thrown ball.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"
#include "view/xray.h"

#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <string>

namespace carom::tour {
namespace {


class OneStep : public Chapter
{
    static constexpr int stages = 7;
    static constexpr std::array<const char*, stages> stage_words{"sweep", "pairs", "contacts", "islands", "solve", "commit", "events"};
    static constexpr float seconds = 3.2f;

public:
    OneStep()
        : Chapter("01-one-step", {{.name = "steps", .value = 60, .low = 5, .high = 240, .format = "%.0f", .is_whole = true, .restarts = true, .logarithmic = true},
                                  {.name = "stage", .value = 1, .low = 1, .high = stages, .format = "%.0f", .is_whole = true}})
    {}

    void build() override
    {
        begin({.sleeping = false});
        const BodyId floor = scene().create_body({});
        scene().create_shape(floor, Segment{.a = {-5, 0}, .b = {5, 0}, .half_thickness = 0.05f}, {.restitution = 0.4f});
        for (int i = 0; i < 3; ++i)
        {
            const BodyId block = scene().create_body({.type = BodyType::Dynamic, .position = {2.2, 0.45 + 0.8 * i}});
            scene().create_shape(block, box(0.4f, 0.4f), {.density = 0.5f, .restitution = 0.2f});
        }
        m_ball = scene().create_body({.type = BodyType::Dynamic, .position = {-3.6, 1.6}, .velocity = {4.5f, 4.2f}});
        scene().create_shape(m_ball, Circle{.radius = 0.3f}, {.density = 3, .restitution = 0.4f});
        m_trail.assign(1, scene().body(m_ball).position());
        m_free = {.y = 1.6, .v = 4.2f, .y_after = 1.6, .v_after = 4.2f};
        m_before.clear();
        m_flies = true;
    }

    [[nodiscard]] float h() const override { return 1 / control("steps"); }

    void step() override
    {
        m_before.clear();
        for (const BodyId body : scene().bodies())
            m_before[body] = scene().body(body).pose();
        const ConstBody ball = scene().body(m_ball);
        Free free{.y = ball.position().y, .v = ball.velocity().y};
        Chapter::step();
        free.y_after = ball.position().y;
        free.v_after = ball.velocity().y;
        m_trail.push_back(ball.position());
        const float g = scene().gravity().y;
        const bool is_free = std::abs(free.v_after - (free.v + g * h())) < 1e-3f;
        m_flies = m_flies && is_free;
        if (m_flies)
            m_free = free; // nothing but gravity acted on it
    }

    [[nodiscard]] bool is_over() const override { return scene().time() > static_cast<double>(seconds); }
    [[nodiscard]] int picture_steps() const override { return static_cast<int>(0.9f / h()); }
    [[nodiscard]] Box view() const override { return {{-4.4, -0.6}, {4.4, 4.6}}; }

    [[nodiscard]] Values values() const override
    {
        const float g = -scene().gravity().y;
        return {{"steps", whole(control("steps"))},
                {"h", fixed(h(), 4)},
                {"g", view::number(g)},
                {"v", fixed(m_free.v)},
                {"v after", fixed(m_free.v_after)},
                {"y", fixed(static_cast<float>(m_free.y))},
                {"y after", fixed(static_cast<float>(m_free.y_after))},
                {"stage", std::to_string(stage() + 1)},
                {"name", word(stage_words[static_cast<std::size_t>(stage())])}};
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        view::draw_scene(canvas, scene(), alpha);
        const float dot = canvas.camera().meters(2.2f);
        for (const Position p : m_trail)
            canvas.fill_circle(p, dot, ink);
        draw_stage(canvas);
        draw_row(canvas);
    }

    [[nodiscard]] TableView table_view() const override { return {.contacts = true, .boxes = true, .islands = true}; }

private:
    struct Free
    {
        double y = 0;
        float v = 0;
        double y_after = 0;
        float v_after = 0;
    };

    [[nodiscard]] int stage() const { return static_cast<int>(control("stage")) - 1; }

    void draw_stage(view::Canvas& canvas) const
    {
        view::XrayToggles show{.outlines = false,
                               .triggers = false,
                               .joints = false,
                               .contacts = false,
                               .normals = false,
                               .impulses = false,
                               .velocities = false,
                               .velocity_time = 0.15f};
        switch (stage())
        {
        case 0: show.boxes = true; break;
        case 1:
            show.boxes = true;
            draw_pairs(canvas);
            break;
        case 2: show.contacts = show.normals = true; break;
        case 3: show.islands = true; break;
        case 4: show.impulses = show.velocities = true; break;
        case 5: draw_ghosts(canvas); break;
        default: draw_events(canvas); break;
        }
        m_xray.toggles = show;
        m_xray.draw(canvas, scene());
    }

    // The contacts of bodies that may meet in the step.
    void draw_pairs(view::Canvas& canvas) const
    {
        for (const ContactInfo& contact : scene().contacts())
        {
            const ConstBody a = scene().body(scene().shape(contact.shape_a).body());
            const ConstBody b = scene().body(scene().shape(contact.shape_b).body());
            const Position from = a.type() == BodyType::Static ? Position{b.position().x, 0} : a.position();
            const Position to = b.type() == BodyType::Static ? Position{a.position().x, 0} : b.position();
            canvas.line(from, to, {yellow, 2.5f});
        }
    }

    void draw_ghosts(view::Canvas& canvas) const
    {
        for (const auto& [body, pose] : m_before)
        {
            view::draw_ghost(canvas, scene(), body, pose, {faint, 1.5f});
            const Position now = scene().body(body).position();
            named_arrow(canvas, pose.position, now - pose.position, "", good_color);
        }
    }

    void draw_events(view::Canvas& canvas) const
    {
        double y = 3.45;
        const auto line = [&](const std::string& text)
        {
            canvas.text({-4.2, y}, text, {.size = 13, .color = yellow, .shadow = view::rgb(0, 0.8f)});
            y -= static_cast<double>(canvas.camera().meters(18));
        };
        for (const ContactBeginEvent& e : scene().contact_begins())
            line(filled(word("begins"), {{"a", view::kind_name(scene(), e.shape_a)}, {"b", view::kind_name(scene(), e.shape_b)}}));
        for (const ImpactEvent& e : scene().impacts())
            line(filled(word("impact"), {{"a", view::kind_name(scene(), e.shape_a)},
                                         {"b", view::kind_name(scene(), e.shape_b)},
                                         {"j", view::number(e.impulse)}}));
        if (scene().contact_begins().empty() && scene().impacts().empty())
            line(word("no events"));
    }

    // The stages in their order, the chosen one lit.
    void draw_row(view::Canvas& canvas) const
    {
        const Box seen = canvas.camera().visible();
        const float pixel = canvas.camera().meters(1);
        const double width = (seen.upper.x - seen.lower.x) / stages;
        const bool roomy = width > static_cast<double>(74 * pixel);
        for (int i = 0; i < stages; ++i)
        {
            const Box box{{seen.lower.x + i * width + static_cast<double>(2 * pixel), seen.upper.y - static_cast<double>(30 * pixel)},
                          {seen.lower.x + (i + 1) * width - static_cast<double>(2 * pixel), seen.upper.y - static_cast<double>(6 * pixel)}};
            const bool chosen = i == stage();
            canvas.fill_box(box, chosen ? yellow : view::rgb(0x2a3550), 4 * pixel);
            const std::string text = roomy ? std::to_string(i + 1) + " " + word(stage_words[static_cast<std::size_t>(i)]) : std::to_string(i + 1);
            label(canvas, {(box.lower.x + box.upper.x) / 2, (box.lower.y + box.upper.y) / 2}, text,
                  chosen ? view::rgb(0x10141c) : ink, 12);
            if (chosen && !roomy)
                label(canvas, {(box.lower.x + box.upper.x) / 2, box.lower.y - static_cast<double>(10 * pixel)},
                      word(stage_words[static_cast<std::size_t>(i)]), yellow, 12);
        }
    }

    BodyId m_ball{};
    std::deque<Position> m_trail;
    std::map<BodyId, Pose> m_before;
    Free m_free{};
    bool m_flies = true;
    mutable view::XrayOverlay m_xray;
};

} // namespace

std::unique_ptr<Chapter> one_step() { return std::make_unique<OneStep>(); }

} // namespace carom::tour
