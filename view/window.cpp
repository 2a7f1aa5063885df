#include "view/window.h"

#include <SDL.h>
#include <SDL_opengl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <imgui_impl_sdl.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace carom::view {

struct Window::Native
{
    SDL_Window* window = nullptr;
    SDL_GLContext gl = nullptr;
    ImGuiContext* imgui = nullptr;
    bool video = false;
    bool offscreen = false;
    bool paced = true; ///< by the display, or on purpose by nothing
    double shown = 0;  ///< ms: when the last frame was handed over
    double work = 0;   ///< ms that a frame takes, the longest of late
    double begun = 0;

    ~Native()
    {
        if (imgui != nullptr)
        {
            ImGui_ImplOpenGL3_Shutdown();
            ImGui_ImplSDL2_Shutdown();
            ImGui::DestroyContext(imgui);
        }
        if (gl != nullptr)
            SDL_GL_DeleteContext(gl);
        if (window != nullptr)
            SDL_DestroyWindow(window);
        if (video)
            SDL_QuitSubSystem(SDL_INIT_VIDEO | SDL_INIT_GAMECONTROLLER);
    }
};

namespace {

[[noreturn]] void fail(const char* what)
{
    throw std::runtime_error(std::string("view::Window: ") + what + ": " + SDL_GetError());
}

void ask_for_gl()
{
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
}

void quiet_look()
{
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 6;
    style.FrameRounding = 4;
    style.GrabRounding = 4;
    style.WindowBorderSize = 0;
    style.ItemSpacing = {8, 6};
    style.Colors[ImGuiCol_WindowBg] = {0.07f, 0.09f, 0.13f, 0.92f};
    style.Colors[ImGuiCol_TitleBg] = {0.10f, 0.13f, 0.19f, 1};
    style.Colors[ImGuiCol_TitleBgActive] = {0.13f, 0.18f, 0.27f, 1};
    style.Colors[ImGuiCol_FrameBg] = {0.15f, 0.19f, 0.27f, 1};
    style.Colors[ImGuiCol_FrameBgHovered] = {0.20f, 0.26f, 0.37f, 1};
    style.Colors[ImGuiCol_Button] = {0.17f, 0.25f, 0.38f, 1};
    style.Colors[ImGuiCol_ButtonHovered] = {0.23f, 0.35f, 0.54f, 1};
    style.Colors[ImGuiCol_Header] = {0.17f, 0.27f, 0.42f, 1};
    style.Colors[ImGuiCol_HeaderHovered] = {0.22f, 0.34f, 0.52f, 1};
    style.Colors[ImGuiCol_CheckMark] = {0.45f, 0.80f, 1, 1};
    style.Colors[ImGuiCol_SliderGrab] = {0.40f, 0.65f, 0.92f, 1};
    style.Colors[ImGuiCol_PlotLines] = {0.45f, 0.80f, 1, 1};
}

double now_ms()
{
    return 1000 * static_cast<double>(SDL_GetPerformanceCounter()) / static_cast<double>(SDL_GetPerformanceFrequency());
}

// The time of a frame on the display that the window is on.
double frame_ms(SDL_Window* window)
{
    SDL_DisplayMode mode{};
    const int display = SDL_GetWindowDisplayIndex(window);
    const bool known = display >= 0 && SDL_GetCurrentDisplayMode(display, &mode) == 0 && mode.refresh_rate > 0;
    return 1000.0 / (known ? mode.refresh_rate : 60);
}

void start_imgui(SDL_Window* window, SDL_GLContext gl)
{
    ImGui::GetIO().IniFilename = nullptr; // leaves no file behind
    quiet_look();
    ImGui_ImplSDL2_InitForOpenGL(window, gl);
    ImGui_ImplOpenGL3_Init("#version 330");
}

Canvas make_canvas(ImDrawList* list, const Camera& camera, Window& window)
{
    return {*list, camera, window.fonts(), window.pixel_scale()};
}

} // namespace

Window::Window(const WindowDef& def) : m_native(std::make_unique<Native>()), m_background(def.background)
{
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    if (SDL_InitSubSystem(SDL_INIT_VIDEO | SDL_INIT_GAMECONTROLLER) != 0)
        fail("no video");
    m_native->video = true;
    const char* driver = SDL_GetCurrentVideoDriver();
    m_native->offscreen = driver != nullptr && std::strcmp(driver, "offscreen") == 0;
    // SDL goes on without a display: a program that nobody sees and nobody can end.
    const bool is_seen =
        driver != nullptr && !m_native->offscreen && std::strcmp(driver, "dummy") != 0 && std::strcmp(driver, "evdev") != 0;
    if (!is_seen && std::getenv("SDL_VIDEODRIVER") == nullptr)
        throw std::runtime_error(
            "there is no display; with SDL_VIDEODRIVER=offscreen in the environment it is drawn without one");
    ask_for_gl();
    const Uint32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
    m_native->window =
        SDL_CreateWindow(def.title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, def.width, def.height, flags);
    if (m_native->window == nullptr)
        fail("no window");
    SDL_SetWindowMinimumSize(m_native->window, std::min(def.width, 320), std::min(def.height, 240));
    m_native->gl = SDL_GL_CreateContext(m_native->window);
    if (m_native->gl == nullptr)
        fail("no OpenGL 3.3");
    m_native->paced = SDL_GL_SetSwapInterval(def.vertical_sync && !m_native->offscreen ? 1 : 0) == 0 || m_native->offscreen;
    m_native->imgui = ImGui::CreateContext();
    start_imgui(m_native->window, m_native->gl);
    if (def.fullscreen)
        set_fullscreen(true);
}

Window::~Window() = default;

// SDL stamps an event when it is fetched, so events are fetched all the time until it is time to begin the frame, not at once after the
// display was waited for.
void Window::poll()
{
    m_events.clear();
    fetch_events();
    if (m_native->offscreen)
        return;
    constexpr double in_hand = 3; // ms
    const double due = m_native->shown + frame_ms(m_native->window) - m_native->work - in_hand;
    while (!m_quit && now_ms() < due)
    {
        SDL_Delay(1);
        fetch_events();
    }
}

void Window::fetch_events()
{
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0)
    {
        ImGui_ImplSDL2_ProcessEvent(&event);
        // SDL turns SIGINT and SIGTERM into SDL_QUIT too: whoever ignores it can only be killed.
        if (event.type == SDL_QUIT)
            m_quit = true;
        m_events.push_back(event);
    }
}

bool Window::begin_frame()
{
    poll();
    if (m_quit)
        return false;
    m_native->begun = now_ms();
    if (m_fonts.prepare(pixel_scale()))
    {
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplSDL2_NewFrame();
    ImGui::NewFrame();
    return true;
}

void Window::end_frame(Image* capture)
{
    ImGui::Render();
    int width = 0;
    int height = 0;
    SDL_GL_GetDrawableSize(m_native->window, &width, &height);
    glViewport(0, 0, width, height);
    glClearColor(m_background.r, m_background.g, m_background.b, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (capture != nullptr)
        read_pixels(*capture);
    m_native->work = std::max(now_ms() - m_native->begun, 0.95 * m_native->work);
    SDL_GL_SwapWindow(m_native->window);
    m_native->shown = now_ms();
    // A display that cannot pace frames would let the loop eat a whole core.
    if (!m_native->paced)
        SDL_Delay(4);
}

void Window::read_pixels(Image& image) const
{
    SDL_GL_GetDrawableSize(m_native->window, &image.width, &image.height);
    const auto row = static_cast<std::size_t>(image.width) * 3;
    const auto rows = static_cast<std::size_t>(image.height);
    std::vector<std::uint8_t> bottom_up(row * rows);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
    image.pixels.resize(bottom_up.size());
    for (std::size_t y = 0; y < rows; ++y)
        std::memcpy(&image.pixels[y * row], &bottom_up[(rows - 1 - y) * row], row);
}

bool Window::wants_keyboard() const { return ImGui::GetIO().WantTextInput; }
bool Window::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Window::has_focus() const { return (SDL_GetWindowFlags(m_native->window) & SDL_WINDOW_INPUT_FOCUS) != 0; }
Vec2 Window::mouse() const
{
    int x = 0;
    int y = 0;
    SDL_GetMouseState(&x, &y);
    return {static_cast<float>(x), static_cast<float>(y)};
}
bool Window::is_offscreen() const { return m_native->offscreen; }

Vec2 Window::size() const
{
    int width = 0;
    int height = 0;
    SDL_GetWindowSize(m_native->window, &width, &height);
    return {static_cast<float>(width), static_cast<float>(height)};
}

float Window::pixel_scale() const
{
    int pixels = 0;
    int height = 0;
    SDL_GL_GetDrawableSize(m_native->window, &pixels, &height);
    return size().x > 0 ? static_cast<float>(pixels) / size().x : 1;
}

void Window::set_title(const std::string& title) { SDL_SetWindowTitle(m_native->window, title.c_str()); }

void Window::set_fullscreen(bool fullscreen)
{
    SDL_SetWindowFullscreen(m_native->window, fullscreen ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
}

bool Window::is_fullscreen() const { return (SDL_GetWindowFlags(m_native->window) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0; }

Canvas Window::canvas(const Camera& camera) { return make_canvas(ImGui::GetBackgroundDrawList(), camera, *this); }
Canvas Window::canvas() { return canvas(Camera::screen(size())); }
Canvas Window::foreground() { return make_canvas(ImGui::GetForegroundDrawList(), Camera::screen(size()), *this); }

} // namespace carom::view
