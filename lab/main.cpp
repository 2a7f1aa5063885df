// carom-lab: every scene in a window, under the x-ray, or headless as one JSON object.

#include "lab/headless.h"
#include "lab/viewer.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

using namespace carom;

struct Arguments
{
    std::string scene = "pyramid";
    std::string screenshot;
    std::string size = "1280x800";
    int steps = -1;
    int substeps = SceneDef{}.substeps;
    int look_at_substep = -1;
    int select = -1;
    float h = 0;
    bool list = false;
    bool headless = false;
    bool json = false;
    bool xray = false;
};

void add_options(CLI::App& app, Arguments& a)
{
    app.add_flag("--list", a.list, "names and descriptions of all scenes");
    app.add_option("--scene", a.scene, "the scene to start with")->capture_default_str();
    app.add_flag("--headless", a.headless, "no window: take the steps and report");
    app.add_flag("--json", a.json, "report as one JSON object (the only report there is)");
    app.add_option("--steps", a.steps, "steps for --headless (default: the scene's own number) and --screenshot (default: 0)")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--step-time", a.h, "seconds a step, headless (default: the scene's own)")->check(CLI::PositiveNumber);
    app.add_option("--substeps", a.substeps, "sub-steps a step, headless")->check(CLI::Range(1, 64))->capture_default_str();
    app.add_option("--screenshot", a.screenshot, "render off the screen, write this PNG file and end");
    app.add_option("--size", a.size, "WIDTHxHEIGHT of the window")->capture_default_str();
    app.add_flag("--xray", a.xray, "start under the x-ray");
    app.add_option("--select", a.select, "with --screenshot: the number of the body whose story is told")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--substep", a.look_at_substep, "with --screenshot: the sub-step of the last step to look at");
}

int list_scenes()
{
    for (const scenes::SceneEntry& entry : scenes::all_scenes())
        std::printf("%-22s%s\n", std::string(entry.name).c_str(), std::string(entry.description).c_str());
    return 0;
}

int headless(const Arguments& a, const scenes::SceneEntry& entry)
{
    lab::HeadlessRun run{.entry = &entry, .steps = a.steps >= 0 ? a.steps : entry.frames, .h = a.h};
    run.base.substeps = a.substeps;
    std::printf("%s\n", lab::run_headless(run).c_str());
    return 0;
}

bool parse_size(const std::string& text, lab::ViewerOptions& options)
{
    char rest = 0;
    return std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &rest) == 2 && options.width >= 64 &&
           options.height >= 64 && options.width <= 16384 && options.height <= 16384;
}

int window(const Arguments& a, const scenes::SceneEntry& entry)
{
    lab::ViewerOptions options{.entry = &entry,
                               .xray = a.xray,
                               .screenshot = a.screenshot,
                               .steps = std::max(a.steps, 0),
                               .select = a.select,
                               .substep = a.look_at_substep};
    if (!parse_size(a.size, options))
    {
        std::fprintf(stderr, "carom-lab: --size %s is not WIDTHxHEIGHT from 64 to 16384\n", a.size.c_str());
        return 2;
    }
    // A picture needs no display; who sets the driver himself keeps it.
    if (!a.screenshot.empty())
        setenv("SDL_VIDEODRIVER", "offscreen", 0);
    return lab::run_viewer(options);
}

int run(const Arguments& a)
{
    if (a.list)
        return list_scenes();
    const scenes::SceneEntry* entry = scenes::find_scene(a.scene);
    if (entry == nullptr)
    {
        std::fprintf(stderr, "carom-lab: there is no scene \"%s\"; --list names them\n", a.scene.c_str());
        return 2;
    }
    return a.headless ? headless(a, *entry) : window(a, *entry);
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app{"Carom lab: scenes, x-ray and numbers"};
    Arguments arguments;
    add_options(app, arguments);
    CLI11_PARSE(app, argc, argv);
    try
    {
        return run(arguments);
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "carom-lab: %s\n", error.what());
        return 1;
    }
}
