#if defined(__x86_64__)
#define CAROM_ISA avx2
#define CAROM_ISA_NAME "avx2"
#include "kernels.inl"
#endif
