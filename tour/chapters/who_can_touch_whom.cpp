// The table of functions over pairs of shapes, and two shapes that light up their entry.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace carom::tour {
namespace {

constexpr int kinds = 6;
constexpr std::array<const char*, kinds> kind_names{"plane", "circle", "polygon", "capsule", "line", "arc"};

enum Function
{
    Never,
    RoundOnSurface,
    OnPlane,
    Outlines,
    OnArc,
};
constexpr std::array<const char*, 5> function_names{"never", "round on surface", "on plane", "outlines", "on arc"};
constexpr std::array<view::Color, 5> function_colors{view::rgb(0x2a3242), view::rgb(0xffa94d), view::rgb(0x69db7c), view::rgb(0x74c0fc),
                                                     view::rgb(0xda77f2)};

// As in the engine's table; true: the entry turns the roles round and calls the other one.
struct Entry
{
    Function function;
    bool is_mirrored;
};

constexpr Entry entry(int a, int b)
{
    constexpr int plane = 0;
    constexpr int circle = 1;
    constexpr int arc = 5;
    if ((a == plane || a == arc) && (b == plane || b == arc))
        return {Never, false};
    if (b == circle)
        return {RoundOnSurface, false};
    if (a == circle)
        return {RoundOnSurface, true};
    if (a == plane || b == plane)
        return {OnPlane, b == plane};
    if (a == arc || b == arc)
        return {OnArc, b == arc};
    return {Outlines, a > b};
}

Geometry geometry_of(int kind)
{
    switch (kind)
    {
    case 0: return HalfSpace{};
    case 1: return Circle{.radius = 0.8f};
    case 2: return Polygon{.vertices = {{-0.9f, -0.6f}, {0.9f, -0.6f}, {0.6f, 0.7f}, {-0.6f, 0.7f}}};
    case 3: return Capsule{.a = {-0.7f, 0}, .b = {0.7f, 0}, .radius_a = 0.5f, .radius_b = 0.35f};
    case 4: return Segment{.a = {-1, 0}, .b = {1, 0}, .half_thickness = 0.08f};
    default: return Arc{.radius = 1, .start_angle = 0.15f * pi, .sweep = 0.7f * pi, .half_thickness = 0.08f};
    }
}

class WhoCanTouchWhom : public Chapter
{
public:
    WhoCanTouchWhom()
        : Chapter("02-who-can-touch-whom",
                  {{.name = "first", .value = 2, .high = kinds - 1, .format = "%.0f", .is_whole = true, .restarts = true},
                   {.name = "second", .value = 1, .high = kinds - 1, .format = "%.0f", .is_whole = true, .restarts = true}})
    {}

    void build() override
    {
        begin({.gravity = {0, 0}, .sleeping = false});
        m_bodies = {add(kind(0), {-0.8, 2.3}), add(kind(1), {0.4, 2.9})};
    }

    void step() override {}
    [[nodiscard]] bool is_still() const override { return true; }
    [[nodiscard]] bool is_moved_by_hand() const override { return true; }
    [[nodiscard]] Box view() const override { return {{-4.6, -5.6}, {4.6, 5.2}}; }
    [[nodiscard]] int picture_steps() const override { return 0; }

    // A click on an entry chooses it.
    bool press(Position at) override
    {
        const auto column = static_cast<int>(std::floor((at.x - corner.x) / cell));
        const auto row = static_cast<int>(std::floor((corner.y - at.y) / cell));
        if (column < 0 || row < 0 || column >= kinds || row >= kinds)
            return false;
        controls()[0].value = static_cast<float>(row);
        controls()[1].value = static_cast<float>(column);
        build();
        return true;
    }

    [[nodiscard]] Values values() const override
    {
        const Entry e = entry(kind(0), kind(1));
        return {{"id1", std::to_string(kind(0))},
                {"id2", std::to_string(kind(1))},
                {"first", word(kind_names[static_cast<std::size_t>(kind(0))])},
                {"second", word(kind_names[static_cast<std::size_t>(kind(1))])},
                {"place", std::to_string(kind(0) * kinds + kind(1))},
                {"mirror", std::to_string(kind(1) * kinds + kind(0))},
                {"function", word(function_names[e.function])},
                {"roles", word(e.function == Never ? "nobody" : e.is_mirrored ? "turned" : "straight")}};
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        canvas.push_clip({{-100, 0.6}, {100, 100}});
        view::draw_scene(canvas, scene(), alpha, quiet_palette());
        for (int i = 0; i < 2; ++i)
        {
            const BodyId body = m_bodies[static_cast<std::size_t>(i)];
            view::draw_ghost(canvas, scene(), body, scene().body(body).pose(), {i == 0 ? first_color : second_color, 2.5f});
            label(canvas, scene().body(body).position() + Vec2{0, i == 0 ? -0.95f : 1.0f},
                  word(i == 0 ? "first" : "second") + ": " + word(kind_names[static_cast<std::size_t>(kind(i))]),
                  i == 0 ? first_color : second_color, 13);
        }
        draw_touch(canvas);
        canvas.pop_clip();
        draw_table(canvas);
    }

private:
    static constexpr double cell = 0.88;
    static constexpr Position corner{-1.9, -0.25};

    [[nodiscard]] int kind(int which) const { return static_cast<int>(controls()[static_cast<std::size_t>(which)].value); }

    BodyId add(int kind, Position at)
    {
        // A shape that is endless or bends inwards has no mass.
        const BodyType type = kind == 0 || kind == 5 ? BodyType::Static : BodyType::Dynamic;
        const BodyId body = scene().create_body({.type = type, .position = at, .angle = kind == 0 ? 0.0f : 0.3f});
        scene().create_shape(body, geometry_of(kind));
        return body;
    }

    void draw_touch(view::Canvas& canvas) const
    {
        for (const BodyId body : m_bodies)
        {
            for (const ContactInfo& contact : scene().body(body).touches_now())
            {
                for (int i = 0; i < contact.point_count; ++i)
                {
                    canvas.fill_circle(contact.points[i].position, canvas.camera().meters(4), bad_color);
                    named_arrow(canvas, contact.points[i].position, contact.normal * 0.8f, i == 0 ? word("normal") : "", yellow);
                }
            }
            if (scene().body(body).type() == BodyType::Dynamic)
                return; // the other one has the same
        }
    }

    void draw_table(view::Canvas& canvas) const
    {
        const float pixel = canvas.camera().meters(1);
        for (int column = 0; column < kinds; ++column)
            label(canvas, {corner.x + (column + 0.5) * cell, corner.y + 0.2}, std::to_string(column), column == kind(1) ? second_color : faint, 12);
        for (int row = 0; row < kinds; ++row)
        {
            const bool is_row = row == kind(0);
            canvas.text({corner.x - 0.15, corner.y - (row + 0.5) * cell},
                        std::to_string(row) + " " + word(kind_names[static_cast<std::size_t>(row)]),
                        {.size = 12, .color = is_row ? first_color : faint, .align_x = 1, .align_y = 0.5f});
            for (int column = 0; column < kinds; ++column)
            {
                const Position low{corner.x + column * cell, corner.y - (row + 1) * cell};
                const Box box{{low.x + 0.03, low.y + 0.03}, {low.x + cell - 0.03, low.y + cell - 0.03}};
                const Entry e = entry(row, column);
                const bool chosen = is_row && column == kind(1);
                const bool mirror = row == kind(1) && column == kind(0);
                const float strength = chosen ? 1 : e.function == Never ? 0.8f : e.is_mirrored ? 0.28f : 0.5f;
                canvas.fill_box(box, view::fade(function_colors[e.function], strength), 3 * pixel);
                if (chosen || mirror)
                    canvas.stroke_box(box, {chosen ? ink : faint, chosen ? 2.5f : 1.5f}, 3 * pixel);
                label(canvas, {low.x + cell / 2, low.y + cell / 2}, e.function == Never ? "–" : std::to_string(row * kinds + column),
                      chosen ? view::rgb(0x10141c) : ink, 12);
            }
        }
    }

    std::array<BodyId, 2> m_bodies{};
};

} // namespace

std::unique_ptr<Chapter> who_can_touch_whom() { return std::make_unique<WhoCanTouchWhom>(); }

} // namespace carom::tour
