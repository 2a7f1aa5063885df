#include "tour/lesson.h"

#include "view/hand_spring.h"

#include <algorithm>

namespace carom::tour {
namespace {

constexpr int most_moments = 36'000; // then it starts anew: a step back plays all of them

} // namespace

Lesson::Lesson(std::unique_ptr<Chapter> chapter) : m_chapter(std::move(chapter))
{
    restart();
}

void Lesson::restart()
{
    m_moments.clear();
    m_grip.reset();
    m_spring = {};
    m_waiting = 0;
    m_runs_to_next = false;
    m_chapter->build();
}

Lesson::Moment Lesson::now() const
{
    Moment moment{.controls = {}, .grip = m_grip};
    for (const Control& control : m_chapter->controls())
        moment.controls.push_back(control.value);
    return moment;
}

void Lesson::play(const Moment& moment)
{
    for (std::size_t i = 0; i < moment.controls.size(); ++i)
        m_chapter->controls()[i].value = moment.controls[i];
    if (!m_chapter->is_moved_by_hand())
        pull(moment.grip);
    m_chapter->step();
}

void Lesson::step()
{
    if (m_chapter->is_over() || steps() >= most_moments)
        restart();
    m_moments.push_back(now());
    play(m_moments.back());
}

void Lesson::back()
{
    paused = true;
    m_runs_to_next = false;
    if (m_moments.empty())
        return;
    std::vector<Moment> moments = std::move(m_moments);
    const Moment last = std::move(moments.back());
    moments.pop_back();
    const Moment& first = moments.empty() ? last : moments.front();
    for (std::size_t i = 0; i < first.controls.size(); ++i)
        m_chapter->controls()[i].value = first.controls[i];
    restart();
    for (const Moment& moment : moments)
        play(moment);
    m_moments = std::move(moments);
}

void Lesson::run_to_next()
{
    paused = false;
    m_runs_to_next = true;
}

void Lesson::advance(double seconds)
{
    if (paused)
        return;
    const auto h = static_cast<double>(m_chapter->h());
    for (m_waiting += seconds * speed; m_waiting >= h && !paused; m_waiting -= h)
    {
        step();
        if (m_runs_to_next && m_chapter->has_struck())
        {
            m_runs_to_next = false;
            paused = true;
            m_waiting = 0;
            return;
        }
    }
}

float Lesson::alpha() const
{
    return paused ? 1 : std::clamp(static_cast<float>(m_waiting / static_cast<double>(m_chapter->h())), 0.0f, 1.0f);
}

void Lesson::set_control(std::size_t index, float value)
{
    Control& control = m_chapter->controls()[index];
    if (control.value == value)
        return;
    control.value = value;
    if (control.restarts)
        restart();
    else
        m_chapter->moved();
}

void Lesson::set_control(std::string_view name, float value)
{
    for (std::size_t i = 0; i < m_chapter->controls().size(); ++i)
    {
        if (m_chapter->controls()[i].name == name)
            set_control(i, value);
    }
}

void Lesson::grab(Position at, float reach)
{
    if (m_chapter->press(at))
        return;
    Scene& scene = m_chapter->scene();
    const auto can_be_taken = [&](ShapeId shape)
    {
        return m_chapter->is_moved_by_hand() || scene.body(scene.shape(shape).body()).type() == BodyType::Dynamic;
    };
    std::optional<ShapeId> taken;
    for (const ShapeId shape : scene.overlap_point(at))
    {
        if (!taken && can_be_taken(shape))
            taken = shape;
    }
    if (const auto near = taken ? std::nullopt : scene.closest_point(at, reach); near && can_be_taken(near->shape))
        taken = near->shape;
    if (!taken)
        return;
    const BodyId body = scene.shape(*taken).body();
    m_grip = Grip{body, scene.body(body).local_point(at), at};
}

void Lesson::drag(Position at)
{
    if (!m_grip)
        return;
    m_grip->at = at;
    if (m_chapter->is_moved_by_hand())
        put();
}

void Lesson::let_go() { m_grip.reset(); }

void Lesson::put()
{
    Scene& scene = m_chapter->scene();
    if (!scene.is_valid(m_grip->body))
        return;
    Body body = scene.body(m_grip->body);
    body.teleport(body.position() + (m_grip->at - body.world_point(m_grip->anchor)), body.angle());
    m_chapter->moved();
}

void Lesson::pull(const std::optional<Grip>& grip)
{
    Scene& scene = m_chapter->scene();
    const bool holds = m_spring && scene.is_valid(m_spring);
    if (!grip || !scene.is_valid(grip->body))
    {
        if (holds)
            scene.destroy(m_spring);
        m_spring = {};
    }
    else if (holds)
        view::move_hand(scene, m_spring, grip->at);
    else
        m_spring = view::pull_by_hand(scene, grip->body, grip->anchor, grip->at);
}

} // namespace carom::tour
