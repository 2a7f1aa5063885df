// carom-web SCENE: a run of the scene on Carom, its mean step in ms. carom-web --describe SCENE, in a native build: the scene for other engines. Both as JSON.

#include "web/describe.h"
#include "web/scenes.h"

#include <chrono>
#include <cstdio>
#include <cstring>

namespace {

using carom::scenes::BuiltScene;
using carom::scenes::SceneEntry;

void run(const SceneEntry& entry)
{
    using Clock = std::chrono::steady_clock;
    BuiltScene built = entry.create({});
    for (int i = 0; i < web::warm_up; ++i)
        built.step(entry.h);
    const Clock::time_point start = Clock::now();
    for (int i = web::warm_up; i < entry.frames; ++i)
        built.step(entry.h);
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    const std::vector<carom::BodyId> bodies = built.scene.bodies();
    double height = 0;
    for (const carom::BodyId body : bodies)
        height += built.scene.body(body).position().y / static_cast<double>(bodies.size());
    std::printf("{\"ms\": %.6f, \"height\": %.6f}\n", ms / (entry.frames - web::warm_up), height);
}

} // namespace

int main(int count, char** arguments)
{
    const char* name = count > 1 ? arguments[count - 1] : "";
    for (const SceneEntry& entry : web::scenes())
    {
        if (entry.name != name)
            continue;
#if defined(CAROM_DESCRIBES)
        if (count == 3 && std::strcmp(arguments[1], "--describe") == 0)
        {
            std::puts(web::describe(entry).c_str());
            return 0;
        }
#endif
        run(entry);
        return 0;
    }
    std::fprintf(stderr, "carom-web: there is no scene \"%s\", but pyramid, tumbler and pile\n", name);
    return 2;
}
