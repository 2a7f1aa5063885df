// Eight lanes as with AVX2, with twice as many registers and masks of their own.
#if defined(__x86_64__)
#define CAROM_ISA avx512
#define CAROM_ISA_NAME "avx512"
#include "kernels.inl"
#endif
