// n (n - 1) / 2 pairs against those that a tree of boxes finds.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"
#include "view/xray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

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
                   {.name = "boxes", .value = 1, .is_switch = true},
                   {.name = "tree", .value = 1, .is_switch = true}})
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
        const auto found = static_cast<std::ptrdiff_t>(scene().contacts().size());
        return {{"n", std::to_string(n)},
                {"all", std::to_string(n * (n - 1) / 2)},
                {"found", std::to_string(found)},
                {"walls", std::to_string(found - ball_pairs())},
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
        if (is_on("tree"))
            draw_tree(canvas);
        for (const ContactInfo& contact : scene().contacts())
        {
            const ConstBody a = scene().body(scene().shape(contact.shape_a).body());
            const ConstBody b = scene().body(scene().shape(contact.shape_b).body());
            canvas.line(end_of(a, b), end_of(b, a), {yellow, 3});
        }
    }

    [[nodiscard]] TableView table_view() const override { return {.boxes = true}; }

private:
    [[nodiscard]] int balls() const { return static_cast<int>(control("balls")); }

    [[nodiscard]] std::ptrdiff_t ball_pairs() const
    {
        const auto moves = [this](ShapeId shape) { return scene().body(scene().shape(shape).body()).type() == BodyType::Dynamic; };
        const std::vector<ContactInfo> contacts = scene().contacts();
        return std::ranges::count_if(contacts, [&](const ContactInfo& c) { return moves(c.shape_a) && moves(c.shape_b); });
    }

    // A ball's middle; of the walls, the place that is nearest to the other one.
    static Position end_of(const ConstBody& body, const ConstBody& other)
    {
        if (body.type() == BodyType::Dynamic)
            return body.position();
        const Position at = other.position();
        const double half = half_room;
        const double to_side = half - std::abs(at.x);
        const double to_end = half - std::abs(at.y);
        return to_side < to_end ? Position{std::copysign(half, at.x), at.y} : Position{at.x, std::copysign(half, at.y)};
    }

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

    // The first levels of a tree of this kind: halves of halves, along the longer side. The engine's own puts eight boxes into one.
    void draw_tree(view::Canvas& canvas) const
    {
        std::vector<Box> boxes;
        for (const BodyId body : scene().bodies())
        {
            if (scene().body(body).type() != BodyType::Dynamic)
                continue;
            const Position at = scene().body(body).position();
            const double r = static_cast<double>(std::get<Circle>(scene().shape(scene().body(body).shapes().front()).geometry()).radius);
            boxes.push_back({{at.x - r, at.y - r}, {at.x + r, at.y + r}});
        }
        draw_branch(canvas, boxes, 0);
    }

    static void draw_branch(view::Canvas& canvas, std::span<Box> boxes, int depth)
    {
        Box all = boxes.front();
        for (const Box& box : boxes)
        {
            all.lower = {std::min(all.lower.x, box.lower.x), std::min(all.lower.y, box.lower.y)};
            all.upper = {std::max(all.upper.x, box.upper.x), std::max(all.upper.y, box.upper.y)};
        }
        static constexpr std::array<view::Color, 3> colors{second_color, view::rgb(0xc9a0ff), ink};
        const auto level = static_cast<std::size_t>(depth);
        const double more = static_cast<double>(canvas.camera().meters(9 - 3 * static_cast<float>(depth)));
        canvas.stroke_box({{all.lower.x - more, all.lower.y - more}, {all.upper.x + more, all.upper.y + more}},
                          {fade(colors[level], 0.8f), 1.8f}, canvas.camera().meters(4));
        if (level + 1 == colors.size() || boxes.size() <= 3)
            return;
        const bool wide = all.upper.x - all.lower.x > all.upper.y - all.lower.y;
        const auto middle = boxes.begin() + static_cast<std::ptrdiff_t>(boxes.size() / 2);
        std::nth_element(boxes.begin(), middle, boxes.end(),
                         [wide](const Box& a, const Box& b) { return wide ? a.lower.x < b.lower.x : a.lower.y < b.lower.y; });
        draw_branch(canvas, boxes.first(boxes.size() / 2), depth + 1);
        draw_branch(canvas, boxes.subspan(boxes.size() / 2), depth + 1);
    }

    mutable view::XrayOverlay m_xray;
};

} // namespace

std::unique_ptr<Chapter> too_many_pairs() { return std::make_unique<TooManyPairs>(); }

} // namespace carom::tour
