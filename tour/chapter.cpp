#include "tour/chapter.h"

#include "tour/chapters/chapters.h"
#include "view/shape_art.h"

#include <algorithm>
#include <stdexcept>

namespace carom::tour {

float Chapter::control(std::string_view name) const
{
    const auto found = std::ranges::find(m_controls, name, &Control::name);
    if (found == m_controls.end())
        throw std::logic_error(m_name + " has no control \"" + std::string(name) + "\"");
    return found->value;
}

const std::string& Chapter::word(std::string_view name) const
{
    const auto found = m_text.words.find(name);
    if (found == m_text.words.end())
        throw std::logic_error(m_name + " has no word \"" + std::string(name) + "\"");
    return found->second;
}

void Chapter::step() { m_scene->step(h()); }

void Chapter::draw(view::Canvas& canvas, float alpha) const
{
    view::draw_scene(canvas, scene(), alpha);
}

std::vector<std::unique_ptr<Chapter>> all_chapters()
{
    std::vector<std::unique_ptr<Chapter>> all;
    all.push_back(one_step());
    all.push_back(who_can_touch_whom());
    all.push_back(five_pairs());
    all.push_back(the_blow());
    all.push_back(sinking_in());
    all.push_back(triggers());
    all.push_back(springs());
    all.push_back(too_many_pairs());
    all.push_back(changing_the_world());
    all.push_back(too_fast());
    all.push_back(many_at_once());
    return all;
}

} // namespace carom::tour
