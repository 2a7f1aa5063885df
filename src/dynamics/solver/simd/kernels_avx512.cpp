// The kernels for AVX-512: eight lanes as with AVX2, with twice as many registers and with mask registers.
#include "core/compiler.h"
#if CAROM_HAS_AVX_KERNELS
#if !defined(__AVX512VL__)
#error "the options for these kernels are missing"
#endif
#define CAROM_ISA avx512
#define CAROM_ISA_NAME "avx512"
#include "kernels.inl"
#endif
