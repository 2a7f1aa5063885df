// The kernels for AVX2: eight lanes to a register.
#include "core/compiler.h"
#if CAROM_HAS_AVX_KERNELS
#if !defined(__AVX2__)
#error "the options for these kernels are missing"
#endif
#define CAROM_ISA avx2
#define CAROM_ISA_NAME "avx2"
#include "kernels.inl"
#endif
