#include "pinball/player/controls.h"

#include <SDL_filesystem.h>
#include <SDL_gamecontroller.h>
#include <SDL_keyboard.h>
#include <SDL_stdinc.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace carom::pinball {

namespace {

constexpr Controls::Action all_actions[] = {
    {"start", "start, one more player", Button::Start},
    {"left", "left flipper", Button::Left},
    {"right", "right flipper", Button::Right},
    {"plunger", "plunger: hold, let go", Button::Plunger},
    {"nudge_left", "nudge from the left", Button::NudgeLeft},
    {"nudge_right", "nudge from the right", Button::NudgeRight},
    {"nudge_up", "nudge from the front", Button::NudgeUp},
    {"pause", "pause", Wish::Pause},
    {"restart", "restart", Wish::Restart},
    {"mute", "mute", Wish::Mute},
    {"quieter", "quieter", Wish::Quieter},
    {"louder", "louder", Wish::Louder},
    {"watch", "watch the last game", Wish::Watch},
    {"slower", "watch slower", Wish::Slower},
    {"faster", "watch faster", Wish::Faster},
    {"xray", "x-ray", Wish::Xray},
    {"slow_motion", "x-ray: slow motion", Wish::SlowMotion},
    {"step", "x-ray: one step", Wish::SingleStep},
    {"substep_back", "x-ray: sub-step back", Wish::SubstepBack},
    {"substep_forth", "x-ray: sub-step forth", Wish::SubstepForth},
    {"tour", "tour: how it works", Wish::Tour},
    {"grid", "grid, for table makers", Wish::Grid},
    {"controls", "change the keys", Wish::Controls},
    {"full_screen", "full screen", Wish::Fullscreen},
    {"quit", "quit", Wish::Quit},
};

struct Usual
{
    Controls::Effect effect;
    Control control;
};
constexpr Control key(int code) { return {Control::Kind::Key, code}; }
constexpr Control pad(int code) { return {Control::Kind::Pad, code}; }

constexpr Usual usual[] = {
    {Button::Start, key(SDL_SCANCODE_RETURN)},
    {Button::Start, key(SDL_SCANCODE_KP_ENTER)},
    {Button::Start, pad(SDL_CONTROLLER_BUTTON_START)},
    {Button::Left, key(SDL_SCANCODE_LSHIFT)},
    {Button::Left, key(SDL_SCANCODE_Z)},
    {Button::Left, key(SDL_SCANCODE_LEFT)},
    {Button::Left, pad(SDL_CONTROLLER_BUTTON_LEFTSHOULDER)},
    {Button::Right, key(SDL_SCANCODE_RSHIFT)},
    {Button::Right, key(SDL_SCANCODE_SLASH)},
    {Button::Right, key(SDL_SCANCODE_RIGHT)},
    {Button::Right, pad(SDL_CONTROLLER_BUTTON_RIGHTSHOULDER)},
    {Button::Plunger, key(SDL_SCANCODE_SPACE)},
    {Button::Plunger, key(SDL_SCANCODE_DOWN)},
    {Button::Plunger, pad(SDL_CONTROLLER_BUTTON_A)},
    {Button::NudgeLeft, key(SDL_SCANCODE_A)},
    {Button::NudgeLeft, pad(SDL_CONTROLLER_BUTTON_DPAD_LEFT)},
    {Button::NudgeRight, key(SDL_SCANCODE_APOSTROPHE)},
    {Button::NudgeRight, pad(SDL_CONTROLLER_BUTTON_DPAD_RIGHT)},
    {Button::NudgeUp, key(SDL_SCANCODE_UP)},
    {Button::NudgeUp, pad(SDL_CONTROLLER_BUTTON_DPAD_UP)},
    {Wish::Pause, key(SDL_SCANCODE_P)},
    {Wish::Pause, pad(SDL_CONTROLLER_BUTTON_BACK)},
    {Wish::Restart, key(SDL_SCANCODE_R)},
    {Wish::Mute, key(SDL_SCANCODE_M)},
    {Wish::Quieter, key(SDL_SCANCODE_MINUS)},
    {Wish::Quieter, key(SDL_SCANCODE_KP_MINUS)},
    {Wish::Louder, key(SDL_SCANCODE_EQUALS)},
    {Wish::Louder, key(SDL_SCANCODE_KP_PLUS)},
    {Wish::Watch, key(SDL_SCANCODE_W)},
    {Wish::Slower, key(SDL_SCANCODE_LEFTBRACKET)},
    {Wish::Slower, key(SDL_SCANCODE_PAGEDOWN)},
    {Wish::Faster, key(SDL_SCANCODE_RIGHTBRACKET)},
    {Wish::Faster, key(SDL_SCANCODE_PAGEUP)},
    {Wish::Xray, key(SDL_SCANCODE_X)},
    {Wish::SlowMotion, key(SDL_SCANCODE_S)},
    {Wish::SingleStep, key(SDL_SCANCODE_N)},
    {Wish::SubstepBack, key(SDL_SCANCODE_COMMA)},
    {Wish::SubstepForth, key(SDL_SCANCODE_PERIOD)},
    {Wish::Tour, key(SDL_SCANCODE_T)},
    {Wish::Grid, key(SDL_SCANCODE_G)},
    {Wish::Controls, key(SDL_SCANCODE_F1)},
    {Wish::Fullscreen, key(SDL_SCANCODE_F11)},
    {Wish::Quit, key(SDL_SCANCODE_ESCAPE)},
};

// A source of ButtonTimeline for each of an action's controls, and for triggers and sticks ones of their own.
constexpr int axis_source = 16;

constexpr float axis_full = 32767;
constexpr float pressed_at = 0.6f;  // of the way of a trigger or stick
constexpr float released_at = 0.4f; // so that a trembling finger is none
constexpr float rod_begins_at = 0.15f;

bool may_repeat(Wish wish)
{
    return wish == Wish::SingleStep || wish == Wish::SubstepBack || wish == Wish::SubstepForth || wish == Wish::Louder ||
           wish == Wish::Quieter;
}

std::optional<std::size_t> place_of(Controls::Effect effect)
{
    for (std::size_t i = 0; i < std::size(all_actions); ++i)
        if (all_actions[i].effect == effect)
            return i;
    return std::nullopt;
}

// In the file: names that mean the same on every keyboard.
std::string name_in_file(Control control)
{
    if (control.kind == Control::Kind::Key)
        return std::string("key ") + SDL_GetScancodeName(static_cast<SDL_Scancode>(control.code));
    const char* name = SDL_GameControllerGetStringForButton(static_cast<SDL_GameControllerButton>(control.code));
    return std::string("pad ") + (name != nullptr ? name : "");
}

Control control_in_file(const std::string& name)
{
    const std::string rest = name.size() > 4 ? name.substr(4) : "";
    if (name.starts_with("key "))
        if (const SDL_Scancode code = SDL_GetScancodeFromName(rest.c_str()); code != SDL_SCANCODE_UNKNOWN)
            return key(code);
    if (name.starts_with("pad "))
        if (const auto code = SDL_GameControllerGetButtonFromString(rest.c_str()); code != SDL_CONTROLLER_BUTTON_INVALID)
            return pad(code);
    throw std::runtime_error("\"" + name + "\" names no key (\"key Left Shift\") and no gamepad button (\"pad leftshoulder\")");
}

} // namespace

std::string label_of(Control control)
{
    if (control.kind == Control::Kind::Pad)
        return name_in_file(control);
    const auto code = static_cast<SDL_Scancode>(control.code);
    std::string name = SDL_GetKeyName(SDL_GetKeyFromScancode(code));
    if (name.empty())
        name = SDL_GetScancodeName(code);
    if (name == "Return")
        return "Enter";
    return name == "Escape" ? "Esc" : name;
}

std::span<const Controls::Action> Controls::actions() { return all_actions; }

Controls::Controls() : m_controls(std::size(all_actions))
{
    for (const Usual& one : usual)
        m_controls[*place_of(one.effect)].push_back(one.control);
}

std::filesystem::path Controls::file_of_user()
{
    char* folder = SDL_GetPrefPath("Carom", "pinball");
    std::filesystem::path file = folder != nullptr ? std::filesystem::path(folder) / "controls.json" : std::filesystem::path{};
    SDL_free(folder);
    return file;
}

std::string Controls::load(const std::filesystem::path& file)
{
    std::ifstream in(file);
    if (!in)
        return {};
    try
    {
        const nlohmann::json json = nlohmann::json::parse(in);
        Controls read = *this;
        std::vector<std::pair<std::size_t, std::vector<std::string>>> named;
        for (const auto& [id, names] : json.items())
        {
            const auto action = std::ranges::find(all_actions, id, &Action::id);
            if (action == std::end(all_actions))
                throw std::runtime_error("\"" + id + "\" is no action");
            named.emplace_back(static_cast<std::size_t>(action - std::begin(all_actions)), names.get<std::vector<std::string>>());
        }
        for (const auto& [action, names] : named)
            read.m_controls[action].clear();
        for (const auto& [action, names] : named)
            for (const std::string& name : names)
                read.bind(action, control_in_file(name));
        *this = read;
        return {};
    }
    catch (const std::exception& error)
    {
        std::error_code ignored;
        std::filesystem::rename(file, file.string() + ".broken", ignored); // the next change would write over it
        return file.string() + " was not read and put aside: " + error.what();
    }
}

std::string Controls::save(const std::filesystem::path& file) const
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < m_controls.size(); ++i)
    {
        json[all_actions[i].id] = nlohmann::ordered_json::array();
        for (const Control control : m_controls[i])
            json[all_actions[i].id].push_back(name_in_file(control));
    }
    std::ofstream out(file);
    out << json.dump(2) << '\n';
    out.close();
    return out ? std::string() : "the keys cannot be kept: " + file.string() + " cannot be written";
}

void Controls::unbind(Control control)
{
    for (auto& controls : m_controls)
        std::erase(controls, control);
}

void Controls::bind(std::size_t action, Control control)
{
    unbind(control);
    auto& controls = m_controls[action];
    if (controls.size() == most_controls)
        controls.erase(controls.begin());
    controls.push_back(control);
}

// --- Events ----------------------------------------------------------------------------------------------------------

std::optional<std::size_t> Controls::action_of(Control control) const
{
    for (std::size_t i = 0; i < m_controls.size(); ++i)
        if (std::ranges::find(m_controls[i], control) != m_controls[i].end())
            return i;
    return std::nullopt;
}

namespace {

// The control of an event, whether it goes down or up.
std::optional<Control> control_of(const SDL_Event& event)
{
    switch (event.type)
    {
    case SDL_KEYDOWN:
    case SDL_KEYUP: return key(event.key.keysym.scancode);
    case SDL_CONTROLLERBUTTONDOWN:
    case SDL_CONTROLLERBUTTONUP: return pad(event.cbutton.button);
    default: return std::nullopt;
    }
}

bool goes_down(const SDL_Event& event) { return event.type == SDL_KEYDOWN || event.type == SDL_CONTROLLERBUTTONDOWN; }

bool is_repeat(const SDL_Event& event) { return event.type == SDL_KEYDOWN && event.key.repeat != 0; }

} // namespace

std::optional<Control> Controls::pressed(const SDL_Event& event)
{
    const auto control = goes_down(event) && !is_repeat(event) ? control_of(event) : std::nullopt;
    const bool has_name = control && name_in_file(*control).size() > 4; // else it could not be kept
    return has_name ? control : std::nullopt;
}

void Controls::turn(std::vector<ButtonPress>& presses, std::size_t side, float value, Button button)
{
    bool& turned = m_turned[side];
    const bool now = value > (turned ? released_at : pressed_at);
    if (now != turned)
        presses.push_back({button, now, axis_source + static_cast<int>(side)});
    turned = now;
}

// Triggers are flippers; the left stick nudges to the sides and forward, and pulled back it holds the plunger's rod.
std::vector<ButtonPress> Controls::buttons_of(const SDL_Event& event)
{
    std::vector<ButtonPress> presses;
    if (event.type == SDL_CONTROLLERAXISMOTION)
    {
        const float value = static_cast<float>(event.caxis.value) / axis_full;
        switch (event.caxis.axis)
        {
        case SDL_CONTROLLER_AXIS_TRIGGERLEFT: turn(presses, 0, value, Button::Left); break;
        case SDL_CONTROLLER_AXIS_TRIGGERRIGHT: turn(presses, 1, value, Button::Right); break;
        case SDL_CONTROLLER_AXIS_LEFTX:
            turn(presses, 2, value, Button::NudgeLeft);
            turn(presses, 3, -value, Button::NudgeRight);
            break;
        case SDL_CONTROLLER_AXIS_LEFTY: turn(presses, 4, -value, Button::NudgeUp); break;
        default: break;
        }
        return presses;
    }
    const auto control = control_of(event);
    if (!control || is_repeat(event))
        return presses;
    const auto action = action_of(*control);
    if (!action || !std::holds_alternative<Button>(all_actions[*action].effect))
        return presses;
    const auto& controls = m_controls[*action];
    const auto source = static_cast<int>(std::ranges::find(controls, *control) - controls.begin());
    presses.push_back({std::get<Button>(all_actions[*action].effect), goes_down(event), source});
    return presses;
}

std::optional<std::uint8_t> Controls::rod_of(const SDL_Event& event)
{
    if (event.type != SDL_CONTROLLERAXISMOTION || event.caxis.axis != SDL_CONTROLLER_AXIS_LEFTY)
        return std::nullopt;
    const float value = static_cast<float>(event.caxis.value) / axis_full;
    const float pulled = std::clamp((value - rod_begins_at) / (1 - rod_begins_at), 0.0f, 1.0f);
    return static_cast<std::uint8_t>(255 * pulled + 0.5f);
}

std::optional<Wish> Controls::wish_of(const SDL_Event& event) const
{
    const auto control = control_of(event);
    if (!control || !goes_down(event))
        return std::nullopt;
    const auto action = action_of(*control);
    if (!action || !std::holds_alternative<Wish>(all_actions[*action].effect))
        return std::nullopt;
    const Wish wish = std::get<Wish>(all_actions[*action].effect);
    return !is_repeat(event) || may_repeat(wish) ? std::optional(wish) : std::nullopt;
}

// --- For the player --------------------------------------------------------------------------------------------------

std::string Controls::labels(Effect effect, std::size_t most) const
{
    std::string text;
    std::size_t shown = 0;
    for (const Control control : m_controls[*place_of(effect)])
        if (control.kind == Control::Kind::Key && shown++ < most)
            text += (text.empty() ? "" : "  or  ") + label_of(control);
    return text;
}

std::string Controls::label(Effect effect) const
{
    const auto& controls = m_controls[*place_of(effect)];
    const std::string key = labels(effect, 1);
    return key.empty() && !controls.empty() ? label_of(controls.front()) : key;
}

std::vector<KeyLine> Controls::key_lines() const
{
    const auto several = [this](std::initializer_list<Wish> wishes)
    {
        std::string text;
        for (const Wish wish : wishes)
            text += (text.empty() ? "" : "   ") + label(wish);
        return text;
    };
    return {{labels(Button::Start, 1), "start, one more player"},
            {labels(Button::Left, 2), "left flipper"},
            {labels(Button::Right, 2), "right flipper"},
            {labels(Button::Plunger, 1), "plunger: hold, let go"},
            {label(Button::NudgeLeft) + "   " + label(Button::NudgeUp) + "   " + label(Button::NudgeRight), "nudge"},
            {several({Wish::Pause, Wish::Restart}), "pause, restart"},
            {several({Wish::Mute, Wish::Quieter, Wish::Louder}), "mute, volume"},
            {several({Wish::Watch}), "watch the last game"},
            {several({Wish::Xray, Wish::Tour}), "x-ray, tour"},
            {several({Wish::Controls, Wish::Fullscreen}), "keys, full screen"},
            {several({Wish::Quit}), "quit"}};
}

std::vector<KeyLine> Controls::xray_key_lines() const
{
    return {{label(Wish::SlowMotion), "slow motion"},
            {label(Wish::Pause), "pause"},
            {label(Wish::SingleStep), "one step"},
            {label(Wish::SubstepBack) + " " + label(Wish::SubstepForth), "sub-steps"},
            {label(Wish::Xray), "close"}};
}

} // namespace carom::pinball
