// Plane and circle, plane and box, two circles, circle and box, two boxes: how each is found, drawn as it is computed.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "tour/chapters/school_geometry.h"
#include "view/shape_art.h"

#include <algorithm>
#include <array>
#include <string>

namespace carom::tour {
namespace {


class FivePairs : public Chapter
{
    static constexpr int pairs = 5;
    static constexpr std::array<const char*, pairs> pair_words{"plane and circle", "plane and box", "two circles", "circle and box", "two boxes"};
    static constexpr std::array<const char*, pairs> pair_sums{"sum 1", "sum 2", "sum 3", "sum 4", "sum 5"};
    static constexpr float radius = 0.7f;
    static constexpr Vec2 half{0.9f, 0.6f};

public:
    FivePairs()
        : Chapter("03-five-pairs",
                  {{.name = "pair", .value = 1, .low = 1, .high = pairs, .format = "%.0f", .is_whole = true, .restarts = true},
                   {.name = "turn", .value = 0.5f, .low = -1.6f, .high = 1.6f, .format = "%.2f rad"}})
    {}

    void build() override
    {
        begin({.gravity = {0, 0}, .sleeping = false});
        switch (pair())
        {
        case 0: add(HalfSpace{.normal = slope}, {0, -1}, 0), add(Circle{.radius = radius}, {0.4, 0.2}, 0); break;
        case 1: add(HalfSpace{.normal = slope}, {0, -1}, 0), add(box(half.x, half.y), {0.3, 0.4}, control("turn")); break;
        case 2: add(Circle{.radius = 0.9f}, {-0.6, 0}, 0), add(Circle{.radius = radius}, {1.0, 0.7}, 0); break;
        case 3: add(box(half.x, half.y), {-0.6, 0}, control("turn")), add(Circle{.radius = radius}, {1.0, 0.6}, 0); break;
        default: add(box(half.x, half.y), {-0.8, -0.1}, 0), add(box(0.8f, 0.8f), {0.8, 0.4}, control("turn")); break;
        }
    }

    void step() override {}
    [[nodiscard]] bool is_still() const override { return true; }
    [[nodiscard]] bool is_moved_by_hand() const override { return true; }
    [[nodiscard]] int picture_steps() const override { return 0; }
    [[nodiscard]] Box view() const override { return {{-4.2, -3.4}, {4.2, 3.2}}; }

    void moved() override
    {
        const std::size_t turned = pair() == 3 ? 0 : 1;
        if (pair() != 0 && pair() != 2)
            scene().body(m_bodies[turned]).teleport(scene().body(m_bodies[turned]).position(), control("turn"));
    }

    [[nodiscard]] Values values() const override
    {
        Values values{{"pair", std::to_string(pair() + 1)},
                      {"name", word(pair_words[static_cast<std::size_t>(pair())])},
                      {"hx", view::number(half.x)},
                      {"hy", view::number(half.y)},
                      {"here", ""},
                      {"sum", ""},
                      {"result", ""}};
        const Found found = find();
        for (const auto& [name, value] : found.numbers)
            values[name] = name == "axis" ? whole(value) : fixed(value);
        values["sum"] = filled(word(pair_sums[static_cast<std::size_t>(pair())]), values);
        if (pair() == 3)
            values["here"] = filled(word("here"), values);
        values["result"] = filled(word(found.gap > 0 ? "apart" : "overlap"), {{"gap", fixed(std::abs(found.gap))}});
        return values;
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        view::draw_scene(canvas, scene(), alpha, quiet_palette());
        const Found found = find();
        for (const auto& [from, to, color, width] : found.lines)
            canvas.line(from, to, {color, width});
        for (const auto& [at, name, color] : found.marks)
        {
            canvas.fill_circle(at, canvas.camera().meters(3.5f), color);
            label(canvas, at + Vec2{0, canvas.camera().meters(14)}, name, color, 12);
        }
        for (const auto& [at, name, color] : found.names)
            label(canvas, at, name, color, 13);
        for (const auto& [from, way, name] : found.arrows)
            named_arrow(canvas, from, way, name, yellow);
        for (const ContactInfo& contact : scene().body(m_bodies[1]).touches_now())
        {
            for (int i = 0; i < contact.point_count; ++i)
            {
                canvas.stroke_circle(contact.points[i].position, canvas.camera().meters(6), {bad_color, 2});
                const bool turned = scene().shape(contact.shape_a).body() == m_bodies[1];
                named_arrow(canvas, contact.points[i].position, contact.normal * (turned ? -0.7f : 0.7f), i == 0 ? word("normal") : "",
                            yellow);
            }
        }
    }

    [[nodiscard]] TableView table_view() const override { return {.contacts = true}; }

private:
    struct Line
    {
        Position from;
        Position to;
        view::Color color;
        float width = 2;
    };
    struct Mark
    {
        Position at;
        std::string name;
        view::Color color;
    };
    struct Arrow
    {
        Position from;
        Vec2 way;
        std::string name;
    };
    struct Found
    {
        float gap = 0; ///< m; negative: they overlap
        std::vector<std::pair<std::string, float>> numbers{};
        std::vector<Line> lines{};
        std::vector<Mark> marks{};
        std::vector<Mark> names{}; ///< without a dot
        std::vector<Arrow> arrows{};
    };
    static constexpr Vec2 slope{-0.196116f, 0.980581f};

    [[nodiscard]] int pair() const { return static_cast<int>(control("pair")) - 1; }

    void add(const Geometry& geometry, Position at, float angle)
    {
        const bool is_plane = std::holds_alternative<HalfSpace>(geometry);
        const BodyId body =
            scene().create_body({.type = is_plane ? BodyType::Static : BodyType::Dynamic, .position = at, .angle = angle});
        scene().create_shape(body, geometry);
        m_bodies[m_next++ % 2] = body;
    }

    [[nodiscard]] Pose pose(std::size_t i) const { return scene().body(m_bodies[i]).pose(); }

    [[nodiscard]] Found find() const
    {
        switch (pair())
        {
        case 0: return plane_circle();
        case 1: return plane_box();
        case 2: return two_circles();
        case 3: return circle_box();
        default: return two_boxes();
        }
    }

    [[nodiscard]] Found plane_circle() const
    {
        const Position center = pose(1).position;
        const float distance = school::above_plane(center, pose(0).position, slope);
        Found found{.gap = distance - radius, .numbers = {{"d", distance}, {"r", radius}, {"gap", distance - radius}}};
        const Position foot = center - slope * distance;
        // Beside each other, so that their lengths can be compared.
        const Vec2 beside = 0.12f * perp(slope);
        found.lines = {{foot, center, first_color}, {center - beside, center - beside - slope * radius, second_color}};
        found.marks = {{center, "c", first_color}, {foot, "", ink}};
        found.names = {{foot - slope * 0.22f, word("foot"), ink},
                       {center - slope * (0.5f * distance) + beside * 1.6f, "d", first_color},
                       {center - slope * (0.5f * radius) - beside * 2.6f, "r", second_color}};
        if (distance > radius)
        {
            found.lines.push_back({center - beside - slope * radius, foot - beside, good_color});
            found.names.push_back({foot + slope * (0.5f * (distance - radius)) - beside * 4, word("gap"), good_color});
        }
        const Position stands = foot + perp(slope) * 1.8f;
        found.arrows = {{stands, slope, "n"}};
        return found;
    }

    [[nodiscard]] Found plane_box() const
    {
        Found found{.gap = 1e9f};
        const auto corners = school::corners(pose(1), half);
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
            const float d = school::above_plane(corners[i], pose(0).position, slope);
            found.gap = std::min(found.gap, d);
            found.lines.push_back({corners[i] - slope * d, corners[i], d < 0 ? bad_color : faint});
            found.marks.push_back({corners[i], view::number(d), d < 0 ? bad_color : first_color});
        }
        found.numbers = {{"gap", found.gap}};
        return found;
    }

    [[nodiscard]] Found two_circles() const
    {
        const Position a = pose(0).position;
        const Position b = pose(1).position;
        const float distance = length(b - a);
        Found found{.gap = distance - 0.9f - radius, .numbers = {{"d", distance}, {"r1", 0.9f}, {"r2", radius}, {"gap", distance - 0.9f - radius}}};
        found.lines = {{a, b, first_color}};
        const Vec2 way = normalize(b - a);
        const Vec2 beside = 0.1f * perp(way);
        found.lines.push_back({a - beside, a - beside + way * 0.9f, second_color});
        found.lines.push_back({b - beside, b - beside - way * radius, second_color});
        found.marks = {{a, "c₁", first_color}, {b, "c₂", first_color}};
        found.names = {{a + 0.5f * (b - a) + beside * 2, "d", first_color},
                       {a + way * 0.45f - beside * 2.4f, "r₁", second_color},
                       {b - way * (0.5f * radius) - beside * 2.4f, "r₂", second_color}};
        return found;
    }

    [[nodiscard]] Found circle_box() const
    {
        const school::Nearest nearest = school::nearest_in_box(pose(1).position, pose(0), half);
        Found found{.gap = nearest.distance - radius,
                    .numbers = {{"x", nearest.local.x}, {"y", nearest.local.y}, {"cx", nearest.clamped.x}, {"cy", nearest.clamped.y},
                                {"d", nearest.distance}, {"r", radius}, {"gap", nearest.distance - radius}}};
        const Position closest = transform(pose(0), nearest.clamped);
        found.lines = {{closest, pose(1).position, first_color}};
        found.lines.push_back({pose(0).position, transform(pose(0), {half.x, 0}), second_color});
        found.lines.push_back({pose(0).position, transform(pose(0), {0, half.y}), second_color});
        found.marks = {{pose(1).position, "c", first_color}, {closest, "", second_color}};
        const Vec2 away = normalize(pose(1).position - closest);
        found.names = {{closest - perp(away) * 0.4f + away * 0.35f, word("nearest"), second_color},
                       {transform(pose(0), {half.x * 0.5f, 0.14f}), view::number(half.x), second_color},
                       {transform(pose(0), {-0.3f, half.y * 0.6f}), view::number(half.y), second_color},
                       {closest + 0.5f * (pose(1).position - closest) + perp(away) * 0.15f, "d", first_color}};
        return found;
    }

    // The shadows of both boxes on the four directions of their sides; the one with the least overlap decides.
    [[nodiscard]] Found two_boxes() const
    {
        const Vec2 other{0.8f, 0.8f};
        const std::array<Vec2, 4> axes{school::axis(pose(0), 0), school::axis(pose(0), 1), school::axis(pose(1), 0), school::axis(pose(1), 1)};
        Found found{.gap = -1e9f};
        std::size_t best = 0;
        for (std::size_t i = 0; i < axes.size(); ++i)
        {
            const float gap = school::gap_along(axes[i], pose(0), half, pose(1), other);
            found.numbers.emplace_back("gap" + std::to_string(i + 1), gap);
            if (gap > found.gap)
            {
                found.gap = gap;
                best = i;
            }
        }
        found.numbers.emplace_back("axis", static_cast<float>(best + 1));
        found.numbers.emplace_back("gap", found.gap);
        add_outline(found, pose(0), half, first_color);
        add_outline(found, pose(1), other, second_color);
        for (std::size_t i = 0; i < axes.size(); ++i)
            add_shadows(found, axes[i], i, other, i == best);
        return found;
    }

    static void add_outline(Found& found, const Pose& pose, Vec2 half_size, view::Color color)
    {
        const auto corners = school::corners(pose, half_size);
        for (std::size_t i = 0; i < corners.size(); ++i)
            found.lines.push_back({corners[i], corners[(i + 1) % corners.size()], color});
    }

    // Each pair of shadows on a side of its own: below, on the left, above, on the right. Where both lie, the line is red.
    void add_shadows(Found& found, Vec2 axis, std::size_t number, Vec2 other, bool is_best) const
    {
        static constexpr std::array<float, 4> offsets{-2.5f, 3.1f, 2.35f, -2.95f};
        const Vec2 side = perp(axis);
        const Position origin = Position{0, 0} + side * offsets[number];
        const auto [low_a, high_a] = school::shadow(axis, pose(0), half);
        const auto [low_b, high_b] = school::shadow(axis, pose(1), other);
        const float strength = is_best ? 1 : 0.55f;
        found.lines.push_back({origin + axis * low_a, origin + axis * high_a, fade(first_color, strength), 5});
        found.lines.push_back({origin + axis * low_b, origin + axis * high_b, fade(second_color, strength), 5});
        const float low = std::max(low_a, low_b);
        const float high = std::min(high_a, high_b);
        if (low < high)
            found.lines.push_back({origin + axis * low, origin + axis * high, bad_color, is_best ? 9.0f : 6.0f});
        found.names.push_back({origin + axis * (0.5f * (low + high)) + side * (number % 2 == 0 ? 0.24f : 0.34f),
                               std::to_string(number + 1) + ": " + fixed(low - high, 2), is_best ? yellow : faint});
    }

    std::array<BodyId, 2> m_bodies{};
    std::size_t m_next = 0;
};

} // namespace

std::unique_ptr<Chapter> five_pairs() { return std::make_unique<FivePairs>(); }

} // namespace carom::tour
