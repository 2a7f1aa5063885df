// Which set of kernels this machine runs.

#include "dynamics/wide_kernels.h"

#include <cstdlib>
#include <string_view>

namespace carom::internal {

namespace baseline {
extern const WideKernels kernels;
}
#if defined(__x86_64__)
namespace avx2 {
extern const WideKernels kernels;
}
namespace avx512 {
extern const WideKernels kernels;
}
#endif

namespace {

const WideKernels& choose()
{
#if defined(__x86_64__)
    const char* wish = std::getenv("CAROM_ISA");
    const std::string_view most = wish != nullptr ? wish : "avx512";
    __builtin_cpu_init();
    const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
    const bool has_avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0;
    if (most == "avx512" && has_avx512)
        return avx512::kernels;
    if (most != "sse2" && has_avx2)
        return avx2::kernels;
#endif
    return baseline::kernels;
}

} // namespace

const WideKernels& wide_kernels()
{
    static const WideKernels& chosen = choose();
    return chosen;
}

} // namespace carom::internal
