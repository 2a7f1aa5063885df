// A pile: sub-steps, islands, sleep, and what happens without them.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"
#include "view/xray.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace carom::tour {
namespace {


class ManyAtOnce : public Chapter
{
    static constexpr int towers = 3;
    static constexpr int heights = 7;
    static constexpr float half = 0.3f;

public:
    ManyAtOnce()
        : Chapter("11-many-at-once", {{.name = "substeps", .value = 4, .low = 1, .high = 8, .format = "%.0f", .is_whole = true, .restarts = true},
                                      {.name = "remember", .value = 1, .is_switch = true, .restarts = true},
                                      {.name = "sleep", .value = 1, .is_switch = true, .restarts = true},
                                      {.name = "islands", .value = 1, .is_switch = true}})
    {}

    void build() override
    {
        build_world();
        m_sink.values.clear();
    }

    void step() override
    {
        if (!is_on("remember"))
            forget();
        Chapter::step();
        m_sink.add(1000 * sink());
    }

    [[nodiscard]] bool has_struck() const override { return scene().report().slept > 0 || scene().report().woken > 0; }
    [[nodiscard]] int picture_steps() const override { return 40; }
    [[nodiscard]] Box view() const override { return {{-4.6, -1.9}, {4.6, 5.2}}; }

    [[nodiscard]] Values values() const override
    {
        const StepReport& r = scene().report();
        return {{"substeps", whole(control("substeps"))},
                {"bodies", std::to_string(towers * heights)},
                {"contacts", std::to_string(r.touching)},
                {"awake", std::to_string(r.awake_bodies)},
                {"units", std::to_string(r.units)},
                {"sink", view::number(1000 * sink())}};
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        view::draw_scene(canvas, scene(), alpha);
        if (is_on("islands"))
        {
            m_xray.toggles = {.outlines = false, .contacts = false, .normals = false, .impulses = false, .velocities = false, .islands = true};
            m_xray.draw(canvas, scene());
        }
        for (int tower = 0; tower < towers; ++tower)
            label(canvas, scene().body(m_blocks[static_cast<std::size_t>((tower + 1) * heights - 1)]).interpolated_pose(alpha).position,
                  word("heavy"), view::rgb(0x10141c), 11);
        const std::array<const Curve*, 1> curves{&m_sink};
        draw_curves(canvas, {{-4.5, -1.8}, {4.5, -0.25}}, word("sink"), curves);
    }

    [[nodiscard]] TableView table_view() const override { return {.contacts = true, .islands = true}; }

private:
    void build_world()
    {
        begin({.substeps = static_cast<int>(control("substeps")), .sleeping = is_on("sleep")});
        const BodyId floor = scene().create_body({});
        scene().create_shape(floor, Segment{.a = {-5, 0}, .b = {5, 0}, .half_thickness = 0.05f});
        for (int i = 0; i < towers * heights; ++i)
        {
            const Position at{-2.7 + 2.7 * (i / heights), 0.05 + static_cast<double>(half) * (2 * (i % heights) + 1)};
            const BodyId block = scene().create_body({.type = BodyType::Dynamic, .position = at});
            const bool is_top = (i + 1) % heights == 0; // it is heavy
            scene().create_shape(block, box(half, half), {.density = is_top ? 12.0f : 1.0f});
            m_blocks[static_cast<std::size_t>(i)] = block;
        }
    }

    // A new world in each step, of places and velocities alone: no contact knows what it bore.
    void forget()
    {
        struct State
        {
            Position position;
            float angle;
            Vec2 velocity;
            float angular_velocity;
        };
        std::vector<State> states;
        for (const BodyId block : m_blocks)
        {
            const ConstBody b = scene().body(block);
            states.push_back({b.position(), b.angle(), b.velocity(), b.angular_velocity()});
        }
        build_world();
        for (std::size_t i = 0; i < states.size(); ++i)
        {
            Body b = scene().body(m_blocks[i]);
            b.teleport(states[i].position, states[i].angle);
            b.set_velocity(states[i].velocity);
            b.set_angular_velocity(states[i].angular_velocity);
        }
    }

    [[nodiscard]] float sink() const
    {
        const double full = 0.05 + static_cast<double>(half) * (2 * heights - 1);
        double most = 0;
        for (int tower = 0; tower < towers; ++tower)
        {
            const BodyId top = m_blocks[static_cast<std::size_t>((tower + 1) * heights - 1)];
            most = std::max(most, full - scene().body(top).position().y);
        }
        return static_cast<float>(most);
    }

    std::array<BodyId, towers * heights> m_blocks{};
    Curve m_sink{second_color};
    mutable view::XrayOverlay m_xray;
};

} // namespace

std::unique_ptr<Chapter> many_at_once() { return std::make_unique<ManyAtOnce>(); }

} // namespace carom::tour
