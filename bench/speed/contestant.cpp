#include "speed/contestant.h"

#include "carom/scene.h"

namespace speed {
std::vector<Contender> contenders()
{
    std::vector<Contender> list{
        {"carom", std::string("Carom ") + CAROM_VERSION_STRING, carom::instruction_set(), 64, enter_carom}};
    for (const truth::Engine& engine : truth::engines())
    {
        if (engine.peer)
        {
            const auto enter = [engine](const SceneMaker& build, const carom::SceneDef& def)
            { return enter_peer(engine, build, def); };
            list.push_back({engine.key, engine.name, "as installed", engine.most_threads, enter});
        }
    }
    return list;
}

} // namespace speed
