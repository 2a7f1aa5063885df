// For what every machine of the platform has.
#define CAROM_ISA baseline
#if defined(__x86_64__)
#define CAROM_ISA_NAME "sse2"
#elif defined(__aarch64__)
#define CAROM_ISA_NAME "neon"
#elif defined(__wasm_simd128__)
#define CAROM_ISA_NAME "wasm"
#else
#define CAROM_ISA_NAME "baseline"
#endif
#include "kernels.inl"
