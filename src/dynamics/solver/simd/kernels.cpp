// Selects the set of kernels for this machine.

#include "dynamics/solver/simd/kernels.h"
#include "carom/scene.h"
#include "core/compiler.h"

#include <array>
#include <cstdlib>
#include <string_view>

namespace carom::internal {

namespace baseline {
extern const WideKernels kernels;
}
#if CAROM_HAS_AVX_KERNELS
namespace avx2 {
extern const WideKernels kernels;
}
namespace avx512 {
extern const WideKernels kernels;
}
#endif

namespace {

struct Sets
{
    std::array<const WideKernels*, 3> list{&baseline::kernels};
    std::size_t count = 1;

    Sets()
    {
#if CAROM_HAS_AVX_KERNELS
        if (has_avx2())
            list[count++] = &avx2::kernels;
        if (has_avx512())
            list[count++] = &avx512::kernels;
#endif
    }
};

const Sets& sets()
{
    static const Sets all;
    return all;
}

// The environment variable names the best set allowed; a name that is unknown or that the machine does not support is ignored.
const WideKernels* choose()
{
    const char* wish = std::getenv("CAROM_ISA");
    for (std::size_t i = 0; wish != nullptr && i < sets().count; ++i)
    {
        if (std::string_view(wish) == sets().list[i]->name)
            return sets().list[i];
    }
    return sets().list[sets().count - 1];
}

const WideKernels*& chosen()
{
    static const WideKernels* kernels = choose();
    return kernels;
}

} // namespace

const WideKernels& wide_kernels() { return *chosen(); }

std::span<const WideKernels* const> all_wide_kernels() { return {sets().list.data(), sets().count}; }

void use_wide_kernels(const WideKernels& kernels) { chosen() = &kernels; }

} // namespace carom::internal

namespace carom {

const char* instruction_set() { return internal::wide_kernels().name; }

} // namespace carom
