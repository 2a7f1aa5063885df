// A pile: sub-steps, islands, sleep, and what happens without them.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"
#include "view/xray.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace carom::tour {
namespace {


class ManyAtOnce : public Chapter
{
    static constexpr int towers = 3;
    static constexpr int heights = 7;
    static constexpr float half = 0.3f;
    static constexpr float heavy = 12; ///< the top block, over the others
    static inline const SceneDef plain_def{.substeps = 1, .sleeping = false};

public:
    ManyAtOnce()
        : Chapter("11-many-at-once", {{.name = "substeps", .value = 4, .low = 1, .high = 8, .format = "%.0f", .is_whole = true, .restarts = true},
                                      {.name = "remember", .value = 1, .is_switch = true, .restarts = true},
                                      {.name = "sleep", .value = 1, .is_switch = true, .restarts = true},
                                      {.name = "islands", .value = 1, .is_switch = true}})
    {}

    void build() override
    {
        begin(def());
        m_blocks = add_towers(scene(), towers);
        m_plain = std::make_unique<Scene>(plain_def);
        m_plain_blocks = add_towers(*m_plain, 1);
        for (Curve* curve : {&m_sink, &m_plain_sink})
            curve->values.clear();
    }

    void step() override
    {
        if (!is_on("remember"))
        {
            const std::vector<State> states = states_of(scene(), m_blocks);
            begin(def());
            m_blocks = add_towers(scene(), towers);
            put(scene(), m_blocks, states);
        }
        Chapter::step();
        m_sink.add(1000 * sink(scene(), m_blocks));
        step_plain();
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
                {"islands", std::to_string(r.islands)},
                {"heavy", whole(heavy)},
                {"sink", view::number(1000 * sink(scene(), m_blocks))},
                {"plain", view::number(1000 * sink(*m_plain, m_plain_blocks))}};
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
        const std::array<const Curve*, 2> curves{&m_plain_sink, &m_sink};
        draw_curves(canvas, {{-4.5, -1.8}, {4.5, -0.25}}, word("sink"), curves, 240 * static_cast<double>(h()));
    }

    [[nodiscard]] TableView table_view() const override { return {.contacts = true, .islands = true}; }

private:
    struct State
    {
        Position position;
        float angle;
        Vec2 velocity;
        float angular_velocity;
    };

    [[nodiscard]] SceneDef def() const
    {
        return {.substeps = static_cast<int>(control("substeps")), .sleeping = is_on("sleep")};
    }

    static std::vector<BodyId> add_towers(Scene& scene, int count)
    {
        const BodyId floor = scene.create_body({});
        scene.create_shape(floor, Segment{.a = {-5, 0}, .b = {5, 0}, .half_thickness = 0.05f});
        std::vector<BodyId> blocks;
        for (int i = 0; i < count * heights; ++i)
        {
            const Position at{-2.7 + 2.7 * (i / heights), 0.05 + static_cast<double>(half) * (2 * (i % heights) + 1)};
            blocks.push_back(scene.create_body({.type = BodyType::Dynamic, .position = at}));
            const bool is_top = (i + 1) % heights == 0;
            scene.create_shape(blocks.back(), box(half, half), {.density = is_top ? heavy : 1.0f});
        }
        return blocks;
    }

    // To forget: a new world in each step, of places and velocities alone. No contact knows what it bore.
    static std::vector<State> states_of(const Scene& scene, const std::vector<BodyId>& blocks)
    {
        std::vector<State> states;
        for (const BodyId block : blocks)
        {
            const ConstBody b = scene.body(block);
            states.push_back({b.position(), b.angle(), b.velocity(), b.angular_velocity()});
        }
        return states;
    }

    static void put(Scene& scene, const std::vector<BodyId>& blocks, const std::vector<State>& states)
    {
        for (std::size_t i = 0; i < states.size(); ++i)
        {
            Body b = scene.body(blocks[i]);
            b.teleport(states[i].position, states[i].angle);
            b.set_velocity(states[i].velocity);
            b.set_angular_velocity(states[i].angular_velocity);
        }
    }

    // A tower without the tricks, for comparison.
    void step_plain()
    {
        const std::vector<State> states = states_of(*m_plain, m_plain_blocks);
        m_plain = std::make_unique<Scene>(plain_def);
        m_plain_blocks = add_towers(*m_plain, 1);
        put(*m_plain, m_plain_blocks, states);
        m_plain->step(h());
        m_plain_sink.add(1000 * sink(*m_plain, m_plain_blocks));
    }

    static float sink(const Scene& scene, const std::vector<BodyId>& blocks)
    {
        const double full = 0.05 + static_cast<double>(half) * (2 * heights - 1);
        double most = 0;
        for (std::size_t top = heights - 1; top < blocks.size(); top += heights)
            most = std::max(most, full - scene.body(blocks[top]).position().y);
        return static_cast<float>(most);
    }

    std::vector<BodyId> m_blocks{};
    std::unique_ptr<Scene> m_plain{};
    std::vector<BodyId> m_plain_blocks{};
    Curve m_sink{second_color};
    Curve m_plain_sink{faint};
    mutable view::XrayOverlay m_xray;
};

} // namespace

std::unique_ptr<Chapter> many_at_once() { return std::make_unique<ManyAtOnce>(); }

} // namespace carom::tour
