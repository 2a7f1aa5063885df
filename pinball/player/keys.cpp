#include "pinball/player/keys.h"

namespace carom::pinball {

namespace {

struct ButtonKey
{
    SDL_Scancode code;
    Button button;
};

constexpr ButtonKey button_keys[] = {
    {SDL_SCANCODE_LSHIFT, Button::Left},    {SDL_SCANCODE_Z, Button::Left},       {SDL_SCANCODE_LEFT, Button::Left},
    {SDL_SCANCODE_RSHIFT, Button::Right},   {SDL_SCANCODE_SLASH, Button::Right},  {SDL_SCANCODE_RIGHT, Button::Right},
    {SDL_SCANCODE_SPACE, Button::Plunger},  {SDL_SCANCODE_DOWN, Button::Plunger}, {SDL_SCANCODE_RETURN, Button::Start},
    {SDL_SCANCODE_KP_ENTER, Button::Start},
};

struct PadKey
{
    SDL_GameControllerButton code;
    Button button;
};

constexpr PadKey pad_keys[] = {
    {SDL_CONTROLLER_BUTTON_LEFTSHOULDER, Button::Left},   {SDL_CONTROLLER_BUTTON_DPAD_LEFT, Button::Left},
    {SDL_CONTROLLER_BUTTON_RIGHTSHOULDER, Button::Right}, {SDL_CONTROLLER_BUTTON_B, Button::Right},
    {SDL_CONTROLLER_BUTTON_A, Button::Plunger},           {SDL_CONTROLLER_BUTTON_START, Button::Start},
};
constexpr int pad_source = 16;

struct WishKey
{
    SDL_Scancode code;
    Wish wish;
};

constexpr WishKey wish_keys[] = {
    {SDL_SCANCODE_P, Wish::Pause},
    {SDL_SCANCODE_R, Wish::Restart},
    {SDL_SCANCODE_M, Wish::Mute},
    {SDL_SCANCODE_MINUS, Wish::Quieter},
    {SDL_SCANCODE_KP_MINUS, Wish::Quieter},
    {SDL_SCANCODE_EQUALS, Wish::Louder},
    {SDL_SCANCODE_KP_PLUS, Wish::Louder},
    {SDL_SCANCODE_X, Wish::Xray},
    {SDL_SCANCODE_T, Wish::Tour},
    {SDL_SCANCODE_F11, Wish::Fullscreen},
    {SDL_SCANCODE_ESCAPE, Wish::Quit},
    {SDL_SCANCODE_S, Wish::SlowMotion},
    {SDL_SCANCODE_N, Wish::SingleStep},
    {SDL_SCANCODE_COMMA, Wish::SubstepBack},
    {SDL_SCANCODE_PERIOD, Wish::SubstepForth},
};

bool may_repeat(Wish wish)
{
    return wish == Wish::SingleStep || wish == Wish::SubstepBack || wish == Wish::SubstepForth || wish == Wish::Louder ||
           wish == Wish::Quieter;
}

template <class Keys, class Code>
std::optional<ButtonPress> look_up(const Keys& keys, Code code, bool down, int first_source)
{
    int source = first_source;
    for (const auto& key : keys)
    {
        if (key.code == code)
            return ButtonPress{key.button, down, source};
        ++source;
    }
    return std::nullopt;
}

} // namespace

std::optional<ButtonPress> button_of(const SDL_Event& event)
{
    switch (event.type)
    {
    case SDL_KEYDOWN:
    case SDL_KEYUP:
        if (event.key.repeat != 0)
            return std::nullopt;
        return look_up(button_keys, event.key.keysym.scancode, event.type == SDL_KEYDOWN, 0);
    case SDL_CONTROLLERBUTTONDOWN:
    case SDL_CONTROLLERBUTTONUP:
        return look_up(pad_keys, static_cast<SDL_GameControllerButton>(event.cbutton.button),
                       event.type == SDL_CONTROLLERBUTTONDOWN, pad_source);
    default: return std::nullopt;
    }
}

std::optional<Wish> wish_of(const SDL_Event& event)
{
    if (event.type == SDL_CONTROLLERBUTTONDOWN && event.cbutton.button == SDL_CONTROLLER_BUTTON_BACK)
        return Wish::Pause;
    if (event.type != SDL_KEYDOWN)
        return std::nullopt;
    for (const WishKey& key : wish_keys)
        if (key.code == event.key.keysym.scancode && (event.key.repeat == 0 || may_repeat(key.wish)))
            return key.wish;
    return std::nullopt;
}

std::span<const KeyLine> key_lines()
{
    static constexpr KeyLine lines[] = {
        {"Enter", "start"},
        {"left Shift  or  Z", "left flipper"},
        {"right Shift  or  /", "right flipper"},
        {"Space", "plunger: hold, let go"},
        {"P", "pause"},
        {"R", "restart"},
        {"M   -   =", "mute, volume"},
        {"X", "x-ray"},
        {"T", "tour: how it works"},
        {"F11", "full screen"},
        {"Esc", "quit"},
    };
    return lines;
}

std::span<const KeyLine> xray_key_lines()
{
    static constexpr KeyLine lines[] = {
        {"S", "slow motion"}, {"P", "pause"}, {"N", "one step"}, {", .", "sub-steps"}, {"X", "close"}};
    return lines;
}

} // namespace carom::pinball
