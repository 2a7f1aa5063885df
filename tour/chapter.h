#pragma once

/// @file
/// A chapter of the tour: one small live scene, what may be changed in it, and the numbers that its text asks for.

#include "carom/scene.h"
#include "tour/text.h"
#include "view/canvas.h"
#include "view/impact_story.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace carom::tour {

/// A slider, or a switch where `is_switch` is set. Its label is in the chapter's text.
struct Control
{
    std::string name;
    float value = 0;
    float low = 0;
    float high = 1;
    const char* format = "%.2f";
    bool is_switch = false;
    bool is_whole = false;  ///< whole numbers alone
    bool restarts = false;  ///< holds from the next start, so that a change starts the scene anew
    bool logarithmic = false;
};

/// The state of the machine to which the chapter sends the reader.
struct TableView
{
    bool contacts = false;
    bool triggers = false;
    bool joints = false;
    bool boxes = false;
    bool velocities = true;
    bool islands = false;
};

class Chapter
{
public:
    /// Reads the chapter's text, of that name. Throws std::runtime_error where there is none.
    Chapter(std::string name, std::vector<Control> controls)
        : m_name(std::move(name)), m_text(load_text(m_name)), m_controls(std::move(controls))
    {}
    virtual ~Chapter() = default;
    Chapter(const Chapter&) = delete;
    Chapter& operator=(const Chapter&) = delete;

    /// The stem of its text file, "04-the-blow".
    [[nodiscard]] const std::string& name() const { return m_name; }
    [[nodiscard]] const ChapterText& text() const { return m_text; }
    [[nodiscard]] const std::string& word(std::string_view name) const; ///< that the picture says
    [[nodiscard]] std::vector<Control>& controls() { return m_controls; }
    [[nodiscard]] const std::vector<Control>& controls() const { return m_controls; }
    [[nodiscard]] float control(std::string_view name) const;
    [[nodiscard]] bool is_on(std::string_view name) const { return control(name) != 0; }

    /// Makes the scene anew, from what the controls say.
    virtual void build() = 0;
    /// Takes controls that hold at once, then a step.
    virtual void step();
    [[nodiscard]] virtual float h() const { return 1.0f / 60; }
    /// The scene that the hand takes things from.
    [[nodiscard]] Scene& scene() { return *m_scene; }
    [[nodiscard]] const Scene& scene() const { return *m_scene; }

    /// The part worth seeing.
    [[nodiscard]] virtual Box view() const = 0;
    /// Nothing moves by itself: no buttons for time.
    [[nodiscard]] virtual bool is_still() const { return false; }
    /// Things are put where the hand is; else they are pulled there by a spring.
    [[nodiscard]] virtual bool is_moved_by_hand() const { return false; }
    /// A press of the button that is meant for something else than a thing of the scene: true.
    virtual bool press(Position at)
    {
        (void)at;
        return false;
    }
    /// After the hand or a slider has moved something.
    virtual void moved() {}
    /// The picture: `alpha` of the way from the step before to the last one.
    virtual void draw(view::Canvas& canvas, float alpha) const;
    /// For the text's placeholders.
    [[nodiscard]] virtual Values values() const { return {}; }
    /// The text in place of a paragraph "{story}".
    [[nodiscard]] virtual std::vector<view::StoryLine> story() const { return {}; }
    /// Something worth stopping at happened in the last step.
    [[nodiscard]] virtual bool has_struck() const { return !scene().impacts().empty(); }
    /// The scene is through; it starts anew.
    [[nodiscard]] virtual bool is_over() const { return false; }
    /// Steps after which its picture is taken.
    [[nodiscard]] virtual int picture_steps() const { return 60; }
    [[nodiscard]] virtual TableView table_view() const { return {}; }

protected:
    void begin(const SceneDef& def) { m_scene = std::make_unique<Scene>(def); }

private:
    std::string m_name;
    ChapterText m_text;
    std::vector<Control> m_controls;
    std::unique_ptr<Scene> m_scene;
};

/// In the order in which they are told.
[[nodiscard]] std::vector<std::unique_ptr<Chapter>> all_chapters();

} // namespace carom::tour
