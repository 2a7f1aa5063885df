#include "speed/contestant.h"

namespace speed {
namespace {

// The engine's kernels are compiled for what the whole build is compiled for.
const char* carom_isa()
{
#if defined(__AVX512F__)
    return "avx512";
#elif defined(__AVX2__)
    return "avx2";
#elif defined(__x86_64__)
    return "sse2";
#elif defined(__aarch64__)
    return "neon";
#else
    return "scalar";
#endif
}

} // namespace

std::vector<Contender> contenders()
{
    std::vector<Contender> list{{"carom", std::string("Carom ") + CAROM_VERSION_STRING, carom_isa(), 64, enter_carom}};
    for (const truth::Engine& engine : truth::engines())
    {
        if (engine.peer)
        {
            const auto enter = [engine](const carom::scenes::SceneEntry& entry, const carom::SceneDef& def)
            { return enter_peer(engine, entry, def); };
            list.push_back({engine.key, engine.name, "as installed", engine.most_threads, enter});
        }
    }
    return list;
}

} // namespace speed
