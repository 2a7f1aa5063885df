// The kernels for the instruction set that every machine of the platform has.
#define CAROM_ISA baseline
#define CAROM_ISA_NAME lanes::baseline_name
#include "kernels.inl"
