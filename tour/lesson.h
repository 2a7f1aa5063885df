#pragma once

/// @file
/// A chapter that is being watched: time, slow motion, single steps, steps back, and the hand in its scene.

#include "tour/chapter.h"

#include <optional>
#include <vector>

namespace carom::tour {

class Lesson
{
public:
    /// Starts the chapter.
    explicit Lesson(std::unique_ptr<Chapter> chapter);

    [[nodiscard]] Chapter& chapter() { return *m_chapter; }
    [[nodiscard]] const Chapter& chapter() const { return *m_chapter; }
    [[nodiscard]] const ChapterText& text() const { return m_chapter->text(); }

    void restart();
    /// Lets this much real time pass.
    void advance(double seconds);
    void step();
    /// The state before the last step. The engine is deterministic: the chapter is played anew up to there, with the same hand and sliders.
    void back();
    /// Goes on until something strikes.
    void run_to_next();
    [[nodiscard]] bool runs_to_next() const { return m_runs_to_next; }
    [[nodiscard]] int steps() const { return static_cast<int>(m_moments.size()); }
    [[nodiscard]] float alpha() const; ///< for drawing between steps

    void set_control(std::size_t index, float value);
    void set_control(std::string_view name, float value);

    /// Takes what is there, or nothing; reach in metres.
    void grab(Position at, float reach);
    void drag(Position at);
    void let_go();
    [[nodiscard]] bool holds() const { return m_grip.has_value(); }

    bool paused = false;
    double speed = 1;

private:
    struct Grip
    {
        BodyId body{};
        Vec2 anchor{}; ///< in the body's frame
        Position at{};
    };
    /// The actions of the reader in a step.
    struct Moment
    {
        std::vector<float> controls;
        std::optional<Grip> grip;
    };

    void play(const Moment& moment);
    void pull(const std::optional<Grip>& grip);
    void put();
    [[nodiscard]] Moment now() const;

    std::unique_ptr<Chapter> m_chapter;
    std::vector<Moment> m_moments;
    std::optional<Grip> m_grip;
    JointId m_spring{};
    double m_waiting = 0; ///< s that are not stepped yet
    bool m_runs_to_next = false;
};

} // namespace carom::tour
