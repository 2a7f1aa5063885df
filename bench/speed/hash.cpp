// carom-hash [scene [steps]]: the state hash of a scene after so many steps on one thread; without a scene, of the ten scenes of the
// benchmark at their ends. It needs nothing but the engine, so that it can be built for any machine: `scripts/verify` compares them.

#include "scenes/scenes.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>

using namespace carom;

static void print(const scenes::SceneEntry& entry, int steps)
{
    scenes::BuiltScene built = entry.create({});
    for (int i = 0; i < steps; ++i)
        built.step(entry.h);
    std::printf("%-14s %5d  %016llx\n", std::string(entry.name).c_str(), steps,
                static_cast<unsigned long long>(built.scene.state_hash()));
    std::fflush(stdout);
}

int main(int argc, char** argv)
{
    if (argc < 2)
    {
        for (const scenes::SceneEntry& entry : scenes::benchmark_scenes())
            print(entry, entry.frames);
        return 0;
    }
    const scenes::SceneEntry* entry = scenes::find_scene(argv[1]);
    const int steps = argc > 2 ? std::atoi(argv[2]) : entry != nullptr ? entry->frames : 0;
    if (entry == nullptr || steps < 1)
    {
        std::cerr << "carom-hash: " << (entry == nullptr ? "there is no scene of that name" : "steps are 1 or more") << '\n';
        return 2;
    }
    print(*entry, steps);
}
