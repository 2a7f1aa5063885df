#include "core/compiler.h"
#if CAROM_HAS_AVX_KERNELS
#define CAROM_ISA avx2
#define CAROM_ISA_NAME "avx2"
#include "kernels.inl"
#endif
