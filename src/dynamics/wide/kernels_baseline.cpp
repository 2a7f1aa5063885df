// For what every machine of the platform has.
#define CAROM_ISA baseline
#define CAROM_ISA_NAME "baseline"
#include "kernels.inl"
