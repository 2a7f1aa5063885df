// Removing from a list while it is walked, done wrong and right; and balls that break each other in callbacks.

#include "tour/chapters/chapters.h"
#include "tour/chapters/drawing.h"
#include "view/shape_art.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace carom::tour {
namespace {


bool is_marked(int number) { return number == 3 || number == 4 || number == 6 || number == 7; }

class ChangingTheWorld : public Chapter
{
    static constexpr int cells = 8;
    static constexpr int steps_of_a_look = 24;
    static constexpr float big = 0.5f;
    static constexpr float smallest = 0.14f;

public:
    ChangingTheWorld()
        : Chapter("09-changing-the-world", {{.name = "balls", .value = 4, .low = 1, .high = 8, .format = "%.0f", .is_whole = true, .restarts = true}})
    {}

    void build() override
    {
        begin({.sleeping = false});
        m_spikes.clear();
        const BodyId ground = scene().create_body({});
        scene().create_shape(ground, Chain{.start = {-4.4f, 1.4f}, .pieces = {{{-4.4f, -3.6f}}, {{4.4f, -3.6f}}, {{4.4f, 1.4f}}}}, {.restitution = 0.3f});
        for (int i = 0; i < 3; ++i)
        {
            const BodyId spike = scene().create_body({.position = {-2.6 + 2.6 * i, -3.3}});
            scene().create_shape(spike, Polygon{.vertices = {{-0.4f, -0.3f}, {0.4f, -0.3f}, {0, 0.7f}}});
            m_spikes.push_back(spike);
        }
        const auto n = static_cast<int>(control("balls"));
        m_made = m_gone = 0;
        for (int i = 0; i < n; ++i)
            add_ball({-3.4 + 6.8 * (i + 0.5) / n, 0.2 + 0.35 * (i % 3)}, big, {0.4f * static_cast<float>(i % 3 - 1), 0});
        m_naive = m_safe = numbers();
        m_at = 0;
        m_steps = 0;
        m_missed = 0;
    }

    void step() override
    {
        Chapter::step();
        if (++m_steps % steps_of_a_look == 0)
            walk();
    }

    [[nodiscard]] bool is_over() const override { return m_steps > steps_of_a_look * (cells + 5); }
    [[nodiscard]] int picture_steps() const override { return steps_of_a_look * 5; }
    [[nodiscard]] Box view() const override { return {{-4.6, -3.8}, {4.6, 4.4}}; }

    [[nodiscard]] Values values() const override
    {
        return {{"missed", std::to_string(m_missed)},
                {"made", std::to_string(m_made)},
                {"gone", std::to_string(m_gone)},
                {"left", std::to_string(m_made - m_gone)},
                {"counted", std::to_string(scene().report().bodies > 0 ? scene().report().bodies - 4 : m_made - m_gone)}};
    }

    void draw(view::Canvas& canvas, float alpha) const override
    {
        view::draw_scene(canvas, scene(), alpha);
        draw_list(canvas, 3.35, word("walked"), m_naive);
        draw_list(canvas, 2.05, word("written down"), m_safe);
    }

private:
    static std::vector<int> numbers()
    {
        std::vector<int> all;
        for (int i = 1; i <= cells; ++i)
            all.push_back(i);
        return all;
    }

    // One look at the cell whose turn it is. The upper list loses it at once, so that the next one slips into its place and is never looked at.
    void walk()
    {
        if (m_at < static_cast<int>(m_naive.size()))
        {
            if (is_marked(m_naive[static_cast<std::size_t>(m_at)]))
                m_naive.erase(m_naive.begin() + m_at);
            ++m_at;
            m_missed = static_cast<int>(std::ranges::count_if(m_naive, [&](int n) { return is_marked(n) && was_passed(n); }));
            return;
        }
        std::erase_if(m_safe, is_marked); // after the walk
    }

    [[nodiscard]] bool was_passed(int number) const
    {
        return std::ranges::find(m_naive, number) - m_naive.begin() < m_at;
    }

    void add_ball(Position at, float radius, Vec2 velocity)
    {
        const BodyId body = scene().create_body({.type = BodyType::Dynamic, .position = at, .velocity = velocity});
        const ShapeId shape = scene().create_shape(body, Circle{.radius = radius}, {.restitution = 0.5f});
        ++m_made;
        scene().set_callbacks(shape, {.on_contact_begin = [this, body, radius](Scene& s, const ContactBeginEvent& e)
                                      {
                                          if (std::ranges::find(m_spikes, e.body_b) != m_spikes.end() && s.is_valid(body))
                                              burst(body, radius);
                                      }});
    }

    // Called after the step: everything may be made and destroyed.
    void burst(BodyId body, float radius)
    {
        const Position at = scene().body(body).position();
        scene().destroy(body);
        ++m_gone;
        const float half = 0.7f * radius;
        if (half < smallest)
            return;
        add_ball(at + Vec2{-half, 0.3f}, half, {-1.5f, 4});
        add_ball(at + Vec2{half, 0.3f}, half, {1.5f, 4});
    }

    void draw_list(view::Canvas& canvas, double y, const std::string& title, const std::vector<int>& list) const
    {
        const float pixel = canvas.camera().meters(1);
        canvas.text({-4.4, y + 0.42}, title, {.size = 12, .color = faint, .align_y = 1});
        const int turn = m_at;
        for (int i = 0; i < static_cast<int>(list.size()); ++i)
        {
            const double x = -4.4 + 1.1 * i;
            const int number = list[static_cast<std::size_t>(i)];
            const bool written = &list == &m_safe && is_marked(number) && number <= turn;
            canvas.fill_box({{x, y - 0.35}, {x + 0.98, y + 0.35}}, is_marked(number) ? fade(bad_color, written ? 0.35f : 0.9f) : view::rgb(0x3a4a68), 4 * pixel);
            label(canvas, {x + 0.49, y}, std::to_string(number) + (written ? " ×" : ""), ink, 14);
            if (i == turn)
                canvas.stroke_box({{x, y - 0.35}, {x + 0.98, y + 0.35}}, {yellow, 3}, 4 * pixel);
        }
    }

    std::vector<BodyId> m_spikes;
    std::vector<int> m_naive;
    std::vector<int> m_safe;
    int m_at = 0;
    int m_steps = 0;
    int m_missed = 0;
    int m_made = 0;
    int m_gone = 0;
};

} // namespace

std::unique_ptr<Chapter> changing_the_world() { return std::make_unique<ChangingTheWorld>(); }

} // namespace carom::tour
