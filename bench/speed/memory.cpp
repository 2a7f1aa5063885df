#include "speed/memory.h"

#include <sys/resource.h>

#include <cstdio>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace speed {

#ifdef __GLIBC__
std::size_t heap_bytes()
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}
#else
std::size_t heap_bytes() { return 0; }
#endif

std::size_t peak_bytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024; // Linux counts in KiB
}

void forget_peak()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    // 5: Linux sets the peak back to what is resident now.
    if (std::FILE* file = std::fopen("/proc/self/clear_refs", "w"))
    {
        std::fputs("5", file);
        std::fclose(file);
    }
}

} // namespace speed
