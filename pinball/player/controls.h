#pragma once

/// @file
/// The meaning of keys, gamepad buttons and sticks. Keys count by their place on the keyboard and are shown as the player's layout labels
/// them. The player may give every action other keys; they are kept in a file.

#include "pinball/player/buttons.h"

#include <SDL_events.h>

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace carom::pinball {

/// Wishes of the user that concern the program rather than the machine.
enum class Wish : std::uint8_t
{
    Pause,
    Restart,
    Mute,
    Quieter,
    Louder,
    Xray,
    Tour,
    Watch,
    Slower,
    Faster,
    Controls,
    Grid,
    Fullscreen,
    Quit,
    SlowMotion,
    SingleStep,
    SubstepBack,
    SubstepForth,
};

struct ButtonPress
{
    Button button = Button::Left;
    bool down = false;
    int source = 0; ///< of ButtonTimeline::push
};

/// Something to press.
struct Control
{
    enum class Kind : std::uint8_t
    {
        Key, ///< `code` is an SDL_Scancode
        Pad, ///< an SDL_GameControllerButton
    };
    Kind kind = Kind::Key;
    int code = 0;
    friend bool operator==(Control, Control) = default;
};

/// As the keyboard of this player labels it, or as gamepads do.
[[nodiscard]] std::string label_of(Control control);

/// A line of the list of keys.
struct KeyLine
{
    std::string keys{};
    std::string meaning{};
};

class Controls
{
public:
    using Effect = std::variant<Button, Wish>;
    struct Action
    {
        const char* id;      ///< in the file
        const char* meaning; ///< for the player
        Effect effect;
    };
    [[nodiscard]] static std::span<const Action> actions();

    /// Those of a new machine.
    Controls();
    /// The file in the user's data directory; empty where there is none.
    [[nodiscard]] static std::filesystem::path file_of_user();
    /// Takes what the file says; what it does not name stays as it is. No file: nothing happens. A sentence where the file is bad: then all
    /// stays as it is, and the file is put aside.
    [[nodiscard]] std::string load(const std::filesystem::path& file);
    /// A sentence where that cannot be done.
    [[nodiscard]] std::string save(const std::filesystem::path& file) const;

    [[nodiscard]] std::span<const Control> controls_of(std::size_t action) const { return m_controls[action]; }
    /// From now on the control does this and nothing else. An action has at most four; the oldest one goes.
    void bind(std::size_t action, Control control);
    void unbind(Control control);

    /// The machine's buttons that this event moves. Repeats of a held key move none.
    [[nodiscard]] std::vector<ButtonPress> buttons_of(const SDL_Event& event);
    [[nodiscard]] std::optional<Wish> wish_of(const SDL_Event& event) const;
    /// How far the stick holds the plunger's rod back, 0 to 255; empty where the event does not move it.
    [[nodiscard]] static std::optional<std::uint8_t> rod_of(const SDL_Event& event);
    /// The control that was pressed, for whoever waits for one to bind.
    [[nodiscard]] static std::optional<Control> pressed(const SDL_Event& event);

    [[nodiscard]] std::string label(
        Effect effect) const; ///< of its first key, or else of its gamepad button; empty where it has none
    /// For the first screen, and for the x-ray.
    [[nodiscard]] std::vector<KeyLine> key_lines() const;
    [[nodiscard]] std::vector<KeyLine> xray_key_lines() const;

private:
    static constexpr std::size_t most_controls = 4;
    [[nodiscard]] std::optional<std::size_t> action_of(Control control) const;
    [[nodiscard]] std::string labels(Effect effect, std::size_t most) const;
    void turn(std::vector<ButtonPress>& presses, std::size_t side, float value, Button button);

    std::vector<std::vector<Control>> m_controls{}; ///< by action
    std::array<bool, 5> m_turned{};                 ///< triggers and directions of the stick that count as pressed
};

} // namespace carom::pinball
