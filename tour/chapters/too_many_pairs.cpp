// n (n - 1) / 2 pairs against those that a tree of boxes finds.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"
#include "view/xray.h"

#include <cmath>
#include <string>

namespace carom::tour {
namespace {


class TooManyPairs : public Chapter
{
    static constexpr float half_room = 4;

public:
    TooManyPairs()
        : Chapter("08-too-many-pairs",
                  {{.name = "balls", .value = 40, .low = 2, .high = 400, .format = "%.0f", .is_whole = true, .restarts = true, .logarithmic = true},
                   {.name = "all pairs", .is_switch = true},
                   {.name = "boxes", .value = 1, .is_switch = true}})
    {}

    void build() override
    {
        begin({.gravity = {0, 0}, .length_scale = 0.3f, .sleeping = false});
        const BodyId walls = scene().create_body({});
        scene().create_shape(walls,
                             Chain{.start = {-half_room, -half_room},
                                   .pieces = {{{half_room, -half_room}}, {{half_room, half_room}}, {{-half_room, half_room}}},
                                   .closed = true},
                             {.friction = 0, .restitution = 1});
        const int n = balls();
        const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(n))));
        const float pitch = 2 * half_room / static_cast<float>(columns);
        const float radius = std::min(0.22f, 0.3f * pitch);
        for (int i = 0; i < n; ++i)
        {
            const float turn = 2.4f * static_cast<float>(i); // all directions alike
            const BodyId ball =
                scene().create_body({.type = BodyType::Dynamic,
                                     .position = Vec2{-half_room + pitch * (static_cast<float>(i % columns) + 0.5f),
                                                      -half_room + pitch * (static_cast<float>(i / columns) + 0.5f)},
                                     .velocity = {1.5f * std::cos(turn), 1.5f * std::sin(turn)}});
            scene().create_shape(ball, Circle{.radius = radius}, {.friction = 0, .restitution = 1});
        }
    }

    [[nodiscard]] Box view() const override { return {{-4.15, -4.15}, {4.15, 4.15}}; }

    [[nodiscard]] Values values() const override
    {
        const int n = balls();
        const int found = scene().report().pairs;
        return {{"n", std::to_string(n)},
                {"all", std::to_string(n * (n - 1) / 2)},
                {"found", std::to_string(found)},
                {"touching", std::to_string(scene().report().touching)}};
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        view::draw_scene(canvas, scene(), alpha);
        if (is_on("all pairs"))
            draw_all(canvas);
        if (is_on("boxes"))
        {
            m_xray.toggles = {.outlines = false, .contacts = false, .normals = false, .impulses = false, .velocities = false, .boxes = true};
            m_xray.draw(canvas, scene());
        }
        for (const ContactInfo& contact : scene().contacts())
        {
            const ConstBody a = scene().body(scene().shape(contact.shape_a).body());
            const ConstBody b = scene().body(scene().shape(contact.shape_b).body());
            if (a.type() == BodyType::Dynamic && b.type() == BodyType::Dynamic)
                canvas.line(a.position(), b.position(), {yellow, 3});
        }
    }

    [[nodiscard]] TableView table_view() const override { return {.boxes = true}; }

private:
    [[nodiscard]] int balls() const { return static_cast<int>(control("balls")); }

    void draw_all(view::Canvas& canvas) const
    {
        const std::vector<BodyId> all = scene().bodies();
        const float strength = std::clamp(30.0f / static_cast<float>(all.size()), 0.03f, 0.5f);
        for (std::size_t i = 0; i < all.size(); ++i)
        {
            for (std::size_t j = i + 1; j < all.size(); ++j)
            {
                if (scene().body(all[i]).type() == BodyType::Dynamic)
                    canvas.line(scene().body(all[i]).position(), scene().body(all[j]).position(), {fade(bad_color, strength), 1});
            }
        }
    }

    mutable view::XrayOverlay m_xray;
};

} // namespace

std::unique_ptr<Chapter> too_many_pairs() { return std::make_unique<TooManyPairs>(); }

} // namespace carom::tour
